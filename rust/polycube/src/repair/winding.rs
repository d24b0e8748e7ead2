//! How often a surface winds around a point.

use crate::mesh::{Face, Point};

/// The winding number of triangles around `point`: 1 inside a closed surface that looks outward, 0 outside of it, and
/// something between for one with holes (van Oosterom and Strackee 1983).
pub(super) fn winding<'a>(points: &[Point], faces: impl Iterator<Item = &'a Face>, point: &Point) -> f64 {
    let angle = |t: [u32; 3]| {
        let [a, b, c] = t.map(|v| points[v as usize] - point);
        let (x, y, z) = (a.norm(), b.norm(), c.norm());
        let below = x * y * z + a.dot(&b) * z + b.dot(&c) * x + c.dot(&a) * y;
        libm::atan2(a.dot(&b.cross(&c)), below)
    };
    faces.flat_map(Face::triangles).map(angle).sum::<f64>() / std::f64::consts::TAU
}
