//! From a simplified polycube to coarse layouts, quadrilateral and hexahedral meshes (paper, section 7).
//!
//! [`remesh`] is the way in: its result has a [`Layout`] (one cell per block and per patch), [`Quads`] and [`Hexes`].

mod fit;
pub(crate) mod lattice;
pub(crate) mod map;
mod meshed;
pub(crate) mod mesher;
mod options;
mod pipeline;
mod report;
mod select;
mod stages;

#[cfg(test)]
mod tests;

pub(crate) use lattice::count_hexes;
pub use lattice::{BoundaryFace, Size};
pub(crate) use map::Refined;
pub use mesher::{Hexes, Layout, Quads, SingularEdge, carry_groups, grouped, grouped_by};
pub use options::RemeshOptions;
pub use pipeline::{Remeshed, remesh};
pub use report::{InvertedCell, RemeshReport};
pub use select::{Failure, TriedPoint};
pub use stages::Stages;
