//! What is on the other side of each face of each hexahedron.

use crate::mesh::hexahedron::{FACES, shared_faces};

/// No hexahedron.
const NONE: u32 = u32::MAX;

/// Of each face of each hexahedron the one on the other side.
pub(super) struct Across(Vec<u32>);

impl Across {
    /// O(n log n).
    pub(super) fn new(cells: &[[u32; 8]]) -> Self {
        let mut across = vec![NONE; cells.len() * FACES.len()];
        for [one, other] in shared_faces(cells) {
            across[slot(one.cell, one.face.into())] = other.cell;
            across[slot(other.cell, other.face.into())] = one.cell;
        }
        Self(across)
    }

    /// The hexahedron beyond face 0 to 5 of `cell`.
    pub(super) fn of(&self, cell: u32, face: usize) -> Option<u32> {
        Some(self.0[slot(cell, face)]).filter(|&other| other != NONE)
    }
}

fn slot(cell: u32, face: usize) -> usize {
    cell as usize * FACES.len() + face
}
