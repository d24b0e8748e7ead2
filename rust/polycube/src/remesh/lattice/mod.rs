//! The integer lattice inside a polycube, its size, and the padding around it.

mod boundary;
mod carrier;
mod grid;
mod keys;
mod padding;
mod size;

pub use boundary::BoundaryFace;
pub(crate) use carrier::Carrier;
pub(crate) use grid::{Grid, Rectangle};
pub(crate) use keys::{Keys, rank, too_fine};
pub(crate) use padding::Padding;
#[cfg(test)]
pub(crate) use size::MOST_HEXES;
pub use size::Size;
pub(crate) use size::{ScaleSearch, check_count};
pub(crate) use size::{count_hexes, scale_for};
