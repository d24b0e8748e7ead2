//! Validity and counts of many orders of levels, fast: the lattice as rows of bits.
//!
//! What a polycube's lattice looks like depends on the order of its levels alone. [`Rows`] takes that order as one
//! rank per level and answers in some dozen word operations per row of cells: is it a valid polycube, and how
//! many blocks has it. It agrees with [`Arrangement`](crate::structure::Arrangement), [`Complex`](super::Complex) and
//! the separatrices.

mod patches;
mod sheets;
#[cfg(test)]
mod tests;
mod valid;
mod word;

use word::{Wide, Word};

use super::{Counts, Objective};
use crate::structure::Structure;

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

impl<R: Word> Marks<R> {
    fn reset(&mut self, rows: usize) {
        for marks in [&mut self.positive, &mut self.negative] {
            marks.clear();
            marks.resize(rows, R::ZERO);
        }
    }

    fn of(&mut self, positive: bool) -> &mut [R] {
        if positive { &mut self.positive } else { &mut self.negative }
    }
}

/// A lattice whose rows of cells along the first axis are words of type `R`, with its work space.
///
/// Bit `i` of row `(j, k)` is the cell above plane `i` along the first axis, and likewise `j` and `k`; planes count
/// from 1.
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
    words: usize,
}

/// [`Rows`] of any width.
pub(crate) trait Counter: Send {
    /// See [`Rows::count`].
    fn count(&mut self, objective: Objective, ranks: &[u16], planes: [usize; 3]) -> Option<usize>;

    /// See [`Rows::counts`].
    fn counts(&mut self, ranks: &[u16], planes: [usize; 3]) -> Option<Counts>;

    /// See [`Rows::is_valid`].
    fn is_valid(&mut self, ranks: &[u16], planes: [usize; 3]) -> bool;

    /// How many words of 64 bits a lattice with all levels apart has: what a count takes is about proportional to that.
    fn words(&self) -> usize;
}

impl<R: Word> Counter for Rows<R> {
    fn count(&mut self, objective: Objective, ranks: &[u16], planes: [usize; 3]) -> Option<usize> {
        self.count(objective, ranks, planes)
    }

    fn counts(&mut self, ranks: &[u16], planes: [usize; 3]) -> Option<Counts> {
        self.counts(ranks, planes)
    }

    fn is_valid(&mut self, ranks: &[u16], planes: [usize; 3]) -> bool {
        self.is_valid(ranks, planes)
    }

    fn words(&self) -> usize {
        self.words
    }
}

/// The most levels that the axis with the fewest levels can have for [`counter`].
pub(crate) const MOST_LEVELS: usize = 1022;

/// [`Rows`] of the narrowest words that hold the structure; nothing if it has more than [`MOST_LEVELS`] levels along
/// every axis.
pub(crate) fn counter(structure: &Structure) -> Option<Box<dyn Counter>> {
    let axis = row_axis(structure);
    let levels = structure.levels.iter().filter(|l| l.axis == axis).count();
    Some(match levels {
        n if n <= Rows::<u64>::capacity() => Box::new(Rows::<u64>::new(structure)),
        n if n <= Rows::<u128>::capacity() => Box::new(Rows::<u128>::new(structure)),
        n if n <= Rows::<Wide<4>>::capacity() => Box::new(Rows::<Wide<4>>::new(structure)),
        n if n <= MOST_LEVELS => Box::new(Rows::<Wide<16>>::new(structure)),
        _ => return None,
    })
}

/// The axis with the fewest levels, along which rows run.
fn row_axis(structure: &Structure) -> usize {
    let count = |axis: &usize| structure.levels.iter().filter(|l| l.axis == *axis).count();
    (0..3).min_by_key(count).unwrap_or(0)
}

impl<R: Word> Rows<R> {
    /// How many planes the first axis can have.
    pub fn capacity() -> usize {
        R::BITS - 2
    }

    /// Prepares the evaluation of orders of `structure`.
    pub fn new(structure: &Structure) -> Self {
        let first = row_axis(structure);
        let axes = [first, (first + 1) % 3, (first + 2) % 3];
        let lengths = structure.edges.iter().map(|e| structure.ends(e)).collect();
        let across = |axis: usize| structure.levels.iter().filter(|l| l.axis == axis).count() + 2;
        Self {
            axes,
            walls: walls(structure, axes),
            lengths,
            size: [0; 2],
            faces: std::array::from_fn(|_| Marks { positive: Vec::new(), negative: Vec::new() }),
            solid: Vec::new(),
            sheets: std::array::from_fn(|_| Vec::new()),
            corners: structure.corners.len(),
            words: across(axes[1]) * across(axes[2]) * (R::BITS / 64),
        }
    }

