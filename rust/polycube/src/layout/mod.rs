//! Base complex and patches of a placed structure, and how many there are.

mod boxes;
mod complex;
mod lattice;
mod pieces;
pub(crate) mod rows;
mod separatrices;

pub use boxes::{Block, Patch};
pub use complex::{Complex, Counts};
pub use lattice::Lattice;
pub use pieces::Pieces;
pub(crate) use rows::{Counter, MOST_LEVELS, counter};
pub use separatrices::Separatrices;

use crate::structure::Arrangement;

/// Which of the three numbers shall be small.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, bitcode::Encode, bitcode::Decode,
)]
#[serde(rename_all = "snake_case")]
pub enum Objective {
    /// [`Counts::blocks_padded`], for volumes.
    #[default]
    BlocksPadded,
    /// [`Counts::blocks`].
    Blocks,
    /// [`Counts::surface_patches`], for surfaces.
    SurfacePatches,
}

impl Counts {
    /// The number that `objective` names.
    pub fn of(&self, objective: Objective) -> usize {
        match objective {
            Objective::BlocksPadded => self.blocks_padded,
            Objective::Blocks => self.blocks,
            Objective::SurfacePatches => self.surface_patches,
        }
    }
}

/// Counts patches and blocks of an arrangement without conflicts. O(c) for c cells of its coarsest lattice.
pub fn count(arrangement: &Arrangement) -> Counts {
    let lattice = Lattice::new(arrangement);
    Complex::new(&lattice, arrangement).counts(arrangement)
}
