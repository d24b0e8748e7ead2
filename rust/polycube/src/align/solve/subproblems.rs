//! Splits a problem into parts that share no pair and no difference, each with its own numbering.

use crate::align::problem::{Difference, PairTerm, Problem};
use petgraph::unionfind::UnionFind;

/// A connected part of a problem. Pairs and differences use positions in `variables`.
#[derive(Default)]
pub(super) struct Subproblem {
    /// The variables of the problem that belong to this part, ascending.
    pub variables: Vec<usize>,
    /// Pairs of distinct variables.
    pub pairs: Vec<PairTerm>,
    /// Differences of distinct variables.
    pub differences: Vec<Difference>,
}

/// The parts of `problem` in the order of their first variables. Linear constraints are ignored.
pub(super) fn split(problem: &Problem) -> Vec<Subproblem> {
    let mut joined = UnionFind::<u32>::new(problem.len());
    let pairs = problem.pairs.iter().map(|p| (p.a, p.b));
    let differences = problem.differences.iter().map(|d| (d.low, d.high));
    for (a, b) in pairs.chain(differences) {
        joined.union(a, b);
    }
    let (mut parts, places) = number(joined);
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
fn number(joined: UnionFind<u32>) -> (Vec<Subproblem>, Vec<(usize, u32)>) {
    let mut parts: Vec<Subproblem> = Vec::new();
    let mut part_of_set = vec![None; joined.len()];
    let place = |(v, set): (usize, u32)| {
        let part = *part_of_set[set as usize].get_or_insert_with(|| {
            parts.push(Subproblem::default());
            parts.len() - 1
        });
        parts[part].variables.push(v);
        (part, parts[part].variables.len() as u32 - 1)
    };
    let places = joined.into_labeling().into_iter().enumerate().map(place).collect();
    (parts, places)
}
