//! From a simplified polycube to coarse layouts, quadrilateral and hexahedral meshes (paper, section 7).
//!
//! [`remesh`] is the way in; it does all of the following. A [`Remesher`] holds the lattice inside the polycube and the
//! map from there to the shape. From it come the [`layout`](Remesher::layout) (one cell per block and per patch),
//! [`quads`](Remesher::quads) and [`hexes`](Remesher::hexes). [`scale_for`] finds the scale of the lattice for a wanted
//! size.

mod fit;
mod lattice;
mod map;
mod meshed;
mod mesher;
mod options;
mod pipeline;
mod report;
mod select;
mod stages;

#[cfg(test)]
mod tests;

pub use lattice::{Carrier, MOST_HEXES, Size, count_hexes, scale_for};
pub use map::LatticeMap;
pub(crate) use map::Refined;
pub use mesher::{Hexes, Layout, MAX_PADDING, Quads, Remesher, SingularEdge};
pub use options::RemeshOptions;
pub use pipeline::{Remeshed, remesh};
pub use report::{InvertedCell, MOST_LISTED, RemeshReport};
pub use stages::Stages;
