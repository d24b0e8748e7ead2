//! `polycube simplify`.

use crate::failure::{Failure, INVALID, Result};
use crate::input::guides;
use crate::input::meshes::MeshFiles;
use crate::options::choice::ChoiceArgs;
use crate::options::format::format;
use crate::options::number::positive;
use crate::options::polycube::PolycubeArgs;
use crate::options::run::{FolderArg, QuietArg};
use crate::options::search::SearchArgs;
use crate::options::strategy::StrategyArg;
use crate::output::folder::{LABELS, Output, REPORT};
use crate::output::front::{self, Point};
use crate::output::progress::Progress;
use crate::output::report::{self, Files, RunReport, StructureFile};
use crate::output::{table, terminal};
use clap::{Arg, ValueHint};
use polycube::mesh::{self, CellKind, Format};
use polycube::simplify::{Simplified, SimplifyOptions};
use polycube::{Context, Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

const NOTES: &str = "\
In the output folder:
  polycube.EXT    the simplified polycube in lattice units, with the connectivity of the input
  polycube.labels the label of each of its boundary faces, one a line, for --labels
  structure.json  levels, corners, edges and facets, before and after
  report.json     options, counts, rounds, times, displacement, distortion, flipped elements
  front/          with --pareto: the mesh of every point of the front
They appear together when all is done, or not at all. With `--strategy naive` and a result that is
not valid, the two reports say what broke, there is no polycube, and the exit code is 3.
`polycube --help` lists the exit codes.
";

/// What to simplify and how.
#[derive(clap::Args, Clone, Debug)]
#[command(after_help = format!("{NOTES}\n{}", guides::NOTES))]
#[command(
    mut_arg("objective", objective),
    mut_arg("simplicity", simplicity),
    mut_arg("max_distortion", max_distortion)
)]
pub struct Args {
    /// The mesh, its labels and its tolerances.
    #[command(flatten)]
    pub mesh: PolycubeArgs,

    /// The shape that the polycube was deformed from, with the same vertices and cells; the distortion of the map is
    /// measured against it
    #[arg(long, value_name = "SHAPE", value_hint = ValueHint::FilePath)]
    pub shape: Option<PathBuf>,

    /// Where the results go.
    #[command(flatten)]
    pub output: FolderArg,

    /// How the levels find their places
    #[arg(long, value_enum, default_value_t)]
    pub strategy: StrategyArg,

    /// How long and how it is searched, and what must stay.
    #[command(flatten)]
    pub search: SearchArgs,

    /// Lattice steps per unit of the polycube [default: 1 if all its levels are integers, else one step per mean mesh
    /// edge]
    #[arg(long, value_name = "S", value_parser = positive, conflicts_with = "edge_length")]
    pub scale: Option<f64>,

    /// Length of a lattice step, in units of the polycube: 1 / SCALE
    #[arg(long, value_name = "H", value_parser = positive)]
    pub edge_length: Option<f64>,

    /// Which result of `best` is taken.
    #[command(flatten)]
    pub choice: ChoiceArgs,

    /// Measure every point between the fewest blocks and the least displacement that `best` found, and write their
    /// meshes to the folder `front` in the output folder
    #[arg(long)]
    pub pareto: bool,

    /// Format of the simplified polycube: obj, off, ply, stl, mesh, meshb, vtk, vtu, vtp, msh or inp
    /// [default: as the input]
    #[arg(long, value_name = "EXT", value_parser = format)]
    pub format: Option<Format>,

    /// Whether it is silent.
    #[command(flatten)]
    pub quiet: QuietArg,
}

/// What the choice comes to where nothing is meshed.
fn objective(arg: Arg) -> Arg {
    arg.help("Which number `best` makes small [default: blocks_padded for a volume, surface_patches for a surface]")
}

fn simplicity(arg: Arg) -> Arg {
    let help = "Trade blocks for closeness: from 1, the fewest blocks that `best` finds, to 0, the least displacement";
    arg.help(help).default_value("1")
}

fn max_distortion(arg: Arg) -> Arg {
    arg.help(
        "The largest mean angle distortion of the map from the shape that a result of `best` may have, 1 or more; of \
         the results that keep it the one with the fewest blocks is taken [default: no limit]",
    )
}

impl Args {
    fn options(&self) -> SimplifyOptions {
        self.search.set(self.choice.set(SimplifyOptions {
            strategy: self.strategy.0,
            scale: self.scale.or(self.edge_length.map(f64::recip)),
            tolerance: self.mesh.tolerance.get(),
            no_repair: self.mesh.tolerance.repair.off,
            ..SimplifyOptions::default()
        }))
    }

    fn inputs(&self) -> Vec<&Path> {
        let PolycubeArgs { polycube, labels, .. } = &self.mesh;
        std::iter::once(polycube).chain(&self.shape).chain(&labels.file).map(PathBuf::as_path).collect()
    }

