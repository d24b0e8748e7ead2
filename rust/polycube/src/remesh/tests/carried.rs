//! Groups painted on a shape, on the boundary of its hexahedra.

use super::cells;
use crate::align::Strategy;
use crate::context::Context;
use crate::generate::{Example, example};
use crate::mesh::{CellKind, Cells, GroupedSurface, Groups, Mesh, Point};
use crate::remesh::{Hexes, RemeshOptions, Size, carry_groups, remesh};
use crate::simplify::{Input, SimplifyOptions};
use nalgebra::Vector3;

fn hexes(polycube: &Mesh, shape: &Mesh) -> Hexes {
    let input = Input { polycube, shape: Some(shape), labels: None };
    let simplify = SimplifyOptions { strategy: Strategy::Paper, ..SimplifyOptions::default() };
    let options = RemeshOptions { simplify, size: Some(Size::Hexes(4000)), ..RemeshOptions::default() };
    remesh(&input, &options, &Context::default()).unwrap().hexes.unwrap()
}

fn centre(points: &[Point], face: &[u32]) -> Point {
    let sum: Vector3<f64> = face.iter().map(|&v| points[v as usize].coords).sum();
    Point::from(sum / face.len() as f64)
}

fn area(points: &[Point], face: &[u32]) -> f64 {
    let at = |k: usize| points[face[k] as usize];
    (2..face.len()).map(|k| (at(k - 1) - at(0)).cross(&(at(k) - at(0))).norm() / 2.0).sum()
}

/// Three groups of the shape's faces: slanted slabs that cut across all facets and do not follow the mesh.
fn painted(shape: &Mesh) -> GroupedSurface {
    let along = |p: Point| p.coords.dot(&Vector3::new(0.8, 0.5, 0.33));
    let heights: Vec<f64> =
        (0..shape.cells().len()).map(|i| along(centre(shape.points(), shape.cells().cell(i)))).collect();
    let mut sorted = heights.clone();
    sorted.sort_by(f64::total_cmp);
    let [low, high] = [sorted.len() / 4, sorted.len() * 2 / 3].map(|i| sorted[i]);
    let of = heights.iter().map(|&h| u32::from(h > low) + u32::from(h > high)).collect();
    let names = ["inlet", "wall", "outlet"].map(str::to_owned).to_vec();
    GroupedSurface::new(shape.clone(), Groups::new(names, of).unwrap()).unwrap()
}

/// The areas of the groups on the shape and on the hexahedra.
fn areas(surface: &GroupedSurface, hexes: &Hexes, groups: &Groups) -> [Vec<f64>; 2] {
    let mut sums = [vec![0.0; groups.names().len()], vec![0.0; groups.names().len()]];
    let (points, all) = (surface.mesh().points(), surface.mesh().cells());
    (0..all.len()).for_each(|i| sums[0][surface.groups().of()[i] as usize] += area(points, all.cell(i)));
    for (side, &group) in hexes.boundary.iter().zip(groups.of()) {
        sums[1][group as usize] += area(hexes.mesh.points(), &side.face.vertices(cells(&hexes.mesh)));
    }
    sums
}

#[test]
fn groups_keep_their_areas_and_places() {
    for (name, kind) in [(Example::Ring, CellKind::Triangles), (Example::SteppedL, CellKind::Quads)] {
        let (polycube, shape) = example(name, 1, kind).unwrap();
        let (hexes, surface) = (hexes(&polycube, &shape), painted(&shape));
        let groups = carry_groups(&surface, &hexes.mesh, &hexes.boundary).unwrap();
        assert_eq!(groups.of().len(), hexes.boundary.len());
        let [shape_areas, own] = areas(&surface, &hexes, &groups);
        for (was, is) in shape_areas.iter().zip(&own) {
            assert!((is / was - 1.0).abs() < 0.02, "{name}: {shape_areas:?} became {own:?}");
        }
        // Every face is near to a face of its group on the shape.
        let middles: Vec<Point> =
            (0..shape.cells().len()).map(|i| centre(shape.points(), shape.cells().cell(i))).collect();
        let reach = (shape_areas.iter().sum::<f64>() / shape.cells().len() as f64).sqrt();
        for (side, &group) in hexes.boundary.iter().zip(groups.of()) {
            let quad = side.face.vertices(cells(&hexes.mesh));
            let (at, size) = (centre(hexes.mesh.points(), &quad), area(hexes.mesh.points(), &quad).sqrt());
            let of_group = middles.iter().zip(surface.groups().of()).filter(|(_, of)| **of == group);
            let near = of_group.map(|(p, _)| (p - at).norm()).fold(f64::INFINITY, f64::min);
            assert!(near < 2.0 * (reach + size), "{name}: {near} from {}", groups.names()[group as usize]);
        }
        let grouped = hexes.grouped_by(&surface).unwrap();
        assert_eq!((grouped.patches(), grouped.sides()), (&groups, &groups));
    }
}

/// A wall thinner than its faces are wide: what is on one side stays there.
#[test]
fn a_thin_wall_has_the_groups_of_either_side() {
    let box_of = |h: f64| -> Vec<Point> {
        let corner = |k: usize| Point::new((k & 1) as f64, (k >> 1 & 1) as f64, h * (k >> 2) as f64);
        [0, 1, 3, 2, 4, 5, 7, 6].map(corner).to_vec()
    };
    let mesh = Mesh::new(box_of(0.01), Cells::Hexahedra(vec![[0, 1, 2, 3, 4, 5, 6, 7]])).unwrap();
    let faces = mesh.cells().boundary().unwrap();
    let quads = faces.iter().map(|face| face.vertices().try_into().unwrap()).collect();
    // The shape is a little thicker, and the lower side of the wall farther from the mesh than the upper one.
    let points = box_of(0.011).into_iter().map(|p| p + Vector3::new(0.0, 0.0, -0.007)).collect();
    let names = (0..6).map(|i| format!("side_{i}")).collect();
    let groups = Groups::new(names, (0..6).collect()).unwrap();
    let surface = GroupedSurface::new(Mesh::new(points, Cells::Quads(quads)).unwrap(), groups).unwrap();
    let label = crate::structure::Label::new(0).unwrap();
    let of_face = |face: u8| crate::mesh::HexFace { cell: 0, face };
    let boundary: Vec<_> =
        (0..6).map(|face| crate::remesh::BoundaryFace { face: of_face(face), label, facet: 0 }).collect();
    let carried = carry_groups(&surface, &mesh, &boundary).unwrap();
    for (side, group) in boundary.iter().zip(carried.of()) {
        let corners = side.face.vertices(cells(&mesh));
        assert_eq!(faces[*group as usize].vertices(), corners, "face {}", side.face.face);
    }
    let beyond = crate::remesh::BoundaryFace { face: crate::mesh::HexFace { cell: 1, face: 0 }, label, facet: 0 };
    assert_eq!(carry_groups(&surface, &mesh, &[beyond]).unwrap_err().kind, crate::ErrorKind::Mismatch);
}
