//! The input of Abaqus and CalculiX.

use super::*;

/// The nodes of the faces S1 to S6 of a C3D8 element, as in the manual of CalculiX.
const FACES: [[usize; 4]; 6] = [[1, 2, 3, 4], [5, 8, 7, 6], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 8, 4], [4, 8, 5, 1]];

/// The lines under each keyword with its parameters.
fn sections(text: &str) -> BTreeMap<&str, Vec<&str>> {
    let mut found = BTreeMap::new();
    let mut last = "";
    for line in text.lines() {
        if line.starts_with('*') {
            last = line;
            assert!(found.insert(last, Vec::new()).is_none(), "{last}");
        } else {
            found.get_mut(last).unwrap().push(line);
        }
    }
    found
}

fn all<'a>(sections: &'a BTreeMap<&str, Vec<&str>>, keyword: &str) -> Vec<(String, Vec<&'a str>)> {
    let strip = |key: &str| key.strip_prefix(keyword).map(str::to_owned);
    sections.iter().filter_map(|(key, lines)| Some((strip(key)?, lines.clone()))).collect()
}

#[test]
fn elements_sets_and_surfaces_are_those_of_the_box() {
    let mesh = box_mesh();
    let hexes = grouped(&mesh);
    let text = texts(SolverFormat::Inp, &hexes).remove(0);
    let sections = sections(&text);
    for (i, line) in sections["*NODE, NSET=all_nodes"].iter().enumerate() {
        let all: Vec<f64> = numbers(line);
        assert_eq!(all[0], i as f64 + 1.0);
        assert!((Point::new(all[1], all[2], all[3]) - mesh.points()[i]).norm() < 1e-12);
        assert!(line.split(", ").all(|word| word.len() <= 20), "CalculiX reads 20 characters of {line}");
    }
    for (i, line) in sections["*ELEMENT, TYPE=C3D8, ELSET=all_elements"].iter().enumerate() {
        let all: Vec<u32> = numbers(line);
        assert_eq!((all[0], array(&all[1..], 1)), (i as u32 + 1, cells(&mesh)[i]));
    }
    let mut elements = BTreeSet::new();
    for (name, lines) in all(&sections, "*ELSET, ELSET=") {
        for element in lines.iter().flat_map(|line| numbers::<usize>(line)) {
            assert_eq!(name, format!("block_{}", hexes.blocks().of()[element - 1]));
            assert!(elements.insert(element));
        }
    }
    assert_eq!(elements.len(), cells(&mesh).len());
    assert!(text.lines().all(|line| line.split(',').count() <= 16));
}

#[test]
fn each_face_of_the_outside_is_in_one_side_and_one_facet() {
    let mesh = box_mesh();
    let text = texts(SolverFormat::Inp, &grouped(&mesh)).remove(0);
    let sections = sections(&text);
    let nodes: BTreeMap<_, _> = all(&sections, "*NSET, NSET=").into_iter().collect();
    let mut quads: [Vec<[u32; 4]>; 2] = [Vec::new(), Vec::new()];
    for (name, lines) in all(&sections, "*SURFACE, TYPE=ELEMENT, NAME=") {
        let quad = |line: &&str| {
            let (element, face) = line.split_once(", S").unwrap();
            let cell = &cells(&mesh)[element.parse::<usize>().unwrap() - 1];
            // Counter-clockwise seen from inside.
            let mut quad = FACES[face.parse::<usize>().unwrap() - 1].map(|node| cell[node - 1]);
            quad.reverse();
            quad
        };
        let found: Vec<[u32; 4]> = lines.iter().map(quad).collect();
        let on = side(mesh.points(), found.iter().flatten().copied()).unwrap();
        let told: BTreeSet<u32> = nodes[&name].iter().flat_map(|line| numbers::<u32>(line)).collect();
        assert_eq!(told, found.iter().flatten().map(|v| v + 1).collect());
        let facet = name.strip_prefix("facet_").map(|i| i.parse::<usize>().unwrap());
        assert!(facet.map_or(SIDES[on] == name, |facet| facet / 2 == on), "{name}");
        quads[usize::from(facet.is_some())].extend(found);
    }
    for quads in quads {
        encloses_the_box(mesh.points(), &quads);
    }
}