    fn files(&self) -> Files {
        let name = |path: &Path| path.display().to_string();
        Files {
            groups: None,
            polycube: Some(name(&self.mesh.polycube)),
            shape: self.shape.as_deref().map(name),
            labels: self.mesh.labels.file.as_deref().map(name),
        }
    }
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<ExitCode> {
    let progress = Progress::start(args.quiet.on)?;
    let Done { result, points } = work(args, &progress.context)?;
    drop(progress);
    let valid = result.report.valid;
    if !args.quiet.on {
        let place = format!("written to {}\n", args.output.folder.display());
        let trade_offs = if points.is_empty() { String::new() } else { format!("\n{}", front::to_table(&points)) };
        terminal::print(&(table::summary(&result.report) + &trade_offs + &place))?;
    }
    if valid {
        return Ok(ExitCode::SUCCESS);
    }
    terminal::print_error(&format!(
        "error: the result is not a valid polycube, so it was not written\n  \
         remedy: see \"broken\" in {}, or choose another strategy",
        args.output.folder.join("report.json").display()
    ));
    Ok(ExitCode::from(INVALID))
}

/// What a run made.
pub struct Done {
    /// The result.
    pub result: Simplified,
    /// The points of its front, if they were asked for.
    points: Vec<Point>,
}

/// Reads, simplifies, writes.
pub fn work(args: &Args, context: &Context) -> Result<Done> {
    let start = Instant::now();
    context.stage("read", 0.0, 0.1).tick(0.0)?;
    let meshes = MeshFiles::read(&args.mesh.polycube, args.shape.as_deref(), args.mesh.labels.given())?;
    let format = output_format(args, &meshes)?;
    let read = start.elapsed().as_secs_f64();
    let middle = context.stage("read", 0.1, if args.pareto { 0.5 } else { 0.9 });
    let about = Failure::in_files(&args.mesh.polycube, args.search.guides.as_deref());
    let (input, mut options) = (meshes.input(), args.options());
    options.guides = args.search.guides()?;
    let mut result = polycube::simplify::simplify(&input, &options, &middle).map_err(about)?;
    let measuring = context.stage("front", 0.5, 0.9);
    let others = if args.pareto { result.pareto(&input, &measuring)? } else { Vec::new() };
    let done = start.elapsed().as_secs_f64();
    result.report.seconds.read = read;
    let elapsed = || start.elapsed().as_secs_f64() - done;
    let points = write(args, (&mut result, &others), format, &context.stage("write", 0.9, 1.0), elapsed)?;
    result.report.seconds.total = start.elapsed().as_secs_f64();
    Ok(Done { result, points })
}

/// The format of the result, once it is known that it can hold the mesh.
fn output_format(args: &Args, meshes: &MeshFiles) -> Result<Format> {
    let format = args.format.map_or_else(|| Format::from_path(&args.mesh.polycube), Ok)?;
    let kind = meshes.polycube.cells().kind();
    if format.holds(kind) {
        return Ok(format);
    }
    let able: Vec<&str> = Format::ALL.into_iter().filter(|f| f.holds(kind)).map(Format::extension).collect();
    Err(Error::new(ErrorKind::Option, format!("a .{format} file cannot hold {kind}"))
        .remedy(format!("choose --format from {}", able.join(", ")))
        .into())
}

/// Writes the mesh, then the reports, which know how long that took, and then gives all of them their names.
fn write(
    args: &Args,
    (result, others): (&mut Simplified, &[Simplified]),
    format: Format,
    context: &Context,
    elapsed: impl Fn() -> f64,
) -> Result<Vec<Point>> {
    context.tick(0.0)?;
    let mut output = Output::new(&args.output.folder)?;
    let name = format!("polycube.{format}");
    if let Some(mesh) = &result.polycube {
        output.add(&name, &mesh::write_bytes(format, mesh, &[])?)?;
        let labels: String = result.input.labels().map(|l| format!("{}\n", l.index())).collect();
        output.add(LABELS, labels.as_bytes())?;
    }
    let points = front::points(others, result.report.chosen, format);
    front::add(&mut output, &points, others, format)?;
    let broken = report::broken(result);
    output.add("structure.json", terminal::to_json(&StructureFile::new(result, &broken))?.as_bytes())?;
    let seconds = &mut result.report.seconds;
    seconds.write = elapsed();
    seconds.total += seconds.read + seconds.write;
    let files = args.files();
    let valid = result.polycube.is_some();
    let options = result.options.clone().into();
    let output_name = valid.then_some(name.as_str());
    let pareto = args.pareto.then_some(points.as_slice());
    let run =
        RunReport { input: &files, options, output: output_name, report: &result.report, pareto, broken: &broken };
    output.add(REPORT, terminal::to_json(&run)?.as_bytes())?;
    let mut stale = front::stale(&args.output.folder);
    stale.extend(output.meshes_left(&[("polycube", &CellKind::ALL)]));
    if !valid {
        stale.extend([output.path(&name), output.path(LABELS)]);
    }
    output.publish(&stale, &args.inputs(), context)?;
    Ok(points)
}
