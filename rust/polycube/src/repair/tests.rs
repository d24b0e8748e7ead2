//! Inputs that other tools write, and what is made of them.

use super::*;
use crate::generate::{Cuboid, Voxels};
use crate::mesh::CellKind;
use crate::simplify::read_structure;
use crate::structure::Tolerance;

fn step(kind: CellKind) -> Mesh {
    let boxes = [Cuboid::new([0; 3], [4, 2, 2]), Cuboid::new([0; 3], [2, 2, 4])];
    Voxels::from_boxes(&boxes).unwrap().mesh(kind, 1.0).unwrap()
}

fn labels_of(mesh: &Mesh) -> Vec<i8> {
    let input = Input { polycube: mesh, shape: None, labels: None };
    let found = read_structure(&input, &Tolerance::default()).unwrap();
    found.labels().map(|l| l.index() as i8).collect()
}

/// What was done to a mesh and its labels, which must then be a polycube.
fn repairs(mesh: &Mesh, labels: Option<&[i8]>) -> (Repaired, Vec<Repair>) {
    let shape = mesh.moved(|p| Point::new(p.x + 0.1 * p.z, p.y, p.z)).unwrap();
    let input = Input { polycube: mesh, shape: Some(&shape), labels };
    let repaired = repair(&input).expect("there is something to repair");
    assert_eq!(repaired.shape.as_ref().map(Mesh::cells), Some(repaired.polycube.cells()));
    let found = read_structure(&repaired.input(), &Tolerance::default()).unwrap();
    assert_eq!((found.structure.facets.len(), found.structure.corners.len()), (8, 12));
    assert!(repair(&repaired.input()).is_none(), "once is enough");
    let repairs = repaired.repairs.clone();
    (repaired, repairs)
}

fn cells<const N: usize>(mesh: &Mesh) -> Vec<[u32; N]> {
    (0..mesh.cells().len()).map(|i| mesh.cells().cell(i).try_into().unwrap()).collect()
}

#[test]
fn a_good_input_stays_as_it_is() {
    for kind in CellKind::ALL {
        let mesh = step(kind);
        let labels = labels_of(&mesh);
        assert!(repair(&Input { polycube: &mesh, shape: Some(&mesh), labels: Some(&labels) }).is_none(), "{kind}");
    }
    // A hole inside is bounded by faces that look into it.
    let hollow = Voxels::from_difference(&[Cuboid::new([0; 3], [3; 3])], &[Cuboid::new([1; 3], [2; 3])]).unwrap();
    let hollow = hollow.mesh(CellKind::Triangles, 1.0).unwrap();
    assert!(repair(&Input { polycube: &hollow, shape: None, labels: None }).is_none());
}

#[test]
fn a_cell_that_is_inverted_in_the_map_is_not_turned() {
    let mesh = step(CellKind::Tetrahedra);
    let inner = |p: &Point| *p == Point::new(1.0, 1.0, 1.0);
    let mesh = mesh.moved(|p| if inner(p) { Point::new(2.5, 1.0, 1.0) } else { *p }).unwrap();
    assert!(!crate::measure::flipped(&mesh, &[]).unwrap().cells.is_empty());
    assert!(repair(&Input { polycube: &mesh, shape: None, labels: None }).is_none());
}

#[test]
fn left_handed_cells_are_turned_and_labels_stay_with_their_faces() {
    for every in [1, 2, 3] {
        for kind in [CellKind::Tetrahedra, CellKind::Hexahedra] {
            let good = step(kind);
            let wrong = good
                .clone()
                .edited(|_, cells| match cells {
                    Cells::Tetrahedra(c) => c.iter_mut().step_by(every).for_each(|t| t.swap(2, 3)),
                    Cells::Hexahedra(c) => c.iter_mut().step_by(every).for_each(|h| h.rotate_left(4)),
                    _ => unreachable!(),
                })
                .unwrap();
            let boundary = wrong.cells().boundary().unwrap();
            let faces = good.cells().boundary().unwrap();
            let keys = faces.iter().map(|f| key(f.vertices(), |v| v));
            let known: HashMap<[u32; 4], i8> = keys.zip(labels_of(&good)).collect();
            let labels: Vec<i8> = boundary.iter().map(|f| known[&key(f.vertices(), |v| v)]).collect();
            let (repaired, done) = repairs(&wrong, Some(&labels));
            assert_eq!(done, [Repair::TurnedCells(good.cells().len().div_ceil(every))], "{kind} {every}");
            assert_eq!(repaired.labels, Some(labels_of(&repaired.polycube)));
            assert!(crate::measure::flipped(&repaired.polycube, &[]).unwrap().is_empty());
        }
    }
}

#[test]
fn surfaces_are_turned_outward_with_labels_of_either_side() {
    let good = step(CellKind::Quads);
    let labels = labels_of(&good);
    let turned: Vec<i8> = labels.iter().map(|l| l ^ 1).collect();
    let count = good.cells().len();
    let inward = Cells::Quads(cells(&good).into_iter().map(|[a, b, c, d]| [d, c, b, a]).collect());
    let inward = Mesh::new(good.points().to_vec(), inward).unwrap();
    let faces = Repair::TurnedFaces(count);
    let (repaired, done) = repairs(&inward, Some(&labels));
    assert_eq!((done, repaired.labels), (vec![faces], Some(labels.clone())));
    let (repaired, done) = repairs(&inward, Some(&turned));
    assert_eq!((done, repaired.labels), (vec![faces, Repair::TurnedLabels(count)], Some(labels)));
    let mut mixed = cells(&good);
    mixed[3].reverse();
    mixed[7].reverse();
    let mixed = Mesh::new(good.points().to_vec(), Cells::Quads(mixed)).unwrap();
    assert_eq!(repairs(&mixed, None).1, [Repair::TurnedFaces(2)]);
}

