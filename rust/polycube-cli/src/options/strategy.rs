//! How levels find their places, by name.

use clap::builder::PossibleValue;
use polycube::align::{SolverKind, Strategy};
use polycube::layout::Objective;

/// A [`Strategy`] on the command line.
#[derive(Clone, Copy, Debug, Default)]
pub struct StrategyArg(pub Strategy);

impl clap::ValueEnum for StrategyArg {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self(Strategy::Best), Self(Strategy::Paper), Self(Strategy::Naive)]
    }

    /// A strategy without a name here does not compile; name it above, too.
    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self.0 {
            Strategy::Naive => {
                ("naive", "Round every level to the lattice, as usual pipelines do; may break the polycube")
            }
            Strategy::Paper => ("paper", "Align corners round by round (Algorithm 1 of the paper)"),
            Strategy::Best => {
                ("best", "Search for the smallest count, starting from Algorithm 1 and from greedy merging")
            }
        };
        Some(PossibleValue::new(name).help(help))
    }
}

/// An [`Objective`] on the command line.
#[derive(Clone, Copy, Debug)]
pub struct ObjectiveArg(pub Objective);

impl clap::ValueEnum for ObjectiveArg {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self(Objective::BlocksPadded), Self(Objective::Blocks), Self(Objective::SurfacePatches)]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self.0 {
            Objective::BlocksPadded => ("blocks_padded", "Blocks of the volume with one padding layer around it"),
            Objective::Blocks => ("blocks", "Blocks of the volume"),
            Objective::SurfacePatches => ("surface_patches", "Patches of the surface"),
        };
        Some(PossibleValue::new(name).help(help))
    }
}

/// A [`SolverKind`] on the command line.
#[derive(Clone, Copy, Debug, Default)]
pub struct SolverArg(pub SolverKind);

impl clap::ValueEnum for SolverArg {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self(SolverKind::Exact), Self(SolverKind::Linear)]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self.0 {
            SolverKind::Exact => ("exact", "Minimum cuts in integer arithmetic"),
            SolverKind::Linear => ("linear", "Linear programs, with the separation planes as in the paper; slow"),
        };
        Some(PossibleValue::new(name).help(help))
    }
}
