//! The search: the most promising partial order first, three ways from each.

use super::Proof;
use super::bound::{Bound, Least};
use super::clauses::Rules;
use super::relations::{ABOVE, BELOW, EQUAL, Relations, is_decided};
use crate::align::guides::Guided;
use crate::align::judge::Judge;
use crate::align::ranks::Ranks;
use crate::context::Context;
use crate::error::Result;
use crate::layout::Objective;
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

/// A partial order with its bound.
struct Child {
    relations: Relations,
    bound: usize,
}

/// The state of the search.
pub(super) struct Tree<'a> {
    rules: Rules<'a>,
    bound: Bound,
    objective: Objective,
    judge: Judge<'a>,
    guided: &'a Guided,
    best: Ranks,
    count: usize,
    nodes: u64,
    heap: BinaryHeap<Open>,
    store: Vec<Option<Relations>>,
    free: Vec<usize>,
    weight: Vec<u32>,
    pushed: u64,
}

impl<'a> Tree<'a> {
    pub(super) fn new(
        rules: Rules<'a>,
        bound: Bound,
        objective: Objective,
        (judge, guided): (Judge<'a>, &'a Guided),
        best: (Ranks, usize),
    ) -> Self {
        let weight = bound.weights(&rules.pairs);
        let (heap, store, free) = (BinaryHeap::new(), Vec::new(), Vec::new());
        let (best, count) = best;
        Self { rules, bound, objective, judge, guided, best, count, nodes: 0, heap, store, free, weight, pushed: 0 }
    }

    /// Searches from `root` until nothing better is possible or a limit is reached.
    pub(super) fn run(mut self, root: Relations, limits: &Limits, context: &Context) -> Result<Proof> {
        let start = Instant::now();
        let most_open = MEMORY / (root.size() + 1);
        if let Some(child) = self.assess(root, 0) {
            self.push(child, 0);
        }
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

    /// Takes the most promising partial order and decides one more pair of levels, in up to three ways.
    fn expand(&mut self) {
        let Some(open) = self.heap.pop() else { return };
        let Some(relations) = self.store[open.slot].take() else { return };
        self.free.push(open.slot);
        let Some(pair) = self.undecided(&relations) else { return };
        for child in self.children(&relations, pair, open.bound.0) {
            self.push(child, open.depth + 1);
        }
    }

    /// What is left of a partial order for each relation that a pair can have.
    fn children(&mut self, parent: &Relations, (a, b): (u32, u32), bound: usize) -> Vec<Child> {
        let mut children = Vec::with_capacity(3);
        for choice in [BELOW, ABOVE, EQUAL] {
            if parent.get(&self.rules.pairs, a, b) & choice == 0 {
                continue;
            }
            self.nodes += 1;
            let mut relations = parent.clone();
            let holds = self.rules.restrict(&mut relations, &[(a, b, choice)]).is_ok();
            children.extend(holds.then_some(relations).and_then(|r| self.assess(r, bound)));
        }
        children
    }

    /// Judges a complete order; bounds a partial one, and keeps it unless that rules it out.
    fn assess(&mut self, relations: Relations, inherited: usize) -> Option<Child> {
        if self.undecided(&relations).is_none() {
            let ranks = self.ranks(&relations);
            let cost =
                self.judge.cost(self.objective, &ranks).filter(|c| *c < self.count && self.guided.allows(&ranks));
            if let Some(cost) = cost {
                (self.best, self.count) = (ranks, cost);
            }
            return None;
        }
        let Least { faces, blocks } = self.bound.least(&self.rules, &relations);
        let own = match self.objective {
            Objective::BlocksPadded => blocks + faces,
            Objective::Blocks => blocks,
            Objective::SurfacePatches => faces,
        };
        let bound = own.max(inherited);
        (bound < self.count).then_some(Child { relations, bound })
    }

    fn push(&mut self, child: Child, depth: u32) {
        let slot = self.free.pop().unwrap_or(self.store.len());
        self.store.resize_with(self.store.len().max(slot + 1), || None);
        self.store[slot] = Some(child.relations);
        self.pushed += 1;
        self.heap.push(Open { bound: Reverse(child.bound), depth, number: self.pushed, slot });
    }

    /// The pair to decide next; none when the order is complete.
    fn undecided(&self, relations: &Relations) -> Option<(u32, u32)> {
        let pairs = &self.rules.pairs;
        let of_axis = |levels: &'_ Vec<u32>| -> Vec<(u32, u32)> {
            let all = levels.iter().enumerate().flat_map(|(i, &a)| levels[..i].iter().map(move |&b| (b, a)));
            all.filter(|&(b, a)| !is_decided(relations.get(pairs, b, a))).collect()
        };
        let open = pairs.of_axis.iter().flat_map(of_axis);
        open.min_by_key(|&(b, a)| (Reverse(self.urgency(relations, b, a)), b, a))
    }

    /// How much a pair matters: for the outlines of facets, for clauses not yet satisfied, and the less the more
    /// relations it can have. The weights were found by trial.
    fn urgency(&self, relations: &Relations, a: u32, b: u32) -> usize {
        let pairs = &self.rules.pairs;
        let outlines = self.weight[pairs.cell(a, b)] as usize;
        let halved = relations.get(pairs, a, b).count_ones() == 2;
        16 * outlines + self.rules.open_clauses(relations, a, b) + 100 * usize::from(halved)
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
