//! Carry a mesh onto a new polycube structure.
//!
//! [`morph`] solves the Laplace problem of the finalisation (paper, section 6).

mod cotangent;
mod dissection;
#[cfg(test)]
mod for_bench;
mod harmonic;
mod ilu;
mod krylov;
mod ldl;
mod mean_value;
mod morph;
#[cfg(test)]
mod on_real_data;
mod solve;
mod sparse;
#[cfg(test)]
pub(crate) mod testing;

pub(crate) use cotangent::positive_weights;
pub(crate) use harmonic::extend_harmonic;
pub use morph::morph;
pub(crate) use sparse::SparseRows;
