//! Meshes that are almost polycubes are read and their deviation is told; the others are refused, naming the element.

mod common;

use common::{dense, paper, read, simplify};
use nalgebra::{Rotation3, Vector3};
use polycube::generate::{Cuboid, Voxels, random_polycube};
use polycube::mesh::{CellKind, Cells, Mesh, Point};
use polycube::parts::SplitMix64;
use polycube::simplify::{Input, read_structure};
use polycube::structure::{Polycube, Tolerance, Violation};
use polycube::{Error, Place, SimplifyOptions};

/// The surface of unit quadrilaterals of boxes.
fn quads(boxes: &[([i64; 3], [i64; 3])]) -> Mesh {
    surface(boxes, CellKind::Quads)
}

fn surface(boxes: &[([i64; 3], [i64; 3])], kind: CellKind) -> Mesh {
    let boxes: Vec<Cuboid> = boxes.iter().map(|b| Cuboid::new(b.0, b.1)).collect();
    Voxels::from_boxes(&boxes).expect("boxes").mesh(kind, 1.0).expect("a mesh")
}

fn cube(n: i64) -> Mesh {
    quads(&[([0; 3], [n; 3])])
}

fn vertex(mesh: &Mesh, at: [f64; 3]) -> u32 {
    mesh.points().iter().position(|p| *p == Point::from(at)).expect("a vertex lies there") as u32
}

/// The face whose vertices have the mean `at`.
fn face(mesh: &Mesh, at: [f64; 3]) -> u32 {
    let middle = |i: usize| {
        let cell = mesh.cells().cell(i);
        cell.iter().map(|&v| mesh.points()[v as usize].coords).sum::<Vector3<f64>>() / cell.len() as f64
    };
    (0..mesh.cells().len()).position(|i| middle(i) == Vector3::from(at)).expect("a face lies there") as u32
}

fn faces(mesh: &Mesh) -> &[[u32; 4]] {
    match mesh.cells() {
        Cells::Quads(faces) => faces,
        _ => unreachable!("the mesh has quadrilaterals"),
    }
}

/// The mesh with other quadrilaterals.
fn with_faces(mesh: &Mesh, change: impl FnOnce(&mut Vec<[u32; 4]>)) -> Mesh {
    let mut own = faces(mesh).to_vec();
    change(&mut own);
    Mesh::new(mesh.points().to_vec(), Cells::Quads(own)).expect("a mesh")
}

/// The mesh with one vertex elsewhere.
fn with_vertex(mesh: &Mesh, v: u32, change: impl FnOnce(&mut Point)) -> Mesh {
    mesh.clone().edited(|points, _| change(&mut points[v as usize])).expect("a mesh")
}

fn violations_of(mesh: &Mesh, labels: Option<&[i8]>) -> Vec<Violation> {
    Polycube::new(mesh, labels, &Tolerance::default()).expect_err("the mesh is no polycube")
}

/// Violations name the edges of face `i`, in any order and direction.
fn edges_of(mesh: &Mesh, i: u32) -> Vec<[u32; 2]> {
    let v = mesh.cells().cell(i as usize);
    let mut edges: Vec<[u32; 2]> = (0..v.len()).map(|k| [v[k], v[(k + 1) % v.len()]]).map(ascending).collect();
    edges.sort_unstable();
    edges
}

