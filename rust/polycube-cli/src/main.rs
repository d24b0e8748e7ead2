//! The `polycube` command.

mod commands;
mod failure;
mod input;
mod options;
mod output;

use clap::FromArgMatches;
use commands::Cli;
use failure::{Failure, USAGE};
use options::effect;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut command = commands::command();
    let parsed = command.try_get_matches_from_mut(std::env::args_os());
    let parsed = parsed.and_then(|m| Ok((Cli::from_arg_matches(&m).map_err(|e| e.format(&mut command))?, m)));
    let (cli, matches) = match parsed {
        Ok(parsed) => parsed,
        Err(error) => return explain(&error),
    };
    if let Err(failure) = effect::check(&matches) {
        return failure.report();
    }
    commands::run(cli.command).unwrap_or_else(|failure: Failure| failure.report())
}

/// Prints what clap has to say: help on standard output, wrong usage on standard error.
fn explain(error: &clap::Error) -> ExitCode {
    if error.print().is_ok() && !error.use_stderr() { ExitCode::SUCCESS } else { ExitCode::from(USAGE) }
}
