//! A mesh read as a polycube: its structure, and what of the structure each face and vertex belongs to.

use super::label::Label;
use super::{Placement, Structure, Surface};
use crate::range::Range;

/// How far a mesh may be from a polycube and still be read as one.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct Tolerance {
    /// Largest angle between a face and the nearest axis, in degrees; 0 to 45.
    pub degrees: f64,
    /// Largest distance of a vertex from the plane of its chart, and from its place in order along a polycube edge, as
    /// a fraction of the bounding box's diagonal; 0 to 1.
    pub distance: f64,
    /// Levels closer than this fraction of the bounding box's diagonal are taken to be equal; 0 to 1.
    pub merge: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { degrees: 30.0, distance: 0.05, merge: 1e-6 }
    }
}

impl Tolerance {
    /// Refuses what is out of its range.
    ///
    /// # Errors
    /// [`ErrorKind::Option`](crate::ErrorKind::Option), which names the field.
    pub fn check(&self) -> crate::Result<()> {
        Range::Within(0.0, 45.0).check("tolerance.degrees", self.degrees)?;
        Range::Within(0.0, 1.0).check("tolerance.distance", self.distance)?;
        Range::Within(0.0, 1.0).check("tolerance.merge", self.merge)
    }
}

/// How far the mesh is from a polycube.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct Deviation {
    /// Largest angle between a face and the axis of its label, in degrees.
    pub degrees: f64,
    /// Largest distance of a vertex from the plane of its chart, or from its place in order along a polycube edge, in
    /// the units of the mesh.
    pub distance: f64,
    /// How many vertices along polycube edges are out of order.
    pub out_of_order: usize,
}

/// A [`Structure`] found on a mesh, with the way back to the mesh.
#[derive(Clone, Debug)]
pub struct Polycube {
    /// Facets, edges, corners, levels.
    pub structure: Structure,
    /// The levels as the mesh has them, in its units.
    pub placement: Placement,
    /// The boundary of the mesh.
    pub surface: Surface,
    /// The facet of every boundary face.
    pub facet_of_face: Vec<u32>,
    /// The mesh vertices along every edge, from its lower to its higher corner.
    pub chains: Vec<Vec<u32>>,
    /// For every mesh vertex and axis, the level that it must lie on: three at corners, two on edges, one on facets.
    pub vertex_levels: Vec<[Option<u32>; 3]>,
    /// How far the mesh is from exact.
    pub deviation: Deviation,
}

impl Polycube {
    /// The label of every boundary face.
    pub fn labels(&self) -> impl Iterator<Item = Label> + '_ {
        self.facet_of_face.iter().map(|&f| self.structure.facets[f as usize].label)
    }

    /// The prescribed coordinates of every mesh vertex when the levels lie at `placement`.
    pub fn prescribed(&self, placement: &[f64]) -> Vec<[Option<f64>; 3]> {
        let at = |level: Option<u32>| level.map(|l| placement[l as usize]);
        self.vertex_levels.iter().map(|levels| levels.map(at)).collect()
    }
}
