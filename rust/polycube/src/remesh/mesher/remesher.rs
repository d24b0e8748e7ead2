//! The lattice of a simplified polycube and its map onto a shape.

use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Mesh, Point};
use crate::remesh::lattice::Grid;
use crate::remesh::map::{SurfaceMap, VolumeMap};
use crate::simplify::Simplified;
use std::sync::OnceLock;

/// The lattice of a simplified polycube and its map onto a shape.
pub struct Remesher<'a> {
    pub(crate) simplified: &'a Simplified,
    pub(crate) polycube: &'a Mesh,
    pub(crate) shape: &'a [Point],
    pub(crate) grid: Grid,
    pub(crate) surface: SurfaceMap<'a>,
    pub(crate) volume: OnceLock<Option<VolumeMap<'a>>>,
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
    pub(crate) fn volume(&self) -> Option<&VolumeMap<'a>> {
        self.volume.get_or_init(|| VolumeMap::new(self.polycube, self.shape)).as_ref()
    }
}

fn invalid() -> Error {
    Error::new(ErrorKind::Polycube, "there is no valid polycube to mesh: rounding to the lattice made it touch itself")
        .remedy("use the strategy `paper`, or a larger scale")
}
