//! Carry a mesh onto a new polycube structure, and judge the result.
//!
//! [`morph`] solves the Laplace problem of the finalisation (paper, section 6); [`flipped`] lists
//! the elements it turned over, [`distortion`] says how far one mesh is from a similarity of another.

mod check;
mod cotangent;
mod distortion;
mod flipped;
#[cfg(test)]
mod for_bench;
mod harmonic;
mod ilu;
mod krylov;
mod mean_value;
mod morph;
#[cfg(test)]
mod on_real_data;
mod sparse;
#[cfg(test)]
pub(crate) mod testing;

pub use distortion::{Distortion, distortion};
pub use flipped::{Flipped, flipped};
pub(crate) use harmonic::extend_harmonic;
pub use morph::morph;
pub(crate) use sparse::Rows;
