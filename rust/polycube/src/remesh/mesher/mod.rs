//! Quadrilaterals, hexahedra and coarse layouts: the lattice mapped onto the shape.

mod embedding;
mod groups;
mod hexes;
mod layout;
mod quads;
mod remesher;

pub use groups::grouped;
pub use hexes::Hexes;
#[cfg(test)]
pub(crate) use hexes::MAX_PADDING;
pub(crate) use hexes::check_padding;
pub use layout::{Layout, SingularEdge};
pub use quads::Quads;
pub(crate) use remesher::Remesher;
