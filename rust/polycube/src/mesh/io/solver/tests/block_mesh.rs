//! The dictionary of blockMesh.

use super::*;
use crate::map::testing::jittered;

/// What is between a keyword and the end of its list.
fn section<'a>(text: &'a str, keyword: &str) -> &'a str {
    let (_, rest) = text.split_once(&format!("\n{keyword}\n(\n")).unwrap();
    rest.split_once("\n);\n").map_or_else(|| rest.split_once(");\n").unwrap().0, |(section, _)| section)
}

#[test]
fn corners_counts_and_names_are_those_of_the_box() {
    let mesh = box_mesh();
    let text = texts(SolverFormat::BlockMesh, &grouped(&mesh)).remove(0);
    let corners: Vec<Point> =
        section(&text, "vertices").lines().map(numbers::<f64>).map(|p| Point::new(p[0], p[1], p[2])).collect();
    assert_eq!(corners.len(), 12);
    let mut volume = 0;
    for (i, line) in section(&text, "blocks").lines().filter(|line| line.starts_with("hex")).enumerate() {
        let all: Vec<u32> = numbers(line);
        assert!(line.contains(&format!(") block_{i} (")), "{line}");
        // Right-handed, from corner to corner.
        let at = |k: usize| corners[all[k] as usize];
        let steps = [at(1) - at(0), at(3) - at(0), at(4) - at(0)];
        assert!(steps[0].cross(&steps[1]).dot(&steps[2]) > 0.0);
        assert_eq!(steps.map(|s| s.norm().round() as u32), [all[8], all[9], all[10]]);
        volume += all[8] * all[9] * all[10];
    }
    assert_eq!(f64::from(volume), VOLUME);
    let boundary = section(&text, "boundary");
    for (name, entry) in SIDES.iter().flat_map(|side| {
        boundary.match_indices(&format!("({side});")).map(|(at, _)| (*side, &boundary[at..])).collect::<Vec<_>>()
    }) {
        let (_, faces) = entry.split_once("(\n").unwrap();
        for line in faces.split_once(");\n").map_or(faces, |f| f.0).lines().filter(|line| line.contains('(')) {
            let quad: Vec<u32> = numbers(line);
            let [a, b, _, d] = array::<4>(&quad, 0).map(|k| corners[k as usize]);
            let normal = (b - a).cross(&(d - a));
            let on = SIDES.iter().position(|side| *side == name).unwrap();
            assert!(normal[on / 2] * if on % 2 == 1 { 1.0 } else { -1.0 } > 0.0, "{name}: {line}");
        }
    }
    assert_eq!(boundary.matches("inGroups").count(), 10);
}

/// Twelve edges of each block have a section for each hexahedron, as long as that, and a line through its vertices.
#[test]
fn edges_have_all_their_vertices() {
    let mesh = jittered(&hex_box(SIZE), 0.1, 3).moved(|p| p + Vector3::new(1e-7, -0.1, 0.0)).unwrap();
    let hexes = grouped(&mesh);
    let text = texts(SolverFormat::BlockMesh, &hexes).remove(0);
    let lines: Vec<Vec<f64>> = section(&text, "edges").lines().map(numbers).collect();
    // Of 20 edges of two blocks those along x of the first have one hexahedron.
    assert_eq!(lines.len(), 16);
    for line in &lines {
        let point = Point::new(line[2], line[3], line[4]);
        assert!(mesh.points().contains(&point));
    }
    let sections =
        section(&text, "blocks").lines().filter(|line| line.starts_with("((")).map(|l| l.matches(" 1 1)").count());
    assert_eq!(sections.collect::<Vec<_>>(), [vec![1; 4], vec![2; 8], vec![2; 12]].concat());
}

/// The points and quadrilaterals of an OBJ file.
fn obj(text: &str) -> (Vec<Point>, Vec<[u32; 4]>) {
    let of = |key: &'static str| text.lines().filter_map(move |line| line.strip_prefix(key));
    let points = of("v ").map(numbers::<f64>).map(|p| Point::new(p[0], p[1], p[2])).collect();
    (points, of("f ").map(|line| array(&numbers::<u32>(line), 1)).collect())
}

/// Faces with vertices inside are put on the outside of the box or on the plane between its blocks.
#[test]
fn wide_faces_lie_on_the_surfaces_written() {
    let mesh = box_mesh();
    let hexes = grouped(&mesh);
    let [text, outside, between] = texts(SolverFormat::BlockMesh, &hexes).try_into().unwrap();
    let on = |surface: &str| section(&text, "faces").lines().filter(|line| line.ends_with(surface)).count();
    // All of the second block but the one between, and of the first, one hexahedron thick, that across it.
    assert_eq!((on(") boundary"), on(") between")), (6, 1));
    let (points, quads) = obj(&outside);
    assert_eq!((points.len(), quads.len()), (QUADS + 2, QUADS));
    assert!(quads.iter().all(|quad| side(&points, *quad).is_some()));
    let area = |(points, quads): &(Vec<Point>, Vec<[u32; 4]>)| -> f64 {
        quads.iter().map(|quad| area_vector(points, *quad).norm()).sum()
    };
    assert!((area(&(points, quads)) - QUADS as f64).abs() < 1e-9);
    let middle = obj(&between);
    assert!(middle.0.iter().all(|p| (p.x - 1.0).abs() < 1e-6));
    assert!((area(&middle) - 4.0).abs() < 1e-9);
}

/// blockMesh tells faces apart by their corners alone.
#[test]
fn blocks_with_the_same_corners_are_refused() {
    let mesh = hex_box([2, 2, 4]);
    let glued = |v: u32| if v >= 36 { v - 36 } else { v };
    let all: Vec<[u32; 8]> = cells(&mesh).iter().map(|c| c.map(glued)).collect();
    let mesh = Mesh::new(mesh.points().to_vec(), Cells::Hexahedra(all)).unwrap();
    let outside: BTreeSet<Vec<u32>> = mesh.cells().boundary().unwrap().iter().map(|f| f.vertices().to_vec()).collect();
    let faces = (0..16).flat_map(|cell| (0..6).map(move |face| HexFace { cell, face }));
    let boundary: Vec<HexFace> = faces.filter(|f| outside.contains(f.vertices(cells(&mesh)).as_slice())).collect();
    let one = |name| Groups::numbered(name, vec![0; boundary.len()]).unwrap();
    let blocks =
        |split: u32| Groups::numbered("block", (0..16).map(|cell| u32::from(cell >= split)).collect()).unwrap();
    let (patches, sides) = (one("patch"), one("side"));
    for split in [8, 16] {
        let hexes = GroupedHexes::new(&mesh, blocks(split), boundary.clone(), patches.clone(), sides.clone()).unwrap();
        let error = write_solver_bytes(SolverFormat::BlockMesh, "ring", &hexes).unwrap_err();
        assert!(error.kind == ErrorKind::Unsupported && error.remedy.contains("json"), "{error}");
        write_solver_bytes(SolverFormat::Json, "ring", &hexes).unwrap();
    }
}
