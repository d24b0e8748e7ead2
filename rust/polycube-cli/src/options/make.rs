//! How a polycube is made of a shape.

use super::number::{fraction, whole};
use super::polycube::RepairArg;
use clap::Args;
use clap::builder::PossibleValue;
use polycube::make::{Axes, MakeOptions};

/// How closely a polycube follows its shape.
#[derive(Args, Clone, Copy, Debug)]
pub struct MakeArgs {
    /// How much of the shape the polycube follows, from 0, as few corners as can be, to 1
    #[arg(long, value_name = "D", value_parser = fraction, default_value_t = MakeOptions::default().detail)]
    pub detail: f64,

    /// Take corners away until no more than N are left, as far as the shape allows, whatever --detail says
    #[arg(long, value_name = "N", value_parser = whole::<usize>(8..=u64::from(u32::MAX)))]
    pub corners: Option<usize>,

    /// Which directions of the shape become the axes of the polycube
    #[arg(long, value_name = "WHICH", value_enum, default_value = "keep")]
    pub axes: AxesArg,
}

/// Which directions become the axes, by name.
#[derive(Clone, Copy, Debug)]
pub struct AxesArg(pub Axes);

impl clap::ValueEnum for AxesArg {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self(Axes::Keep), Self(Axes::Best)]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self.0 {
            Axes::Keep => ("keep", "Those of the coordinates"),
            Axes::Best => ("best", "Those that the surface looks along best, for a shape that lies askew"),
        };
        Some(PossibleValue::new(name).help(help))
    }
}

impl MakeArgs {
    /// What the library takes, with the labels of the shape if it has any.
    pub fn get(self, labels: Option<Vec<i8>>, repair: RepairArg) -> MakeOptions {
        let Self { detail, corners, axes } = self;
        MakeOptions { detail, corners, axes: axes.0, labels, no_repair: repair.off }
    }
}
