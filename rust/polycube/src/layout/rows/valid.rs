//! Whether the facets painted on the rows bound a solid that is a polycube of this structure.

use super::Rows;
use super::Word;

impl<R: Word> Rows<R> {
    /// Whether the facets are exactly the boundary of the solid, each facing outward.
    pub(super) fn is_consistent(&self) -> bool {
        let top = R::ONE << (R::BITS - 1);
        let nj = self.size[0];
        let bounds = |axis: usize, row: usize, below: R| {
            let (solid, marks) = (self.solid[row], &self.faces[axis]);
            marks.negative[row] == solid & !below && marks.positive[row] == below & !solid
        };
        (0..self.solid.len()).all(|row| {
            let solid = self.solid[row];
            (solid & top).is_zero()
                && bounds(0, row, solid << 1)
                && bounds(1, row, self.before(row, 1))
                && bounds(2, row, self.before(row, nj))
        })
    }

    /// Whether solid and empty cells nowhere meet only across a lattice edge or vertex.
    pub(super) fn is_manifold(&self) -> bool {
        let nj = self.size[0];
        (nj + 1..self.solid.len()).all(|row| {
            let [a, b, c, d] = [row, row - 1, row - nj, row - nj - 1].map(|r| self.solid[r]);
            let [p, q, r, s] = [a, b, c, d].map(|w| w << 1);
            let diagonal = |a: R, b: R, c: R, d: R| (a & d & !b & !c) | (b & c & !a & !d);
            let edges = diagonal(a, b, c, d) | diagonal(a, b, p, q) | diagonal(a, c, p, r);
            let lone = |x: R, opposite: R, others: R| x & opposite & !others;
            let corners = |a, b, c, d, p, q, r, s| {
                lone(a, s, b | c | d | p | q | r)
                    | lone(b, r, a | c | d | p | q | s)
                    | lone(c, q, a | b | d | p | r | s)
                    | lone(d, p, a | b | c | q | r | s)
            };
            (edges | corners(a, b, c, d, p, q, r, s) | corners(!a, !b, !c, !d, !p, !q, !r, !s)).is_zero()
        })
    }

    /// Whether the edges of the solid are those of the structure, `length` lattice edges in all: none has vanished by
    /// two facets becoming one, none touches another or a corner.
    pub(super) fn keeps_edges(&self, length: usize) -> bool {
        let nj = self.size[0];
        let ridges = |row: usize| {
            let [a, b, c, d] = [0, 1, nj, nj + 1].map(|back| self.before(row, back));
            [a ^ b ^ c ^ d, a ^ c ^ (a ^ c) << 1, a ^ b ^ (a ^ b) << 1]
        };
        let (mut edges, mut straight, mut corners) = (0, 0, 0);
        for row in nj + 1..self.solid.len() {
            let [x, y, z] = ridges(row);
            let around = [[x, x << 1], [y, ridges(row - 1)[1]], [z, ridges(row - nj)[2]]];
            let any = around.map(|[p, q]| p | q);
            let both = around.map(|[p, q]| p & q);
            let on_line = both[0] & !(any[1] | any[2]) | both[1] & !(any[0] | any[2]) | both[2] & !(any[0] | any[1]);
            edges += (x.count_ones() + y.count_ones() + z.count_ones()) as usize;
            straight += on_line.count_ones() as usize;
            corners += ((any[0] | any[1] | any[2]) & !on_line).count_ones() as usize;
        }
        edges == length && corners == self.corners && straight + self.lengths.len() == length
    }
}
