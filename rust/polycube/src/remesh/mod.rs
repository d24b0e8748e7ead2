//! From a simplified polycube to coarse layouts, quadrilateral and hexahedral meshes (paper, section 7).
//!
//! [`remesh`] is the way in; it does all of the following. A [`Remesher`] holds the lattice inside the polycube and the map from there to the shape. From it come the
//! [`layout`](Remesher::layout) (one cell per block and per patch), [`quads`](Remesher::quads) and
//! [`hexes`](Remesher::hexes). [`scale_for`] finds the scale of the lattice for a wanted size, [`hausdorff`] measures how
//! far a mesh is from the shape, and [`base_complex`] finds the blocks of any hexahedral mesh.

mod base_complex;
mod fit;
mod hausdorff;
mod lattice;
mod map;
mod meshed;
mod mesher;
mod options;
mod pipeline;
mod report;
mod select;

#[cfg(test)]
mod tests;

pub use base_complex::base_complex;
pub use hausdorff::hausdorff;
pub use lattice::{Carrier, MOST_HEXES, Size, count_hexes, scale_for};
pub use mesher::{Hexes, Layout, MAX_PADDING, Quads, Remesher, SingularEdge};
pub use options::RemeshOptions;
pub use pipeline::{Remeshed, remesh};
pub use report::{InvertedCell, MOST_LISTED, RemeshReport, Stages};