    /// The number that `objective` counts, of the polycube whose level `l` lies on plane `ranks[l]` (from 1) of its
    /// axis, `planes` of them per axis; `None` if that is not a valid polycube of this structure.
    pub fn count(&mut self, objective: Objective, ranks: &[u16], planes: [usize; 3]) -> Option<usize> {
        if !self.place(ranks, planes) {
            return None;
        }
        if objective == Objective::SurfacePatches {
            return Some(self.patches());
        }
        self.grow_sheets();
        let faces = if objective == Objective::Blocks { 0 } else { self.surface_faces() };
        Some(self.blocks() + faces)
    }

    /// All three numbers at once, see [`count`](Self::count).
    pub fn counts(&mut self, ranks: &[u16], planes: [usize; 3]) -> Option<Counts> {
        if !self.place(ranks, planes) {
            return None;
        }
        self.grow_sheets();
        let blocks = self.blocks();
        Some(Counts { surface_patches: self.patches(), blocks, blocks_padded: blocks + self.surface_faces() })
    }

    /// Whether that is a valid polycube, see [`count`](Self::count).
    pub fn is_valid(&mut self, ranks: &[u16], planes: [usize; 3]) -> bool {
        self.place(ranks, planes)
    }

    /// Lays the facets out; whether they are a valid polycube.
    fn place(&mut self, ranks: &[u16], planes: [usize; 3]) -> bool {
        let rank = |l: u32| usize::from(ranks[l as usize]);
        if self.lengths.iter().any(|[low, high]| rank(*low) >= rank(*high)) {
            return false;
        }
        let length = self.lengths.iter().map(|[low, high]| rank(*high) - rank(*low)).sum();
        self.size = [planes[self.axes[1]] + 2, planes[self.axes[2]] + 2];
        self.paint(ranks);
        self.fill();
        self.is_consistent() && self.is_manifold() && self.keeps_edges(length)
    }

    /// Marks where the facets lie, by the parity of their sides.
    fn paint(&mut self, ranks: &[u16]) {
        let [nj, nk] = self.size;
        self.faces.iter_mut().for_each(|f| f.reset(nj * nk));
        let rank = |l: u32| usize::from(ranks[l as usize]);
        for wall in &self.walls {
            let i = rank(wall.first);
            let from_here = !R::ZERO << i;
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
                    *first = *first ^ (R::ONE << i);
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

    /// The row `distance` before `row`, empty outside the lattice.
    fn before(&self, row: usize, distance: usize) -> R {
        row.checked_sub(distance).map_or(R::ZERO, |r| self.solid[r])
    }

    fn after(&self, row: usize, distance: usize) -> R {
        self.solid.get(row + distance).copied().unwrap_or(R::ZERO)
    }
}

/// Every bit the parity of the bits at and below it.
fn parity<R: Word>(mut word: R) -> R {
    let mut shift = 1;
    while shift < R::BITS {
        word = word ^ (word << shift);
        shift *= 2;
    }
    word
}

/// The runs of set bits in `inner` that hold a bit of `seed`.
fn spread<R: Word>(seed: R, inner: R) -> R {
    spread_up(seed, inner) | spread_down(seed, inner)
}

/// `seed` and the set bits of `through` that follow it upwards without a gap.
fn spread_up<R: Word>(mut seed: R, mut through: R) -> R {
    let mut shift = 1;
    while shift < R::BITS {
        seed = seed | (through & (seed << shift));
        through = through & (through << shift);
        shift *= 2;
    }
    seed
}

/// `seed` and the set bits of `through` that follow it downwards without a gap.
fn spread_down<R: Word>(mut seed: R, mut through: R) -> R {
    let mut shift = 1;
    while shift < R::BITS {
        seed = seed | (through & (seed >> shift));
        through = through & (through >> shift);
        shift *= 2;
    }
    seed
}

fn walls(structure: &Structure, axes: [usize; 3]) -> Vec<Wall> {
    let wall = |edge: &crate::structure::Edge| {
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
    structure.edges.iter().filter(|e| e.axis != axes[0]).map(wall).collect()
}
