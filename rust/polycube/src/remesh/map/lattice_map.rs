//! A polycube on an integer lattice: what a map from there to a shape needs of it.

use super::level_interpolation::LevelInterpolation;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::simplify::Simplified;
use crate::structure::{Polycube, Structure};
use std::sync::Arc;

/// A polycube on an integer lattice. With a shape that has the same cells it is a map from the lattice to that shape.
#[derive(Clone, Debug)]
pub(crate) struct LatticeMap {
    /// The polycube as it was read: which facet, edge or corner each face and vertex of the mesh belongs to.
    pub polycube: Arc<Polycube>,
    /// The mesh in lattice units: its facets lie at the levels.
    pub mesh: Mesh,
    /// The lattice coordinate of each level of the structure.
    pub levels: Vec<i64>,
}

impl LatticeMap {
    /// That of a simplified polycube. Linear time.
    ///
    /// # Errors
    /// [`ErrorKind::Polycube`] when the simplification gave no valid polycube.
    pub(crate) fn new(simplified: &Simplified) -> Result<Self> {
        let mesh = simplified.polycube.clone().ok_or_else(invalid)?;
        Ok(Self { polycube: Arc::new(simplified.input.clone()), mesh, levels: simplified.levels.clone() })
    }

    /// The facets, edges and levels.
    pub(crate) fn structure(&self) -> &Structure {
        &self.polycube.structure
    }

    /// The same map onto a lattice with other levels in the same order: points between levels move in proportion.
    pub(crate) fn on_levels(&self, levels: Vec<i64>) -> Self {
        let mut mesh = self.mesh.clone();
        LevelInterpolation::new(self.structure(), &self.levels, &levels).move_all(mesh.points_mut());
        Self { polycube: Arc::clone(&self.polycube), mesh, levels }
    }
}

fn invalid() -> Error {
    Error::new(ErrorKind::Polycube, "there is no valid polycube to mesh: rounding to the lattice made it touch itself")
        .remedy("use the strategy `paper`, or a larger scale")
}
