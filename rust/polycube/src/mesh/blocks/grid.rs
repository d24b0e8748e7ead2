//! The grid of a block, found by walking from hexahedron to hexahedron.

use super::across::Across;
use crate::mesh::GroupedHexes;
use crate::mesh::hexahedron::{CORNERS, FACES, OCTANTS};

/// A hexahedron as it lies in its block: of each octant of the block's axes which of its vertices is there.
#[derive(Clone, Copy)]
struct Seen {
    cell: u32,
    local: [usize; 8],
}

/// Size, vertices and hexahedra of a block.
type Grid = ([u32; 3], Vec<u32>, Vec<u32>);

/// Walks within blocks.
pub(super) struct Walker<'a> {
    cells: &'a [[u32; 8]],
    block: &'a [u32],
    across: &'a Across,
}

impl<'a> Walker<'a> {
    pub(super) fn new(hexes: &'a GroupedHexes, across: &'a Across) -> Self {
        Self { cells: hexes.cells(), block: hexes.blocks().of(), across }
    }

    /// The grid of the block that has just these hexahedra, its axes those of the first; nothing if they are no box. A
    /// block that goes round and meets itself is cut open there. Linear time.
    pub(super) fn grid(&self, members: &[u32]) -> Option<Grid> {
        let mut corner = Seen { cell: *members.first()?, local: OCTANTS };
        for axis in 0..3 {
            corner = self.run(corner, axis, false, members.len()).1;
        }
        let size = [0, 1, 2].map(|axis| self.run(corner, axis, true, members.len()).0);
        if size.iter().try_fold(1_usize, |all, &n| all.checked_mul(n)) != Some(members.len()) {
            return None;
        }
        let mut seen = Vec::with_capacity(members.len());
        seen.push(corner);
        for n in 1..members.len() {
            let strides = [1, size[0], size[0] * size[1]];
            let axis = (0..2).find(|&a| n % strides[a + 1] != 0).unwrap_or(2);
            seen.push(self.next(&seen[n - strides[axis]], axis, true)?);
        }
        let vertices = self.vertices(size, &seen)?;
        let cells: Vec<u32> = seen.iter().map(|s| s.cell).collect();
        let mut sorted = cells.clone();
        sorted.sort_unstable();
        (sorted == members).then_some((size.map(|n| n as u32), vertices, cells))
    }

    /// How many hexahedra there are from one on along an axis, and the last; `most` at most.
    fn run(&self, start: Seen, axis: usize, up: bool, most: usize) -> (usize, Seen) {
        let (mut count, mut last) = (1, start);
        while let Some(next) = self.next(&last, axis, up).filter(|next| next.cell != start.cell && count < most) {
            (count, last) = (count + 1, next);
        }
        (count, last)
    }

    /// The hexahedron of the same block at the upper or lower side along an axis.
    fn next(&self, from: &Seen, axis: usize, up: bool) -> Option<Seen> {
        let shared = OCTANTS.into_iter().filter(|octant| (octant >> axis & 1 == 1) == up);
        let face = FACES.iter().position(|face| shared.clone().all(|o| face.contains(&from.local[o])))?;
        let cell = self.across.of(from.cell, face)?;
        if self.block[cell as usize] != self.block[from.cell as usize] {
            return None;
        }
        let (old, new) = (&self.cells[from.cell as usize], &self.cells[cell as usize]);
        let on_face = |v: u32| FACES[face].iter().any(|&k| old[k] == v);
        let mut local = [0; 8];
        for octant in shared {
            let near = new.iter().position(|&v| v == old[from.local[octant]])?;
            local[octant ^ 1 << axis] = near;
            local[octant] = CORNERS[near][1..].iter().copied().find(|&k| !on_face(new[k]))?;
        }
        Some(Seen { cell, local })
    }

    /// The vertices of a grid, if all hexahedra around one have the same there.
    fn vertices(&self, size: [usize; 3], seen: &[Seen]) -> Option<Vec<u32>> {
        let [along, up] = [size[0] + 1, size[1] + 1];
        let mut vertices = vec![None; along * up * (size[2] + 1)];
        for (n, seen) in seen.iter().enumerate() {
            let [i, j, k] = [n % size[0], n / size[0] % size[1], n / (size[0] * size[1])];
            for (octant, &local) in seen.local.iter().enumerate() {
                let place = ((k + (octant >> 2)) * up + j + (octant >> 1 & 1)) * along + i + (octant & 1);
                let vertex = self.cells[seen.cell as usize][local];
                if *vertices[place].get_or_insert(vertex) != vertex {
                    return None;
                }
            }
        }
        vertices.into_iter().collect()
    }
}