#[test]
fn a_hole_inside_that_looks_outward_is_turned() {
    let outer = Voxels::from_boxes(&[Cuboid::new([0; 3], [3; 3])]).unwrap().mesh(CellKind::Quads, 1.0).unwrap();
    let inner = Voxels::from_boxes(&[Cuboid::new([1; 3], [2; 3])]).unwrap().mesh(CellKind::Quads, 1.0).unwrap();
    let first = outer.points().len() as u32;
    let all = cells(&outer).into_iter().chain(cells(&inner).into_iter().map(|q: [u32; 4]| q.map(|v| v + first)));
    let mesh = Mesh::new([outer.points(), inner.points()].concat(), Cells::Quads(all.collect())).unwrap();
    let repaired = repair(&Input { polycube: &mesh, shape: None, labels: None }).unwrap();
    assert_eq!(repaired.repairs, [Repair::TurnedFaces(6)]);
    assert!(read_structure(&repaired.input(), &Tolerance::default()).is_ok());
}

/// Every cell with vertices of its own.
fn exploded(mesh: &Mesh) -> Mesh {
    let points = (0..mesh.cells().len()).flat_map(|i| mesh.cells().cell(i)).map(|&v| mesh.points()[v as usize]);
    fn own<const N: usize>(n: usize) -> Vec<[u32; N]> {
        (0..n).map(|i| std::array::from_fn(|k| (i * N + k) as u32)).collect()
    }
    let n = mesh.cells().len();
    let cells = match mesh.cells().kind() {
        CellKind::Triangles => Cells::Triangles(own(n)),
        CellKind::Quads => Cells::Quads(own(n)),
        CellKind::Tetrahedra => Cells::Tetrahedra(own(n)),
        CellKind::Hexahedra => Cells::Hexahedra(own(n)),
    };
    Mesh::new(points.collect(), cells).unwrap()
}

#[test]
fn vertices_at_one_place_are_welded() {
    for kind in CellKind::ALL {
        let good = step(kind);
        let loose = exploded(&good);
        let (repaired, done) = repairs(&loose, None);
        assert_eq!(done, [Repair::Welded(loose.points().len() - good.points().len())], "{kind}");
        assert_eq!(repaired.polycube.points().len(), loose.points().len(), "vertices keep their numbers");
    }
    // What is at one place in the polycube and not in the shape is not one vertex.
    let good = step(CellKind::Quads);
    let loose = exploded(&good);
    let mut away = 0.0;
    let apart = loose
        .moved(|p| {
            away += 0.01;
            Point::new(p.x + away, p.y, p.z)
        })
        .unwrap();
    assert!(repair(&Input { polycube: &loose, shape: Some(&apart), labels: None }).is_none());
}

#[test]
fn duplicates_and_faces_inside_are_left_out() {
    let good = step(CellKind::Quads);
    let labels = labels_of(&good);
    let own: Vec<[u32; 4]> = cells(&good);
    let with = |more: &[[u32; 4]]| Mesh::new(good.points().to_vec(), Cells::Quads([&own[..], more].concat())).unwrap();
    let [a, b, c, d] = own[5];
    let twice = with(&[own[2], [d, c, b, a]]);
    let (repaired, done) = repairs(&twice, Some(&[&labels[..], &[3, 4]].concat()));
    assert_eq!((done, repaired.labels), (vec![Repair::Duplicates(2)], Some(labels)));
    // A wall between the arm and the upright.
    let at = |x: f64, y: f64, z: f64| good.points().iter().position(|p| *p == Point::new(x, y, z));
    let corner = |y: f64, z: f64| at(2.0, y, z).map(|v| v as u32);
    let middle = Point::new(2.0, 1.0, 1.0);
    let centre = good.points().len() as u32;
    let ring: Vec<u32> =
        [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0), (0.0, 2.0), (0.0, 1.0)]
            .map(|(y, z)| corner(y, z).unwrap())
            .to_vec();
    let wall = [0, 2, 4, 6].map(|k| [ring[(k + 7) % 8], ring[k], ring[k + 1], centre]);
    let points = [good.points(), &[middle]].concat();
    let walled = Mesh::new(points, Cells::Quads([&own[..], &wall].concat())).unwrap();
    assert_eq!(repairs(&walled, None).1, [Repair::InnerFaces(4)]);
    let tetrahedra = step(CellKind::Tetrahedra);
    let own: Vec<[u32; 4]> = cells(&tetrahedra);
    let again = Cells::Tetrahedra([&own[..], &own[4..7]].concat());
    let again = Mesh::new(tetrahedra.points().to_vec(), again).unwrap();
    assert_eq!(repairs(&again, None).1, [Repair::Duplicates(3)]);
}

/// Found by fuzzing: where each part is enclosed by the others, none is inside.
#[test]
fn parts_that_enclose_each_other_stay() {
    let points = [[4.0; 3], [4.0; 3], [4.0; 3], [0.0; 3], [0.0; 3], [0.0, 4.0, 3.0]].map(Point::from);
    let quads = vec![[3, 4, 1, 0], [5, 3, 4, 1], [4, 2, 1, 3]];
    let mesh = Mesh::new(points.to_vec(), Cells::Quads(quads)).unwrap();
    let input = Input { polycube: &mesh, shape: None, labels: None };
    assert!(repair(&input).is_none_or(|repaired| !repaired.polycube.cells().is_empty()));
}
