//! From the inside of the polycube on the lattice to the inside of the shape, by tetrahedra (paper, section 7).

use crate::mesh::{Mesh, Point, Simplices};
use crate::spatial::{Location, SimplexIndex, bounds, in_tetrahedron};
use nalgebra::Vector3;
use std::borrow::Cow;

/// The piecewise linear map of the volume.
pub(crate) struct VolumeMap<'a> {
    tetrahedra: Cow<'a, [[u32; 4]]>,
    /// The vertices on the lattice.
    from: &'a [Point],
    /// The same vertices in the shape.
    to: &'a [Point],
    index: SimplexIndex<[f64; 3]>,
}

impl<'a> VolumeMap<'a> {
    /// Indexes the tetrahedra of `polycube`; nothing for a surface. O(n log n).
    pub(crate) fn new(polycube: &'a Mesh, to: &'a [Point]) -> Option<Self> {
        let Simplices::Tetrahedra(tetrahedra) = polycube.cells().simplices() else { return None };
        let from = polycube.points();
        let boxes = (0..).zip(tetrahedra.iter()).map(|(i, t)| {
            let (low, high) = bounds(&corners(from, t));
            (low, high, i)
        });
        let index = SimplexIndex::new(boxes);
        Some(Self { tetrahedra, from, to, index })
    }

    /// The point of the shape that belongs to the lattice point `at`, and whether a tetrahedron holds it (if not,
    /// the nearest is taken). Nothing if all tetrahedra are flat.
    pub(crate) fn place(&self, at: [f64; 3]) -> Option<(Point, bool)> {
        let corners = |t: u32| corners(self.from, &self.tetrahedra[t as usize]);
        let gap = |t: u32, w: [f64; 4]| {
            let corners = corners(t);
            (0..3).map(|k| (0..4).map(|c| w[c] * corners[c][k]).sum::<f64>() - at[k]).map(|d| d * d).sum()
        };
        let Location { simplex, weights, inside } = self.index.locate(at, |t| in_tetrahedron(at, corners(t)), gap)?;
        let ends = self.tetrahedra[simplex as usize].map(|v| self.to[v as usize].coords);
        let sum: Vector3<f64> = ends.iter().zip(weights).map(|(p, w)| p * w).sum();
        Some((Point::from(sum), inside))
    }
}

fn corners(points: &[Point], tetrahedron: &[u32; 4]) -> [[f64; 3]; 4] {
    tetrahedron.map(|v| points[v as usize].coords.into())
}
