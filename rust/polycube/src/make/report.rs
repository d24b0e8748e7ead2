//! What was made, and how good it is.

use super::embedding::Embedded;
use super::loops::along;
use crate::measure::{Distortion, distortion};
use crate::mesh::{Cells, Face, Mesh, Point};
use crate::repair::Repair;
use crate::structure::area_vector;

/// Wall-clock seconds of the stages.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct MakeSeconds {
    /// Finding the loops and drawing the charts.
    pub structure: f64,
    /// Placing the facets and making the map one to one.
    pub embedding: f64,
    /// All of it.
    pub total: f64,
}

/// What was made, and how good it is.
#[derive(Clone, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct MakeReport {
    /// What of the shape was repaired first, in the order in which it was; mostly nothing.
    pub repairs: Vec<Repair>,
    /// Corners of the polycube.
    pub corners: usize,
    /// Its edges.
    pub edges: usize,
    /// Its facets.
    pub facets: usize,
    /// Handles, over all parts.
    pub genus: usize,
    /// The rows of the rotation that takes directions of the shape to those of the polycube; nothing where its axes are
    /// those of the coordinates.
    pub rotation: Option<[[f64; 3]; 3]>,
    /// Mean over the surface of one minus the cosine between its normal and the direction of its facet: 0 for a
    /// polycube.
    pub misfit: f64,
    /// The share of the surface that is less than a quarter as long on the polycube, in some direction, as on average:
    /// there meshes are coarse and their cells thin.
    pub squashed: f64,
    /// How far the map from the shape to the polycube is from a similarity; nothing where it is folded.
    pub distortion: Option<Distortion>,
    /// Vertices that were added to the shape to make room for the map.
    pub added: usize,
    /// The triangles whose map is turned over; none where the map is one to one.
    pub folded: Vec<usize>,
    /// How long it took.
    pub seconds: MakeSeconds,
}

impl MakeReport {
    pub(super) fn new(input: &Mesh, embedded: &Embedded, [polycube, shape]: [&Mesh; 2], seconds: MakeSeconds) -> Self {
        let structure = &embedded.polycube.structure;
        Self {
            repairs: Vec::new(),
            corners: structure.corners.len(),
            edges: structure.edges.len(),
            facets: structure.facets.len(),
            genus: structure.genus(),
            rotation: None,
            misfit: misfit(shape, &embedded.refined.labels()),
            squashed: squashed(shape, polycube),
            distortion: distortion(shape, polycube).ok().filter(|_| embedded.folded.is_empty()),
            added: shape.points().len() - input.points().len(),
            folded: embedded.folded.clone(),
            seconds,
        }
    }
}

/// See [`MakeReport::squashed`].
const SQUASHED: f64 = 0.25;

/// The share of the area of a shape where the least singular value of the map to its polycube, both of one area, is
/// small.
fn squashed(shape: &Mesh, polycube: &Mesh) -> f64 {
    let Cells::Triangles(triangles) = shape.cells() else { return 0.0 };
    let doubled = |mesh: &Mesh, t: &[u32; 3]| area_vector(mesh.points(), &Face::Triangle(*t)).norm();
    let total = |mesh: &Mesh| triangles.iter().map(|t| doubled(mesh, t)).sum::<f64>();
    let scale = (total(shape) / total(polycube)).sqrt();
    let small =
        |t: &&[u32; 3]| scale * least_stretch(&t.map(|v| [shape, polycube].map(|m| m.points()[v as usize]))) < SQUASHED;
    // The sum of none is -0 otherwise.
    triangles.iter().filter(small).fold(0.0, |sum, t| sum + doubled(shape, t)) / total(shape)
}

/// The smaller singular value of the map of a triangle, whose corners are given before and after; 1 for one without
/// area.
fn least_stretch(corners: &[[Point; 2]; 3]) -> f64 {
    let gram = |k: usize| {
        let (u, v) = (corners[1][k] - corners[0][k], corners[2][k] - corners[0][k]);
        [u.dot(&u), u.dot(&v), v.dot(&v)]
    };
    let determinant = |g: [f64; 3]| g[0] * g[2] - g[1] * g[1];
    let (f, t) = (gram(0), gram(1));
    if determinant(f) <= 0.0 {
        return 1.0;
    }
    let sum = (f[2] * t[0] - 2.0 * f[1] * t[1] + f[0] * t[2]) / determinant(f);
    let product = f64::max(determinant(t), 0.0) / determinant(f);
    let larger = 0.5 * (sum + f64::max(sum * sum - 4.0 * product, 0.0).sqrt());
    if larger > 0.0 { (product / larger).sqrt() } else { 0.0 }
}

/// The mean over triangles, by their areas, of one minus the cosine between normal and label.
fn misfit(shape: &Mesh, labels: &[i8]) -> f64 {
    let Cells::Triangles(triangles) = shape.cells() else { return 0.0 };
    let (mut looking, mut total) = (0.0, 0.0);
    for (&t, &label) in triangles.iter().zip(labels) {
        let normal = area_vector(shape.points(), &Face::Triangle(t));
        looking += along(&normal, label as u8);
        total += normal.norm();
    }
    1.0 - looking / f64::max(total, f64::MIN_POSITIVE)
}
