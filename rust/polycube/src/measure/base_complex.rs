//! The base complex of any hexahedral mesh, from its cells alone.

use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::hexahedron::FACES;

const NONE: u32 = u32::MAX;

/// The block of the base complex that each hexahedron belongs to, numbered from 0 by their first hexahedra.
///
/// An edge is singular when another number than 4 hexahedra meet at it inside, or than 2 on the boundary. Every
/// singular edge sends a sheet of faces out of each face at it; a sheet goes straight on over regular edges. Blocks are
/// what the sheets separate. Nothing but `hexes` (VTK's order) is used, so this also serves to compare meshes of
/// others.
///
/// O(n log n) time for n hexahedra, about 400 bytes of passing memory for each.
///
/// # Errors
/// [`ErrorKind::Mesh`] naming a cell when three cells share a face, or when there are too many for 32-bit indices;
/// [`ErrorKind::Cancelled`].
pub(crate) fn base_complex(hexes: &[[u32; 8]], context: &Context) -> Result<Vec<u32>> {
    context.check()?;
    let faces = Faces::new(hexes)?;
    context.tick(0.4)?;
    let edges = Edges::new(&faces);
    context.tick(0.8)?;
    let sheets = edges.sheets(&faces);
    context.tick(0.9)?;
    Ok(blocks(hexes.len(), &faces, &sheets))
}

/// The faces of a mesh with the one or two cells at each.
struct Faces {
    vertices: Vec<[u32; 4]>,
    cells: Vec<[u32; 2]>,
    /// Six faces for each cell.
    of_cell: Vec<u32>,
}

impl Faces {
    fn new(hexes: &[[u32; 8]]) -> Result<Self> {
        if hexes.len() as u64 * 24 > u64::from(u32::MAX) {
            return Err(Error::new(ErrorKind::Mesh, "the mesh has too many cells"));
        }
        let ring = |i: usize| FACES[i % 6].map(|k| hexes[i / 6][k]);
        let key = |i: usize| {
            let mut face = ring(i);
            face.sort_unstable();
            face
        };
        let mut sorted: Vec<([u32; 4], u32)> = (0..6 * hexes.len()).map(|i| (key(i), i as u32)).collect();
        sorted.sort_unstable();
        let mut faces = Self { vertices: vec![], cells: vec![], of_cell: vec![NONE; 6 * hexes.len()] };
        for group in sorted.chunk_by(|a, b| a.0 == b.0) {
            let [first, others @ ..] = group else { continue };
            if let [_, third, ..] = others {
                let message = format!("its face {:?} belongs to {} cells", first.0, group.len());
                return Err(Error::new(ErrorKind::Mesh, message).at(Place::Cell(third.1 / 6)));
            }
            group.iter().for_each(|&(_, i)| faces.of_cell[i as usize] = faces.cells.len() as u32);
            faces.vertices.push(ring(first.1 as usize));
            faces.cells.push([first.1 / 6, others.first().map_or(NONE, |o| o.1 / 6)]);
        }
        Ok(faces)
    }

    fn is_inner(&self, face: u32) -> bool {
        self.cells[face as usize][1] != NONE
    }

    fn share_cell(&self, a: u32, b: u32) -> bool {
        self.cells[a as usize].iter().any(|c| *c != NONE && self.cells[b as usize].contains(c))
    }
}

/// The faces around every edge.
struct Edges {
    start: Vec<u32>,
    faces: Vec<u32>,
    /// Four edges for each face.
    of_face: Vec<u32>,
}

impl Edges {
    fn new(faces: &Faces) -> Self {
        let key = |i: usize| {
            let (ring, k) = (&faces.vertices[i / 4], i % 4);
            let (a, b) = (ring[k], ring[(k + 1) % 4]);
            [a.min(b), a.max(b)]
        };
        let mut sorted: Vec<([u32; 2], u32)> = (0..4 * faces.vertices.len()).map(|i| (key(i), i as u32)).collect();
        sorted.sort_unstable();
        let mut edges = Self { start: vec![0], faces: vec![], of_face: vec![NONE; sorted.len()] };
        for group in sorted.chunk_by(|a, b| a.0 == b.0) {
            for &(_, i) in group {
                edges.of_face[i as usize] = edges.start.len() as u32 - 1;
                edges.faces.push(i / 4);
            }
            edges.start.push(edges.faces.len() as u32);
        }
        edges
    }

    fn around(&self, edge: u32) -> &[u32] {
        &self.faces[self.start[edge as usize] as usize..self.start[edge as usize + 1] as usize]
    }

    /// Inside as many cells as faces meet at an edge; on the boundary, one less.
    fn is_singular(&self, faces: &Faces, edge: u32) -> bool {
        let around = self.around(edge);
        let on_boundary = around.iter().any(|&f| !faces.is_inner(f));
        around.len() != if on_boundary { 3 } else { 4 }
    }

    /// Which inner faces belong to a sheet.
    fn sheets(&self, faces: &Faces) -> Vec<bool> {
        let mut marked = vec![false; faces.cells.len()];
        let mut front: Vec<u32> = Vec::new();
        let mut mark = |face: u32, front: &mut Vec<u32>| {
            if faces.is_inner(face) && !std::mem::replace(&mut marked[face as usize], true) {
                front.push(face);
            }
        };
        let count = self.start.len() as u32 - 1;
        let singular: Vec<bool> = (0..count).map(|e| self.is_singular(faces, e)).collect();
        for edge in (0..count).filter(|&e| singular[e as usize]) {
            self.around(edge).iter().for_each(|&f| mark(f, &mut front));
        }
        while let Some(face) = front.pop() {
            let own = &self.of_face[4 * face as usize..4 * face as usize + 4];
            for &edge in own.iter().filter(|&&e| !singular[e as usize]) {
                let ahead = self.around(edge).iter().find(|&&f| f != face && !faces.share_cell(f, face));
                ahead.into_iter().for_each(|&f| mark(f, &mut front));
            }
        }
        marked
    }
}

/// Floods cells through faces that belong to no sheet.
fn blocks(cells: usize, faces: &Faces, sheets: &[bool]) -> Vec<u32> {
    let mut block = vec![NONE; cells];
    let mut count = 0;
    let mut stack = Vec::new();
    for seed in 0..cells as u32 {
        if block[seed as usize] != NONE {
            continue;
        }
        block[seed as usize] = count;
        stack.push(seed);
        while let Some(cell) = stack.pop() {
            for &face in &faces.of_cell[6 * cell as usize..6 * cell as usize + 6] {
                for next in faces.cells[face as usize] {
                    if next != NONE && !sheets[face as usize] && block[next as usize] == NONE {
                        block[next as usize] = count;
                        stack.push(next);
                    }
                }
            }
        }
        count += 1;
    }
    block
}
