//! Quadrilaterals, hexahedra and coarse layouts: the lattice mapped onto the shape.

mod carried;
mod embedding;
mod groups;
mod hexes;
mod layout;
mod quads;
mod remesher;
mod uv;

pub use carried::carry_groups;
pub use groups::{grouped, grouped_by};
pub use hexes::Hexes;
#[cfg(test)]
pub(crate) use hexes::MAX_PADDING;
pub(crate) use hexes::check_padding;
pub use layout::{Layout, SingularEdge};
pub use quads::Quads;
pub(crate) use remesher::Remesher;
