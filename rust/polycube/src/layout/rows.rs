//! Validity and counts of many orders of levels, fast: the lattice as rows of bits.
//!
//! What a polycube's lattice looks like depends on the order of its levels alone. [`Rows`] takes that order as one
//! rank per level and answers in some dozen word operations per row of cells: is it a valid polycube, and how
//! many blocks has it. It agrees with [`Arrangement`](crate::structure::Arrangement) and [`Complex`](super::Complex).

use super::Counts;
use crate::structure::Structure;
use num_traits::PrimInt;

/// An edge of the structure along one of the two axes across the rows, by the levels it needs.
struct Wall {
    /// Whether it runs along the second axis (else along the third).
    along_second: bool,
    /// Its level on the first axis.
    first: u32,
    /// Its level on the other of the two axes.
    across: u32,
    /// Its ends.
    ends: [u32; 2],
    /// For an edge along the second axis: the sign of its facet on the third. Along the third axis: the signs of its
    /// facets on the second and on the first. True for positive.
    positive: [bool; 2],
}

/// Marks on the lower faces of cells, by the sign of the facet.
#[derive(Default)]
struct Marks<R> {
    positive: Vec<R>,
    negative: Vec<R>,
}

impl<R: PrimInt> Marks<R> {
    fn reset(&mut self, rows: usize) {
        for marks in [&mut self.positive, &mut self.negative] {
            marks.clear();
            marks.resize(rows, R::zero());
        }
    }

    fn of(&mut self, positive: bool) -> &mut [R] {
        if positive { &mut self.positive } else { &mut self.negative }
    }
}

/// A lattice whose rows of cells along the first axis are words of type `R`, with its work space.
///
/// Bit `i` of row `(j, k)` is the cell above plane `i` along the first axis, and likewise `j` and `k`; planes count from 1.
pub struct Rows<R> {
    axes: [usize; 3],
    walls: Vec<Wall>,
    /// Ends of all edges: the first must rank below the second.
    lengths: Vec<[u32; 2]>,
    size: [usize; 2],
    faces: [Marks<R>; 3],
    solid: Vec<R>,
    sheets: [Vec<R>; 3],
    corners: usize,
}

impl<R: PrimInt> Rows<R> {
    /// How many planes the first axis can have.
    pub fn capacity() -> usize {
        R::zero().count_zeros() as usize - 2
    }

    /// The axis with the fewest levels, along which rows run.
    pub fn row_axis(structure: &Structure) -> usize {
        let count = |axis: &usize| structure.levels.iter().filter(|l| l.axis == *axis).count();
        (0..3).min_by_key(count).unwrap_or(0)
    }

    /// Prepares the evaluation of orders of `structure`.
    pub fn new(structure: &Structure) -> Self {
        let first = Self::row_axis(structure);
        let axes = [first, (first + 1) % 3, (first + 2) % 3];
        let lengths = structure.edges.iter().map(|e| structure.ends(e)).collect();
        Self {
            axes,
            walls: walls(structure, axes),
            lengths,
            size: [0; 2],
            faces: std::array::from_fn(|_| Marks { positive: Vec::new(), negative: Vec::new() }),
            solid: Vec::new(),
            sheets: std::array::from_fn(|_| Vec::new()),
            corners: structure.corners.len(),
        }
    }

    /// Counts of the polycube whose level `l` lies on plane `ranks[l]` (from 1) of its axis, `planes` of them per axis;
    /// `None` if it is not valid. `surface_patches` is left 0: [`Complex`](super::Complex) counts those.
    pub fn count(&mut self, ranks: &[u16], planes: [usize; 3]) -> Option<Counts> {
        let rank = |l: u32| usize::from(ranks[l as usize]);
        if self.lengths.iter().any(|[low, high]| rank(*low) >= rank(*high)) {
            return None;
        }
        self.size = [planes[self.axes[1]] + 2, planes[self.axes[2]] + 2];
        self.paint(ranks);
        self.fill();
        let length = self.lengths.iter().map(|[low, high]| rank(*high) - rank(*low)).sum();
        if !self.is_consistent() || !self.is_manifold() || !self.keeps_edges(length) {
            return None;
        }
        self.grow_sheets();
        let blocks = self.blocks();
        Some(Counts { surface_patches: 0, blocks, blocks_padded: blocks + self.surface_faces() })
    }

