//! Base complex and patches of a placed structure, and how many there are.

mod complex;
mod lattice;
mod separatrices;

pub use complex::{Complex, Counts};
pub use lattice::Lattice;
