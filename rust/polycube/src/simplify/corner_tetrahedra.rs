//! Meshes as tetrahedra, to be untangled.

use crate::measure::tetrahedron_volume;
use crate::mesh::hexahedron::corner_tetrahedra;
use crate::mesh::{Cells, Face, Mesh, Point};
use crate::optimise::Freedom;
use crate::structure::{Label, Polycube, area_vector};
use nalgebra::Vector3;

/// A mesh as the tetrahedra at the corners of its cells. Those of a surface have a vertex of their own that floats in a
/// plane above the face, so that a tetrahedron is inverted just where the face is.
pub(crate) struct CornerTetrahedra {
    /// How many of the points are vertices of the mesh; the others float.
    pub(super) vertices: usize,
    pub(crate) tetrahedra: Vec<[u32; 4]>,
    pub(crate) points: Vec<Point>,
    pub(crate) rest: Vec<Point>,
    pub(crate) freedom: Vec<Freedom>,
}

impl CornerTetrahedra {
    /// The cells of `mesh`, which shall look as in `shape`. Vertices slide in their facets; those on polycube edges are
    /// held.
    pub(super) fn new(polycube: &Polycube, mesh: &Mesh, shape: &[Point]) -> Self {
        let mut corners = Self::held(polycube, mesh.points(), shape);
        match mesh.cells() {
            Cells::Tetrahedra(cells) => corners.tetrahedra.clone_from(cells),
            Cells::Hexahedra(cells) => corners.tetrahedra = cells.iter().flat_map(corner_tetrahedra).collect(),
            Cells::Triangles(_) | Cells::Quads(_) => corners.lift(polycube),
        }
        corners
    }

    /// The surface of a polycube with the vertices `points`; otherwise as [`new`](Self::new).
    pub(crate) fn of_surface(polycube: &Polycube, points: &[Point], shape: &[Point]) -> Self {
        let mut corners = Self::held(polycube, points, shape);
        corners.lift(polycube);
        corners
    }

    fn held(polycube: &Polycube, points: &[Point], rest: &[Point]) -> Self {
        let freedom = polycube.vertex_levels.iter().map(|levels| match levels.iter().flatten().count() {
            0 => Freedom::Free,
            1 => Freedom::Axes(levels.map(|l| l.is_some())),
            _ => Freedom::Fixed,
        });
        let (points, rest, freedom) = (points.to_vec(), rest.to_vec(), freedom.collect());
        Self { vertices: points.len(), tetrahedra: Vec::new(), points, rest, freedom }
    }

    /// Adds the tetrahedra over the faces of a surface.
    fn lift(&mut self, polycube: &Polycube) {
        let area =
            |points: &[Point]| -> f64 { polycube.surface.faces().iter().map(|f| area_vector(points, f).norm()).sum() };
        let stretch = (area(&self.points) / area(&self.rest)).sqrt();
        for (face, label) in polycube.surface.faces().iter().zip(polycube.labels()) {
            match *face {
                Face::Triangle(t) => self.lift_triangle(t, label, stretch),
                Face::Quad(q) => {
                    (0..4).for_each(|k| self.lift_triangle([0, 1, 3].map(|i| q[(k + i) % 4]), label, stretch))
                }
            }
        }
    }

    fn lift_triangle(&mut self, t: [u32; 3], label: Label, stretch: f64) {
        let middle = |at: &[Point]| Point::from(t.iter().map(|&v| at[v as usize].coords).sum::<Vector3<f64>>() / 3.0);
        let area = area_vector(&self.rest, &Face::Triangle(t));
        let height = area.norm().sqrt();
        let mut up = Vector3::zeros();
        up[label.axis()] = f64::from(label.sign());
        self.tetrahedra.push([t[0], t[1], t[2], self.points.len() as u32]);
        self.points.push(middle(&self.points) + up * (height * stretch));
        self.rest.push(middle(&self.rest) + area.try_normalize(0.0).unwrap_or(up) * height);
        self.freedom.push(Freedom::Axes(std::array::from_fn(|a| a == label.axis())));
    }

    /// The tetrahedra that are turned over or flat, ascending.
    pub(crate) fn turned_over(&self) -> Vec<usize> {
        let bad = |(_, t): &(usize, &[u32; 4])| tetrahedron_volume(&self.points, t) <= 0.0;
        self.tetrahedra.iter().enumerate().filter(bad).map(|(i, _)| i).collect()
    }
}