fn ascending([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Labels by normals, with those of some faces replaced.
fn relabelled(mesh: &Mesh, changes: &[([f64; 3], i8)]) -> Vec<i8> {
    let mut labels = common::labels(&read(mesh));
    changes.iter().for_each(|(at, label)| labels[face(mesh, *at) as usize] = *label);
    labels
}

#[test]
fn turned_polycubes_are_read_and_the_angle_is_told() {
    for seed in 0..common::cases(60) {
        let mesh = random_polycube(seed, 5, 8).unwrap().mesh(CellKind::Quads, 1.0).unwrap();
        let straight = read(&mesh);
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 4_f64.to_radians());
        let result =
            simplify(&mesh.moved(|p| turn * p).unwrap(), &SimplifyOptions { scale: Some(1.0), ..paper() }).unwrap();
        assert_eq!(result.input.structure.edges.len(), straight.structure.edges.len(), "seed {seed}");
        let deviation = result.report.deviation;
        assert!((deviation.degrees - 4.0).abs() < 1e-6, "seed {seed}: {deviation:?}");
        assert!(deviation.distance > 0.0);
        assert_eq!(dense::check(&result.input.structure, &result.levels), Ok(()), "seed {seed}");
    }
}

#[test]
fn noisy_polycubes_have_the_structure_of_the_clean_ones() {
    let mut rng = SplitMix64::new(7);
    for seed in 0..common::cases(60) {
        let clean = random_polycube(seed, 5, 8).unwrap().mesh(CellKind::Quads, 1.0).unwrap();
        let mut noise = || 0.2 * rng.unit() - 0.1;
        let mesh = clean.moved(|p| p + Vector3::from([noise(), noise(), noise()])).unwrap();
        let result = simplify(&mesh, &SimplifyOptions { scale: Some(1.0), ..paper() }).unwrap();
        let expected = read(&clean);
        let found = &result.input;
        assert_eq!(found.structure, expected.structure, "seed {seed}");
        let off = found.placement.iter().zip(&expected.placement).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off <= 0.1, "seed {seed}: a level is off by {off}");
        assert!(result.report.deviation.distance > 0.0 && result.report.deviation.distance <= 0.1);
        assert_eq!(dense::check(&found.structure, &result.levels), Ok(()), "seed {seed}");
    }
}

#[test]
fn faces_beyond_the_angle_tolerance_are_skew() {
    let straight = cube(2);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 35_f64.to_radians());
    let sides: Vec<u32> = (0..24).filter(|&i| common::labels(&read(&straight))[i as usize] < 4).collect();
    let mesh = straight.moved(|p| turn * p).unwrap();
    let found = violations_of(&mesh, None);
    let skew = |v: &Violation| match v {
        Violation::SkewFace { face, degrees, limit: 30.0 } if (degrees - 35.0).abs() < 1e-9 => *face,
        other => panic!("{other} is not skew by 35 degrees"),
    };
    assert_eq!(found.iter().map(skew).collect::<Vec<_>>(), sides);
    let wide = Tolerance { degrees: 36.0, distance: 0.5, ..Tolerance::default() };
    assert!(Polycube::new(&mesh, None, &wide).is_ok());
}

#[test]
fn a_mesh_without_faces_is_empty() {
    let mesh = Mesh::new(Vec::new(), Cells::Quads(Vec::new())).unwrap();
    assert_eq!(violations_of(&mesh, None), [Violation::Empty]);
}

#[test]
fn a_face_of_three_cells_is_refused_at_the_third() {
    let points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1], [1, 1, 1]];
    let points = points.iter().map(|p| Point::from(p.map(f64::from))).collect();
    let cells = Cells::Tetrahedra(vec![[0, 1, 2, 3], [0, 2, 1, 4], [0, 1, 2, 5]]);
    assert_eq!(violations_of(&Mesh::new(points, cells).unwrap(), None), [Violation::CrowdedCell { cell: 2 }]);
}

#[test]
fn cells_that_use_a_vertex_twice_are_collapsed() {
    // A prism as a hexahedron, beside a whole one.
    let points =
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1], [2, 0, 0], [2, 0, 1]];
    let points = points.iter().map(|p| Point::from(p.map(f64::from))).collect();
    let cells = Cells::Hexahedra(vec![[0, 1, 2, 3, 4, 5, 6, 7], [1, 8, 2, 2, 5, 9, 6, 6]]);
    let mesh = Mesh::new(points, cells).unwrap();
    assert_eq!(violations_of(&mesh, None), [Violation::CollapsedCell { cell: 1, corners: 6 }]);
}

#[test]
fn faces_must_have_vertices_of_their_own() {
    let mesh = with_faces(&cube(1), |faces| faces[2][3] = faces[2][0]);
    assert_eq!(violations_of(&mesh, None), [Violation::BadFace { face: 2 }]);
}

