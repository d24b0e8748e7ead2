//! Which result of the search is taken.

use super::number::{at_least_one, fraction, zero_or_more};
use super::strategy::ObjectiveArg;
use clap::Args;
use polycube::simplify::SimplifyOptions;

/// Which of the results between the fewest blocks and the least displacement is taken.
#[derive(Args, Clone, Debug, Default)]
pub struct ChoiceArgs {
    /// Which number `best` makes small [default: blocks_padded for hexahedra, surface_patches for --surface-only]
    #[arg(long, value_enum)]
    pub objective: Option<ObjectiveArg>,

    /// Trade blocks for closeness: from 1, the fewest blocks that `best` finds, to 0, the least displacement [default:
    /// the fewest whose hexahedra are good]
    #[arg(long, value_name = "S", value_parser = fraction)]
    pub simplicity: Option<f64>,

    /// The farthest that `best` may move a corner, in units of the polycube; 0 where none shall [default: no limit]
    #[arg(long, value_name = "D", value_parser = zero_or_more)]
    pub max_displacement: Option<f64>,

    /// The largest mean angle distortion of the map from the shape that a result of `best` may have, 1 or more
    /// [default: no limit]
    #[arg(long, value_name = "D", value_parser = at_least_one)]
    pub max_distortion: Option<f64>,
}

impl ChoiceArgs {
    /// These options for `simplify`.
    pub fn set(&self, options: SimplifyOptions) -> SimplifyOptions {
        let Self { simplicity, max_displacement, max_distortion, .. } = *self;
        SimplifyOptions {
            objective: self.objective.map(|o| o.0),
            simplicity,
            max_displacement,
            max_distortion,
            ..options
        }
    }
}
