//! `polycube validate`.

use crate::args::PolycubeArgs;
use crate::failure::{INVALID, Result};
use crate::mesh_files::{read_labels, read_meshes};
use crate::terminal;
use clap::ValueHint;
use polycube::map::flipped;
use polycube::mesh::{Mesh, Point};
use polycube::structure::{Polycube, Violation};
use polycube::{Error, ErrorKind, Place};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;

const NOTES: &str = "\
Exit codes: 0 valid; 3 violations found; 1 a file cannot be read; 2 wrong usage.
The rules are checked one after the other, each only where those before it hold, so that one fault is
reported once and not by all that follows from it.";

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

/// One violation.
#[derive(Debug, Serialize)]
struct Finding {
    rule: &'static str,
    /// Whether the polycube or the shape is concerned.
    mesh: &'static str,
    element: Option<Place>,
    /// The middle of the element.
    at: Option<[f64; 3]>,
    message: String,
    remedy: String,
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
    let (mesh, shape) = match read_meshes(&args.mesh.polycube, args.shape.as_deref()) {
        Ok(meshes) => meshes,
        Err(error) => return Ok(vec![unreadable(error)?]),
    };
    let labels = match &args.mesh.labels {
        Some(file) if mesh.cells.boundary().is_ok() => Some(read_labels(file, &args.mesh.polycube, &mesh)?),
        _ => None,
    };
    let mut findings = check_polycube(args, &mesh, labels.as_deref());
    if let Some(shape) = &shape {
        let cells = flipped(shape, &[]).map(|f| f.cells).unwrap_or_default();
        findings.extend(inverted(&cells).map(|v| Finding::new(v, shape, "shape")));
    }
    Ok(findings)
}

fn check_polycube(args: &Args, mesh: &Mesh, labels: Option<&[i8]>) -> Vec<Finding> {
    let (mut violations, labels) = match Polycube::new(mesh, labels, &args.mesh.tolerance.get()) {
        Ok(polycube) => {
            let labels: Vec<i8> = polycube.labels().map(|l| l.index() as i8).collect();
            (polycube.overlaps(&mesh.points), labels)
        }
        Err(violations) => (violations, Vec::new()),
    };
    let flipped = flipped(mesh, &labels).unwrap_or_default();
    let fresh = inverted(&flipped.cells).filter(|v| !violations.contains(v)).collect::<Vec<_>>();
    violations.extend(fresh);
    let mut findings: Vec<_> = violations.into_iter().map(|v| Finding::new(v, mesh, "polycube")).collect();
    findings.extend(flipped.faces.iter().map(|&face| Finding::flipped_face(face, mesh)));
    findings
}

fn inverted(cells: &[u32]) -> impl Iterator<Item = Violation> + '_ {
    cells.iter().map(|&cell| Violation::InvertedCell { cell })
}

/// The finding that an error of reading stands for.
fn unreadable(error: Error) -> polycube::Result<Finding> {
    let rule = match (error.kind, error.place) {
        (ErrorKind::Mesh, Some(Place::Vertex(_))) => "not_finite",
        (ErrorKind::Mesh, _) => "empty",
        (ErrorKind::Parse, _) => "malformed",
        (ErrorKind::Mismatch, _) => "mismatch",
        _ => return Err(error),
    };
    let mesh = if rule == "mismatch" { "shape" } else { "polycube" };
    let remedy = match error.remedy.is_empty() {
        true => "export the mesh again".to_owned(),
        false => error.remedy,
    };
    Ok(Finding { rule, mesh, element: error.place, at: None, message: error.message, remedy })
}

impl Finding {
    fn new(violation: Violation, mesh: &Mesh, name: &'static str) -> Self {
        let rule = violation.rule();
        let error = Error::from(violation);
        let at = error.place.and_then(|place| middle(mesh, place));
        Self { rule, mesh: name, element: error.place, at, message: error.message, remedy: error.remedy }
    }

    fn flipped_face(face: u32, mesh: &Mesh) -> Self {
        let place = Place::Face(face);
        Self {
            rule: "flipped_face",
            mesh: "polycube",
            element: Some(place),
            at: middle(mesh, place),
            message: "the face looks away from the side of its label".to_owned(),
            remedy: "untangle the polycube map, or correct the label".to_owned(),
        }
    }

    fn line(&self) -> String {
        let element = self.element.map(|e| format!("{e}")).unwrap_or_default();
        let at = self.at.map(|[x, y, z]| format!(" at ({x}, {y}, {z})")).unwrap_or_default();
        let colon = if element.is_empty() { "" } else { ": " };
        format!("  {element}{at}{colon}{}\n", self.message)
    }
}

/// The middle of an element's vertices.
fn middle(mesh: &Mesh, place: Place) -> Option<[f64; 3]> {
    let vertices = match place {
        Place::Vertex(v) => vec![v],
        Place::Edge(a, b) => vec![a, b],
        Place::Face(i) => mesh.cells.boundary().ok()?.get(i as usize)?.vertices().to_vec(),
        Place::Cell(i) if (i as usize) < mesh.cells.len() => mesh.cells.cell(i as usize).to_vec(),
        Place::Cell(_) | Place::PolycubeEdge(_) | Place::Facet(_) | Place::Line(_) => return None,
    };
    let points: Option<Vec<&Point>> = vertices.iter().map(|&v| mesh.points.get(v as usize)).collect();
    let points = points?;
    let mean = |axis: usize| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64;
    Some([0, 1, 2].map(mean))
}

impl Verdict {
    fn to_text(&self) -> String {
        if self.valid {
            return format!("{}: valid\n", self.file);
        }
        let n = self.violations.len();
        let mut text = format!("{}: {n} {}\n", self.file, if n == 1 { "violation" } else { "violations" });
        for group in self.violations.chunk_by(|a, b| (a.rule, a.mesh) == (b.rule, b.mesh)) {
            let of = if group[0].mesh == "shape" { " (shape)" } else { "" };
            text += &format!("\n{}{of}: {}\n  remedy: {}\n", group[0].rule, group.len(), group[0].remedy);
            group.iter().for_each(|finding| text += &finding.line());
        }
        text
    }
}
