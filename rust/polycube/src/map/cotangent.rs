//! Cotangent weights of a triangulated surface.

use super::sparse::SparseRows;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::{Point, Stars};

/// A triangle whose doubled area is below this part of its longest edge squared is too thin for
/// its cotangents to mean anything.
const THINNEST: f64 = 1e-6;

/// The least cotangent of positive weights.
const LEAST: f64 = 0.05;

/// How many elements are handled between two looks at the context.
pub(super) const CHUNK: usize = 1 << 13;

/// The symmetric matrix of weights `w_ij = cot α + cot β` over the angles opposite to the edge
/// `ij`; an empty row for a vertex of no triangle.
///
/// The weights come as they are, negative ones too: their Laplacian is the stiffness matrix of
/// linear elements, positive semidefinite for any triangulation, and only unclamped does it
/// reproduce linear functions. What is clamped is the triangle: one thinner than [`THINNEST`],
/// whose cotangents would run to infinity, counts as equilateral.
pub(super) fn cotangent_weights(points: &[Point], triangles: &[[u32; 3]], context: &Context) -> Result<SparseRows> {
    weights(points, triangles, |cotangent| cotangent, context)
}

/// The same with every cotangent within [`LEAST`] and its inverse: no weight is negative, so that convex facets are
/// never folded (Tutte 1963), and the problem is solved on the thinnest triangles, but linear functions are not
/// reproduced.
pub(crate) fn positive_weights(points: &[Point], triangles: &[[u32; 3]], context: &Context) -> Result<SparseRows> {
    weights(points, triangles, |cotangent| cotangent.clamp(LEAST, 1.0 / LEAST), context)
}

fn weights(
    points: &[Point],
    triangles: &[[u32; 3]],
    bounded: impl Fn(f64) -> f64,
    context: &Context,
) -> Result<SparseRows> {
    let stars = Stars::new(points.len(), triangles.iter().copied());
    let angles: Vec<_> = triangles.iter().map(|t| cotangents(t.map(|v| points[v as usize])).map(&bounded)).collect();
    let mut rows = SparseRows::new();
    let mut row = Vec::new();
    for v in 0..points.len() {
        if v % CHUNK == 0 {
            context.tick(v as f64 / points.len() as f64)?;
        }
        for &t in stars.of(v) {
            spokes(v as u32, &triangles[t as usize], &angles[t as usize], &mut row);
        }
        rows.push(&mut row);
    }
    Ok(rows)
}

/// The weights one triangle gives to the two edges that meet in its vertex `v`.
fn spokes(v: u32, triangle: &[u32; 3], angles: &[f64; 3], row: &mut Vec<(u32, f64)>) {
    let Some(i) = triangle.iter().position(|&u| u == v) else {
        return;
    };
    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
    for (end, angle) in [(j, angles[k]), (k, angles[j])] {
        if triangle[end] != v {
            row.push((triangle[end], angle));
        }
    }
}

/// The cotangents of the three angles of a triangle, those of an equilateral one if it is too thin.
fn cotangents(p: [Point; 3]) -> [f64; 3] {
    let edges = [p[2] - p[1], p[0] - p[2], p[1] - p[0]];
    let doubled = edges[0].cross(&edges[1]).norm();
    let longest = edges.iter().fold(0.0, |m: f64, e| m.max(e.norm_squared()));
    // Written so that a NaN is too thin, too.
    if doubled > THINNEST * longest {
        [(1, 2), (2, 0), (0, 1)].map(|(j, k)| -edges[j].dot(&edges[k]) / doubled)
    } else {
        [1.0 / 3.0_f64.sqrt(); 3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::SplitMix64;
    use proptest::prelude::*;

    fn weights(points: &[Point], triangles: &[[u32; 3]]) -> SparseRows {
        cotangent_weights(points, triangles, &Context::default()).unwrap()
    }

    #[test]
    fn known_angles() {
        let half = 3.0_f64.sqrt() / 2.0;
        let equilateral = [Point::origin(), Point::new(2.0, 0.0, 0.0), Point::new(1.0, 2.0 * half, 0.0)];
        for c in cotangents(equilateral) {
            assert!((c - 1.0 / 3.0_f64.sqrt()).abs() < 1e-15);
        }
        let right = [Point::origin(), Point::new(0.0, 3.0, 0.0), Point::new(0.0, 0.0, 4.0)];
        for (c, expected) in cotangents(right).into_iter().zip([0.0, 0.75, 4.0 / 3.0]) {
            assert!((c - expected).abs() < 1e-15);
        }
    }

    #[test]
    fn two_triangles_add_up_on_their_common_edge() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 2.0]].map(|[x, y]| Point::new(x, y, 0.0));
        let rows = weights(&points, &[[0, 1, 2], [0, 2, 3]]);
        // Opposite to 0-2: a right angle at 1, and 45 degrees at 3.
        assert!((rows.row(0).find(|e| e.0 == 2).unwrap().1 - 1.0).abs() < 1e-15);
        assert!(rows.row(1).all(|(_, w)| (w - 1.0).abs() < 1e-15));
    }

    #[test]
    fn flat_triangles_count_as_equilateral() {
        let p = |x: f64| Point::new(x, 0.0, 0.0);
        for points in [[p(0.0), p(0.0), p(0.0)], [p(0.0), p(1.0), p(2.0)], [p(0.0), p(0.0), p(1.0)]] {
            assert_eq!(cotangents(points), [1.0 / 3.0_f64.sqrt(); 3]);
        }
        assert!(weights(&[p(0.0), p(1.0)], &[[0, 0, 1]]).row(0).all(|e| e.1.is_finite()));
    }

    proptest! {
        /// In a planar fan, obtuse triangles and negative weights included, linear functions are harmonic.
        #[test]
        fn linear_functions_are_harmonic(seed in any::<u64>(), spokes in 4_u32..9) {
            let mut random = SplitMix64::new(seed);
            let mut points = vec![Point::origin()];
            for k in 0..spokes {
                let turn = std::f64::consts::TAU * (f64::from(k) + 0.6 * random.unit()) / f64::from(spokes);
                let r = 0.1 + random.unit();
                points.push(Point::new(r * turn.cos(), r * turn.sin(), 0.0));
            }
            let fan: Vec<_> = (0..spokes).map(|k| [0, 1 + k, 1 + (k + 1) % spokes]).collect();
            let rows = weights(&points, &fan);
            let (mut sum, mut scale) = (Point::origin().coords, 0.0);
            for (j, w) in rows.row(0) {
                sum += w * points[j].coords;
                scale += w.abs();
            }
            prop_assert!(sum.norm() < 1e-12 * scale);
        }
    }
}
