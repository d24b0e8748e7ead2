//! `polycube view`.

mod cells;
mod hexes;
mod page;
mod picture;
mod raster;
mod scene;

use crate::failure::{Failure, Result};
use crate::input::meshes::MeshFiles;
use crate::options::number::whole;
use crate::options::polycube::PolycubeArgs;
use crate::options::run::QuietArg;
use crate::options::search::RoundsArg;
use crate::options::strategy::StrategyArg;
use crate::output::folder::write_file;
use crate::output::progress::Progress;
use crate::output::terminal;
use clap::ValueHint;
use polycube::Context;
use polycube::simplify::default_objective;
use scene::Scene;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const NOTES: &str = "\
The page is one file that needs no network: open it in any browser. It shows the layout on the
polycube and on the shape, for the input, after each round of the simplification, and for the
result. The picture shows input and result.";

/// What to show.
#[derive(clap::Args, Clone, Debug)]
#[command(after_help = NOTES)]
pub struct Args {
    /// The mesh, its labels and its tolerances.
    #[command(flatten)]
    mesh: PolycubeArgs,

    /// The shape that the polycube was deformed from, with the same vertices and cells
    #[arg(long, value_name = "SHAPE", value_hint = ValueHint::FilePath)]
    shape: Option<PathBuf>,

    /// A hexahedral mesh to show beside it, coloured by quality
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    hexes: Option<PathBuf>,

    /// The page to write
    #[arg(short, long, value_name = "PAGE", value_hint = ValueHint::FilePath)]
    output: PathBuf,

    /// A picture to write, too: PNG, drawn without a display
    #[arg(long, value_name = "PICTURE", value_parser = picture_file, value_hint = ValueHint::FilePath)]
    png: Option<PathBuf>,

    /// Width of each of the two or four parts of the picture, in pixels; they are square
    #[arg(long, value_name = "PIXELS", value_parser = whole::<u32>(16..=4096), default_value_t = 640, requires = "png")]
    png_size: u32,

    /// The axis that points up
    #[arg(long, value_enum, default_value_t = Axis::Y)]
    up: Axis,

    /// How the levels find their places
    #[arg(long, value_enum, default_value_t)]
    strategy: StrategyArg,

    /// How many rounds of Algorithm 1 there are.
    #[command(flatten)]
    rounds: RoundsArg,

    /// Whether it is silent.
    #[command(flatten)]
    quiet: QuietArg,
}

/// A file whose name says that it is a PNG picture.
fn picture_file(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("pictures are PNG: name a file with the extension .png".to_owned()) }
}

/// An axis.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Axis {
    X,
    Y,
    Z,
}

/// Simplifies and writes the page.
pub fn run(args: &Args) -> Result<ExitCode> {
    let progress = Progress::start(args.quiet.on)?;
    work(args, &progress.context)?;
    drop(progress);
    if !args.quiet.on {
        let pictures = args.png.iter().map(|path| format!("{}\n", path.display()));
        let files: String = std::iter::once(format!("{}\n", args.output.display())).chain(pictures).collect();
        terminal::print(&files)?;
    }
    Ok(ExitCode::SUCCESS)
}

fn work(args: &Args, context: &Context) -> Result<()> {
    context.stage("read", 0.0, 0.1).tick(0.0)?;
    let meshes = MeshFiles::read(&args.mesh.polycube, args.shape.as_deref(), args.mesh.labels.given())?;
    let hexes = args.hexes.as_deref().map(hexes::read).transpose()?;
    let options = polycube::SimplifyOptions {
        strategy: args.strategy.0,
        lambda_min: args.rounds.lambda_min,
        objective: Some(default_objective(&meshes.polycube)),
        tolerance: args.mesh.tolerance.get(),
        no_repair: args.mesh.tolerance.repair.off,
        ..polycube::SimplifyOptions::default()
    };
    let about = Failure::in_file(&args.mesh.polycube);
    let scene = Scene::new(&meshes, &options, args.up as usize, &context.stage("view", 0.1, 0.9)).map_err(about)?;
    let writing = context.stage("write", 0.9, 1.0);
    let picture = args.png.as_ref().map(|_| picture::png(&scene, args.png_size, &writing)).transpose()?;
    let page = page::html(&title(&args.mesh.polycube), &scene, hexes.as_ref())?;
    if let (Some(path), Some(bytes)) = (&args.png, picture) {
        write_file(path, &bytes, context)?;
    }
    Ok(write_file(&args.output, page.as_bytes(), context)?)
}

fn title(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    name.split('.').next().unwrap_or_default().to_owned()
}