/// The middle of the top moves into a corner: the triangles along the sides there lose their area.
#[test]
fn flat_faces_have_no_label() {
    let mesh = surface(&[([0; 3], [2; 3])], CellKind::Triangles);
    let labels = common::labels(&read(&mesh));
    let middle = vertex(&mesh, [1.0, 1.0, 2.0]);
    let mesh = with_vertex(&mesh, middle, |p| *p = Point::new(0.0, 0.0, 2.0));
    let p = |v: u32| mesh.points()[v as usize];
    let is_flat = |i: &u32| {
        let [a, b, c] = <[u32; 3]>::try_from(mesh.cells().cell(*i as usize)).unwrap().map(p);
        (b - a).cross(&(c - a)).norm() == 0.0
    };
    let flat: Vec<u32> = (0..mesh.cells().len() as u32).filter(is_flat).collect();
    assert!(!flat.is_empty());
    let expected: Vec<Violation> = flat.into_iter().map(|face| Violation::FlatFace { face }).collect();
    assert_eq!(violations_of(&mesh, None), expected);
    assert!(Polycube::new(&mesh, Some(&labels), &Tolerance::default()).is_ok());
}

#[test]
fn holes_are_open_edges() {
    let whole = cube(2);
    let mesh = with_faces(&whole, |faces| faces.truncate(faces.len() - 1));
    let open = |v: Violation| match v {
        Violation::OpenEdge { edge } => ascending(edge),
        other => panic!("{other} is no open edge"),
    };
    let mut found: Vec<_> = violations_of(&mesh, None).into_iter().map(open).collect();
    found.sort_unstable();
    assert_eq!(found, edges_of(&whole, 23));
}

#[test]
fn an_edge_of_four_faces_is_not_manifold() {
    let mesh = quads(&[([0; 3], [1; 3]), ([1, 1, 0], [2, 2, 1])]);
    let edge = [vertex(&mesh, [1.0, 1.0, 0.0]), vertex(&mesh, [1.0, 1.0, 1.0])];
    assert_eq!(violations_of(&mesh, None), [Violation::NonManifoldEdge { edge }]);
}

#[test]
fn a_turned_face_is_inconsistent_with_its_neighbours() {
    let mesh = with_faces(&cube(2), |faces| faces[5].reverse());
    let turned = |v: Violation| match v {
        Violation::InconsistentOrientation { edge } => ascending(edge),
        other => panic!("{other} is about something else"),
    };
    let mut found: Vec<_> = violations_of(&mesh, None).into_iter().map(turned).collect();
    found.sort_unstable();
    assert_eq!(found, edges_of(&mesh, 5));
}

#[test]
fn cubes_that_touch_at_a_vertex_are_not_manifold() {
    let mesh = quads(&[([0; 3], [1; 3]), ([1; 3], [2; 3])]);
    assert_eq!(violations_of(&mesh, None), [Violation::NonManifoldVertex { vertex: vertex(&mesh, [1.0; 3]) }]);
}

#[test]
fn neighbours_of_opposite_labels_are_named_by_their_edge() {
    let mesh = cube(1);
    let labels = relabelled(&mesh, &[([0.5, 1.0, 0.5], 5)]);
    let [Violation::OppositeCharts { edge }] = violations_of(&mesh, Some(&labels))[..] else { panic!() };
    let expected = [vertex(&mesh, [0.0, 1.0, 1.0]), vertex(&mesh, [1.0, 1.0, 1.0])];
    assert_eq!(ascending(edge), ascending(expected));
}

/// Two of the four faces around the middle of the top look along X.
#[test]
fn a_corner_of_two_axes_is_incomplete() {
    let mesh = cube(4);
    let labels = relabelled(&mesh, &[([1.5, 1.5, 4.0], 0), ([2.5, 2.5, 4.0], 0)]);
    let vertex = vertex(&mesh, [2.0, 2.0, 4.0]);
    assert_eq!(violations_of(&mesh, Some(&labels)), [Violation::IncompleteCorner { vertex }]);
}

#[test]
fn an_island_of_another_label_has_too_few_corners() {
    let mesh = cube(3);
    let at = [1.5, 1.5, 3.0];
    let found = violations_of(&mesh, Some(&relabelled(&mesh, &[(at, 0)])));
    assert!(found.contains(&Violation::TooFewCorners { face: face(&mesh, at), corners: 0 }), "{found:?}");
    assert!(found.iter().all(|v| matches!(v, Violation::TooFewCorners { corners: 0, .. })), "{found:?}");
}

