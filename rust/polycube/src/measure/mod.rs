//! What is measured of meshes: the quality of cells, what is turned over, distortion, distances, blocks.
//!
//! [`scaled_jacobians`], [`Quality`] and [`CellMeasures`] say how good cells are, [`flipped`] what a map turned over,
//! [`distortion`] how far one mesh is from a similarity of another, [`hausdorff`] how far a mesh is from a shape, and
//! `base_complex` finds the blocks of any hexahedral mesh, and `crossings` where a surface crosses itself.

mod base_complex;
mod cells;
mod crossings;
mod distortion;
mod faces;
mod flipped;
pub(crate) mod hausdorff;
mod quality;
mod soundness;

pub(crate) use base_complex::base_complex;
pub use cells::{CellMeasures, MeasureSummary, Spread};
pub(crate) use crossings::crossings;
pub use distortion::{Distortion, distortion};
pub use flipped::{Flipped, flipped};
pub use hausdorff::hausdorff;
pub(crate) use quality::BARS;
pub(crate) use quality::edges;
pub use quality::{Quality, Statistics, cell_qualities, scaled_jacobian, scaled_jacobians, statistics};
pub(crate) use quality::{or_worst, quadrilateral_scaled_jacobian, tetrahedron_volume};
pub(crate) use soundness::{ACCEPTED, AIM, Fair, GOOD, corner_soundness, mean, mean_determinant, soundness};
