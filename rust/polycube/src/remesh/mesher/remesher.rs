//! The lattice inside a polycube and the map from there onto a shape.

use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Mesh, Point};
use crate::remesh::lattice::Grid;
use crate::remesh::map::{LatticeMap, SurfaceMap, VolumeMap};
use std::sync::OnceLock;

/// The lattice inside a polycube and the map from there onto a shape.
pub(crate) struct Remesher<'a> {
    pub(crate) map: &'a LatticeMap,
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
    /// [`ErrorKind::Mismatch`] unless `shape` has the cells of the polycube; [`ErrorKind::Option`] when the lattice is
    /// finer than 32-bit indices can count; [`ErrorKind::Cancelled`].
    pub(crate) fn new(map: &'a LatticeMap, shape: &'a Mesh, context: &Context) -> Result<Self> {
        context.tick(0.0)?;
        let polycube = &map.mesh;
        if polycube.cells() != shape.cells() || polycube.points().len() != shape.points().len() {
            let message = "shape and polycube do not have the same vertices and cells";
            return Err(Error::new(ErrorKind::Mismatch, message).remedy("give the shape of this polycube"));
        }
        let grid = Grid::new(map.structure(), &map.levels)?;
        context.tick(0.7)?;
        let surface = SurfaceMap::new(&map.polycube, polycube.points(), shape.points());
        context.tick(1.0)?;
        Ok(Self { map, shape: shape.points(), grid, surface, volume: OnceLock::new() })
    }

    /// The tetrahedral map, indexed at its first use; nothing for surfaces.
    pub(crate) fn volume(&self) -> Option<&VolumeMap<'a>> {
        self.volume.get_or_init(|| VolumeMap::new(&self.map.mesh, self.shape)).as_ref()
    }
}
