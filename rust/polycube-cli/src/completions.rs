//! `polycube completions`.

use crate::args::Cli;
use crate::failure::Result;
use crate::terminal;
use clap::CommandFactory;
use clap_complete::Shell;
use std::process::ExitCode;

/// What to complete for.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the script.
pub fn run(args: &Args) -> Result<ExitCode> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "polycube", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))?;
    Ok(ExitCode::SUCCESS)
}
