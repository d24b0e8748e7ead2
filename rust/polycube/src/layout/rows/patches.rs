//! The coarse quad layout on rows of bits: separatrices from all corners, and the patches that they leave.

use super::Word;
use super::{Rows, spread_down, spread_up};

/// Per axis, one bit for the lattice edge above each vertex.
type EdgeBits<R> = [Vec<R>; 3];

impl<R: Word> Rows<R> {
    /// Patches of the surface, as [`Separatrices`](super::super::separatrices::Separatrices) counts them. The order
    /// must be valid.
    pub(super) fn patches(&self) -> usize {
        let (flat, sharp) = self.surface_edges();
        let marked = self.separatrices(&flat, &sharp);
        let mut count = 0;
        for row in self.size[0]..self.solid.len() {
            for axis in 0..3 {
                let on_surface = self.faces[axis].positive[row] | self.faces[axis].negative[row];
                let separates = |along: usize| marked[along][row] | sharp[along][row];
                count += (on_surface & separates((axis + 1) % 3) & separates((axis + 2) % 3)).count_ones() as usize;
            }
        }
        count
    }

    /// The lattice edges where the surface is flat and those where it is an edge of the polycube.
    fn surface_edges(&self) -> (EdgeBits<R>, EdgeBits<R>) {
        let mut flat: EdgeBits<R> = std::array::from_fn(|_| vec![R::ZERO; self.solid.len()]);
        let mut sharp = flat.clone();
        for row in 0..self.solid.len() {
            let [a, b, c, d] = [0, 1, self.size[0], self.size[0] + 1].map(|back| self.before(row, back));
            for (axis, [p, q, r, s]) in
                [[a, b, c, d], [a, c, a << 1, c << 1], [a, b, a << 1, b << 1]].into_iter().enumerate()
            {
                sharp[axis][row] = p ^ q ^ r ^ s;
                flat[axis][row] = (p | q | r | s) & !(p & q & r & s) & !sharp[axis][row];
            }
        }
        (flat, sharp)
    }

    /// The flat lattice edges that separatrices run along: spread from corners until nothing is added.
    fn separatrices(&self, flat: &EdgeBits<R>, sharp: &EdgeBits<R>) -> EdgeBits<R> {
        let mut marked: EdgeBits<R> = std::array::from_fn(|_| vec![R::ZERO; self.solid.len()]);
        let kinds: Vec<[R; 2]> = (0..self.solid.len()).map(|row| self.vertex_kinds(sharp, row)).collect();
        let corner = |row: usize| kinds[row][0];
        for row in self.size[0] + 1..self.solid.len() {
            mark(&mut marked, flat, row, self.size[0], [corner(row); 3]);
        }
        let mut count = ones(&marked);
        loop {
            let rows = kinds.iter().enumerate().skip(self.size[0] + 1);
            rows.clone().chain(rows.rev()).for_each(|(row, &kind)| self.pass_on(&mut marked, flat, row, kind));
            let before = std::mem::replace(&mut count, ones(&marked));
            if count == before {
                return marked;
            }
        }
    }

    /// The vertices of a row that are corners, and those inside a polycube edge.
    fn vertex_kinds(&self, sharp: &EdgeBits<R>, row: usize) -> [R; 2] {
        let at = |axis: usize, back: usize| row.checked_sub(back).map_or(R::ZERO, |r| sharp[axis][r]);
        let around = [[at(0, 0), at(0, 0) << 1], [at(1, 0), at(1, 1)], [at(2, 0), at(2, self.size[0])]];
        let any = around.map(|[p, q]| p | q);
        let both = around.map(|[p, q]| p & q);
        let inside = both[0] & !(any[1] | any[2]) | both[1] & !(any[0] | any[2]) | both[2] & !(any[0] | any[1]);
        [(any[0] | any[1] | any[2]) & !inside, inside]
    }

    /// Carries marks over the vertices of a row: straight on, and over a polycube edge to the flat edge on its other
    /// side.
    fn pass_on(&self, marked: &mut EdgeBits<R>, flat: &EdgeBits<R>, row: usize, [corner, on_edge]: [R; 2]) {
        let nj = self.size[0];
        if (marked[0][row] | marked[1][row] | marked[1][row - 1] | marked[2][row] | marked[2][row - nj]).is_zero() {
            return;
        }
        if !marked[0][row].is_zero() {
            marked[0][row] = straight(marked[0][row], flat[0][row], corner | on_edge);
        }
        let meets = [
            marked[0][row] | marked[0][row] << 1,
            marked[1][row] | marked[1][row - 1],
            marked[2][row] | marked[2][row - nj],
        ];
        let over = (meets[0] | meets[1] | meets[2]) & on_edge;
        let free = !(corner | on_edge);
        mark(marked, flat, row, nj, meets.map(|m| m & free | over));
    }
}

/// Marks the flat lattice edges at the vertices of a row, along each axis those of `at`.
fn mark<R: Word>(marked: &mut EdgeBits<R>, flat: &EdgeBits<R>, row: usize, nj: usize, at: [R; 3]) {
    marked[0][row] = marked[0][row] | flat[0][row] & (at[0] | at[0] >> 1);
    for (axis, back) in [(1, 1), (2, nj)] {
        marked[axis][row] = marked[axis][row] | flat[axis][row] & at[axis];
        marked[axis][row - back] = marked[axis][row - back] | flat[axis][row - back] & at[axis];
    }
}

/// Marks along a row, spread over runs of flat edges that no vertex of `stops` interrupts.
fn straight<R: Word>(marked: R, flat: R, stops: R) -> R {
    spread_up(marked, flat & !stops) | spread_down(marked, flat & !(stops >> 1))
}

fn ones<R: Word>(bits: &EdgeBits<R>) -> u32 {
    bits.iter().flatten().map(|w| w.count_ones()).sum()
}
