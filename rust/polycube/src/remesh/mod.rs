//! From a simplified polycube to coarse layouts, quadrilateral and hexahedral meshes (paper, section 7).
//!
//! [`remesh`] is the way in; it does all of the following. A [`Remesher`] holds the lattice inside the polycube and the map from there to the shape. From it come the
//! [`layout`](Remesher::layout) (one cell per block and per patch), [`quads`](Remesher::quads) and
//! [`hexes`](Remesher::hexes). [`scale_for`] finds the scale of the lattice for a wanted size, [`hausdorff`] measures how
//! far a mesh is from the shape, and [`base_complex`] finds the blocks of any hexahedral mesh.

mod barycentric;
mod base_complex;
mod bracket;
mod choose;
mod climb;
mod embedding;
mod gaps;
mod grid;
mod hausdorff;
mod hexes;
mod improve;
mod interior;
mod keys;
mod layout;
mod locate;
mod padding;
mod pipeline;
mod quads;
mod reach;
mod refine;
mod report;
mod site;
mod size;
mod slide;
mod spacing;
mod start;
mod surface_map;
mod untangle;
mod volume_map;
mod warp;

#[cfg(test)]
mod tests;

pub use base_complex::base_complex;
pub use hausdorff::hausdorff;
pub use hexes::{Hexes, MAX_PADDING};
pub use layout::{Layout, SingularEdge};
pub use pipeline::{RemeshOptions, Remeshed, remesh};
pub use quads::Quads;
pub use report::{InvertedCell, MOST_LISTED, RemeshReport, Stages};
pub use site::Site;
pub use size::{MOST_HEXES, Size, count_hexes, scale_for};

use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Mesh, Point};
use crate::simplify::Simplified;
use grid::Grid;
use std::sync::OnceLock;
use surface_map::SurfaceMap;
use volume_map::VolumeMap;

/// The lattice of a simplified polycube and its map onto a shape.
pub struct Remesher<'a> {
    simplified: &'a Simplified,
    polycube: &'a Mesh,
    shape: &'a [Point],
    grid: Grid,
    surface: SurfaceMap<'a>,
    volume: OnceLock<Option<VolumeMap<'a>>>,
}

impl<'a> Remesher<'a> {
    /// Cuts the polycube into unit cells and indexes its surface. The polycube itself may stand for a missing shape.
    ///
    /// O(n log n) for n lattice cells and mesh cells together; memory in proportion to both.
    ///
    /// # Errors
    /// [`ErrorKind::Polycube`] when the simplification gave no valid polycube; [`ErrorKind::Mismatch`] unless `shape` has
    /// the cells of the polycube; [`ErrorKind::Option`] when the lattice is finer than 32-bit indices can count;
    /// [`ErrorKind::Cancelled`].
    pub fn new(simplified: &'a Simplified, shape: &'a Mesh, context: &Context) -> Result<Self> {
        context.tick(0.0)?;
        let polycube = simplified.polycube.as_ref().ok_or_else(invalid)?;
        if polycube.cells != shape.cells || polycube.points.len() != shape.points.len() {
            let message = "shape and polycube do not have the same vertices and cells";
            return Err(Error::new(ErrorKind::Mismatch, message).remedy("give the shape of this polycube"));
        }
        let grid = Grid::new(&simplified.input.structure, &simplified.levels)?;
        context.tick(0.7)?;
        let surface = SurfaceMap::new(&simplified.input, &polycube.points, &shape.points);
        context.tick(1.0)?;
        Ok(Self { simplified, polycube, shape: &shape.points, grid, surface, volume: OnceLock::new() })
    }

    /// The tetrahedral map, indexed at its first use; nothing for surfaces.
    fn volume(&self) -> Option<&VolumeMap<'a>> {
        self.volume.get_or_init(|| VolumeMap::new(self.polycube, self.shape)).as_ref()
    }
}

fn invalid() -> Error {
    Error::new(ErrorKind::Polycube, "there is no valid polycube to mesh: rounding to the lattice made it touch itself")
        .remedy("use the strategy `paper`, or a larger scale")
}