#[test]
fn one_label_everywhere_is_no_polycube() {
    let ring = [Cuboid::new([0; 3], [3, 3, 1])];
    let ring = Voxels::from_difference(&ring, &[Cuboid::new([1, 1, 0], [2, 2, 1])]).unwrap();
    let ring = ring.mesh(CellKind::Quads, 1.0).unwrap();
    let one_label = vec![0; ring.cells().len()];
    assert_eq!(violations_of(&ring, Some(&one_label)), [Violation::ChartWithHandle { face: 0 }]);
    let mesh = cube(1);
    let lenient = Tolerance { distance: 10.0, ..Tolerance::default() };
    let found = Polycube::new(&mesh, Some(&[0; 6]), &lenient).map(|_| ()).unwrap_err();
    assert_eq!(found, [Violation::TooFewCorners { face: 0, corners: 0 }]);
}

#[test]
fn a_flattened_cube_has_edges_without_length() {
    let mesh = cube(1);
    let labels = common::labels(&read(&mesh));
    let upright: Vec<[u32; 2]> = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]
        .map(|[x, y]| ascending([vertex(&mesh, [x, y, 0.0]), vertex(&mesh, [x, y, 1.0])]))
        .to_vec();
    let mesh = mesh.moved(|p| Point::new(p.x, p.y, 0.0)).unwrap();
    let flat = |v: Violation| match v {
        Violation::ZeroLengthEdge { ends } => ascending(ends),
        other => panic!("{other} is about something else"),
    };
    let mut found: Vec<_> = violations_of(&mesh, Some(&labels)).into_iter().map(flat).collect();
    found.sort_unstable();
    let mut expected = upright;
    expected.sort_unstable();
    assert_eq!(found, expected);
}

#[test]
fn an_edge_that_is_folded_is_named_with_its_run() {
    let mesh = cube(4);
    let [below, low, high] = [1.0, 2.0, 3.0].map(|z| vertex(&mesh, [0.0, 0.0, z]));
    let mesh = with_vertex(&with_vertex(&mesh, low, |p| p.z = 2.45), high, |p| p.z = 1.55);
    let [Violation::NonMonotoneEdge { edge, run, vertices, distance }] = violations_of(&mesh, None)[..] else {
        panic!()
    };
    assert_eq!((edge, run, vertices), ([low, high], [low, high], 2));
    assert!((distance - 0.45).abs() < 1e-12);
    let lenient = Tolerance { distance: 0.2, ..Tolerance::default() };
    assert_eq!(Polycube::new(&mesh, None, &lenient).unwrap().deviation.out_of_order, 2);
    // One vertex beyond the corner: it goes back to the corner, and takes nothing with it.
    let beyond = with_vertex(&cube(4), below, |p| p.z = -0.8);
    let found = violations_of(&beyond, None);
    let [Violation::NonMonotoneEdge { run, vertices: 1, .. }] = found[..] else { panic!("{found:?}") };
    assert_eq!(run, [below; 2]);
}

/// A cell of the surface that is turned over or without area.
fn has_flat_face(mesh: &Mesh, labels: &[i8]) -> bool {
    !polycube::measure::flipped(mesh, labels).expect("labels fit").is_empty()
}

/// Two neighbours on a straight edge change places, by as little as rounding and by as much as is tolerated.
#[test]
fn neighbours_out_of_order_are_put_in_order() {
    for kind in [CellKind::Triangles, CellKind::Quads, CellKind::Tetrahedra, CellKind::Hexahedra] {
        for back in [1e-8, 1e-5, 1e-3, 0.2] {
            let clean = surface(&[([0; 3], [6, 3, 3]), ([0; 3], [3, 6, 3])], kind);
            let labels = common::labels(&read(&clean));
            let [one, two] = [1.0, 2.0].map(|z| vertex(&clean, [0.0, 0.0, z]));
            let mesh = with_vertex(&clean, one, |p| p.z = 1.5 + back / 2.0);
            let mesh = with_vertex(&mesh, two, |p| p.z = 1.5 - back / 2.0);
            let input = Input { polycube: &mesh, shape: Some(&clean), labels: Some(&labels) };
            let options = SimplifyOptions { scale: Some(2.0), ..SimplifyOptions::default() };
            let result = polycube::simplify::simplify(&input, &options, &polycube::Context::default()).unwrap();
            let before = result.report.before;
            assert_eq!((before.surface_patches, before.blocks), (14, 3), "{kind}, {back}");
            assert_eq!(result.report.deviation.out_of_order, 2, "{kind}, {back}");
            assert!(result.report.deviation.distance >= back / 2.1);
            assert!(result.report.notes.contains(&polycube::simplify::Note::OutOfOrder(2)));
            let ordered = result.polycube.unwrap();
            let found = polycube::validate::validate(&input, &Tolerance::default()).unwrap();
            assert!(found.is_empty(), "{kind}, {back}: {found:?}");
            assert!(ordered.points()[one as usize].z < ordered.points()[two as usize].z, "{kind}, {back}");
            assert!(!has_flat_face(&ordered, &labels), "{kind}, {back}");
        }
    }
}

