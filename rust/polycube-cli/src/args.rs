//! The command line: subcommands and what they have in common.

use crate::{compare, completions, demo, inspect, remesh, simplify, validate, view};
use clap::{Args, CommandFactory, Parser, Subcommand, ValueHint};
use polycube::structure::Tolerance;
use std::ops::RangeInclusive;
use std::path::PathBuf;

const EXIT_CODES: &str = "\
Exit codes:
  0    done; `validate`: the polycube is valid
  1    failure: a file cannot be read, understood or written, or there is no solution;
       `compare`: some inputs could not be compared, the others are in the table
  2    wrong usage: an unknown option, one that has no effect with the strategy chosen, or a value
       out of its range
  3    not a valid polycube: violations found, shape and polycube do not match,
       or `--strategy naive` broke it
  4    `remesh`: the meshes are written, but hexahedra are inverted, or the surface is farther
       from the shape than `--max-hausdorff` allows
  130  cancelled with Ctrl-C; no file is left half written

Mesh files: .obj .off .ply .stl (surfaces), .mesh .vtk .vtu (surfaces, tetrahedra, hexahedra).
Vertices, faces and cells are numbered from 0.";

/// Turn a polycube into a coarser one: align its corners on the integer lattice, keep its topology,
/// and morph its mesh onto the result. The method is that of Cherchi, Livesu and Scateni, "Polycube
/// Simplification for Coarse Layouts of Surfaces and Volumes", Computer Graphics Forum 35 (5), 2016.
#[derive(Debug, Parser)]
#[command(name = "polycube", version, after_help = EXIT_CODES, max_term_width = 100)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The command line, where the value of an option may be a negative number, so that its range is told.
pub fn command() -> clap::Command {
    let negative = |arg: clap::Arg| {
        let takes = !arg.is_positional() && arg.get_action().takes_values();
        if takes { arg.allow_negative_numbers(true) } else { arg }
    };
    Cli::command().mut_subcommands(|subcommand| subcommand.mut_args(negative))
}

/// What the command can do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Simplify a polycube and write the result with a report
    Simplify(simplify::Args),
    /// Simplify a polycube and mesh its shape with the blocks found: coarse layout, quadrilaterals, hexahedra
    Remesh(Box<remesh::Args>),
    /// Mesh shapes without and with simplification and compare: hexahedra, quality, patches, blocks, times
    Compare(Box<compare::Args>),
    /// Show the structure found in a polycube: charts, corners, edges, levels, block counts
    Inspect(inspect::Args),
    /// List everything that keeps a mesh from being a valid polycube, where it is and how to mend it
    Validate(validate::Args),
    /// Write example polycubes made by the program and simplify one of them
    Demo(demo::Args),
    /// Write a page that shows the simplification step by step, and a picture
    View(view::Args),
    /// Print a completion script for a shell
    Completions(completions::Args),
}

/// The mesh and its labels.
#[derive(Args, Clone, Debug)]
pub struct PolycubeArgs {
    /// The polycube: a mesh file whose boundary faces look along the axes
    #[arg(value_name = "POLYCUBE", value_hint = ValueHint::FilePath)]
    pub polycube: PathBuf,

    /// Label file: one integer a line for each boundary face, 0 to 5 for +X -X +Y -Y +Z -Z, -1 for "by the normal"
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub labels: Option<PathBuf>,

    /// How far the mesh may be from an exact polycube.
    #[command(flatten)]
    pub tolerance: ToleranceArgs,
}

/// How far a mesh may be from a polycube.
#[derive(Args, Clone, Debug)]
pub struct ToleranceArgs {
    /// Largest angle between a face and the nearest axis, in degrees from 0 to 45 [default: 30]
    #[arg(long, value_name = "DEG", value_parser = degrees)]
    pub angle_tolerance: Option<f64>,

    /// Largest distance of a vertex from the plane of its facet, as a fraction of the bounding box's diagonal, from 0
    /// to 1 [default: 0.05]
    #[arg(long, value_name = "F", value_parser = fraction)]
    pub level_tolerance: Option<f64>,
}

impl ToleranceArgs {
    /// The tolerance asked for; the library's defaults where nothing was said.
    pub fn get(&self) -> Tolerance {
        let default = Tolerance::default();
        Tolerance {
            degrees: self.angle_tolerance.unwrap_or(default.degrees),
            distance: self.level_tolerance.unwrap_or(default.distance),
            ..default
        }
    }
}

fn degrees(text: &str) -> Result<f64, String> {
    within(text, 0.0..=45.0)
}

/// A number from 0 to 1.
pub fn fraction(text: &str) -> Result<f64, String> {
    within(text, 0.0..=1.0)
}

/// A number above 0, up to 100.
pub fn percent(text: &str) -> Result<f64, String> {
    let found = positive(text).ok().filter(|x| *x <= 100.0);
    found.ok_or_else(|| "expected a number above 0, up to 100".to_owned())
}

/// Whole numbers of a range, for `value_parser`.
pub fn whole<T: TryFrom<u64>>(range: RangeInclusive<u64>) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let found = text.parse().ok().filter(|x| range.contains(x));
        found.and_then(|x| T::try_from(x).ok()).ok_or_else(|| {
            let (start, end) = (range.start(), range.end());
            // An end that only the machine has is told to those who went beyond it.
            if *end < MACHINE || text.parse::<f64>().is_ok_and(|x| x > *end as f64) {
                format!("expected a whole number from {start} to {end}")
            } else {
                format!("expected a whole number of {start} or more")
            }
        })
    }
}

fn within(text: &str, range: RangeInclusive<f64>) -> Result<f64, String> {
    let found = text.parse().ok().filter(|x| range.contains(x));
    found.ok_or_else(|| format!("expected a number from {} to {}", range.start(), range.end()))
}

/// The least that a range may end at because the machine ends there.
const MACHINE: u64 = u32::MAX as u64;

/// A number of 1 or more.
pub fn at_least_one(text: &str) -> Result<f64, String> {
    let found = text.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 1.0);
    found.ok_or_else(|| "expected a number of 1 or more".to_owned())
}

/// A number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    let found = text.parse().ok().filter(|x: &f64| x.is_normal() && *x > 0.0);
    found.ok_or_else(|| "expected a number above 0".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        command().debug_assert();
    }

    #[test]
    fn the_defaults_in_the_help_are_those_of_the_library() {
        let found = ToleranceArgs { angle_tolerance: None, level_tolerance: None }.get();
        assert_eq!((found.degrees, found.distance), (30.0, 0.05));
    }

    #[test]
    fn numbers_have_their_ranges() {
        for bad in ["0", "-1", "nan", "inf", "", "1e-320"] {
            assert!(positive(bad).is_err(), "{bad}");
        }
        for bad in ["-0.1", "1.1", "nan", "x"] {
            assert!(fraction(bad).is_err(), "{bad}");
        }
        let whole = |text| whole::<u8>(1..=16)(text);
        assert_eq!(whole("16"), Ok(16));
        for bad in ["0", "-3", "17", "300", "1.5", "x", ""] {
            assert_eq!(whole(bad), Err("expected a whole number from 1 to 16".to_owned()), "{bad}");
        }
        let counted = |text| super::whole::<u32>(1..=u64::from(u32::MAX))(text);
        assert_eq!(counted("-1"), Err("expected a whole number of 1 or more".to_owned()));
        assert!(counted("4294967296").is_err_and(|e| e.ends_with("to 4294967295")));
        assert_eq!(degrees("45"), Ok(45.0));
        assert!(degrees("45.1").is_err());
    }
}
