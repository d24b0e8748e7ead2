//! `polycube make`.

use crate::failure::{Failure, INFERIOR, Result};
use crate::input::meshes::MeshFiles;
use crate::options::format::format;
use crate::options::make::MakeArgs;
use crate::options::polycube::{LabelsArg, RepairArg};
use crate::options::run::{FolderArg, QuietArg};
use crate::output::folder::{LABELS, Output, REPORT};
use crate::output::progress::Progress;
use crate::output::report::MakeRun;
use crate::output::terminal;
use clap::ValueHint;
use polycube::make::{Made, make};
use polycube::mesh::{self, CellKind, Format};
use polycube::{Context, Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const NOTES: &str = "\
In the output folder:
  shape.EXT       the shape as triangles, cut finer in places where the map needs room; the vertices
                  of SHAPE come first and keep their numbers
  polycube.EXT    the polycube, vertex by vertex and triangle by triangle that of shape.EXT
  polycube.labels the label of each of its faces, one a line, for --labels
  report.json     repairs, corners, edges, facets, genus, misfit, squashed, distortion, added vertices,
                  times
They appear together when all is done, or not at all. Then
  polycube remesh out/shape.EXT --polycube out/polycube.EXT --labels out/polycube.labels -o mesh
meshes the shape. SHAPE is a closed surface of triangles or quadrilaterals, of any genus and any
number of parts. Its axes are those of the file, or with --axes best those that the surface looks along
best; report.json then has the rotation.
With --labels, for shapes that another program has labelled, the charts are those of the labels, and
they are only put in place; an error says where labels are not those of a polycube.
Exit code 4: the files are written, but the map is folded in places, which report.json lists.";

/// The shape and what is wanted.
#[derive(clap::Args, Clone, Debug)]
#[command(
    after_help = NOTES,
    mut_arg("detail", |detail| detail.conflicts_with("labels")),
    mut_arg("corners", |corners| corners.conflicts_with("labels")),
    mut_arg("axes", |axes| axes.conflicts_with("labels"))
)]
pub struct Args {
    /// The shape: a mesh file of a closed surface
    #[arg(value_name = "SHAPE", value_hint = ValueHint::FilePath)]
    pub shape: PathBuf,

    /// Where the results go.
    #[command(flatten)]
    pub output: FolderArg,

    /// How closely the polycube follows the shape.
    #[command(flatten)]
    pub make: MakeArgs,

    /// Labels of the shape, whose charts become the facets.
    #[command(flatten)]
    pub labels: LabelsArg,

    /// Whether the shape is repaired.
    #[command(flatten)]
    pub repair: RepairArg,

    /// Format of shape and polycube: obj, off, ply, stl, mesh, meshb, vtk, vtu, vtp, msh or inp
    /// [default: as the input]
    #[arg(long, value_name = "EXT", value_parser = format)]
    pub format: Option<Format>,

    /// Whether it is silent.
    #[command(flatten)]
    pub quiet: QuietArg,
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<ExitCode> {
    let progress = Progress::start(args.quiet.on)?;
    let made = work(args, &progress.context)?;
    drop(progress);
    let report = &made.report;
    if !args.quiet.on {
        let notes: String = report.repairs.iter().map(|repair| format!("note: {repair}\n")).collect();
        terminal::print(&format!(
            "{notes}{} corners, {} edges, {} facets, genus {}; {} vertices added; {:.2} s\nwritten to {}\n",
            report.corners,
            report.edges,
            report.facets,
            report.genus,
            report.added,
            report.seconds.total,
            args.output.folder.display()
        ))?;
    }
    if report.folded.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    let count = report.folded.len();
    terminal::print_error(&format!("warning: {count} triangles of the map are turned over: report.json lists them"));
    Ok(ExitCode::from(INFERIOR))
}

fn work(args: &Args, context: &Context) -> Result<Made> {
    context.stage("read", 0.0, 0.05).tick(0.0)?;
    let MeshFiles { polycube: shape, labels, .. } = MeshFiles::read(&args.shape, None, args.labels.given())?;
    let format = args.format.map_or_else(|| Format::from_path(&args.shape), Ok)?;
    if !format.holds(CellKind::Triangles) {
        return Err(Error::new(ErrorKind::Option, format!("a .{format} file cannot hold triangles")).into());
    }
    let middle = context.stage("make", 0.05, 0.95);
    let made = make(&shape, &args.make.get(labels, args.repair), &middle).map_err(Failure::in_file(&args.shape))?;
    write(args, &made, format, &context.stage("write", 0.95, 1.0))?;
    Ok(made)
}

fn write(args: &Args, made: &Made, format: Format, context: &Context) -> Result<()> {
    let mut output = Output::new(&args.output.folder)?;
    for (i, (name, mesh)) in [("shape", &made.shape), ("polycube", &made.polycube)].into_iter().enumerate() {
        context.tick(i as f64 / 2.0)?;
        output.add(&format!("{name}.{format}"), &mesh::write_bytes(format, mesh, &[])?)?;
    }
    let labels: String = made.labels.iter().map(|l| format!("{l}\n")).collect();
    output.add(LABELS, labels.as_bytes())?;
    let name = |path: &PathBuf| path.display().to_string();
    let run = MakeRun {
        input: &name(&args.shape),
        labels: args.labels.file.as_ref().map(name),
        options: args.labels.file.is_none().then(|| args.make.get(None, args.repair)),
        report: &made.report,
    };
    output.add(REPORT, terminal::to_json(&run)?.as_bytes())?;
    let inputs: Vec<&Path> = std::iter::once(&args.shape).chain(&args.labels.file).map(PathBuf::as_path).collect();
    let stale = output.meshes_left(&[("shape", &CellKind::ALL), ("polycube", &CellKind::ALL)]);
    Ok(output.publish(&stale, &inputs, context)?)
}
