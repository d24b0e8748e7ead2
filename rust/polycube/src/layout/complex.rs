//! The base complex: the blocks left when every singular edge sends its separation sheets through the volume.

use super::lattice::Lattice;
use super::separatrices::Separatrices;
use crate::structure::{Arrangement, Edge, Structure};

/// How coarse a layout is.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, bitcode::Encode, bitcode::Decode,
)]
pub struct Counts {
    /// Patches left by the separatrices traced on the surface alone.
    pub surface_patches: usize,
    /// Blocks of the base complex of the unpadded polycube.
    pub blocks: usize,
    /// Blocks after one padding layer around it: `blocks` and the faces of the base complex on the surface.
    pub blocks_padded: usize,
}

/// The base complex of a polycube on its coarsest lattice.
///
/// The singular edges of a polycube are its edges. A convex one has one block and sends no sheet; from a reflex
/// one two sheets continue the planes of its facets into the solid until they meet the surface. All other lattice
/// edges inside are regular, so a sheet is the whole connected part of its plane inside the polycube.
pub struct Complex<'a> {
    lattice: &'a Lattice,
    /// For every cell, bit `a` when the face at its lower side along axis `a` belongs to a sheet.
    sheets: Vec<u8>,
}

impl<'a> Complex<'a> {
    /// Grows the sheets of all reflex edges. O(c) for c lattice cells.
    pub fn new(lattice: &'a Lattice, arrangement: &Arrangement) -> Self {
        let mut complex = Self { lattice, sheets: vec![0; lattice.len()] };
        let structure = arrangement.structure();
        let mut front = Vec::new();
        for edge in &structure.edges {
            complex.emit(structure, arrangement.placement(), edge, &mut front);
        }
        while let Some((cell, axis)) = front.pop() {
            for along in (0..3).filter(|&a| a != axis) {
                let stride = lattice.stride(along);
                complex.reach(cell - stride, axis, &mut front);
                complex.reach(cell + stride, axis, &mut front);
            }
        }
        complex
    }

    /// Counts blocks and patches. O(c) for c lattice cells.
    pub fn counts(&self, arrangement: &Arrangement) -> Counts {
        let blocks = (0..self.lattice.len()).filter(|&c| self.starts_block(c)).count();
        let faces = (0..3).flat_map(|axis| (0..self.lattice.len()).map(move |c| (c, axis)));
        let faces = faces.filter(|&(c, axis)| self.starts_surface_face(c, axis)).count();
        let separatrices = Separatrices::new(self.lattice, arrangement);
        Counts { surface_patches: separatrices.count_patches(), blocks, blocks_padded: blocks + faces }
    }

    pub(super) fn lattice(&self) -> &Lattice {
        self.lattice
    }

    /// Whether the lattice face at the lower side of `cell` along `axis` separates two blocks.
    pub fn is_sheet(&self, cell: usize, axis: usize) -> bool {
        self.sheets[cell] >> axis & 1 == 1
    }

    /// The two inner faces at each lattice edge of a reflex edge belong to sheets.
    fn emit(&mut self, structure: &Structure, placement: &[f64], edge: &Edge, front: &mut Vec<(usize, usize)>) {
        let (low, high) = structure.extent(&structure.edge_box(edge), placement);
        let from: [usize; 3] = std::array::from_fn(|a| self.lattice.rank(a, low[a]));
        let to = self.lattice.rank(edge.axis, high[edge.axis]);
        let (u, v) = ((edge.axis + 1) % 3, (edge.axis + 2) % 3);
        let (du, dv) = (self.lattice.stride(u), self.lattice.stride(v));
        for step in from[edge.axis]..to {
            let mut at = from;
            at[edge.axis] = step;
            let cell = self.lattice.index(at);
            let around = [cell, cell - du, cell - dv, cell - du - dv];
            if around.iter().filter(|&&c| self.lattice.is_solid(c)).count() == 3 {
                [(cell, u), (cell - dv, u), (cell, v), (cell - du, v)]
                    .into_iter()
                    .for_each(|(c, axis)| self.reach(c, axis, front));
            }
        }
    }

    fn reach(&mut self, cell: usize, axis: usize, front: &mut Vec<(usize, usize)>) {
        if self.lattice.is_inner(cell, axis) && !self.is_sheet(cell, axis) {
            self.sheets[cell] |= 1 << axis;
            front.push((cell, axis));
        }
    }

    /// Blocks are boxes, so each is counted by the one cell at its lowest corner.
    pub(super) fn starts_block(&self, cell: usize) -> bool {
        self.lattice.is_solid(cell)
            && (0..3).all(|axis| self.is_sheet(cell, axis) || !self.lattice.is_solid(cell - self.lattice.stride(axis)))
    }

    /// Faces of the complex on the surface are rectangles, each counted by its lattice face at the lowest corner.
    pub(super) fn starts_surface_face(&self, cell: usize, axis: usize) -> bool {
        let below = cell.wrapping_sub(self.lattice.stride(axis));
        if below >= self.lattice.len() || self.lattice.is_solid(cell) == self.lattice.is_solid(below) {
            return false;
        }
        let (solid, empty) = if self.lattice.is_solid(cell) { (cell, below) } else { (below, cell) };
        (0..3).filter(|&along| along != axis).all(|along| {
            let stride = self.lattice.stride(along);
            let flat = self.lattice.is_solid(solid - stride) && !self.lattice.is_solid(empty - stride);
            !flat || self.is_sheet(solid, along)
        })
    }
}
