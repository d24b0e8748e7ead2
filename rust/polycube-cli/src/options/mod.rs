//! Options that subcommands share: one file for each group, which a subcommand takes with `#[command(flatten)]`.

pub mod choice;
pub mod effect;
pub mod format;
pub mod make;
pub mod mesh;
pub mod number;
pub mod polycube;
pub mod run;
pub mod search;
pub mod strategy;
