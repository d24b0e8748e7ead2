//! OpenFOAM's texts.

use super::*;

/// What is in the outermost parentheses, after the number before them.
fn list(text: &str) -> (usize, &str) {
    let (header, rest) = text.split_once("}\n").unwrap();
    assert!(header.starts_with("FoamFile\n{"));
    let (count, rest) = rest.split_once("\n(\n").unwrap();
    (count.parse().unwrap(), rest.strip_suffix(")\n").unwrap())
}

fn lines<T: std::str::FromStr>(text: &str) -> Vec<Vec<T>> {
    let (count, list) = list(text);
    assert_eq!(count, list.lines().count());
    list.lines().map(numbers).collect()
}

/// The named dictionaries of a list.
fn entries(text: &str) -> Vec<(String, String)> {
    let (count, list) = list(text);
    let entry = |part: &str| part.trim().split_once("\n").map(|(name, rest)| (name.to_owned(), rest.to_owned()));
    let found: Vec<_> = list.split("}\n").filter_map(entry).collect();
    assert_eq!(found.len(), count);
    found
}

fn number(entry: &str, key: &str) -> usize {
    let (_, rest) = entry.split_once(&format!("{key} ")).unwrap();
    rest.split_once(';').unwrap().0.parse().unwrap()
}

#[test]
fn faces_are_in_upper_triangular_order_and_close_every_cell() {
    let mesh = box_mesh();
    let files = texts(SolverFormat::Foam, &grouped(&mesh));
    let points: Vec<Point> = lines::<f64>(&files[0]).iter().map(|p| Point::new(p[0], p[1], p[2])).collect();
    assert_eq!(points, mesh.points());
    let faces: Vec<[u32; 4]> = lines::<u32>(&files[1].replace("4(", "(")).iter().map(|f| array(f, 0)).collect();
    let [owner, neighbour] = [2, 3].map(|i| lines::<usize>(&files[i]).concat());
    assert_eq!(owner.len(), faces.len());
    assert!(files[2].contains(&format!("nFaces:{} nInternalFaces:{}\"", faces.len(), neighbour.len())));
    let inner: Vec<_> = owner.iter().zip(&neighbour).collect();
    assert!(inner.iter().all(|(owner, neighbour)| owner < neighbour) && inner.is_sorted());
    let mut sums = vec![Vector3::zeros(); cells(&mesh).len()];
    let mut vertices = vec![BTreeSet::new(); cells(&mesh).len()];
    for (i, face) in faces.iter().enumerate() {
        let area = area_vector(&points, *face);
        sums[owner[i]] += area;
        vertices[owner[i]].extend(face);
        if let Some(&other) = neighbour.get(i) {
            sums[other] -= area;
            vertices[other].extend(face);
        }
    }
    assert!(sums.iter().all(|sum| sum.norm() < 1e-12));
    let expected: Vec<BTreeSet<u32>> = cells(&mesh).iter().map(|cell| cell.iter().copied().collect()).collect();
    assert_eq!(vertices, expected);
    encloses_the_box(&points, &faces[neighbour.len()..]);
}

#[test]
fn patches_follow_one_another_and_zones_are_blocks() {
    let mesh = box_mesh();
    let hexes = grouped(&mesh);
    let files = texts(SolverFormat::Foam, &hexes);
    let faces: Vec<[u32; 4]> = lines::<u32>(&files[1].replace("4(", "(")).iter().map(|f| array(f, 0)).collect();
    let mut next = list(&files[3]).0;
    for (name, entry) in entries(&files[4]) {
        let (start, count) = (number(&entry, "startFace"), number(&entry, "nFaces"));
        assert_eq!(start, next);
        next += count;
        let on = side(mesh.points(), faces[start..next].iter().flatten().copied()).unwrap();
        assert!(entry.contains(&format!("inGroups 1({});", SIDES[on])), "{entry}");
        assert_eq!(name.strip_prefix("facet_").unwrap().parse::<usize>().unwrap() / 2, on);
    }
    assert_eq!(next, faces.len());
    let mut found = vec![None; cells(&mesh).len()];
    for (name, entry) in entries(&files[5]) {
        let (_, cells) = entry.split_once("List<label> ").unwrap();
        let all: Vec<usize> = numbers(&cells.replace('\n', " "));
        assert_eq!(all[0], all.len() - 1);
        all[1..].iter().for_each(|&cell| assert_eq!(found[cell].replace(name.clone()), None));
    }
    let blocks = hexes.blocks();
    let names: Vec<_> = blocks.of().iter().map(|&b| Some(blocks.names()[b as usize].clone())).collect();
    assert_eq!(found, names);
}
