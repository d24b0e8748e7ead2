//! The `polycube` command.

mod args;
mod colour;
mod compare;
mod completions;
mod demo;
mod failure;
mod guides;
mod inspect;
mod mesh_files;
mod output;
mod pareto;
mod progress;
mod remesh;
mod report;
mod search;
mod simplify;
mod table;
mod terminal;
mod validate;
mod view;

use args::{Cli, Command};
use clap::Parser;
use failure::{Failure, USAGE};
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return explain(&error),
    };
    let done = match cli.command {
        Command::Simplify(args) => simplify::run(&args),
        Command::Remesh(args) => remesh::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Validate(args) => validate::run(&args),
        Command::Demo(args) => demo::run(&args),
        Command::View(args) => view::run(&args),
        Command::Completions(args) => completions::run(&args),
    };
    done.unwrap_or_else(|failure: Failure| failure.report())
}

/// Prints what clap has to say: help on standard output, wrong usage on standard error.
fn explain(error: &clap::Error) -> ExitCode {
    if error.print().is_ok() && !error.use_stderr() { ExitCode::SUCCESS } else { ExitCode::from(USAGE) }
}
