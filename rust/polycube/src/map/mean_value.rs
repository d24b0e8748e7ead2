//! Mean value coordinates of the inner vertices of a tetrahedral mesh.

use super::cotangent::CHUNK;
use super::sparse::SparseRows;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::{Point, Stars};

/// Smallest determinant of the three unit vectors to the corners of a tetrahedron for which the
/// coordinates are trusted.
const THINNEST: f64 = 1e-10;

/// For each vertex of a tetrahedron the other three, counter-clockwise seen from outside.
const OPPOSITE: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The matrix whose row `v` expresses `v` by its neighbours, for every `v` with `inner[v]`; the
/// other rows are empty. Entries are positive and add up to 1 in each row.
///
/// The weights are those of Floater, Kós and Reimers ("Mean value coordinates in 3D", 2005) for a
/// vertex in the kernel of its star, which it is when all tetrahedra around it are positive; then
/// they reproduce linear functions. A star with an inverted or flat tetrahedron has no kernel to
/// speak of: all its neighbours weigh the same.
pub(super) fn mean_value_weights(
    points: &[Point],
    tetrahedra: &[[u32; 4]],
    inner: &[bool],
    context: &Context,
) -> Result<SparseRows> {
    let stars = Stars::new(points.len(), tetrahedra.iter().copied());
    let mut rows = SparseRows::new();
    let mut row = Vec::new();
    for (v, &inner) in inner.iter().enumerate() {
        if v % CHUNK == 0 {
            context.tick(v as f64 / points.len() as f64)?;
        }
        if inner && !mean_values(v, points, tetrahedra, stars.of(v), &mut row) {
            uniform(v, tetrahedra, stars.of(v), &mut row);
        }
        normalise(&mut row);
        rows.push(&mut row);
    }
    Ok(rows)
}

/// Fills `row` with the mean value weights of `v`; false if its star does not allow them.
fn mean_values(v: usize, points: &[Point], tetrahedra: &[[u32; 4]], star: &[u32], row: &mut Vec<(u32, f64)>) -> bool {
    for &t in star {
        let corners = opposite(v as u32, &tetrahedra[t as usize]);
        let ends = corners.map(|u| points[u as usize]);
        let Some(weights) = corner_weights(&points[v], ends) else {
            return false;
        };
        row.extend(corners.into_iter().zip(weights));
    }
    true
}

/// What the triangle `ends`, counter-clockwise seen from outside, gives to the weights of its
/// corners around `centre`; nothing if the tetrahedron is inverted, flat, or not of numbers.
fn corner_weights(centre: &Point, ends: [Point; 3]) -> Option<[f64; 3]> {
    let rays = ends.map(|p| p - centre);
    let lengths = rays.map(|r| r.norm());
    let unit = [0, 1, 2].map(|i| rays[i] / lengths[i]);
    // Normal of the plane through the centre and the edge opposite to corner i, angle seen there.
    let across = [(1, 2), (2, 0), (0, 1)].map(|(j, k)| (unit[j].cross(&unit[k]), unit[j].dot(&unit[k])));
    let sines = across.map(|(normal, _)| normal.norm());
    let determinant = unit[0].dot(&across[0].0);
    // A NaN, from a zero length, is not trusted either.
    let trusted = determinant > THINNEST;
    if !trusted {
        return None;
    }
    let normals = [0, 1, 2].map(|i| across[i].0 / sines[i]);
    // libm's, because the platform's own differ in the last bit from one system to the next.
    let half = [0, 1, 2].map(|i| normals[i] * (0.5 * libm::atan2(sines[i], across[i].1)));
    let mean = half[0] + half[1] + half[2];
    let weights = [0, 1, 2].map(|i| mean.dot(&normals[i]) * sines[i] / (determinant * lengths[i]));
    weights.iter().all(|&w| w > 0.0 && w.is_finite()).then_some(weights)
}

/// The same weight for every neighbour, in place of what `row` holds.
fn uniform(v: usize, tetrahedra: &[[u32; 4]], star: &[u32], row: &mut Vec<(u32, f64)>) {
    row.clear();
    row.extend(star.iter().flat_map(|&t| tetrahedra[t as usize]).filter(|&u| u as usize != v).map(|u| (u, 1.0)));
    row.sort_by_key(|entry| entry.0);
    row.dedup();
}

/// Makes the entries add up to 1.
fn normalise(row: &mut [(u32, f64)]) {
    let sum: f64 = row.iter().map(|entry| entry.1).sum();
    for entry in row {
        entry.1 /= sum;
    }
}

/// The other three vertices of a tetrahedron around `v`.
fn opposite(v: u32, tetrahedron: &[u32; 4]) -> [u32; 3] {
    let i = tetrahedron.iter().position(|&u| u == v).unwrap_or(0);
    OPPOSITE[i].map(|k| tetrahedron[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::testing::{jittered, tet_box};
    use crate::mesh::{Cells, Mesh};
    use crate::rng::SplitMix64;
    use proptest::prelude::*;

    fn rows(mesh: &Mesh, inner: &[bool]) -> SparseRows {
        let Cells::Tetrahedra(t) = mesh.cells() else { panic!("not tetrahedra") };
        mean_value_weights(mesh.points(), t, inner, &Context::default()).unwrap()
    }

    /// The 24 tetrahedra around the centre of the box of two cubes a side, and that centre.
    fn star(seed: u64) -> (Mesh, Vec<bool>) {
        let mesh = jittered(&tet_box([2, 2, 2]), 0.15, seed);
        let inner = (0..27).map(|v| v == 13).collect();
        (mesh, inner)
    }

    #[test]
    fn a_regular_octahedron_weighs_alike() {
        let axis = |k: usize, s: f64| {
            let mut p = Point::origin();
            p[k] = s;
            p
        };
        let points = [axis(0, 1.0), axis(1, 1.0), axis(2, 1.0)];
        let weights = corner_weights(&Point::origin(), points).unwrap();
        // Mean of the unit normals over an octant: (π/4)(1, 1, 1).
        for w in weights {
            assert!((w - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
        }
    }

    #[test]
    fn an_inverted_star_weighs_uniformly() {
        let (mut mesh, inner) = star(1);
        mesh.points_mut()[13] = Point::new(5.0, 5.0, 5.0);
        let row: Vec<_> = rows(&mesh, &inner).row(13).collect();
        assert!(row.len() > 10 && row.iter().all(|e| e.1 == row[0].1));
        assert!((row.iter().map(|e| e.1).sum::<f64>() - 1.0).abs() < 1e-14);
        mesh.points_mut()[13] = mesh.points()[0];
        assert!(rows(&mesh, &inner).row(13).all(|e| e.1.is_finite()));
    }

    proptest! {
        #[test]
        fn linear_functions_are_reproduced(seed in any::<u64>()) {
            let (mesh, inner) = star(seed);
            let mut random = SplitMix64::new(!seed);
            let slope = [0, 1, 2].map(|_| random.unit() - 0.5);
            let f = |p: &Point| 3.0 + slope[0] * p.x + slope[1] * p.y + slope[2] * p.z;
            let row: Vec<_> = rows(&mesh, &inner).row(13).collect();
            prop_assert!(row.iter().all(|e| e.1 > 0.0));
            let mean: f64 = row.iter().map(|&(j, w)| w * f(&mesh.points()[j])).sum();
            prop_assert!((mean - f(&mesh.points()[13])).abs() < 1e-13);
        }
    }
}
