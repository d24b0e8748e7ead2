//! The integer lattice inside a polycube, its size, and the padding around it.

mod carrier;
mod grid;
mod keys;
mod padding;
mod size;

pub use carrier::Carrier;
pub(crate) use grid::{Grid, Rectangle};
pub(crate) use keys::{Keys, rank, too_fine};
pub(crate) use padding::Padding;
pub use size::{MOST_HEXES, Size, count_hexes, scale_for};
pub(crate) use size::{ScaleSearch, check_count};
