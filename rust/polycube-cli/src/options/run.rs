//! What a run tells, and where its results go.

use clap::{Args, ValueHint};
use std::path::PathBuf;

/// Where the results go.
#[derive(Args, Clone, Debug)]
pub struct FolderArg {
    /// Folder for the results; made if it is not there
    #[arg(short = 'o', long = "output", id = "output", value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub folder: PathBuf,
}

/// Whether a run is silent.
#[derive(Args, Clone, Copy, Debug)]
pub struct QuietArg {
    /// Print nothing but errors
    #[arg(short = 'q', long = "quiet", id = "quiet")]
    pub on: bool,
}
