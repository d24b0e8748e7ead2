//! What went wrong, as a message for people and an exit code for programs.

use crate::terminal;
use polycube::{Error, ErrorKind};
use std::fmt;
use std::path::Path;
use std::process::ExitCode;

/// Exit code of a run that failed.
pub const FAILURE: u8 = 1;
/// Exit code of wrong usage.
pub const USAGE: u8 = 2;
/// Exit code for something that is not a valid polycube.
pub const INVALID: u8 = 3;
/// Exit code for meshes that are not as good as asked for.
pub const INFERIOR: u8 = 4;
/// Exit code of a run that was cancelled.
pub const CANCELLED: u8 = 130;

/// Result of a subcommand or a part of it.
pub type Result<T> = std::result::Result<T, Failure>;

/// An error and the file it is about, where the message does not name it.
#[derive(Debug)]
pub struct Failure {
    file: Option<String>,
    error: Error,
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self { file: None, error }
    }
}

impl Failure {
    /// An error in the mesh of `file`. Only errors about the mesh get the name.
    pub fn in_file(file: &Path) -> impl Fn(Error) -> Self + '_ {
        move |error| {
            let about_mesh = matches!(error.kind, ErrorKind::Mesh | ErrorKind::Polycube | ErrorKind::Mismatch);
            Self { file: about_mesh.then(|| file.display().to_string()), error }
        }
    }

    /// Prints the message and gives the exit code.
    pub fn report(&self) -> ExitCode {
        terminal::print_error(&self.to_string());
        ExitCode::from(self.code())
    }

    fn code(&self) -> u8 {
        match self.error.kind {
            ErrorKind::Mesh | ErrorKind::Polycube | ErrorKind::Mismatch => INVALID,
            ErrorKind::Option => USAGE,
            ErrorKind::Cancelled => CANCELLED,
            ErrorKind::Io | ErrorKind::Parse | ErrorKind::Unsupported | ErrorKind::Infeasible | ErrorKind::Internal => {
                FAILURE
            }
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.error.kind == ErrorKind::Cancelled {
            return f.write_str("cancelled");
        }
        f.write_str("error: ")?;
        if let Some(file) = &self.file {
            write!(f, "{file}: ")?;
        }
        if let Some(place) = &self.error.place {
            write!(f, "{place}: ")?;
        }
        f.write_str(&self.error.message)?;
        if self.error.remedy.is_empty() { Ok(()) } else { write!(f, "\n  remedy: {}", self.error.remedy) }
    }
}
