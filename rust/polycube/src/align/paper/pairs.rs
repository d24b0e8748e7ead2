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
/// edge-neighbour, (c) pairs whose middle lies outside the polycube.
pub fn visible_neighbours(arrangement: &Arrangement, context: &Context) -> Result<Vec<[u32; 2]>> {
    let structure = arrangement.structure();
    let positions = positions(arrangement);
    let mut near = neighbours(&on_grid(&positions), context)?;
    let beside = edge_neighbours(structure);
    near.retain(|&[a, b]| {
        let (at_a, at_b) = (&beside[a as usize], &beside[b as usize]);
        !at_a.contains(&b) && !at_a.iter().any(|c| at_b.contains(c))
    });
    let middle =
        |[a, b]: [u32; 2]| std::array::from_fn(|k| f64::midpoint(positions[a as usize][k], positions[b as usize][k]));
    Ok(near.into_par_iter().with_min_len(1024).filter(|&pair| arrangement.contains(middle(pair))).collect())
}

/// For every corner and axis the nearest of its `neighbours` that it can align with, each pair once, ascending.
///
/// Along an axis a pair can align if its levels are not aligned yet, if `differences` do not force them apart, and if
/// another axis is left to keep the corners apart.
pub fn candidates(
    arrangement: &Arrangement,
    neighbours: &[[u32; 2]],
    classes: &Classes,
    differences: &[Difference],
) -> Vec<Pair> {
    let structure = arrangement.structure();
    let positions = positions(arrangement);
    let order = Order::new(classes, differences, arrangement.placement());
    let mut pairs = Vec::new();
    for axis in 0..3 {
        nearest(structure, &positions, neighbours, axis, &order, classes, &mut pairs);
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
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

/// Adds the nearest alignable neighbour of every corner along `axis`; of equally near ones the first.
fn nearest(
    structure: &Structure,
    positions: &[[f64; 3]],
    near: &[[u32; 2]],
    axis: usize,
    order: &Order,
    classes: &Classes,
    pairs: &mut Vec<Pair>,
) {
    let mut best: Vec<Option<(f64, Pair)>> = vec![None; positions.len()];
    for &corners in near {
        let pair = Pair { axis, corners };
        let [a, b] = pair.levels(structure).map(|l| classes.of(l));
        let [p, q] = corners.map(|c| positions[c as usize]);
        let separable = (0..3).any(|k| k != axis && p[k] != q[k]);
        if a == b || !separable || order.forces_apart(a, b) {
            continue;
        }
        let distance = (p[axis] - q[axis]).abs();
        for c in corners {
            let entry = &mut best[c as usize];
            if entry.is_none_or(|(d, _)| distance < d) {
                *entry = Some((distance, pair));
            }
        }
    }
    pairs.extend(best.into_iter().flatten().map(|(_, pair)| pair));
}

/// The order that the differences impose on classes.
struct Order<'a> {
    /// For every class, the classes above it and whether they must be strictly above.
    above: Vec<Vec<(u32, bool)>>,
    placement: &'a [f64],
}

impl<'a> Order<'a> {
    fn new(classes: &Classes, differences: &[Difference], placement: &'a [f64]) -> Self {
        let mut above = vec![Vec::new(); placement.len()];
        for d in differences {
            let (low, high) = (classes.of(d.low), classes.of(d.high));
            above[low as usize].push((high, d.gap > 0));
        }
        Self { above, placement }
    }

    /// Whether a chain of differences keeps the two classes strictly apart.
    fn forces_apart(&self, a: u32, b: u32) -> bool {
        let at = |c: u32| self.placement[c as usize];
        let (low, high) = if at(a) <= at(b) { (a, b) } else { (b, a) };
        let mut seen = vec![(low, false)];
        let mut next = 0;
        while let Some(&(class, strict)) = seen.get(next) {
            next += 1;
            for &(up, gap) in &self.above[class as usize] {
                let state = (up, strict || gap);
                if state == (high, true) {
                    return true;
                }
                if at(up) <= at(high) && !seen.contains(&state) {
                    seen.push(state);
                }
            }
        }
        false
    }
}
