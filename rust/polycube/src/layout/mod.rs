//! Base complex and patches of a placed structure, and how many there are.

mod boxes;
mod complex;
mod lattice;
mod rows;
mod separatrices;

pub use boxes::{Block, Patch};
pub use complex::{Complex, Counts};
pub use lattice::Lattice;
pub use rows::Rows;
pub use separatrices::Separatrices;

use crate::structure::Arrangement;

/// Counts patches and blocks of an arrangement without conflicts. O(c) for c cells of its coarsest lattice.
pub fn count(arrangement: &Arrangement) -> Counts {
    let lattice = Lattice::new(arrangement);
    Complex::new(&lattice, arrangement).counts(arrangement)
}
