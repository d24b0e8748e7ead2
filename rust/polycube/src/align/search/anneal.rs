//! Simulated annealing over orders of levels, counting blocks at every step.

use super::front::Front;
use super::moves::Moves;
use super::state::State;
use crate::align::guides::Guided;
use crate::align::ranks::Ranks;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::layout::{Counter, Objective, counter};
use crate::rng::SplitMix64;
use crate::structure::Structure;
use std::time::Instant;

/// What is searched, the same for every chain.
pub(super) struct Landscape<'a> {
    /// The structure.
    pub structure: &'a Structure,
    /// Its moves.
    pub moves: &'a Moves,
    /// The number to make small.
    pub objective: Objective,
    /// What every order must respect.
    pub guided: &'a Guided,
    /// The levels of the input.
    pub targets: &'a [f64],
    /// How much the displacement of each level counts.
    pub weights: &'a [f64],
    /// The least distance of two planes, in units of the input.
    pub gap: f64,
    /// The displacement of all corners, as a root mean square in units of the input, that doubles the count at weight
    /// 1.
    pub unit: f64,
    /// When to stop whatever is left to do.
    pub deadline: Option<Instant>,
}

impl<'a> Landscape<'a> {
    /// How much work one chain or one greedy merging may be, in words of bits looked at: a few seconds.
    const WORK: usize = 100_000_000;

    /// A walker; its work space is made once.
    pub(super) fn chain(&'a self) -> Result<Chain<'a>> {
        let most = || Error::new(ErrorKind::Internal, "too many levels to search");
        Ok(Chain { landscape: self, rows: counter(self.structure).ok_or_else(most)?, corners: self.corners() })
    }

    /// Whether it is time to stop.
    pub(super) fn is_late(&self) -> bool {
        self.deadline.is_some_and(|d| Instant::now() >= d)
    }

    /// So many of `counts` that the work stays in bounds.
    pub(super) fn affordable(&self, counts: u32) -> u32 {
        let words = counter(self.structure).map_or(1, |rows| rows.words()).max(1);
        counts.min((Self::WORK / words) as u32)
    }

    fn corners(&self) -> f64 {
        self.structure.corners.len() as f64
    }
}

/// One run of annealing.
#[derive(Clone, Copy)]
pub(super) struct Schedule {
    /// Seed of the random numbers.
    pub seed: u64,
    /// Number of moves tried.
    pub steps: u32,
    /// First temperature, as a fraction of the count at the start.
    pub hot: f64,
    /// Last temperature, likewise.
    pub cold: f64,
    /// How much displacement counts, see [`Landscape::unit`].
    pub weight: f64,
    /// Whether two levels may move at once.
    pub paired: bool,
    /// The largest [`State::shape_cost`] to accept.
    pub most: f64,
}

/// A walker on a landscape.
pub(super) struct Chain<'a> {
    landscape: &'a Landscape<'a>,
    rows: Box<dyn Counter>,
    corners: f64,
}

impl Chain<'_> {
    /// Judges an order; nothing if it is no valid polycube.
    pub(super) fn state(&mut self, ranks: Ranks) -> Option<State> {
        let count = self.count(&ranks)?;
        let shape = std::array::from_fn(|axis| self.shape(&ranks, axis));
        Some(State { ranks, count, shape })
    }

    /// What the objective counts in an order; nothing if it is no valid polycube or the guides do not allow it.
    pub(super) fn count(&mut self, ranks: &Ranks) -> Option<usize> {
        if !self.landscape.guided.allows(ranks) {
            return None;
        }
        self.rows.count(self.landscape.objective, &ranks.of_level, ranks.planes)
    }

    fn shape(&self, ranks: &Ranks, axis: usize) -> f64 {
        let Landscape { structure, weights, targets, gap, .. } = *self.landscape;
        ranks.shape_cost(structure, weights, targets, gap, axis)
    }

    /// The count, raised by the displacement.
    pub(super) fn energy(&self, state: &State, weight: f64) -> f64 {
        let displacement = (state.shape_cost() / self.corners).sqrt() / self.landscape.unit;
        state.count as f64 * (1.0 + weight * displacement)
    }

    /// Walks from `start`, leaving every accepted state in `front`.
    pub(super) fn walk(
        &mut self,
        start: State,
        schedule: &Schedule,
        front: &mut Front,
        context: &Context,
    ) -> Result<()> {
        let mut random = SplitMix64::new(schedule.seed);
        let mut now = start;
        let mut energy = self.energy(&now, schedule.weight);
        let scale = energy;
        // Neither logarithms nor powers of the standard library are the same on every machine.
        let cooling = libm::pow(schedule.cold / schedule.hot, 1.0 / f64::from(schedule.steps.max(1)));
        let mut temperature = schedule.hot * scale;
        for step in 0..schedule.steps {
            if step % 128 == 0 {
                context.tick(f64::from(step) / f64::from(schedule.steps))?;
                if self.landscape.is_late() {
                    break;
                }
            }
            temperature *= cooling;
            let limit = energy - temperature * libm::log(random.unit().max(1e-12));
            if let Some((next, its)) = self.attempt(&now, limit, schedule, &mut random) {
                (now, energy) = (next, its);
                front.offer(&now);
            }
        }
        Ok(())
    }

    /// A random neighbour of `now` and its energy, if it is valid and its energy at most `limit`.
    fn attempt(
        &mut self,
        now: &State,
        limit: f64,
        schedule: &Schedule,
        random: &mut SplitMix64,
    ) -> Option<(State, f64)> {
        let (ranks, axis) = self.landscape.moves.draw(&now.ranks, schedule.paired, random)?;
        let mut shape = now.shape;
        shape[axis] = self.shape(&ranks, axis);
        if shape.iter().sum::<f64>() > schedule.most {
            return None;
        }
        let count = self.count(&ranks)?;
        let next = State { ranks, count, shape };
        let energy = self.energy(&next, schedule.weight);
        (energy <= limit).then_some((next, energy))
    }
}
