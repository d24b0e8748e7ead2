//! Proof of how few blocks there can be: an exact search over orders of levels with a lower bound.

mod bound;
mod clauses;
mod grid;
mod judge;
mod outline;
mod relations;
mod tree;

use super::ranks::Ranks;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::structure::Structure;
use bound::Bound;
use clauses::Rules;
use judge::Judge;
use std::time::Duration;
use tree::{Limits, Tree};

/// What is to be least.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Objective {
    /// Blocks of the base complex after one padding layer; for volumes.
    #[default]
    BlocksPadded,
    /// Blocks of the base complex without padding.
    Blocks,
    /// Patches of the surface; for surfaces.
    SurfacePatches,
}

/// What is known of the optimum of one structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// No valid order has a lower count; at most [`count`](Self::count).
    pub bound: usize,
    /// The best order known.
    pub best: Ranks,
    /// The count of [`best`](Self::best).
    pub count: usize,
    /// Whether `best` is certified to be optimal: `bound == count`.
    pub proven: bool,
    /// How many partial orders were looked at.
    pub nodes: u64,
}

/// Bounds the count of every valid order of the levels of `structure` from below.
///
/// # Errors
/// [`ErrorKind::Polycube`] if `incumbent` is not a valid order, [`ErrorKind::Cancelled`].
pub fn prove(
    structure: &Structure,
    objective: Objective,
    incumbent: &Ranks,
    budget: u64,
    time_limit: Option<Duration>,
    context: &Context,
) -> Result<Proof> {
    let mut judge = Judge::new(structure, objective);
    let count = judge.cost(incumbent).ok_or_else(|| {
        Error::new(ErrorKind::Polycube, "the order to start from is not a valid polycube")
            .remedy("start from the order of the input, or from a result of `align`")
    })?;
    let (rules, root) =
        Rules::new(structure).map_err(|_| Error::new(ErrorKind::Internal, "the rules exclude a valid order"))?;
    let tree = Tree::new(rules, Bound::new(structure), objective, judge, (incumbent.clone(), count));
    tree.run(root, &Limits { nodes: budget, time: time_limit }, context)
}
