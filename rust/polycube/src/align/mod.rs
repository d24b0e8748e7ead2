//! Aligning the corners of a polycube on the integer lattice. Nothing here knows about meshes.
//!
//! [`align`] is the way in. Algorithm 1 pairs corners ([`neighbours`]), turns the pairs and the distances to keep
//! into an integer [`problem`], [`solve`]s it, checks the result exactly, and repeats.

mod classes;
mod constraints;
pub mod neighbours;
mod order;
mod pairs;
mod paper;
pub mod problem;
pub mod prove;
pub mod ranks;
mod relax;
#[allow(missing_docs)]
pub mod search;
mod separate;
pub mod solve;

pub use paper::Round;

use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::layout::{Counts, count};
use crate::structure::{Arrangement, Conflict, Placement, Structure};
use order::place_in_order;
use paper::Settings;
use problem::Problem;
use solve::{ExactSolver, LinearSolver, Solver};

/// How the levels find their places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Strategy {
    /// Round every level to the lattice, as standard pipelines do. May break the polycube.
    Naive,
    /// Algorithm 1 of the paper.
    #[default]
    Paper,
}

/// Who solves the integer problems.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SolverKind {
    /// Minimum cuts in integer arithmetic; corners that attract each other are kept apart when they would meet.
    #[default]
    Exact,
    /// Linear programs through `good_lp`, with the separation planes as printed in Eq. 4. Slow.
    Linear,
}

/// What [`align`] shall do.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Options {
    /// How the levels find their places.
    pub strategy: Strategy,
    /// Lattice steps per unit of the input, above 0.
    pub scale: f64,
    /// Algorithm 1 stops before λ falls below this: 0 (the default) for the coarsest result, 1 for one round.
    pub lambda_min: f64,
    /// Who solves the integer problems.
    pub solver: SolverKind,
}

impl Default for Options {
    fn default() -> Self {
        Self { strategy: Strategy::default(), scale: 1.0, lambda_min: 0.0, solver: SolverKind::default() }
    }
}

/// Levels on the lattice, and how they got there.
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// The lattice coordinate of every level.
    pub levels: Vec<i64>,
    /// Counts of the input as it came.
    pub before: Counts,
    /// Counts of the result; nothing if it is not valid.
    pub after: Option<Counts>,
    /// The rounds of Algorithm 1, in order.
    pub rounds: Vec<Round>,
    /// What a naive rounding broke; empty for every other strategy.
    pub broken: Vec<Conflict>,
}

/// Moves the levels of a valid polycube to integers so that they align.
///
/// `input` is the coordinate of each level; its arrangement must be free of conflicts. The result keeps facets,
/// corners and edges, is embedded, and has no more blocks than the input. Which levels coincide and how the
/// others are ordered does not depend on the scale (paper, Fig. 3), nor on units or position of the input.
///
/// # Errors
/// [`ErrorKind::Option`] for a scale that is not positive or too large for the lattice, [`ErrorKind::Polycube`] for an
/// input that touches itself, [`ErrorKind::Cancelled`].
pub fn align(structure: &Structure, input: &[f64], options: &Options, context: &Context) -> Result<Alignment> {
    let targets = scaled(input, options.scale)?;
    let arrangement = Arrangement::new(structure, input);
    if !arrangement.conflicts().is_empty() {
        return Err(Error::new(ErrorKind::Polycube, "the polycube touches or crosses itself")
            .remedy("validate it to see where, and move the parts apart"));
    }
    let before = count(&arrangement);
    match options.strategy {
        Strategy::Naive => Ok(naive(structure, &targets, before)),
        Strategy::Paper => simplify(structure, input, &targets, before, options, context),
    }
}

fn scaled(input: &[f64], scale: f64) -> Result<Placement> {
    let targets: Placement = input.iter().map(|x| x * scale).collect();
    let bound = Problem::MAX_LEVEL as f64 / 2.0;
    if !(scale.is_finite() && scale > 0.0) {
        return Err(Error::new(ErrorKind::Option, format!("the scale {scale} is not a positive number")));
    }
    if targets.iter().any(|x| x.abs() > bound) {
        return Err(Error::new(ErrorKind::Option, format!("with scale {scale} the lattice exceeds ±{bound} steps"))
            .remedy("use a smaller scale or a longer edge length, or move the polycube to the origin"));
    }
    Ok(targets)
}

