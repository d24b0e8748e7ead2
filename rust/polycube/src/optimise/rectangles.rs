//! Quadrilaterals of a surface as elements: four corners each, whose third edge is the normal of the surface.

use super::elements::{Elements, Measure, check};
use super::sizes::{fair, sizes};
use crate::error::Result;
use crate::measure::mean;
use crate::mesh::Point;
use nalgebra::{Matrix3, Vector3};

/// The two pairs of opposite sides.
const SIDES: [[[usize; 2]; 2]; 2] = [[[0, 1], [3, 2]], [[0, 3], [1, 2]]];

impl Elements {
    /// Quadrilaterals that should be rectangles with about the lengths of sides they have in `points`, averaged as
    /// those of [`boxes_like`](Self::boxes_like), where `normals` has the unit normal of the surface at each. `is_fair`
    /// asks for no thinner ones than [`fair_boxes_like`](Self::fair_boxes_like).
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`](crate::ErrorKind::Mesh) naming the cell that has a vertex outside `points`.
    pub(crate) fn rectangles_like(
        quads: &[[u32; 4]],
        points: &[Point],
        normals: &[Vector3<f64>],
        smoothing: usize,
        is_fair: bool,
    ) -> Result<Self> {
        check(quads, points.len())?;
        let sizes = sizes(quads, &SIDES, points, smoothing);
        let sizes = if is_fair { fair(sizes) } else { sizes };
        let corners = quads.iter().flat_map(corners).collect();
        let shapes = sizes.iter().flat_map(corner_shapes).collect();
        let mut own = Self::new(corners, shapes, vec![1.0; 4 * quads.len()], 4, Measure::ScaledJacobian);
        let heights = sizes.iter().map(height);
        own.offsets = normals.iter().zip(heights).flat_map(|(normal, height)| [normal * height; 4]).collect();
        own.mean = mean((0..own.len()).map(|i| own.edges(i, points).determinant()));
        Ok(own)
    }
}

/// Each corner with the next and the last one, and itself for the normal: right-handed seen from outside.
fn corners(quad: &[u32; 4]) -> [[u32; 4]; 4] {
    std::array::from_fn(|k| [quad[k], quad[(k + 1) % 4], quad[(k + 3) % 4], quad[k]])
}

/// The length of a normal: neither side is much longer or shorter.
fn height([a, b]: &[f64; 2]) -> f64 {
    (a * b).sqrt()
}

/// The edges that the four corners should have.
fn corner_shapes(size: &[f64; 2]) -> [Matrix3<f64>; 4] {
    std::array::from_fn(|k| Matrix3::from_diagonal(&Vector3::new(size[k % 2], size[(k + 1) % 2], height(size))))
}
