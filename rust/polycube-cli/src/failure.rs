//! What went wrong, as a message for people and an exit code for programs.

use crate::output::terminal;
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

/// An error and its exit code.
#[derive(Debug)]
pub struct Failure {
    error: Error,
    code: u8,
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = code(error.kind);
        Self { error, code }
    }
}

impl Failure {
    /// An error in the mesh of `file`. Only errors about the mesh get the name.
    pub fn in_file(file: &Path) -> impl Fn(Error) -> Self + '_ {
        move |error| {
            let about_mesh = matches!(error.kind, ErrorKind::Mesh | ErrorKind::Polycube | ErrorKind::Mismatch);
            if about_mesh { error.in_file(file.display()).into() } else { error.into() }
        }
    }

    /// An error of work on the mesh of `file` with the `guides` of another. Only what the guides cannot have gets their
    /// name.
    pub fn in_files(file: &Path, guides: Option<&Path>) -> impl Fn(Error) -> Self {
        move |error| match guides {
            Some(guides) if is_about_guides(&error) => error.in_file(guides.display()).into(),
            _ => Self::in_file(file)(error),
        }
    }

    /// An error of reading a mesh. A file that holds none cannot be understood, which is another matter than a mesh
    /// that is no polycube.
    pub fn in_reading(error: Error) -> Self {
        let code = if error.kind == ErrorKind::Mesh { FAILURE } else { code(error.kind) };
        Self { error, code }
    }

    /// Prints the message and gives the exit code.
    pub fn report(&self) -> ExitCode {
        terminal::print_error(&self.to_string());
        ExitCode::from(self.code)
    }
}

fn code(kind: ErrorKind) -> u8 {
    match kind {
        ErrorKind::Mesh | ErrorKind::Polycube | ErrorKind::Mismatch => INVALID,
        ErrorKind::Option => USAGE,
        ErrorKind::Cancelled => CANCELLED,
        ErrorKind::Io | ErrorKind::Parse | ErrorKind::Unsupported | ErrorKind::Infeasible | ErrorKind::Internal => {
            FAILURE
        }
    }
}

/// Without guides there is a result.
fn is_about_guides(error: &Error) -> bool {
    error.kind == ErrorKind::Infeasible || error.option == Some("guides")
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.error.kind == ErrorKind::Cancelled {
            return f.write_str("cancelled");
        }
        f.write_str("error: ")?;
        if let Some(file) = &self.error.file {
            write!(f, "{file}: ")?;
        }
        if let Some(place) = &self.error.place {
            write!(f, "{place}: ")?;
        }
        f.write_str(&self.error.message)?;
        if self.error.remedy.is_empty() { Ok(()) } else { write!(f, "\n  remedy: {}", self.error.remedy) }
    }
}