#[test]
fn a_vertex_far_off_its_plane_is_named_with_its_distance() {
    let mesh = cube(4);
    let pushed = vertex(&mesh, [2.0, 2.0, 4.0]);
    let mesh = with_vertex(&mesh, pushed, |p| p.z += 0.4);
    assert!(Polycube::new(&mesh, None, &Tolerance::default()).is_ok());
    let strict = Tolerance { distance: 0.01, ..Tolerance::default() };
    let found = Polycube::new(&mesh, None, &strict).map(|_| ()).unwrap_err();
    let distance = found.iter().find_map(|v| match v {
        Violation::OffLevel { vertex, distance } if *vertex == pushed => Some(*distance),
        _ => None,
    });
    assert!((distance.unwrap() - 0.2).abs() < 1e-12, "{found:?}");
}

#[test]
fn parts_that_cross_are_named_by_faces_of_both() {
    let one = cube(2);
    let other = polycube::parts::translate(&one, Vector3::from([1.0; 3])).unwrap();
    let count = one.points().len() as u32;
    let beside = faces(&other).iter().map(|f| f.map(|v| v + count));
    let all = faces(&one).iter().copied().chain(beside).collect();
    let mesh = Mesh::new([one.points(), other.points()].concat(), Cells::Quads(all)).unwrap();
    let found = read(&mesh).overlaps(mesh.points());
    assert!(!found.is_empty());
    for violation in found {
        let Violation::SelfOverlap { face, other } = violation else { panic!("{violation}") };
        assert_ne!(face < 24, other < 24, "one face of each cube");
    }
    let error = simplify(&mesh, &paper()).unwrap_err();
    assert_eq!(error.kind, polycube::ErrorKind::Polycube);
    assert!(matches!(error.place, Some(Place::Face(_))), "{error}");
}

#[test]
fn a_surface_that_looks_inward_is_inside_out() {
    let mesh = with_faces(&cube(2), |faces| faces.iter_mut().for_each(|f| f.reverse()));
    assert_eq!(read(&mesh).overlaps(mesh.points()), [Violation::InsideOut { face: 0 }]);
}

#[test]
fn a_face_of_three_cells_is_named_by_a_cell() {
    let mesh = surface(&[([0; 3], [1; 3])], CellKind::Tetrahedra);
    let Cells::Tetrahedra(cells) = mesh.cells() else { unreachable!() };
    let twice = Cells::Tetrahedra([&cells[..], &cells[..1]].concat());
    let mesh = Mesh::new(mesh.points().to_vec(), twice).unwrap();
    let found = violations_of(&mesh, None);
    assert!(matches!(found[0].place(), Some(Place::Cell(_))), "{found:?}");
}

#[test]
fn every_violation_says_what_to_do() {
    let mesh = with_faces(&cube(2), |faces| faces.truncate(faces.len() - 1));
    for violation in violations_of(&mesh, None) {
        let error = Error::from(violation.clone());
        assert!(error.place == violation.place() && !error.message.is_empty() && !error.remedy.is_empty());
    }
}

#[test]
fn swapped_meshes_are_recognised() {
    let straight = cube(2);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 40_f64.to_radians());
    let turned = straight.moved(|p| turn * p).unwrap();
    let remedy = |polycube, shape| {
        let input = Input { polycube, shape: Some(shape), labels: None };
        read_structure(&input, &Tolerance::default()).expect_err("a cube turned by 40 degrees is no polycube").remedy
    };
    assert!(remedy(&turned, &straight).starts_with("swap the two"));
    assert!(remedy(&turned, &turned).starts_with("this looks like a shape, not a polycube"));
    let dented = with_vertex(&straight, vertex(&straight, [0.0; 3]), |p| p.x += 0.9);
    assert!(remedy(&dented, &dented).starts_with("give labels"));
}
