//! Quadrilaterals, hexahedra and coarse layouts: the lattice mapped onto the shape.

mod embedding;
mod hexes;
mod layout;
mod quads;
mod remesher;

pub(crate) use hexes::check_padding;
pub use hexes::{Hexes, MAX_PADDING};
pub use layout::{Layout, SingularEdge};
pub use quads::Quads;
pub use remesher::Remesher;
