//! The search: the most promising partial order first, three ways from each.

use super::bound::{Bound, Least};
use super::clauses::Rules;
use super::judge::Judge;
use super::relations::{ABOVE, BELOW, EQUAL, Relations, is_decided};
use super::{Objective, Proof};
use crate::align::ranks::Ranks;
use crate::context::Context;
use crate::error::Result;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::time::{Duration, Instant};

/// Open partial orders may fill this many bytes.
const MEMORY: usize = 1 << 29;

/// When to stop.
pub(super) struct Limits {
    /// After this many partial orders.
    pub nodes: u64,
    /// After this time.
    pub time: Option<Duration>,
}

/// A partial order, some completion of which may be better than the best found. The one with the lowest bound comes
/// first, of several the deepest, of several the latest.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Open {
    bound: Reverse<usize>,
    depth: u32,
    number: u64,
    slot: usize,
}

/// The state of the search.
pub(super) struct Tree<'a> {
    rules: Rules<'a>,
    bound: Bound,
    objective: Objective,
    judge: Judge<'a>,
    best: Ranks,
    count: usize,
    nodes: u64,
    heap: BinaryHeap<Open>,
    store: Vec<Option<Relations>>,
    free: Vec<usize>,
    weight: Vec<u32>,
}

impl<'a> Tree<'a> {
    pub fn new(rules: Rules<'a>, bound: Bound, objective: Objective, judge: Judge<'a>, best: (Ranks, usize)) -> Self {
        let weight = bound.weights(&rules.pairs);
        let (heap, store, free) = (BinaryHeap::new(), Vec::new(), Vec::new());
        let (best, count) = best;
        Self { rules, bound, objective, judge, best, count, nodes: 0, heap, store, free, weight }
    }

    /// Searches from `root` until nothing better is possible or a limit is reached.
    pub fn run(mut self, root: Relations, limits: &Limits, context: &Context) -> Result<Proof> {
        let start = Instant::now();
        let most_open = MEMORY / (root.size() + 1);
        self.visit(root, 0, 0);
        let first = self.heap.peek().map_or(self.count, |o| o.bound.0);
        while self.heap.peek().is_some_and(|o| o.bound.0 < self.count) {
            let late = limits.time.is_some_and(|t| start.elapsed() >= t);
            if late || self.nodes >= limits.nodes || self.heap.len() >= most_open {
                break;
            }
            let now = self.heap.peek().map_or(self.count, |o| o.bound.0);
            context.tick((now - first) as f64 / (self.count - first).max(1) as f64)?;
            self.expand();
        }
        let bound = self.heap.peek().map_or(self.count, |o| o.bound.0.min(self.count));
        let proven = bound == self.count;
        Ok(Proof { bound, best: self.best, count: self.count, proven, nodes: self.nodes })
    }

    /// Takes the most promising partial order and decides one more pair of levels.
    fn expand(&mut self) {
        let Some(open) = self.heap.pop() else { return };
        let Some(relations) = self.store[open.slot].take() else { return };
        self.free.push(open.slot);
        let Some((a, b)) = self.undecided(&relations) else { return };
        for choice in [BELOW, ABOVE, EQUAL] {
            let mut child = relations.clone();
            if relations.get(&self.rules.pairs, a, b) & choice != 0 {
                self.nodes += 1;
                if self.rules.restrict(&mut child, &[(a, b, choice)]).is_ok() {
                    self.visit(child, open.bound.0, open.depth + 1);
                }
            }
        }
    }

    /// Judges a complete order; keeps a partial one unless its bound rules it out.
    fn visit(&mut self, relations: Relations, inherited: usize, depth: u32) {
        if self.undecided(&relations).is_none() {
            let ranks = self.ranks(&relations);
            if let Some(cost) = self.judge.cost(&ranks).filter(|c| *c < self.count) {
                (self.best, self.count) = (ranks, cost);
            }
            return;
        }
        let Least { faces, blocks } = self.bound.least(&self.rules, &relations);
        let own = match self.objective {
            Objective::BlocksPadded => blocks + faces,
            Objective::Blocks => blocks,
            Objective::SurfacePatches => faces,
        };
        let bound = own.max(inherited);
        if bound < self.count {
            let slot = self.free.pop().unwrap_or(self.store.len());
            self.store.resize_with(self.store.len().max(slot + 1), || None);
            self.store[slot] = Some(relations);
            self.heap.push(Open { bound: Reverse(bound), depth, number: self.nodes, slot });
        }
    }

    /// The pair to decide next: the one that matters most for the outlines of facets and for clauses.
    fn undecided(&self, relations: &Relations) -> Option<(u32, u32)> {
        let pairs = &self.rules.pairs;
        let mut best = None;
        for levels in &pairs.of_axis {
            for (i, &a) in levels.iter().enumerate() {
                for &b in levels[..i].iter().filter(|&&b| !is_decided(relations.get(pairs, b, a))) {
                    let clauses = self.rules.open_clauses(relations, b, a);
                    let score = self.weight[pairs.cell(b, a)] as usize * 16 + clauses;
                    if best.is_none_or(|(most, _)| score > most) {
                        best = Some((score, (b, a)));
                    }
                }
            }
        }
        best.map(|(_, pair)| pair)
    }

    fn ranks(&self, relations: &Relations) -> Ranks {
        let pairs = &self.rules.pairs;
        let mut ranks = self.best.clone();
        for (axis, levels) in pairs.of_axis.iter().enumerate() {
            let lower = |&a: &u32| levels.iter().filter(|&&b| relations.below(pairs, b, a)).count();
            let keys: Vec<usize> = levels.iter().map(lower).collect();
            ranks.set_axis(axis, levels, &keys);
        }
        ranks
    }
}
