//! Which corners to align next (paper, section 4).

use super::neighbours::neighbours;
use crate::align::classes::Classes;
use crate::align::problem::Difference;
use crate::align::relax::Pair;
use crate::context::Context;
use crate::error::Result;
use crate::structure::{Arrangement, Structure};
use rayon::prelude::*;

/// For every corner those that no pair joins it with: (a) the other ends of its edges, (b) the other ends of theirs.
pub(super) struct Linked(Vec<Vec<u32>>);

impl Linked {
    /// The links of the corners of `structure`.
    pub(super) fn new(structure: &Structure) -> Self {
        let mut beside = vec![Vec::new(); structure.corners.len()];
        for [a, b] in structure.edges.iter().map(|e| e.corners) {
            beside[a as usize].push(b);
            beside[b as usize].push(a);
        }
        let around = |own: &Vec<u32>| own.iter().flat_map(|&c| &beside[c as usize]).chain(own).copied().collect();
        Self(beside.iter().map(around).collect())
    }

    fn joins(&self, [a, b]: [u32; 2]) -> bool {
        self.0[a as usize].contains(&b)
    }
}

/// Corners with adjacent Voronoi cells that are not `linked`.
pub(super) fn near_corners(
    structure: &Structure,
    placement: &[f64],
    linked: &Linked,
    context: &Context,
) -> Result<Vec<[u32; 2]>> {
    let mut near = neighbours(&on_grid(&positions(structure, placement)), context)?;
    near.retain(|&pair| !linked.joins(pair));
    Ok(near)
}

/// For every corner and axis the nearest of the `near` corners that it can align with, each pair once, ascending; of
/// equally near ones the first.
///
/// Along an axis a pair can align if its levels are not aligned yet, if another axis is left to keep the corners apart,
/// if `differences` do not force them apart, and if (c) its middle lies inside the polycube. The last two take longest
/// and are asked only of pairs that are nearer than what is known.
pub(super) fn candidates(
    arrangement: &Arrangement,
    near: &[[u32; 2]],
    classes: &Classes,
    differences: &[Difference],
) -> Vec<Pair> {
    let positions = positions(arrangement.structure(), arrangement.placement());
    let order = Order::new(arrangement.placement(), classes, differences);
    // Few corners take less time than another thread takes to begin.
    let together = if near.len() < 8192 { 3 } else { 1 };
    let alignable = |axis| nearest(arrangement, &positions, near, axis, classes, Search::new(&order));
    let mut pairs: Vec<Pair> = (0..3).into_par_iter().with_min_len(together).flat_map_iter(alignable).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// The nearest corner along `axis` that each corner can align with, if any.
fn nearest(
    arrangement: &Arrangement,
    positions: &[[f64; 3]],
    near: &[[u32; 2]],
    axis: usize,
    classes: &Classes,
    mut search: Search,
) -> impl Iterator<Item = Pair> {
    let structure = arrangement.structure();
    let mut best: Vec<Option<(f64, Pair)>> = vec![None; positions.len()];
    for &corners in near {
        let pair = Pair { axis, corners };
        let [p, q] = corners.map(|c| positions[c as usize]);
        let distance = (p[axis] - q[axis]).abs();
        let nearer = corners.map(|c| best[c as usize].is_none_or(|(d, _)| distance < d));
        let separable = (0..3).any(|k| k != axis && p[k] != q[k]);
        if !separable || nearer == [false; 2] {
            continue;
        }
        let [a, b] = pair.levels(structure).map(|l| classes.of(l));
        if a != b && !search.forces_apart(a, b) && arrangement.contains(middle(p, q)) {
            let ends = corners.iter().zip(nearer).filter(|(_, nearer)| *nearer);
            ends.for_each(|(&c, _)| best[c as usize] = Some((distance, pair)));
        }
    }
    best.into_iter().flatten().map(|(_, pair)| pair)
}

fn middle(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| f64::midpoint(p[k], q[k]))
}

fn positions(structure: &Structure, placement: &[f64]) -> Vec<[f64; 3]> {
    (0..structure.corners.len() as u32).map(|c| structure.position(c, placement)).collect()
}

/// Positions in 1/256 of a lattice step: exact for integers.
fn on_grid(positions: &[[f64; 3]]) -> Vec<[i64; 3]> {
    positions.iter().map(|p| p.map(|x| (x * 256.0).round() as i64)).collect()
}

/// The order that the differences impose on the classes.
struct Order<'a> {
    /// For every class, the classes above it and whether they must be strictly above.
    above: Vec<Vec<(u32, bool)>>,
    placement: &'a [f64],
}

impl<'a> Order<'a> {
    fn new(placement: &'a [f64], classes: &Classes, differences: &[Difference]) -> Self {
        let mut above = vec![Vec::new(); placement.len()];
        // With a negative gap the higher one may lie below.
        for d in differences.iter().filter(|d| d.gap >= 0) {
            above[classes.of(d.low) as usize].push((classes.of(d.high), d.gap > 0));
        }
        Self { above, placement }
    }
}

/// A search through an order, many times in the same memory.
struct Search<'a> {
    order: &'a Order<'a>,
    /// The number of the question in which a class was last reached, by a chain without and with a strict step.
    seen: Vec<[u32; 2]>,
    question: u32,
    /// What the present question has reached.
    reached: Vec<(u32, bool)>,
}

impl<'a> Search<'a> {
    fn new(order: &'a Order<'a>) -> Self {
        Self { order, seen: vec![[0; 2]; order.placement.len()], question: 0, reached: Vec::new() }
    }

    /// Whether a chain of differences keeps the two classes strictly apart.
    fn forces_apart(&mut self, a: u32, b: u32) -> bool {
        let Order { above, placement } = self.order;
        let at = |c: u32| placement[c as usize];
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
            for &(up, gap) in &above[class as usize] {
                if (up, strict || gap) == (high, true) {
                    return true;
                }
                if at(up) <= end {
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
