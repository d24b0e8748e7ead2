//! What is on the other side of each face of each hexahedron.

use super::HexFace;
use crate::mesh::hexahedron::FACES;

/// No hexahedron.
const NONE: u32 = u32::MAX;

/// Of each face of each hexahedron the one on the other side.
pub(super) struct Across(Vec<u32>);

impl Across {
    /// Faces are the same where all their vertices are; none is that of more than two hexahedra. O(n log n).
    pub(super) fn new(cells: &[[u32; 8]]) -> Self {
        let mut keys = Vec::with_capacity(cells.len() * FACES.len());
        for (cell, _) in (0..).zip(cells) {
            for side in (0..FACES.len() as u8).map(|face| HexFace { cell, face }) {
                let mut key = side.vertices(cells);
                key.sort_unstable();
                keys.push((key, side));
            }
        }
        keys.sort_unstable();
        let mut across = vec![NONE; keys.len()];
        for same in keys.chunk_by(|a, b| a.0 == b.0) {
            if let [(_, one), (_, other)] = same {
                across[slot(one.cell, one.face.into())] = other.cell;
                across[slot(other.cell, other.face.into())] = one.cell;
            }
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