fn naive(structure: &Structure, targets: &[f64], before: Counts) -> Alignment {
    let placement: Placement = targets.iter().map(|x| x.round()).collect();
    let arrangement = Arrangement::new(structure, &placement);
    let broken = arrangement.conflicts();
    let after = broken.is_empty().then(|| count(&arrangement));
    Alignment { levels: to_integers(&placement), before, after, rounds: Vec::new(), broken }
}

/// Algorithm 1 from λ = 1 again and again until it finds nothing more, so that a second call changes nothing.
fn simplify(
    structure: &Structure,
    input: &[f64],
    targets: &[f64],
    before: Counts,
    options: &Options,
    context: &Context,
) -> Result<Alignment> {
    let solver: &dyn Solver = match options.solver {
        SolverKind::Exact => &ExactSolver::default(),
        SolverKind::Linear => &LinearSolver::default(),
    };
    let oblique_planes = options.solver == SolverKind::Linear;
    let settings = Settings { lambda_min: options.lambda_min, solver, oblique_planes };
    let mut best = place_in_order(structure, input, targets, solver, context)?;
    let mut after = before;
    let mut rounds = Vec::new();
    let mut from = input.to_vec();
    loop {
        let (found, counts, steps) = improve(structure, &from, input, &settings, context)?;
        if rounds.is_empty() || counts.blocks_padded < after.blocks_padded {
            rounds.extend(steps);
        }
        if counts.blocks_padded >= after.blocks_padded {
            break;
        }
        best = place_in_order(structure, &found, targets, solver, context)?;
        from.clone_from(&best);
        after = counts;
    }
    Ok(Alignment { levels: to_integers(&best), before, after: Some(after), rounds, broken: Vec::new() })
}

/// One run of Algorithm 1 on `from`, settled near `from` or, if that is as coarse, near `input`.
fn improve(
    structure: &Structure,
    from: &[f64],
    input: &[f64],
    settings: &Settings,
    context: &Context,
) -> Result<(Placement, Counts, Vec<Round>)> {
    let unit = Unit::of(structure, from);
    let own = unit.apply(structure, from);
    let outcome = paper::run(structure, &own, settings, context)?;
    let near = outcome.settle(structure, &own, settings.solver, context)?;
    let counts = count(&Arrangement::new(structure, &near));
    let original = Unit::of(structure, input).apply(structure, input);
    let faithful = outcome.settle(structure, &original, settings.solver, context)?;
    let faithful_counts = count(&Arrangement::new(structure, &faithful));
    let (placement, counts) = if faithful_counts.blocks_padded <= counts.blocks_padded {
        (faithful, faithful_counts)
    } else {
        (near, counts)
    };
    Ok((placement, counts, outcome.rounds))
}

/// The lattice that Algorithm 1 works on, whatever the scale of the result: its steps are half the
/// shortest edge, so that rounding alone collapses nothing.
struct Unit {
    origin: [f64; 3],
    scale: f64,
}

impl Unit {
    const STEPS_PER_SHORTEST_EDGE: f64 = 2.0;

    fn of(structure: &Structure, placement: &[f64]) -> Self {
        let along = |axis: usize| structure.levels.iter().zip(placement).filter(move |(l, _)| l.axis == axis);
        let origin: [f64; 3] = std::array::from_fn(|a| along(a).map(|(_, &x)| x).fold(f64::INFINITY, f64::min));
        let size = |a: usize| along(a).map(|(_, &x)| x - origin[a]).fold(0.0, f64::max);
        let largest = size(0).max(size(1)).max(size(2));
        let finest = Problem::MAX_LEVEL as f64 / 2.0 / largest;
        Self { origin, scale: (Self::STEPS_PER_SHORTEST_EDGE / structure.shortest_edge(placement)).min(finest) }
    }

    fn apply(&self, structure: &Structure, placement: &[f64]) -> Placement {
        let own = structure.levels.iter().zip(placement);
        own.map(|(l, x)| (x - self.origin[l.axis]) * self.scale).collect()
    }
}

fn to_integers(placement: &[f64]) -> Vec<i64> {
    placement.iter().map(|&x| x as i64).collect()
}
