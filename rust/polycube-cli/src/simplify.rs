//! `polycube simplify`.

use crate::args::{PolycubeArgs, at_least_one, fraction, positive};
use crate::failure::{Failure, INVALID, Result};
use crate::mesh_files::MeshFiles;
use crate::output::{Output, REPORT};
use crate::pareto::Point;
use crate::progress::Progress;
use crate::report::{self, Files, RunReport, StructureFile};
use crate::search::SearchArgs;
use crate::{guides, pareto, table, terminal};
use clap::ValueHint;
use clap::builder::PossibleValue;
use polycube::align::Strategy;
use polycube::layout::Objective;
use polycube::mesh::{self, CellKind, Format};
use polycube::simplify::{Options, Simplified};
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

/// The name of the label file written.
pub const LABELS: &str = "polycube.labels";

/// What to simplify and how.
#[derive(clap::Args, Clone, Debug)]
#[command(after_help = format!("{NOTES}\n{}", guides::NOTES))]
pub struct Args {
    /// The mesh, its labels and its tolerances.
    #[command(flatten)]
    pub mesh: PolycubeArgs,

    /// The shape that the polycube was deformed from, with the same vertices and cells; the distortion of the map is
    /// measured against it
    #[arg(long, value_name = "SHAPE", value_hint = ValueHint::FilePath)]
    pub shape: Option<PathBuf>,

    /// Folder for the results; made if it is not there
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub output: PathBuf,

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

    /// Which number `best` makes small [default: blocks_padded for a volume, surface_patches for a surface]
    #[arg(long, value_enum)]
    pub objective: Option<ObjectiveArg>,

    /// Trade blocks for closeness: from 1, the fewest blocks that `best` finds, to 0, the least displacement
    #[arg(long, value_name = "S", value_parser = fraction, default_value_t = 1.0)]
    pub simplicity: f64,

    /// The farthest that `best` may move a corner, in units of the polycube [default: no limit]
    #[arg(long, value_name = "D", value_parser = positive)]
    pub max_displacement: Option<f64>,

    /// The largest mean angle distortion of the map from the shape that a result of `best` may have, 1 or more; of the
    /// results that keep it the one with the fewest blocks is taken [default: no limit]
    #[arg(long, value_name = "D", value_parser = at_least_one)]
    pub max_distortion: Option<f64>,

    /// Measure every point between the fewest blocks and the least displacement that `best` found, and write their
    /// meshes to the folder `front` in the output folder
    #[arg(long)]
    pub pareto: bool,

    /// Format of the simplified polycube: obj, off, ply, stl, mesh, vtk or vtu [default: as the input]
    #[arg(long, value_name = "EXT", value_parser = format)]
    pub format: Option<Format>,

    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// A mesh file format by its extension.
pub fn format(text: &str) -> std::result::Result<Format, String> {
    text.parse().map_err(|e: Error| e.to_string())
}

/// A [`Strategy`] on the command line.
#[derive(Clone, Copy, Debug, Default)]
pub struct StrategyArg(pub Strategy);

impl clap::ValueEnum for StrategyArg {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self(Strategy::Best), Self(Strategy::Paper), Self(Strategy::Naive)]
    }

    /// A strategy without a name here does not compile; name it above, too.
    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self.0 {
            Strategy::Naive => {
                ("naive", "Round every level to the lattice, as usual pipelines do; may break the polycube")
            }
            Strategy::Paper => ("paper", "Align corners round by round (Algorithm 1 of the paper)"),
            Strategy::Best => {
                ("best", "Search for the smallest count, starting from Algorithm 1 and from greedy merging")
            }
        };
        Some(PossibleValue::new(name).help(help))
    }
}

/// An [`Objective`] on the command line.
#[derive(Clone, Copy, Debug)]
pub struct ObjectiveArg(pub Objective);

impl clap::ValueEnum for ObjectiveArg {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self(Objective::BlocksPadded), Self(Objective::Blocks), Self(Objective::SurfacePatches)]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self.0 {
            Objective::BlocksPadded => ("blocks_padded", "Blocks of the volume with one padding layer around it"),
            Objective::Blocks => ("blocks", "Blocks of the volume"),
            Objective::SurfacePatches => ("surface_patches", "Patches of the surface"),
        };
        Some(PossibleValue::new(name).help(help))
    }
}

impl Args {
    fn options(&self) -> Options {
        self.search.set(Options {
            strategy: self.strategy.0,
            scale: self.scale.or(self.edge_length.map(f64::recip)),
            objective: self.objective.map(|o| o.0),
            simplicity: Some(self.simplicity),
            max_displacement: self.max_displacement,
            max_distortion: self.max_distortion,
            tolerance: self.mesh.tolerance.get(),
            ..Options::default()
        })
    }

    fn inputs(&self) -> Vec<&Path> {
        let PolycubeArgs { polycube, labels, .. } = &self.mesh;
        std::iter::once(polycube).chain(&self.shape).chain(labels).map(PathBuf::as_path).collect()
    }

    fn files(&self) -> Files {
        let name = |path: &Path| path.display().to_string();
        Files {
            polycube: name(&self.mesh.polycube),
            shape: self.shape.as_deref().map(name),
            labels: self.mesh.labels.as_deref().map(name),
        }
    }
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<ExitCode> {
    let progress = Progress::start(args.quiet)?;
    let Done { result, points } = work(args, &progress.context)?;
    drop(progress);
    let valid = result.report.valid;
    if !args.quiet {
        let place = format!("written to {}\n", args.output.display());
        let front = if points.is_empty() { String::new() } else { format!("\n{}", pareto::to_table(&points)) };
        terminal::print(&(table::summary(&result.report) + &front + &place))?;
    }
    if valid {
        return Ok(ExitCode::SUCCESS);
    }
    terminal::print_error(&format!(
        "error: the result is not a valid polycube, so it was not written\n  remedy: see \"broken\" in {}, or choose another strategy",
        args.output.join("report.json").display()
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
    let meshes = MeshFiles::read(&args.mesh.polycube, args.shape.as_deref(), args.mesh.labels.as_deref())?;
    let format = output_format(args, &meshes)?;
    let read = start.elapsed().as_secs_f64();
    let middle = context.stage("read", 0.1, if args.pareto { 0.5 } else { 0.9 });
    let about = Failure::in_files(&args.mesh.polycube, args.search.guides.as_deref());
    let (input, mut options) = (meshes.input(), args.options());
    options.guides = args.search.guides(&args.mesh.polycube, &input, &options.tolerance)?;
    let mut result = polycube::simplify::simplify(&input, &options, &middle).map_err(about)?;
    let front = context.stage("front", 0.5, 0.9);
    let others = if args.pareto { result.pareto(&input, &front)? } else { Vec::new() };
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
    let kind = meshes.polycube.cells.kind();
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
    let mut output = Output::new(&args.output)?;
    let name = format!("polycube.{format}");
    if let Some(mesh) = &result.polycube {
        output.add(&name, &mesh::write_bytes(format, mesh, &[])?)?;
        let labels: String = result.input.labels().map(|l| format!("{}\n", l.index())).collect();
        output.add(LABELS, labels.as_bytes())?;
    }
    let points = pareto::points(others, result.report.chosen, format);
    pareto::add(&mut output, &points, others, format)?;
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
    let mut stale = pareto::stale(&args.output);
    stale.extend(output.meshes_left(&[("polycube", &CellKind::ALL)]));
    if !valid {
        stale.extend([output.path(&name), output.path(LABELS)]);
    }
    output.publish(&stale, &args.inputs(), context)?;
    Ok(points)
}
