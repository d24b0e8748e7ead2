//! How long and how it is searched.

use super::number::{fraction, positive, whole};
use super::strategy::SolverArg;
use crate::failure::Result;
use crate::input::guides;
use clap::{Args, ValueHint};
use polycube::align::{Effort, Guides};
use polycube::simplify::SimplifyOptions;
use std::path::PathBuf;
use std::time::Duration;

/// How long and how it is searched, and what must stay.
#[derive(Args, Clone, Debug)]
pub struct SearchArgs {
    /// How many rounds of Algorithm 1 there are.
    #[command(flatten)]
    rounds: RoundsArg,

    /// How long `best` searches: moves tried per level of the polycube in each of its eight chains
    #[arg(long, value_name = "N", value_parser = whole::<u32>(0..=u64::from(u32::MAX)))]
    #[arg(default_value_t = Effort::default().steps_per_level)]
    steps: u32,

    /// Facets that must not move, that must or must not align, and planes of symmetry to keep: a JSON file, see
    /// `polycube simplify --help`
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub guides: Option<PathBuf>,

    /// How long `best` tries to prove that its result cannot be beaten: partial orders looked at
    #[arg(long, value_name = "N", value_parser = whole::<u64>(0..=u64::MAX))]
    #[arg(default_value_t = Effort::default().proof_nodes)]
    proof_nodes: u64,

    /// Stop the search after this many seconds with the best found; the result may then differ from run to run
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    time_limit: Option<f64>,

    /// Who solves the integer problems
    #[arg(long, value_enum, default_value_t)]
    solver: SolverArg,
}

impl Default for SearchArgs {
    fn default() -> Self {
        let Effort { steps_per_level: steps, proof_nodes, .. } = Effort::default();
        Self {
            rounds: RoundsArg::default(),
            steps,
            guides: None,
            proof_nodes,
            time_limit: None,
            solver: SolverArg::default(),
        }
    }
}

impl SearchArgs {
    /// These options for `simplify`, but for the guides.
    pub fn set(&self, options: SimplifyOptions) -> SimplifyOptions {
        let effort = Effort {
            steps_per_level: self.steps,
            proof_nodes: self.proof_nodes,
            // What no duration holds is no limit.
            time_limit: self.time_limit.and_then(|s| Duration::try_from_secs_f64(s).ok()),
        };
        SimplifyOptions { lambda_min: self.rounds.lambda_min, solver: self.solver.0, effort, ..options }
    }

    /// Reads the guides; none if none were asked for.
    pub fn guides(&self) -> Result<Guides> {
        self.guides.as_deref().map_or_else(|| Ok(Guides::default()), guides::read)
    }
}

/// When Algorithm 1 ends.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct RoundsArg {
    /// Stop before the weight λ of staying close to the input falls below this, from 0 (coarsest) to 1 (one round)
    #[arg(long, value_name = "L", value_parser = fraction, default_value_t = 0.0)]
    pub lambda_min: f64,
}