    /// Marks where the facets lie, by the parity of their sides.
    fn paint(&mut self, ranks: &[u16]) {
        let [nj, nk] = self.size;
        self.faces.iter_mut().for_each(|f| f.reset(nj * nk));
        let rank = |l: u32| usize::from(ranks[l as usize]);
        for wall in &self.walls {
            let i = rank(wall.first);
            let from_here = !R::zero() << i;
            let (across, ends) = (rank(wall.across), wall.ends.map(rank));
            if wall.along_second {
                let row = across * nj;
                let marks = self.faces[2].of(wall.positive[0]);
                marks[row + ends[0]..row + ends[1]].iter_mut().for_each(|m| *m = *m ^ from_here);
            } else {
                for k in ends[0]..ends[1] {
                    let row = k * nj + across;
                    let second = &mut self.faces[1].of(wall.positive[0])[row];
                    *second = *second ^ from_here;
                    let first = &mut self.faces[0].of(wall.positive[1])[row];
                    *first = *first ^ (R::one() << i);
                }
            }
        }
        for marks in [&mut self.faces[0].positive, &mut self.faces[0].negative] {
            for slab in marks.chunks_mut(nj) {
                (1..nj).for_each(|j| slab[j] = slab[j] ^ slab[j - 1]);
            }
        }
    }

    /// Cells after an odd number of crossings along the first axis are solid.
    fn fill(&mut self) {
        let crossings = self.faces[0].positive.iter().zip(&self.faces[0].negative);
        self.solid.clear();
        self.solid.extend(crossings.map(|(&p, &n)| parity(p ^ n)));
    }

