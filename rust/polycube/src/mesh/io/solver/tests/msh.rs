//! Gmsh's text.

use super::*;

fn section<'a>(text: &'a str, name: &str) -> std::str::Lines<'a> {
    let (_, rest) = text.split_once(&format!("${name}\n")).unwrap();
    rest.split_once(&format!("$End{name}\n")).unwrap().0.lines()
}

/// The numbers of the physical groups of each entity by dimension and number.
fn entities(text: &str) -> BTreeMap<(u32, u32), Vec<u32>> {
    let mut lines = section(text, "Entities");
    let counts: Vec<usize> = numbers(lines.next().unwrap());
    assert_eq!(counts[..2], [0, 0]);
    let dimensions = std::iter::repeat_n(2, counts[2]).chain(std::iter::repeat_n(3, counts[3]));
    let entity = |(dimension, line): (u32, &str)| {
        let all: Vec<f64> = numbers(line);
        assert!((1..4).all(|k| all[k] < all[k + 3] || dimension == 2 && all[k] == all[k + 3]));
        let groups = all[8..8 + all[7] as usize].iter().map(|&x| x as u32).collect();
        assert_eq!((all.len(), all[all.len() - 1]), (9 + all[7] as usize, 0.0));
        ((dimension, all[0] as u32), groups)
    };
    dimensions.zip(lines).map(entity).collect()
}

fn points(text: &str) -> Vec<Point> {
    let mut lines = section(text, "Nodes");
    let header: Vec<usize> = numbers(lines.next().unwrap());
    let mut found = BTreeMap::new();
    for _ in 0..header[0] {
        let block: Vec<usize> = numbers(lines.next().unwrap());
        let tags: Vec<usize> = lines.by_ref().take(block[3]).map(|line| line.parse().unwrap()).collect();
        for tag in tags {
            let x: Vec<f64> = numbers(lines.next().unwrap());
            assert!(found.insert(tag, Point::new(x[0], x[1], x[2])).is_none());
        }
    }
    assert_eq!((lines.next(), header[1..].to_vec()), (None, vec![found.len(), 1, found.len()]));
    assert!(found.keys().copied().eq(1..=found.len()));
    found.into_values().collect()
}

/// The elements of each entity with their numbers.
fn elements(text: &str) -> BTreeMap<(u32, u32), Vec<Vec<u32>>> {
    let mut lines = section(text, "Elements");
    let header: Vec<usize> = numbers(lines.next().unwrap());
    let mut found = BTreeMap::new();
    for _ in 0..header[0] {
        let block: Vec<u32> = numbers(lines.next().unwrap());
        assert_eq!(block[2], if block[0] == 2 { 3 } else { 5 });
        let all: Vec<Vec<u32>> = lines.by_ref().take(block[3] as usize).map(numbers).collect();
        assert!(found.insert((block[0], block[1]), all).is_none());
    }
    let tags: BTreeSet<u32> = found.values().flatten().map(|element| element[0]).collect();
    assert_eq!((lines.next(), tags.len()), (None, header[1]));
    found
}

#[test]
fn entities_elements_and_names_are_those_of_the_box() {
    let mesh = box_mesh();
    let hexes = grouped(&mesh);
    let text = texts(SolverFormat::Msh, &hexes).remove(0);
    assert_eq!(section(&text, "MeshFormat").collect::<Vec<_>>(), ["4.1 0 8"]);
    let name = |line: &str| {
        let (numbers, name) = line.split_once(" \"").unwrap();
        let (dimension, number) = numbers.split_once(' ').unwrap();
        ((dimension.parse().unwrap(), number.parse().unwrap()), name.trim_end_matches('"').to_owned())
    };
    let names: BTreeMap<(u32, u32), String> = section(&text, "PhysicalNames").skip(1).map(name).collect();
    // Two of the twelve patches are empty, as both blocks reach four sides only.
    assert_eq!(names.len(), 6 + 10 + 2);
    assert_eq!(points(&text), mesh.points());
    let entities = entities(&text);
    let (mut quads, mut count) = (Vec::new(), 0);
    for (entity, all) in elements(&text) {
        let told: Vec<&str> = entities[&entity].iter().map(|&group| names[&(entity.0, group)].as_str()).collect();
        for element in all {
            if entity.0 == 2 {
                quads.push(array::<4>(&element[1..], 1));
                let on = side(mesh.points(), quads[quads.len() - 1]).unwrap();
                assert_eq!(told, [SIDES[on].to_owned(), format!("facet_{}", entity.1 - 1)]);
                assert_eq!((entity.1 - 1) / 2, on as u32);
            } else {
                let cell = element[0] as usize - 1;
                assert_eq!(array(&element[1..], 1), cells(&mesh)[cell]);
                assert_eq!(told, [format!("block_{}", hexes.blocks().of()[cell])]);
                count += 1;
            }
        }
    }
    assert_eq!(count, cells(&mesh).len());
    encloses_the_box(mesh.points(), &quads);
}
