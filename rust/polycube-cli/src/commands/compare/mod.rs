//! `polycube compare`.

mod csv;
mod pairs;
mod row;
mod table;

use crate::failure::{FAILURE, Result};
use crate::input::meshes::read_meshes;
use crate::options::choice::ChoiceArgs;
use crate::options::mesh::MeshArgs;
use crate::options::polycube::ToleranceArgs;
use crate::options::strategy::StrategyArg;
use crate::output::folder::write_file;
use crate::output::progress::Progress;
use crate::output::table::Style;
use crate::output::terminal;
use clap::ValueHint;
use pairs::Pair;
use polycube::compare::{Comparison, compare};
use polycube::remesh::RemeshOptions;
use polycube::simplify::{Input, SimplifyOptions};
use polycube::{Context, ErrorKind};
use row::Row;
use std::path::PathBuf;
use std::process::ExitCode;

const NOTES: &str = "\
Every shape is meshed twice: `without` simplification, the levels of its polycube rounded to the
lattice (kept in their order where rounding breaks the polycube: see the notes), and `with` it,
with about as many hexahedra. The gain is the part of the padded blocks (with --surface-only: of the
patches) that simplifying saves.

What cannot be compared gets a line that says so, and the others go on; standard error says why, and
so does what is written to a file. Exit code 0: all were compared; 1: some were not; 2: wrong usage,
or no inputs; 130: cancelled, nothing is written.

List file: a line for each input, a polycube or shape and polycube with a tab between; names are
taken from the folder of the list. Empty lines and lines that start with # are skipped.";

/// What to compare and how.
#[derive(clap::Args, Clone, Debug)]
#[command(after_help = NOTES)]
pub struct Args {
    /// Polycubes named NAME.polycube.EXT with their shapes NAME.shape.EXT beside them, or folders of such pairs
    #[arg(value_name = "POLYCUBE|DIR", value_hint = ValueHint::AnyPath)]
    inputs: Vec<PathBuf>,

    /// A shape and its polycube, whatever their names; as often as you like
    #[arg(long, value_names = ["SHAPE", "POLYCUBE"], num_args = 2, value_hint = ValueHint::FilePath)]
    #[arg(action = clap::ArgAction::Append)]
    pair: Vec<PathBuf>,

    /// A file that lists polycubes or pairs
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    list: Option<PathBuf>,

    /// What is meshed, and how fine without simplification.
    #[command(flatten)]
    mesh: MeshArgs,

    /// How the simplification finds the places of the levels
    #[arg(long, value_enum, default_value_t)]
    strategy: StrategyArg,

    /// Which result of `best` is meshed.
    #[command(flatten)]
    choice: ChoiceArgs,

    /// How far the polycubes may be from exact ones.
    #[command(flatten)]
    tolerance: ToleranceArgs,

    /// How the comparison is written [default: as the extension of --output says (csv, json, md), else table]
    #[arg(long, value_enum)]
    format: Option<Format>,

    /// File to write it to [default: standard output]
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: Option<PathBuf>,

    /// Show no progress
    #[arg(short, long)]
    quiet: bool,
}

/// How a comparison is written.
#[derive(Clone, Copy, Debug, PartialEq, clap::ValueEnum)]
enum Format {
    /// For the terminal
    Table,
    /// One line for each mesh, with times per stage
    Csv,
    /// Everything
    Json,
    /// The table for a document
    Markdown,
}

impl Args {
    /// The format asked for, or else that of the file.
    fn format(&self) -> Format {
        let extension =
            self.output.as_ref().and_then(|path| Some(path.extension()?.to_string_lossy().to_ascii_lowercase()));
        let told = match extension.as_deref() {
            Some("csv") => Format::Csv,
            Some("json") => Format::Json,
            Some("md" | "markdown") => Format::Markdown,
            _ => Format::Table,
        };
        self.format.unwrap_or(told)
    }

    fn options(&self) -> RemeshOptions {
        let simplify = SimplifyOptions {
            strategy: self.strategy.0,
            tolerance: self.tolerance.get(),
            no_repair: self.tolerance.repair.off,
            ..SimplifyOptions::default()
        };
        self.mesh.set(RemeshOptions { simplify: self.choice.set(simplify), ..RemeshOptions::default() })
    }
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<ExitCode> {
    let pairs = pairs::collect(&args.inputs, &args.pair, args.list.as_deref())?;
    let progress = Progress::start(args.quiet)?;
    let rows = rows_of(&pairs, &args.options(), &progress.context)?;
    let format = args.format();
    // On a terminal the failures stand below the table already.
    let why = format != Format::Table || args.output.is_some();
    let text = match format {
        Format::Table => table::text(&rows, Style::Terminal, (args.mesh.surface_only, why)),
        Format::Markdown => table::text(&rows, Style::Markdown, (args.mesh.surface_only, why)),
        Format::Csv => csv::text(&rows)?,
        Format::Json => terminal::to_json(&rows)?,
    };
    match &args.output {
        Some(path) => write_file(path, text.as_bytes(), &progress.context)?,
        None => {
            drop(progress);
            terminal::print(&text)?;
        }
    }
    let failed: Vec<_> = rows.iter().filter_map(|r| Some((&r.model, r.error.as_ref()?))).collect();
    for (model, error) in &failed {
        terminal::print_error(&format!("error: {model}: {error}"));
    }
    Ok(if failed.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(FAILURE) })
}

fn rows_of(pairs: &[Pair], options: &RemeshOptions, context: &Context) -> Result<Vec<Row>> {
    let mut rows = Vec::with_capacity(pairs.len());
    for (i, pair) in pairs.iter().enumerate() {
        let part = |i: usize| i as f64 / pairs.len() as f64;
        let (comparison, error) = match compared(pair, options, &context.stage("compare", part(i), part(i + 1))) {
            Ok(comparison) => (Some(comparison), None),
            Err(error) if error.kind == ErrorKind::Cancelled => return Err(error.into()),
            Err(error) => (None, Some(error)),
        };
        let name = |path: &PathBuf| path.display().to_string();
        let (model, shape, polycube) = (pair.model(), name(&pair.shape), name(&pair.polycube));
        rows.push(Row { model, shape, polycube, comparison, error });
    }
    Ok(rows)
}

fn compared(pair: &Pair, options: &RemeshOptions, context: &Context) -> polycube::Result<Comparison> {
    context.tick(0.0)?;
    let (polycube, shape) = read_meshes(&pair.polycube, Some(&pair.shape))?;
    let input = Input { polycube: &polycube, shape: shape.as_ref(), labels: None };
    compare(&input, options, context)
}
