//! Taking loops away as long as that pays.

use super::LoopOptions;
use super::moves::Moves;
use super::trial::{Move, Trial};
use crate::context::Context;
use crate::error::Result;
use std::collections::BTreeSet;

/// Trials for a loop that cannot go alone.
const BUDGET: usize = 30;
/// Moves of several loops are looked for once the best of single loops costs more than this share of what a corner is
/// worth.
const CHEAP: f64 = 0.3;
/// How often all loops are looked at again when no move is known.
const REVIEWS: usize = 2;

/// What is known of the moves that a loop can start.
#[derive(Clone, Debug, Default)]
struct Known {
    /// The number of moves made when it was looked at.
    since: u32,
    /// The best move and its price.
    best: Option<(f64, Move)>,
}

/// What a move costs for each corner that goes away; nothing for moves that do not pay.
fn price(m: &Move, worth: f64) -> Option<f64> {
    match m.corners {
        0 => (m.free && m.cost <= 1e-12).then_some(f64::NEG_INFINITY),
        1.. => Some(m.cost + worth * m.corners as f64).filter(|&p| p < -1e-9),
        fewer => Some(m.cost / -fewer as f64).filter(|&p| p < worth),
    }
}

/// Takes loops away, cheapest corners first, until a corner less costs more than it is worth or few enough are left.
///
/// # Errors
/// Only that the context was cancelled.
pub(super) fn coarsen(moves: &mut Moves, options: &LoopOptions, context: &Context) -> Result<()> {
    let mut search = Search::new(moves, options.worth_of_corner());
    let mut corners = search.moves.corners() as i64;
    let goal = options.corners.map_or(0, |c| c as i64);
    let mut reviews = 0;
    loop {
        search.look(context)?;
        let Some((price, set)) = search.best() else {
            if reviews == REVIEWS || search.is_current() {
                return Ok(());
            }
            reviews += 1;
            search.forget();
            continue;
        };
        if corners <= goal && price > f64::NEG_INFINITY {
            return Ok(());
        }
        corners += search.make(price, &set);
        context.tick(search.progress())?;
    }
}

struct Search<'a> {
    moves: &'a mut Moves,
    worth: f64,
    single: Vec<Option<Known>>,
    several: Vec<Option<Known>>,
    /// Sets of loops that were extended since the last move.
    expanded: BTreeSet<Vec<u32>>,
    expanded_since: u32,
    loops: usize,
}

impl<'a> Search<'a> {
    fn new(moves: &'a mut Moves, worth: f64) -> Self {
        let count = moves.graph.loops.len();
        let loops = moves.graph.loops.iter().filter(|l| l.alive).count();
        let none = vec![None; count];
        Self { moves, worth, single: none.clone(), several: none, expanded: BTreeSet::new(), expanded_since: 0, loops }
    }

    /// Looks at all loops around which something changed.
    fn look(&mut self, context: &Context) -> Result<()> {
        for l in 0..self.single.len() {
            if !self.moves.is_first(l as u32) {
                (self.single[l], self.several[l]) = (None, None);
            } else if !self.is_fresh(l, &self.single[l]) {
                context.check()?;
                let best = match self.moves.try_loops(&[l as u32]) {
                    Trial::Valid(m) => price(&m, self.worth).map(|p| (p, m)),
                    Trial::Blocked(_) => None,
                };
                self.single[l] = Some(Known { since: self.moves.moves, best });
            }
        }
        let cheap = best_of(&self.single).is_some_and(|(p, _)| p <= CHEAP * self.worth);
        if cheap { Ok(()) } else { self.look_deeper(context) }
    }

    /// Looks for moves of several loops.
    fn look_deeper(&mut self, context: &Context) -> Result<()> {
        if self.expanded_since != self.moves.moves {
            self.expanded.clear();
            self.expanded_since = self.moves.moves;
        }
        for l in 0..self.several.len() {
            if self.single[l].is_none() || self.is_fresh(l, &self.several[l]) {
                continue;
            }
            context.check()?;
            let worth = self.worth;
            let best = match self.moves.try_loops(&[l as u32]) {
                Trial::Valid(_) => None,
                Trial::Blocked(b) => self.moves.unblock(b, BUDGET, usize::MAX, &mut self.expanded, |m| price(m, worth)),
            };
            self.several[l] = Some(Known { since: self.moves.moves, best });
        }
        Ok(())
    }

    fn is_fresh(&self, l: usize, known: &Option<Known>) -> bool {
        known.as_ref().is_some_and(|k| {
            let loops = k.best.as_ref().map_or(&[][..], |b| &b.1.loops);
            self.moves.is_unchanged(&[l as u32], k.since) && self.moves.is_unchanged(loops, k.since)
        })
    }

    /// The price and the loops of the best move known.
    fn best(&self) -> Option<(f64, Vec<u32>)> {
        let found = [best_of(&self.single), best_of(&self.several)].into_iter().flatten();
        found.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(price, m)| (price, m.loops.clone()))
    }

    /// Whether all that is known was found after the last move.
    fn is_current(&self) -> bool {
        let mut known = self.single.iter().chain(&self.several).flatten();
        known.all(|k| k.since == self.moves.moves)
    }

    fn forget(&mut self) {
        self.single.iter_mut().chain(&mut self.several).for_each(|k| *k = None);
    }

    /// Makes a move if it is still as good as it was. Returns by how many the corners grow.
    fn make(&mut self, price_before: f64, loops: &[u32]) -> i64 {
        if let Trial::Valid(m) = self.moves.try_loops(loops)
            && price(&m, self.worth).is_some_and(|p| p <= price_before + 1e-12)
        {
            self.moves.take(loops);
            return m.corners;
        }
        let stale = |k: &Option<Known>| k.as_ref().and_then(|k| k.best.as_ref()).is_some_and(|b| b.1.loops == loops);
        self.single.iter_mut().chain(&mut self.several).filter(|k| stale(k)).for_each(|k| *k = None);
        0
    }

    fn progress(&self) -> f64 {
        let left = self.moves.graph.loops.iter().filter(|l| l.alive).count();
        1.0 - left as f64 / self.loops.max(1) as f64
    }
}

fn best_of(known: &[Option<Known>]) -> Option<(f64, &Move)> {
    let best = known.iter().flatten().filter_map(|k| k.best.as_ref());
    best.min_by(|a, b| a.0.total_cmp(&b.0)).map(|b| (b.0, &b.1))
}
