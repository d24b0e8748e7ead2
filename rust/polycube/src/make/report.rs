//! What was made, and how good it is.

use super::embedding::Embedded;
use super::loops::along;
use crate::measure::{Distortion, distortion};
use crate::mesh::{Cells, Face, Mesh};
use crate::structure::area_vector;

/// Wall-clock seconds of the stages.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct MakeSeconds {
    /// Finding the loops and drawing the charts.
    pub structure: f64,
    /// Placing the facets and making the map one to one.
    pub embedding: f64,
    /// All of it.
    pub total: f64,
}

/// What was made, and how good it is.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct MakeReport {
    /// Corners of the polycube.
    pub corners: usize,
    /// Its edges.
    pub edges: usize,
    /// Its facets.
    pub facets: usize,
    /// Handles, over all parts.
    pub genus: usize,
    /// Mean over the surface of one minus the cosine between its normal and the direction of its facet: 0 for a
    /// polycube.
    pub misfit: f64,
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
            corners: structure.corners.len(),
            edges: structure.edges.len(),
            facets: structure.facets.len(),
            genus: structure.genus(),
            misfit: misfit(shape, &embedded.refined.labels()),
            distortion: distortion(shape, polycube).ok().filter(|_| embedded.folded.is_empty()),
            added: shape.points().len() - input.points().len(),
            folded: embedded.folded.clone(),
            seconds,
        }
    }
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
