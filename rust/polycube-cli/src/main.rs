//! The `polycube` command.

mod args;
mod colour;
mod compare;
mod completions;
mod demo;
mod effect;
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
use clap::FromArgMatches;
use failure::{Failure, USAGE};
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut command = args::command();
    let parsed = command.try_get_matches_from_mut(std::env::args_os());
    let parsed = parsed.and_then(|m| Ok((Cli::from_arg_matches(&m).map_err(|e| e.format(&mut command))?, m)));
    let (cli, matches) = match parsed {
        Ok(parsed) => parsed,
        Err(error) => return explain(&error),
    };
    if let Err(failure) = effect::check(&matches) {
        return failure.report();
    }
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
