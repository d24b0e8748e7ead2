//! Surfaces whose faces are in groups.

use super::{Groups, Mesh};
use crate::error::{Error, ErrorKind, Result};

/// A surface of triangles or quadrilaterals whose faces are in groups.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupedSurface {
    mesh: Mesh,
    groups: Groups,
}

impl GroupedSurface {
    /// The faces of `mesh` in `groups`, one for each in its order.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a volume; [`ErrorKind::Mesh`] for no faces; [`ErrorKind::Mismatch`] unless there
    /// is one group for each face.
    pub fn new(mesh: Mesh, groups: Groups) -> Result<Self> {
        if mesh.cells().is_volume() {
            let message = format!("{} have no groups of faces", mesh.cells().kind());
            return Err(Error::new(ErrorKind::Unsupported, message).remedy("give triangles or quadrilaterals"));
        }
        if mesh.cells().is_empty() {
            return Err(Error::new(ErrorKind::Mesh, "a surface without faces has no groups"));
        }
        if groups.of().len() != mesh.cells().len() {
            let message = format!("{} faces are in groups, and the mesh has {}", groups.of().len(), mesh.cells().len());
            return Err(Error::new(ErrorKind::Mismatch, message).remedy("give one group for each face"));
        }
        Ok(Self { mesh, groups })
    }

    /// The surface.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The group of each face.
    pub fn groups(&self) -> &Groups {
        &self.groups
    }
}
