//! How sound hexahedra are: what makes a solver accept them, in one number.
//!
//! A scaled Jacobian divides by the lengths of edges, so a cell that has collapsed along one of them may be perfect by
//! it. Whoever raises the least of it without looking at sizes makes such cells. Soundness is the least of three
//! numbers that are all 1 for cubes of one size: the scaled Jacobian, and what lengths and volumes allow.

use super::quality::{corner_jacobian, edges, or_worst};
use crate::mesh::Point;
use crate::mesh::hexahedron::corner_tetrahedra;
use nalgebra::Matrix3;

/// Determinants whose sum is less than this part of the sum of their sizes are those of a tangled mesh.
const TANGLED: f64 = 0.05;

/// What takes nothing from soundness. Edges twice as far apart in length, or a determinant half as large, make it a
/// half.
pub(crate) struct Fair {
    /// How much longer than another an edge at a corner may be.
    pub(crate) ratio: f64,
    /// The least part of the mean determinant of a mesh.
    pub(crate) determinant: f64,
}

/// What is aimed at when vertices are moved: more than what is accepted, as the last cells never get there.
pub(crate) const AIM: Fair = Fair { ratio: 5.0, determinant: 0.05 };
/// What meshes are judged by.
pub(crate) const ACCEPTED: Fair = Fair { ratio: 8.0, determinant: 0.03 };
/// A mesh whose cells are all as sound as this is good: a scaled Jacobian that Verdict's manual calls acceptable for
/// hexahedra, edges at a corner that differ by no more than a factor of 16, and at least a 67th of the mean
/// determinant.
pub(crate) const GOOD: f64 = 0.5;

/// How sound the corner of a hexahedron with these `edges` is, in −1..1, in a mesh whose `mean` determinant is known
/// (0: it is not).
pub(crate) fn corner_soundness(edges: &Matrix3<f64>, mean: f64, fair: &Fair) -> f64 {
    let jacobian = corner_jacobian(edges);
    if !(jacobian > 0.0 && mean > 0.0) {
        return jacobian;
    }
    let [a, b, c] = [0, 1, 2].map(|i| edges.column(i).norm_squared());
    let ratio = (a.min(b).min(c) / a.max(b).max(c)).sqrt();
    jacobian.min(fair.ratio * ratio).min(edges.determinant() / (fair.determinant * mean))
}

/// How sound a hexahedron is, in −1..1, positive where it is not inverted: as its worst corner.
///
/// # Panics
/// When a vertex is not among `points`.
pub(crate) fn soundness(points: &[Point], hex: &[u32; 8], mean: f64) -> f64 {
    let corner = |corner: [u32; 4]| or_worst(corner_soundness(&edges(points, corner), mean, &ACCEPTED));
    corner_tetrahedra(hex).into_iter().map(corner).fold(1.0, f64::min)
}

/// The mean of the corner determinants of hexahedra; where they all but cancel each other out, of their sizes. 0 for
/// none. Linear time.
pub(crate) fn mean_determinant(points: &[Point], hexes: &[[u32; 8]]) -> f64 {
    mean(hexes.iter().flat_map(corner_tetrahedra).map(|corner| edges(points, corner).determinant()))
}

/// The mean of determinants; where they all but cancel each other out, of their sizes. 0 for none.
pub(crate) fn mean(determinants: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut sizes, mut count) = (0.0, 0.0, 0_usize);
    for determinant in determinants {
        sum += determinant;
        sizes += determinant.abs();
        count += 1;
    }
    let all = count.max(1) as f64;
    if sum > TANGLED * sizes { sum / all } else { sizes / all }
}
