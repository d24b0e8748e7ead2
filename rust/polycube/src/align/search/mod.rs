//! The strategy `best`: Algorithm 1 and greedy merging, then annealing from both; the coarsest valid result wins.

mod anneal;
mod chains;
mod coarsest;
mod components;
mod front;
mod greedy;
mod moves;
mod state;

pub(crate) use coarsest::{coarsest, place_trade_off};
pub(crate) use moves::Moves;

use super::Task;
use super::effort::Effort;
use super::guides::symmetries;
use super::prove::{Proof, prove_guided};
use super::ranks::Ranks;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::layout::MOST_LEVELS;
use crate::structure::Structure;
use anneal::Landscape;
use components::Component;
use front::Front;
use state::State;
use std::time::Instant;

/// The trade-offs met on the way.
pub(super) struct SearchResult {
    /// Orders between the coarsest and the input.
    pub front: Front,
    /// What is known of the least count.
    pub proof: Proof,
}

/// Whether [`search`] can handle a structure: it needs 1022 levels or fewer on one axis.
pub(super) fn is_searchable(structure: &Structure) -> bool {
    (0..3).any(|axis| structure.levels.iter().filter(|l| l.axis == axis).count() <= MOST_LEVELS)
}

/// How much more than any other the displacement of a fixed level counts.
const FIXED: f64 = 1e4;

/// Searches for the order with the smallest count, starting from that of `paper`, a valid placement, and from that of
/// the input; solids that stay separate are searched one by one.
///
/// The result counts no more than either, and than greedy merging from the input. The start of the task stands for the
/// input where guides do not allow the input itself.
pub(super) fn search(task: &Task, paper: &[f64], context: &Context) -> Result<SearchResult> {
    let parts = if task.guided.is_free() { components::split(task.structure, &task.start) } else { Vec::new() };
    if parts.len() < 2 { search_whole(task, paper, context) } else { search_parts(task, paper, &parts, context) }
}

fn search_parts(task: &Task, paper: &[f64], parts: &[Component], context: &Context) -> Result<SearchResult> {
    let mut found = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        let done = |k: usize| k as f64 / parts.len() as f64;
        let own = context.stage("search", done(k), done(k + 1));
        let input = part.of(task.input);
        found.push(search_whole(&part.task(task, &input), &part.of(paper), &own)?);
    }
    let sum = |of: fn(&Proof) -> usize| found.iter().map(|f| of(&f.proof)).sum::<usize>();
    let (bound, nodes) = (sum(|p| p.bound), found.iter().map(|f| f.proof.nodes).sum());
    let prepared = Prepared::new(task);
    let landscape = prepared.landscape(task);
    let mut chain = landscape.chain()?;
    let mut front = Front::default();
    let starts = [Ranks::new(task.structure, paper), Ranks::new(task.structure, &task.start)];
    starts.into_iter().filter_map(|ranks| chain.state(ranks)).for_each(|s| front.offer(&s));
    components::combine(task, parts, &found, &mut chain, &mut front, context)?;
    let best = front.states().next();
    let best = best.ok_or_else(|| Error::new(ErrorKind::Internal, "the start of the search is not valid"))?;
    let proof = Proof { bound, best: best.ranks.clone(), count: best.count, proven: best.count == bound, nodes };
    Ok(SearchResult { front, proof })
}

fn search_whole(task: &Task, paper: &[f64], context: &Context) -> Result<SearchResult> {
    let prepared = Prepared::new(task);
    let starts = [Ranks::new(task.structure, paper), Ranks::new(task.structure, &task.start)];
    run(&prepared.landscape(task), &starts, &task.options.effort, context)
}

/// What a landscape borrows.
struct Prepared {
    moves: Moves,
    weights: Vec<f64>,
}

impl Prepared {
    fn new(task: &Task) -> Self {
        let Task { structure, input, guided, .. } = task;
        let mut weights: Vec<f64> = structure.levels.iter().map(|l| f64::from(l.corners)).collect();
        guided.fixed().for_each(|(l, _)| weights[l as usize] *= FIXED);
        Self { moves: Moves::new(structure, guided, symmetries(structure, input)), weights }
    }

    fn landscape<'a>(&'a self, task: &'a Task) -> Landscape<'a> {
        let Task { structure, input, guided, options, .. } = task;
        Landscape {
            structure,
            moves: &self.moves,
            objective: options.objective,
            guided,
            targets: input,
            weights: &self.weights,
            gap: structure.shortest_edge(input) / 2.0,
            unit: diagonal(structure, input),
            deadline: task.deadline,
        }
    }
}

/// Greedy merging, the chains, the proof.
fn run(landscape: &Landscape, starts: &[Ranks; 2], effort: &Effort, context: &Context) -> Result<SearchResult> {
    let mut chain = landscape.chain()?;
    let valid: Vec<State> = starts.iter().filter_map(|ranks| chain.state(ranks.clone())).collect();
    let Some(input) = valid.last().cloned() else {
        return Err(Error::new(ErrorKind::Internal, "the start of the search is not valid"));
    };
    let mut front = Front::default();
    valid.iter().for_each(|s| front.offer(s));
    let merged = greedy::merge(landscape, &mut chain, input.clone(), greedy::saved, &mut front, context)?;
    let begin = [valid[0].clone(), merged.clone()];
    chains::walk(landscape, &begin, effort, &mut front, &context.stage("search", 0.0, 0.8))?;
    greedy::merge(landscape, &mut chain, input, greedy::saved_per_cost, &mut front, context)?;
    chains::fill(landscape, effort, &mut front, &context.stage("search", 0.8, 1.0))?;
    // The front holds every state accepted on the way, so it begins with the best of them.
    let incumbent = front.states().next().unwrap_or(&merged).ranks.clone();
    let left = landscape.deadline.map(|d| d.saturating_duration_since(Instant::now()));
    let limits = (effort.proof_nodes, left);
    let proof = prove_guided(landscape.structure, landscape.guided, landscape.objective, &incumbent, limits, context)?;
    if let Some(state) = chain.state(proof.best.clone()) {
        front.offer(&state);
    }
    Ok(SearchResult { front, proof })
}

fn diagonal(structure: &Structure, placement: &[f64]) -> f64 {
    let size = |axis: usize| {
        let along = structure.levels.iter().zip(placement).filter(|(l, _)| l.axis == axis).map(|(_, &x)| x);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        high - low
    };
    (size(0) * size(0) + size(1) * size(1) + size(2) * size(2)).sqrt()
}