    /// Whether the facets are exactly the boundary of the solid, each facing outward.
    fn is_consistent(&self) -> bool {
        let top = R::one().rotate_right(1);
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

    /// The row `distance` before `row`, empty outside the lattice.
    fn before(&self, row: usize, distance: usize) -> R {
        row.checked_sub(distance).map_or(R::zero(), |r| self.solid[r])
    }

    fn after(&self, row: usize, distance: usize) -> R {
        self.solid.get(row + distance).copied().unwrap_or(R::zero())
    }

    /// Whether solid and empty cells nowhere meet only across a lattice edge or vertex.
    fn is_manifold(&self) -> bool {
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
    fn keeps_edges(&self, length: usize) -> bool {
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

    /// Inner faces beside a reflex edge, and all that their planes reach.
    fn grow_sheets(&mut self) {
        let [nj, nk] = self.size;
        let strides = [0, 1, nj];
        let mut sheets = std::mem::take(&mut self.sheets);
        for (axis, sheet) in sheets.iter_mut().enumerate() {
            sheet.clear();
            sheet.extend((0..nj * nk).map(|row| self.seeds(row, strides[axis])));
        }
        let [first, second, third] = &mut sheets;
        self.flood(first, 0, &[1, nj]);
        self.flood(second, 1, &[nj]);
        self.flood(third, nj, &[1]);
        self.sheets = sheets;
    }

    /// Solid cells whose neighbour before them (across the rows at `stride`, along the row for 0) is solid too.
    fn inner(&self, row: usize, stride: usize) -> R {
        self.solid[row] & if stride == 0 { self.solid[row] << 1 } else { self.before(row, stride) }
    }

    /// Inner faces beside which exactly one of two cells is solid: there runs a reflex edge.
    fn seeds(&self, row: usize, stride: usize) -> R {
        let nj = self.size[0];
        let inner = self.inner(row, stride);
        if inner.is_zero() {
            return inner;
        }
        let beside = |r: R, lower: R| r ^ lower;
        let lower = |at: R, row: Option<usize>| match (stride, row) {
            (0, _) => at << 1,
            (_, Some(r)) => self.before(r, stride),
            _ => R::zero(),
        };
        let mut one_solid = R::zero();
        for step in [1, nj].into_iter().filter(|s| *s != stride) {
            let (back, ahead) = (self.before(row, step), self.after(row, step));
            one_solid = one_solid | beside(back, lower(back, row.checked_sub(step)));
            one_solid = one_solid | beside(ahead, lower(ahead, Some(row + step)));
        }
        if stride != 0 {
            let across = self.solid[row] ^ self.before(row, stride);
            one_solid = one_solid | across << 1 | across >> 1;
        }
        inner & one_solid
    }

    /// Spreads a sheet over inner faces along `steps` across the rows and, where its plane holds them, along the rows.
    fn flood(&self, sheet: &mut [R], stride: usize, steps: &[usize]) {
        let within = |word: R, inner: R| if stride == 0 { word } else { spread(word, inner) };
        let reach = |sheet: &mut [R], row: usize, from: usize| {
            let inner = self.inner(row, stride);
            let come = sheet[from] & inner & !sheet[row];
            if !come.is_zero() {
                sheet[row] = within(sheet[row] | come, inner);
            }
            !come.is_zero()
        };
        let rows = sheet.len();
        (0..rows).filter(|_| stride != 0).for_each(|row| sheet[row] = spread(sheet[row], self.inner(row, stride)));
        loop {
            let mut grew = false;
            for &step in steps {
                (step..rows).for_each(|row| grew |= reach(sheet, row, row - step));
                (0..rows - step).rev().for_each(|row| grew |= reach(sheet, row, row + step));
            }
            if !grew {
                return;
            }
        }
    }

    /// Each block once, by the cell at its lowest corner.
    fn blocks(&self) -> usize {
        let nj = self.size[0];
        let starts = |row: usize| {
            let closed = |axis: usize, below: R| self.sheets[axis][row] | !below;
            let [x, y, z] = [self.solid[row] << 1, self.before(row, 1), self.before(row, nj)];
            self.solid[row] & closed(0, x) & closed(1, y) & closed(2, z)
        };
        (0..self.solid.len()).map(|row| starts(row).count_ones() as usize).sum()
    }

    /// Each face of the complex on the surface once, by its lattice face at the lowest corner.
    fn surface_faces(&self) -> usize {
        let nj = self.size[0];
        let mut count = 0;
        for row in nj..self.solid.len() {
            for (axis, stride) in [0, 1, nj].into_iter().enumerate() {
                for positive in [false, true] {
                    count += self.face_starts(row, axis, stride, positive).count_ones() as usize;
                }
            }
        }
        count
    }

    fn face_starts(&self, row: usize, axis: usize, stride: usize, positive: bool) -> R {
        let nj = self.size[0];
        let marks = if positive { &self.faces[axis].positive } else { &self.faces[axis].negative };
        let mut starts = marks[row];
        if starts.is_zero() {
            return starts;
        }
        // The solid cell lies above a face that looks down, and below one that looks up.
        let behind = |sheet: &[R]| match (positive, stride) {
            (false, _) => sheet[row],
            (true, 0) => sheet[row] << 1,
            (true, _) => sheet[row - stride],
        };
        for (other, step) in [0, 1, nj].into_iter().enumerate().filter(|(a, _)| *a != axis) {
            let before = if step == 0 { marks[row] << 1 } else { marks[row - step] };
            starts = starts & (!before | behind(&self.sheets[other]));
        }
        starts
    }
}

/// Every bit the parity of the bits at and below it.
fn parity<R: PrimInt>(mut word: R) -> R {
    let mut shift = 1;
    while shift < R::zero().count_zeros() as usize {
        word = word ^ (word << shift);
        shift *= 2;
    }
    word
}

/// The runs of set bits in `inner` that hold a bit of `seed`.
fn spread<R: PrimInt>(seed: R, inner: R) -> R {
    let (mut up, mut down) = (seed, seed);
    let (mut over, mut under) = (inner, inner);
    let mut shift = 1;
    while shift < R::zero().count_zeros() as usize {
        up = up | (over & (up << shift));
        over = over & (over << shift);
        down = down | (under & (down >> shift));
        under = under & (under >> shift);
        shift *= 2;
    }
    up | down
}

fn walls(structure: &Structure, axes: [usize; 3]) -> Vec<Wall> {
    let wall = |edge: &&crate::structure::Edge| {
        let levels = structure.corners[edge.corners[0] as usize].levels;
        let along_second = edge.axis == axes[1];
        let positive = |axis: usize| {
            let facets = edge.facets.map(|f| structure.facets[f as usize].label);
            facets.iter().any(|l| l.axis() == axis && l.sign() > 0)
        };
        Wall {
            along_second,
            first: levels[axes[0]],
            across: levels[if along_second { axes[2] } else { axes[1] }],
            ends: structure.ends(edge),
            positive: if along_second { [positive(axes[2]), false] } else { [positive(axes[1]), positive(axes[0])] },
        }
    };
    structure.edges.iter().filter(|e| e.axis != axes[0]).collect::<Vec<_>>().iter().map(wall).collect()
}
