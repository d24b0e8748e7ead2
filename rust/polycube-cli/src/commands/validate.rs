//! `polycube validate`.

use crate::failure::{INVALID, Result};
use crate::input::meshes::{read_labels, read_meshes};
use crate::options::polycube::PolycubeArgs;
use crate::output::table::short;
use crate::output::terminal;
use clap::ValueHint;
use polycube::Context;
use polycube::mesh;
use polycube::simplify::Input;
use polycube::validate::{Finding, Subject, validate, validate_shape};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;

const NOTES: &str = "\
Exit codes: 0 valid; 3 violations found, among them a mesh file that does not follow its format;
1 a file cannot be read; 2 wrong usage.
The rules are checked one after the other, each only where those before it hold, so that one fault
is reported once and not by all that follows from it.";

/// What to check.
#[derive(clap::Args, Debug)]
#[command(after_help = NOTES)]
pub struct Args {
    /// The mesh, its labels and its tolerances.
    #[command(flatten)]
    mesh: PolycubeArgs,

    /// The shape that the polycube was deformed from: it must have the same vertices and cells, none inverted
    #[arg(long, value_name = "SHAPE", value_hint = ValueHint::FilePath)]
    shape: Option<PathBuf>,

    /// The mesh is no polycube but a shape to make one of: check that it is closed, looks outward and does not cross
    /// itself
    #[arg(long, conflicts_with_all = ["shape", "labels"])]
    as_shape: bool,

    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What the check found.
#[derive(Debug, Serialize)]
struct Verdict {
    valid: bool,
    file: String,
    shape: Option<String>,
    violations: Vec<Finding>,
}

/// Checks, prints what was found, and tells by the exit code whether that is nothing.
pub fn run(args: &Args) -> Result<ExitCode> {
    let violations = check(args)?;
    let name = |path: &PathBuf| path.display().to_string();
    let valid = violations.is_empty();
    let verdict = Verdict { valid, file: name(&args.mesh.polycube), shape: args.shape.as_ref().map(name), violations };
    if args.json {
        terminal::print_json(&verdict)?
    } else {
        terminal::print(&verdict.to_text())?
    }
    Ok(if valid { ExitCode::SUCCESS } else { ExitCode::from(INVALID) })
}

/// Everything that is wrong. A file that cannot be read as a mesh is a finding; one that cannot be opened, an error.
fn check(args: &Args) -> Result<Vec<Finding>> {
    if args.as_shape {
        return match mesh::read(&args.mesh.polycube) {
            Ok(shape) => Ok(validate_shape(&shape, &Context::default())?),
            Err(error) => Ok(vec![Finding::of(error, Subject::Shape)?]),
        };
    }
    let (mesh, shape) = match read_meshes(&args.mesh.polycube, args.shape.as_deref()) {
        Ok(meshes) => meshes,
        Err(error) => {
            // A sound polycube leaves the shape.
            let shape = mesh::read(&args.mesh.polycube).is_ok();
            return Ok(vec![Finding::of(error, if shape { Subject::Shape } else { Subject::Polycube })?]);
        }
    };
    let labels = match mesh.cells().boundary() {
        Ok(_) => read_labels(args.mesh.labels.given(), &args.mesh.polycube, &mesh)?,
        Err(_) => None,
    };
    let input = Input { polycube: &mesh, shape: shape.as_ref(), labels: labels.as_deref() };
    Ok(validate(&input, &args.mesh.tolerance.get())?)
}

fn line(finding: &Finding) -> String {
    let element = finding.element.map(|e| format!("{e}")).unwrap_or_default();
    let at = finding.at.map(|at| format!(" at ({})", at.map(short).join(", "))).unwrap_or_default();
    let colon = if element.is_empty() { "" } else { ": " };
    format!("  {element}{at}{colon}{}\n", finding.message)
}

impl Verdict {
    /// The files that the violations are in.
    fn files(&self) -> String {
        let in_one = |mesh: Subject| self.violations.iter().all(|v| v.mesh == mesh);
        match &self.shape {
            Some(shape) if in_one(Subject::Shape) => shape.clone(),
            Some(shape) if !in_one(Subject::Polycube) => format!("{} and {shape}", self.file),
            _ => self.file.clone(),
        }
    }

    fn to_text(&self) -> String {
        if self.valid {
            return format!("{}: valid\n", self.file);
        }
        let n = self.violations.len();
        let mut text = format!("{}: {n} {}\n", self.files(), if n == 1 { "violation" } else { "violations" });
        for group in self.violations.chunk_by(|a, b| (a.rule, a.mesh) == (b.rule, b.mesh)) {
            let of = if group[0].mesh == Subject::Shape { " (shape)" } else { "" };
            text += &format!("\n{}{of}: {}\n  remedy: {}\n", group[0].rule, group.len(), group[0].remedy);
            group.iter().for_each(|finding| text += &line(finding));
        }
        text
    }
}
