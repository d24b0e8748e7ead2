//! Aligning the corners of a polycube on the integer lattice. Nothing here knows about meshes.
//!
//! [`align`] is the way in. Algorithm 1 pairs corners ([`neighbours`]), turns the pairs and the distances to keep
//! into an integer [`problem`], [`solve`]s it, checks the result exactly, and repeats.

mod classes;
mod judge;
mod options;
mod order;
mod paper;
pub mod problem;
pub mod prove;
pub mod ranks;
mod relax;
mod search;
mod separate;
pub mod solve;
mod unit;

pub use options::{Options, SolverKind, Strategy};
pub use paper::{Round, neighbours};
pub use search::Effort;

use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::layout::{Counts, count};
use crate::structure::{Arrangement, Conflict, Placement, Structure};
use problem::Problem;

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
    /// The trade-off between few blocks and little displacement, from the fewest blocks on; only from [`Strategy::Best`].
    pub front: Vec<TradeOff>,
    /// How far the objective can go down at most; only from [`Strategy::Best`].
    pub bound: Option<LowerBound>,
}

/// What is proven of the least count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct LowerBound {
    /// No valid polycube of this structure counts less.
    pub count: usize,
    /// Whether the search reached it, so that its result is the optimum.
    pub proven: bool,
    /// Partial orders looked at.
    pub nodes: u64,
}

/// One way to trade blocks for displacement.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct TradeOff {
    /// What the objective counts.
    pub count: usize,
    /// Root mean square of the corners' displacement, in units of the input, at the finest lattice.
    pub displacement: f64,
    /// The number of every level's plane, from 1.
    pub order: Vec<u16>,
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
        Strategy::Paper => checked(structure, paper::simplify(structure, input, &targets, before, options, context)?),
        Strategy::Best => checked(structure, search::coarsest(structure, input, &targets, before, options, context)?),
    }
}

/// The alignment, if its levels are a valid polycube by the exact check.
fn checked(structure: &Structure, found: Alignment) -> Result<Alignment> {
    let placement: Placement = found.levels.iter().map(|&x| x as f64).collect();
    let arrangement = Arrangement::new(structure, &placement);
    if arrangement.conflicts().is_empty() && arrangement.inside_out().is_empty() {
        return Ok(found);
    }
    Err(Error::new(ErrorKind::Internal, "the polycube found touches itself"))
}

/// The alignment at another scale: the order of `levels`, which [`align`] found at any scale, as near as possible to `input`
/// at the scale of `options`. Where the order does not matter ([`Strategy::Naive`]), what [`align`] itself would give.
///
/// Takes one integer problem instead of the many of [`align`]. λ is not used.
///
/// # Errors
/// [`ErrorKind::Option`] for a scale that is not positive or too large for the lattice, [`ErrorKind::Cancelled`].
pub fn rescale(
    structure: &Structure,
    input: &[f64],
    levels: &[i64],
    options: &Options,
    context: &Context,
) -> Result<Vec<i64>> {
    let targets = scaled(input, options.scale)?;
    if options.strategy == Strategy::Naive {
        return Ok(targets.iter().map(|x| x.round() as i64).collect());
    }
    let valid: Placement = levels.iter().map(|&x| x as f64).collect();
    Ok(to_integers(&order::place_in_order(structure, &valid, &targets, &*options.solver.solver(), context)?))
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
    Alignment {
        levels: to_integers(&placement),
        before,
        after,
        rounds: Vec::new(),
        broken,
        front: Vec::new(),
        bound: None,
    }
}

fn to_integers(placement: &[f64]) -> Vec<i64> {
    placement.iter().map(|&x| x as i64).collect()
}
