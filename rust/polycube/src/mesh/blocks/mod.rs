//! The block structure of a mesh of hexahedra: each block a grid, what lies beyond its faces, and which of its edges
//! have as many hexahedra as which others.

mod across;
mod classes;
mod faces;
mod grid;

#[cfg(test)]
mod tests;

use super::GroupedHexes;
use crate::error::{Error, ErrorKind, Result};
use across::Across;
use grid::Walker;

/// The faces of a block by the axis and side that they lie at.
pub const BLOCK_FACES: [&str; 6] = ["-i", "+i", "-j", "+j", "-k", "+k"];

/// A box of hexahedra.
///
/// Its axes i, j and k are those of its first hexahedron in VTK's order, and are right-handed where that is. Vertices
/// and hexahedra are counted from the lower end of each axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Its number among [`GroupedHexes::blocks`].
    pub group: u32,
    /// How many hexahedra it has along each axis.
    pub size: [u32; 3],
    /// Its vertices, one more than hexahedra along each axis: i runs fastest, k slowest.
    pub vertices: Vec<u32>,
    /// Its hexahedra, i fastest.
    pub cells: Vec<u32>,
    /// What lies beyond its faces, in the order of [`BLOCK_FACES`].
    pub faces: [Beyond; 6],
    /// The class of the edges along each axis; see [`Blocks::classes`].
    pub class: [u32; 3],
    /// Whether the edges of the class run along the axis (1) or against it (−1).
    pub sign: [i8; 3],
}

/// What lies beyond a face of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// A whole face of another block, or of the same one.
    Block(Neighbour),
    /// The outside.
    Outside {
        /// The number of its patch among [`GroupedHexes::patches`].
        patch: u32,
        /// The number of its side among [`GroupedHexes::sides`].
        side: u32,
    },
}

/// How a block goes on in another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neighbour {
    /// The number of that block among [`Blocks::blocks`].
    pub block: u32,
    /// Which of its faces it is, 0 to 5.
    pub face: u8,
    /// For each axis of this block the axis of that one that it goes on in, 1 to 3, negative where that runs the other
    /// way, as CGNS has it.
    pub transform: [i8; 3],
    /// Where the first vertex of this face, the one with the lowest places along i, j and k, is in that block.
    pub first: [u32; 3],
}

/// All blocks of a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Blocks {
    /// The blocks that are not empty, in the order of [`GroupedHexes::blocks`].
    pub blocks: Vec<Block>,
    /// How many hexahedra lie along the edges of each class. Edges are in one class that lie opposite to each other in
    /// a block, and so on from block to block: who changes the number of one changes that of all.
    pub classes: Vec<u32>,
}

impl Blocks {
    /// The block structure of a mesh whose blocks are boxes that share whole faces, as those of [`remesh`] are.
    /// O(n log n) for n hexahedra.
    ///
    /// ```
    /// use polycube::generate::{Example, example};
    /// use polycube::mesh::{Blocks, CellKind};
    /// use polycube::remesh::{RemeshOptions, Size, remesh};
    /// use polycube::{Context, Input};
    ///
    /// let (cube, shape) = example(Example::SteppedL, 1, CellKind::Quads)?;
    /// let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
    /// let options = RemeshOptions { size: Some(Size::Hexes(400)), ..RemeshOptions::default() };
    /// let result = remesh(&input, &options, &Context::default())?;
    /// let hexes = result.hexes.expect("not of the surface alone");
    ///
    /// let blocks = Blocks::new(&hexes.grouped()?)?.blocks;
    /// assert_eq!(blocks.len(), result.report.hex_blocks);
    /// let cells: u32 = blocks.iter().map(|block| block.size.iter().product::<u32>()).sum();
    /// assert_eq!(cells as usize, hexes.mesh.cells().len());
    /// # Ok::<(), polycube::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] naming a block that is no box, that shares a part of a face only, or has a face in more
    /// patches than one; [`ErrorKind::Mesh`] where the edges of a class come back turned round, as in a Möbius strip.
    ///
    /// [`remesh`]: crate::remesh::remesh
    pub fn new(hexes: &GroupedHexes) -> Result<Self> {
        let across = Across::new(hexes.cells());
        let walker = Walker::new(hexes, &across);
        let mut blocks = Vec::new();
        for (group, name, cells) in hexes.blocks().members() {
            let (size, vertices, cells) = walker.grid(&cells).ok_or_else(|| no_box(name, cells[0]))?;
            let faces = [Beyond::Outside { patch: 0, side: 0 }; 6];
            blocks.push(Block { group: group as u32, size, vertices, cells, faces, class: [0; 3], sign: [1; 3] });
        }
        faces::join(hexes, &mut blocks)?;
        let classes = classes::number(hexes, &mut blocks)?;
        Ok(Self { blocks, classes })
    }

    /// How many faces lie between two blocks.
    pub fn inner_faces(&self) -> usize {
        let all = self.blocks.iter().flat_map(|block| block.faces);
        all.filter(|beyond| matches!(beyond, Beyond::Block(_))).count() / 2
    }
}

impl Block {
    /// The vertex at a place: along each axis 0 to the size.
    ///
    /// # Panics
    /// For a place beyond the block.
    pub fn vertex(&self, at: [u32; 3]) -> u32 {
        let [i, j, k] = at.map(|x| x as usize);
        let [along, up] = [self.size[0] as usize + 1, self.size[1] as usize + 1];
        self.vertices[(k * up + j) * along + i]
    }

    /// The places of the corners, in VTK's order.
    pub(super) fn corners(&self) -> [[u32; 3]; 8] {
        super::hexahedron::OCTANTS.map(|octant| [0, 1, 2].map(|a| if octant >> a & 1 == 1 { self.size[a] } else { 0 }))
    }

    /// The quadrilaterals of a face, 0 to 5; some look inward.
    pub(super) fn quads(&self, face: usize) -> Vec<[u32; 4]> {
        let [u, v] = [[1, 2], [0, 2], [0, 1]][face / 2];
        let mut at = [if face % 2 == 1 { self.size[face / 2] } else { 0 }; 3];
        let mut vertex = |[x, y]: [u32; 2]| {
            (at[u], at[v]) = (x, y);
            self.vertex(at)
        };
        let all = (0..self.size[v]).flat_map(|y| (0..self.size[u]).map(move |x| [x, y]));
        all.map(|[x, y]| [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].map(&mut vertex)).collect()
    }

    /// The vertices along the edge that begins at a corner, in the direction of an axis.
    pub(super) fn edge(&self, corner: [u32; 3], axis: usize) -> Vec<u32> {
        let mut at = corner;
        let step = |x| {
            at[axis] = x;
            self.vertex(at)
        };
        (0..=self.size[axis]).map(step).collect()
    }

    /// The edges along an axis: of each its vertices.
    pub(super) fn edges(&self, axis: usize) -> [Vec<u32>; 4] {
        super::hexahedron::EDGES[axis].map(|[from, _]| self.edge(self.corners()[from], axis))
    }
}

fn no_box(name: &str, cell: u32) -> Error {
    Error::new(ErrorKind::Mismatch, format!("{name} is no box of hexahedra"))
        .at(crate::error::Place::Cell(cell))
        .remedy("give each block the hexahedra of one box, as `block_id` of a mesh from `remesh` does")
}
