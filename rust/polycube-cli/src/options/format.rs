//! Formats of mesh files, by their extensions.

use polycube::mesh::{Format, SolverFormat};
use polycube::{Error, ErrorKind};

/// A mesh file format by its extension.
pub fn format(text: &str) -> Result<Format, String> {
    text.parse().map_err(|e: Error| e.to_string())
}

/// A format that meshes can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputFormat {
    /// One that is read, too.
    Mesh(Format),
    /// One for solvers.
    Solver(SolverFormat),
}

/// A format of files to write by its extension.
pub fn output_format(text: &str) -> Result<OutputFormat, String> {
    let solver = text.parse().map(OutputFormat::Solver);
    solver.or_else(|_: Error| text.parse().map(OutputFormat::Mesh)).map_err(|e: Error| match e.kind {
        ErrorKind::Unsupported => format!("{e}, or for a solver one of {}", solver_formats()),
        _ => e.to_string(),
    })
}

/// The names of the formats for solvers.
pub fn solver_formats() -> String {
    SolverFormat::ALL.map(SolverFormat::extension).join(", ")
}
