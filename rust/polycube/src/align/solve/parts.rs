//! Splits a problem into parts that share no pair and no difference, each with its own numbering.

use crate::align::problem::{Difference, PairTerm, Problem};

/// A connected part of a problem. Pairs and differences use positions in `variables`.
#[derive(Default)]
pub(super) struct Part {
    /// The variables of the problem that belong to this part, ascending.
    pub variables: Vec<usize>,
    /// Pairs of distinct variables.
    pub pairs: Vec<PairTerm>,
    /// Differences of distinct variables.
    pub differences: Vec<Difference>,
}

/// The parts of `problem` in the order of their first variables. Linear constraints are ignored.
pub(super) fn split(problem: &Problem) -> Vec<Part> {
    let mut forest: Vec<u32> = (0..problem.len() as u32).collect();
    let pairs = problem.pairs.iter().map(|p| (p.a, p.b));
    let differences = problem.differences.iter().map(|d| (d.low, d.high));
    for (a, b) in pairs.chain(differences) {
        let (a, b) = (root(&mut forest, a), root(&mut forest, b));
        // The lowest variable is the root, so parts come out in a fixed order.
        forest[a.max(b) as usize] = a.min(b);
    }
    let (mut parts, places) = number(&mut forest);
    for p in problem.pairs.iter().filter(|p| p.a != p.b) {
        let (part, a) = places[p.a as usize];
        let pair = PairTerm { a, b: places[p.b as usize].1, weight: p.weight };
        parts[part].pairs.push(pair);
    }
    for d in problem.differences.iter().filter(|d| d.low != d.high) {
        let (part, low) = places[d.low as usize];
        let difference = Difference { low, high: places[d.high as usize].1, gap: d.gap };
        parts[part].differences.push(difference);
    }
    parts
}

/// Parts with their variables, and for each variable its part and its position there.
fn number(forest: &mut [u32]) -> (Vec<Part>, Vec<(usize, u32)>) {
    let mut parts: Vec<Part> = Vec::new();
    let mut places: Vec<(usize, u32)> = Vec::with_capacity(forest.len());
    for v in 0..forest.len() {
        let first = root(forest, v as u32) as usize;
        if first == v {
            parts.push(Part::default());
        }
        let part = if first == v { parts.len() - 1 } else { places[first].0 };
        places.push((part, parts[part].variables.len() as u32));
        parts[part].variables.push(v);
    }
    (parts, places)
}

/// The root of `v`, halving the way to it.
fn root(forest: &mut [u32], mut v: u32) -> u32 {
    while forest[v as usize] != v {
        let up = forest[forest[v as usize] as usize];
        forest[v as usize] = up;
        v = up;
    }
    v
}
