//! The command line: the list of subcommands, each in a file or folder of its own, which knows nothing of the list.
//!
//! A new one is a file here with `Args` and `run`, a line in [`Command`] and one in [`run`], and one in the README.

mod compare;
mod completions;
mod demo;
mod inspect;
mod make;
mod remesh;
mod simplify;
mod validate;
mod view;

use crate::failure::Result;
use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;

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
       from the shape than `--max-hausdorff` allows; `make`: the polycube is written, but its map
       is folded in places
  130  cancelled with Ctrl-C; no file is left half written

Mesh files: .obj .off .ply .stl .vtp (surfaces), .mesh .meshb .vtk .vtu .msh .inp (surfaces,
tetrahedra, hexahedra).
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
    /// Make a polycube of a closed surface
    Make(make::Args),
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

/// Does what was asked for.
pub fn run(command: Command) -> Result<ExitCode> {
    match command {
        Command::Make(args) => make::run(&args),
        Command::Simplify(args) => simplify::run(&args),
        Command::Remesh(args) => remesh::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Validate(args) => validate::run(&args),
        Command::Demo(args) => demo::run(&args),
        Command::View(args) => view::run(&args),
        Command::Completions(args) => completions::run(&args, Cli::command()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        command().debug_assert();
    }

    #[test]
    fn the_readme_has_the_words_of_the_help() {
        let readme = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md")).unwrap();
        for subcommand in Cli::command().get_subcommands() {
            let about = subcommand.get_about().unwrap();
            assert!(readme.contains(&format!(" | {about} |")), "README.md does not say: {about}");
        }
    }
}
