//! The strategy `best`: Algorithm 1 and greedy merging, then annealing from both; the coarsest valid result wins.

mod anneal;
mod coarsest;
mod front;
mod greedy;
mod moves;

pub use coarsest::{coarsest, place_trade_off};
pub use moves::Moves;

use super::Task;
use super::prove::{Proof, prove_guided};
use super::ranks::Ranks;
use crate::context::Context;
use crate::error::Result;
use crate::layout::Rows;
use crate::structure::Structure;
use anneal::{Chain, Landscape, Schedule, State};
use front::Front;
use num_traits::PrimInt;
use std::time::{Duration, Instant};

/// How long the search may take.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Effort {
    /// Moves tried per level in each of the four chains; the result is the same for the same number.
    pub steps_per_level: u32,
    /// Partial orders that the proof of a lower bound looks at; 0 for a quick bound.
    pub proof_nodes: u64,
    /// Stop after this time, with the best found; the result then depends on the machine.
    pub time_limit: Option<Duration>,
}

impl Default for Effort {
    fn default() -> Self {
        Self { steps_per_level: 400, proof_nodes: 200, time_limit: None }
    }
}

/// The chains, two from the result of Algorithm 1 and two from that of greedy merging, of which one each minds displacement.
const CHAINS: [Schedule; 4] = [
    Schedule { seed: 1, steps: 0, hot: 0.05, cold: 0.002, weight: 0.01 },
    Schedule { seed: 2, steps: 0, hot: 0.1, cold: 0.002, weight: 0.01 },
    Schedule { seed: 3, steps: 0, hot: 0.05, cold: 0.002, weight: 0.3 },
    Schedule { seed: 4, steps: 0, hot: 0.05, cold: 0.002, weight: 2.0 },
];

/// The trade-offs met on the way.
pub struct Found {
    /// Orders between the coarsest and the input.
    pub front: Front,
    /// What is known of the least count.
    pub proof: Proof,
}

/// Whether [`search`] can handle a structure: it needs 126 levels or fewer on one axis.
pub fn is_searchable(structure: &Structure) -> bool {
    levels_along_rows(structure) <= Rows::<u128>::capacity()
}

fn levels_along_rows(structure: &Structure) -> usize {
    let axis = Rows::<u128>::row_axis(structure);
    structure.levels.iter().filter(|l| l.axis == axis).count()
}

/// How much more than any other the displacement of a fixed level counts.
const FIXED: f64 = 1e4;

/// Searches for the order with the smallest count, starting from that of `paper`, a valid placement, and from that of the input.
///
/// The result counts no more than either, and than greedy merging from the input. The start of the task stands for the input
/// where guides do not allow the input itself.
pub fn search(task: &Task, paper: &[f64], context: &Context) -> Result<Found> {
    let Task { structure, input, guided, options, .. } = task;
    let effort = &options.effort;
    let moves = Moves::new(structure, guided);
    let mut weights: Vec<f64> = structure.levels.iter().map(|l| f64::from(l.corners)).collect();
    guided.fixed().for_each(|(l, _)| weights[l as usize] *= FIXED);
    let landscape = Landscape {
        structure,
        moves: &moves,
        objective: options.objective,
        guided,
        targets: input,
        weights: &weights,
        gap: structure.shortest_edge(input) / 2.0,
        unit: diagonal(structure, input),
        deadline: effort.time_limit.map(|limit| Instant::now() + limit),
    };
    let starts = [Ranks::new(structure, paper), Ranks::new(structure, &task.start)];
    if levels_along_rows(structure) <= Rows::<u64>::capacity() {
        run::<u64>(&landscape, &starts, effort, context)
    } else {
        run::<u128>(&landscape, &starts, effort, context)
    }
}

fn run<R: PrimInt + Send>(
    landscape: &Landscape,
    starts: &[Ranks; 2],
    effort: &Effort,
    context: &Context,
) -> Result<Found> {
    let mut chain = Chain::<R>::new(landscape);
    let valid: Vec<State> = starts.iter().filter_map(|ranks| chain.state(ranks.clone())).collect();
    let Some(input) = valid.last().cloned() else {
        return Err(crate::Error::new(crate::ErrorKind::Internal, "the start of the search is not valid"));
    };
    let merged = greedy::merge(landscape.structure, landscape.moves, &mut chain, input, context)?;
    let begin = [valid[0].clone(), merged.clone()];
    let mut front = Front::default();
    valid.iter().chain([&merged]).for_each(|s| front.offer(s));
    walk_all::<R>(landscape, &begin, effort, context)?.into_iter().for_each(|seen| front.join(seen));
    // The front holds every state accepted on the way, so it begins with the best of them.
    let incumbent = front.states().next().unwrap_or(&merged).ranks.clone();
    let left = landscape.deadline.map(|d| d.saturating_duration_since(Instant::now()));
    let limits = (effort.proof_nodes, left);
    let proof = prove_guided(landscape.structure, landscape.guided, landscape.objective, &incumbent, limits, context)?;
    if let Some(state) = chain.state(proof.best.clone()) {
        front.offer(&state);
    }
    Ok(Found { front, proof })
}

/// All chains, two at a time. What they find does not depend on how they are scheduled.
fn walk_all<R: PrimInt + Send>(
    landscape: &Landscape,
    begin: &[State; 2],
    effort: &Effort,
    context: &Context,
) -> Result<Vec<Front>> {
    let steps = effort.steps_per_level.saturating_mul(landscape.structure.levels.len() as u32);
    let walk = |i: usize| {
        let schedule = Schedule { steps, ..CHAINS[i] };
        let mut front = Front::default();
        let start = begin[i % 2].clone();
        Chain::<R>::new(landscape).walk(start, &schedule, &mut front, context).map(|()| front)
    };
    let mut results = Vec::new();
    for first in (0..CHAINS.len()).step_by(2) {
        let pair = std::thread::scope(|scope| {
            let other = scope.spawn(|| walk(first + 1));
            let own = walk(first);
            [Some(own), other.join().ok()]
        });
        for result in pair.into_iter().flatten() {
            results.push(result?);
        }
    }
    Ok(results)
}

fn diagonal(structure: &Structure, placement: &[f64]) -> f64 {
    let size = |axis: usize| {
        let along = structure.levels.iter().zip(placement).filter(|(l, _)| l.axis == axis).map(|(_, &x)| x);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        high - low
    };
    (size(0) * size(0) + size(1) * size(1) + size(2) * size(2)).sqrt()
}
