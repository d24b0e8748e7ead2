//! Options that would have no effect are wrong usage.

use super::strategy::StrategyArg;
use crate::failure::Result;
use clap::ArgMatches;
use clap::parser::ValueSource;
use polycube::align::Strategy;
use polycube::{Error, ErrorKind};

/// Options that only the search of `best` looks at.
const SEARCH: [&str; 8] =
    ["objective", "steps", "proof_nodes", "time_limit", "simplicity", "max_displacement", "max_distortion", "pareto"];

/// Options of Algorithm 1, from which `best` starts, too.
const PAPER: [&str; 2] = ["lambda_min", "solver"];

/// Refuses options that the strategy of the subcommand does not look at.
///
/// # Errors
/// [`ErrorKind::Option`] naming the first.
pub fn check(matches: &ArgMatches) -> Result<()> {
    let Some((_, matches)) = matches.subcommand() else { return Ok(()) };
    let Ok(Some(&StrategyArg(strategy))) = matches.try_get_one("strategy") else { return Ok(()) };
    let named = |id: &&str| matches.value_source(id) == Some(ValueSource::CommandLine);
    let mut idle = matches.ids().map(clap::Id::as_str).filter(named).filter_map(|id| Some((id, needed(id, strategy)?)));
    let Some((id, strategies)) = idle.next() else { return Ok(()) };
    let message = format!("--{} is for {strategies}", id.replace('_', "-"));
    Err(Error::new(ErrorKind::Option, message).remedy("leave it out").into())
}

/// The strategies that an option is for; nothing if `strategy` is one of them.
fn needed(option: &str, strategy: Strategy) -> Option<&'static str> {
    match strategy {
        Strategy::Best => None,
        Strategy::Paper | Strategy::Naive if SEARCH.contains(&option) => Some("`--strategy best`"),
        Strategy::Naive if PAPER.contains(&option) => Some("`--strategy best` or `paper`"),
        Strategy::Paper | Strategy::Naive => None,
    }
}
