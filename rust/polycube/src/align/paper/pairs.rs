//! Which corners to align next (paper, section 4).

use super::neighbours::neighbours;
use crate::align::classes::Classes;
use crate::align::problem::Difference;
use crate::context::Context;
use crate::error::Result;
use crate::structure::{Arrangement, Structure};
use rayon::prelude::*;

/// Two corners that shall come to have the same coordinate along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
pub struct Pair {
    /// 0, 1 or 2 for X, Y or Z.
    pub axis: usize,
    /// The corners, ascending.
    pub corners: [u32; 2],
}

impl Pair {
    /// The levels that become equal.
    pub fn levels(&self, structure: &Structure) -> [u32; 2] {
        self.corners.map(|c| structure.corners[c as usize].levels[self.axis])
    }
}

/// Corners with adjacent Voronoi cells, without (a) the two ends of an edge, (b) two corners with a common
/// edge-neighbour.
pub fn near_corners(arrangement: &Arrangement, context: &Context) -> Result<Vec<[u32; 2]>> {
    let structure = arrangement.structure();
    let mut near = neighbours(&on_grid(&positions(arrangement)), context)?;
    let beside = edge_neighbours(structure);
    near.retain(|&[a, b]| {
        let (at_a, at_b) = (&beside[a as usize], &beside[b as usize]);
        !at_a.contains(&b) && !at_a.iter().any(|c| at_b.contains(c))
    });
    Ok(near)
}

/// For every corner and axis the nearest of the `near` corners that it can align with, each pair once, ascending; of
/// equally near ones the first.
///
/// Along an axis a pair can align if its levels are not aligned yet, if another axis is left to keep the corners apart, if
/// `differences` do not force them apart, and if (c) its middle lies inside the polycube. The last two take longest and
/// are asked only of pairs that are nearer than what is known.
pub fn candidates(
    arrangement: &Arrangement,
    near: &[[u32; 2]],
    classes: &Classes,
    differences: &[Difference],
) -> Vec<Pair> {
    // Few corners take less time than another thread takes to begin.
    let together = if near.len() < 8192 { 3 } else { 1 };
    let alignable =
        |axis| nearest(arrangement, near, axis, classes, Order::new(arrangement, axis, classes, differences));
    let mut pairs: Vec<Pair> = (0..3).into_par_iter().with_min_len(together).flat_map_iter(alignable).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// The nearest corner along `axis` that each corner can align with, if any.
fn nearest(
    arrangement: &Arrangement,
    near: &[[u32; 2]],
    axis: usize,
    classes: &Classes,
    mut order: Order,
) -> impl Iterator<Item = Pair> {
    let structure = arrangement.structure();
    let positions = positions(arrangement);
    let mut best: Vec<Option<(f64, Pair)>> = vec![None; positions.len()];
    for &corners in near {
        let pair = Pair { axis, corners };
        let [a, b] = pair.levels(structure).map(|l| classes.of(l));
        let [p, q] = corners.map(|c| positions[c as usize]);
        let distance = (p[axis] - q[axis]).abs();
        let nearer = corners.map(|c| best[c as usize].is_none_or(|(d, _)| distance < d));
        let separable = (0..3).any(|k| k != axis && p[k] != q[k]);
        if a == b || !separable || nearer == [false; 2] || order.forces_apart(a, b) {
            continue;
        }
        if arrangement.contains(middle(p, q)) {
            let ends = corners.iter().zip(nearer).filter(|(_, nearer)| *nearer);
            ends.for_each(|(&c, _)| best[c as usize] = Some((distance, pair)));
        }
    }
    best.into_iter().flatten().map(|(_, pair)| pair)
}

fn middle(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| f64::midpoint(p[k], q[k]))
}

fn positions(arrangement: &Arrangement) -> Vec<[f64; 3]> {
    let structure = arrangement.structure();
    (0..structure.corners.len() as u32).map(|c| structure.position(c, arrangement.placement())).collect()
}

/// Positions in 1/256 of a lattice step: exact for integers.
fn on_grid(positions: &[[f64; 3]]) -> Vec<[i64; 3]> {
    positions.iter().map(|p| p.map(|x| (x * 256.0).round() as i64)).collect()
}

fn edge_neighbours(structure: &Structure) -> Vec<Vec<u32>> {
    let mut beside = vec![Vec::new(); structure.corners.len()];
    for [a, b] in structure.edges.iter().map(|e| e.corners) {
        beside[a as usize].push(b);
        beside[b as usize].push(a);
    }
    beside
}

/// The order that the differences impose on the classes of one axis.
struct Order<'a> {
    /// For every class, the classes above it and whether they must be strictly above.
    above: Vec<Vec<(u32, bool)>>,
    placement: &'a [f64],
    /// The number of the question in which a class was last reached, by a chain without and with a strict step.
    seen: Vec<[u32; 2]>,
    question: u32,
    /// What the present question has reached.
    reached: Vec<(u32, bool)>,
}

impl<'a> Order<'a> {
    fn new(arrangement: &'a Arrangement, axis: usize, classes: &Classes, differences: &[Difference]) -> Self {
        let (structure, placement) = (arrangement.structure(), arrangement.placement());
        let mut above = vec![Vec::new(); placement.len()];
        for d in differences.iter().filter(|d| structure.levels[d.low as usize].axis == axis) {
            let (low, high) = (classes.of(d.low), classes.of(d.high));
            above[low as usize].push((high, d.gap > 0));
        }
        Self { above, placement, seen: vec![[0; 2]; placement.len()], question: 0, reached: Vec::new() }
    }

    /// Whether a chain of differences keeps the two classes strictly apart.
    fn forces_apart(&mut self, a: u32, b: u32) -> bool {
        let at = |c: u32| self.placement[c as usize];
        let (low, high) = if at(a) <= at(b) { (a, b) } else { (b, a) };
        let end = at(high);
        if at(low) == end {
            return false; // What is strictly above lies strictly higher.
        }
        self.question += 1;
        self.reached.clear();
        self.reach(low, false);
        let mut next = 0;
        while let Some(&(class, strict)) = self.reached.get(next) {
            next += 1;
            for i in 0..self.above[class as usize].len() {
                let (up, gap) = self.above[class as usize][i];
                if (up, strict || gap) == (high, true) {
                    return true;
                }
                if self.placement[up as usize] <= end {
                    self.reach(up, strict || gap);
                }
            }
        }
        false
    }

    fn reach(&mut self, class: u32, strict: bool) {
        let seen = &mut self.seen[class as usize][usize::from(strict)];
        if std::mem::replace(seen, self.question) != self.question {
            self.reached.push((class, strict));
        }
    }
}
