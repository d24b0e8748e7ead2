//! What the alignment shall do.

use super::effort::Effort;
use super::guides::Guides;
use super::solve::{ExactSolver, LinearSolver, Solver};
use crate::layout::Objective;

/// How the levels find their places.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, bitcode::Encode, bitcode::Decode,
)]
#[serde(rename_all = "snake_case")]
pub enum Strategy {
    /// Round every level to the lattice, as standard pipelines do. May break the polycube.
    Naive,
    /// Algorithm 1 of the paper.
    Paper,
    /// A search for the smallest count, from the results of Algorithm 1 and of greedy merging; never worse than either.
    #[default]
    Best,
}

/// Who solves the integer problems.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, bitcode::Encode, bitcode::Decode,
)]
#[serde(rename_all = "snake_case")]
pub enum SolverKind {
    /// Minimum cuts in integer arithmetic; corners that attract each other are kept apart when they would meet.
    #[default]
    Exact,
    /// Linear programs through `good_lp`, with the separation planes as printed in Eq. 4. Slow.
    Linear,
}

/// What [`align`](super::align()) shall do.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct AlignOptions {
    /// How the levels find their places.
    pub strategy: Strategy,
    /// Lattice steps per unit of the input, above 0.
    pub scale: f64,
    /// Algorithm 1 stops before λ falls below this: 0 (the default) for the coarsest result, 1 for one round.
    pub lambda_min: f64,
    /// Who solves the integer problems.
    pub solver: SolverKind,
    /// Which number [`Strategy::Best`] makes small; Algorithm 1 always minds `blocks_padded`.
    pub objective: Objective,
    /// How long [`Strategy::Best`] searches.
    pub effort: Effort,
    /// How far along the front [`Strategy::Best`] goes: from 1, the fewest blocks, to 0, the least displacement.
    pub simplicity: f64,
    /// The farthest that [`Strategy::Best`] may move a corner, in units of the input, where the lattice allows it.
    pub max_displacement: Option<f64>,
    /// What must stay; every strategy respects it.
    pub guides: Guides,
}

impl Default for AlignOptions {
    fn default() -> Self {
        Self {
            strategy: Strategy::default(),
            scale: 1.0,
            lambda_min: 0.0,
            solver: SolverKind::default(),
            objective: Objective::default(),
            effort: Effort::default(),
            simplicity: 1.0,
            max_displacement: None,
            guides: Guides::default(),
        }
    }
}

/// Whether corners that move by `moved` keep within `limit`, but for what rounding to `scale` steps per unit adds to
/// either.
pub(crate) fn keeps(moved: f64, limit: f64, scale: f64) -> bool {
    (moved - limit) * scale <= 1e-9
}

impl SolverKind {
    /// A solver of this kind.
    pub fn solver(self) -> Box<dyn Solver> {
        match self {
            SolverKind::Exact => Box::new(ExactSolver),
            SolverKind::Linear => Box::new(LinearSolver::default()),
        }
    }
}
