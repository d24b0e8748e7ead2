//! `polycube demo`.

use super::simplify;
use crate::failure::Result;
use crate::options::choice::ChoiceArgs;
use crate::options::number::whole;
use crate::options::polycube::{LabelsArg, PolycubeArgs, ToleranceArgs};
use crate::options::run::{FolderArg, QuietArg};
use crate::options::search::SearchArgs;
use crate::options::strategy::StrategyArg;
use crate::output::folder::Output;
use crate::output::progress::Progress;
use crate::output::{table, terminal};
use clap::ValueHint;
use clap::builder::PossibleValue;
use polycube::Context;
use polycube::generate::{Example, example};
use polycube::mesh::CellKind;
use polycube::mesh::{self, Format};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const NOTES: &str = "\
In the output folder:
  examples/  every example as EXAMPLE.polycube.obj (quadrilaterals) with EXAMPLE.shape.obj, and as
             EXAMPLE.polycube.mesh (tetrahedra) with EXAMPLE.shape.mesh
  EXAMPLE/   the simplified example";

/// What to show.
#[derive(clap::Args, Debug)]
#[command(after_help = NOTES)]
pub struct Args {
    /// Folder for the examples and the result; made if it is not there
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath, default_value = "polycube-demo")]
    output: PathBuf,

    /// Where the seed shifts the parts of the examples; 0 leaves all of them aligned
    #[arg(long, value_name = "N", value_parser = whole::<u64>(0..=u64::MAX), default_value_t = 1)]
    seed: u64,

    /// The example to simplify
    #[arg(long, value_enum, default_value_t = ExampleArg(Example::CubeSpikes))]
    example: ExampleArg,

    /// Whether it is silent.
    #[command(flatten)]
    quiet: QuietArg,
}

/// An [`Example`] on the command line.
#[derive(Clone, Copy, Debug)]
struct ExampleArg(Example);

impl clap::ValueEnum for ExampleArg {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [ExampleArg; 4] = [
            ExampleArg(Example::CubeSpikes),
            ExampleArg(Example::SteppedL),
            ExampleArg(Example::Ring),
            ExampleArg(Example::DoubleTorus),
        ];
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self.0 {
            Example::CubeSpikes => ("cube-spikes", "A cube with a smaller box on each of its faces"),
            Example::SteppedL => ("stepped-l", "An L whose arms carry steps"),
            Example::Ring => ("ring", "A square ring on legs, with teeth on top"),
            Example::DoubleTorus => ("double-torus", "A plate with two holes, and bumps on all sides"),
        };
        Some(PossibleValue::new(name).help(help))
    }
}

/// Writes the examples, simplifies one, and says what to try next.
pub fn run(args: &Args) -> Result<ExitCode> {
    let progress = Progress::start(args.quiet.on)?;
    let folder = args.output.join("examples");
    write_examples(args.seed, &folder, &progress.context.stage("examples", 0.0, 0.5))?;
    let job = job(args, &folder);
    let simplify::Done { result, .. } = simplify::work(&job, &progress.context.stage("simplify", 0.5, 1.0))?;
    drop(progress);
    if !args.quiet.on {
        let text = format!(
            "{} examples are in {}; this is what simplifying {} did:\n\n{}written to {}\n\n{}",
            Example::ALL.len(),
            folder.display(),
            args.example.0,
            table::summary(&result.report),
            job.output.folder.display(),
            next(args, &folder)
        );
        terminal::print(&text)?;
    }
    Ok(ExitCode::SUCCESS)
}

fn write_examples(seed: u64, folder: &Path, context: &Context) -> Result<()> {
    let kinds = [(CellKind::Quads, Format::Obj), (CellKind::Tetrahedra, Format::Medit)];
    let mut output = Output::new(folder)?;
    let jobs = Example::ALL.into_iter().flat_map(|e| kinds.map(|(kind, format)| (e, kind, format)));
    let total = (Example::ALL.len() * kinds.len()) as f64;
    for (done, (name, kind, format)) in (0_u32..).zip(jobs) {
        context.tick(f64::from(done) / total)?;
        let (polycube, shape) = example(name, seed, kind)?;
        output.add(&format!("{name}.polycube.{format}"), &mesh::write_bytes(format, &polycube, &[])?)?;
        output.add(&format!("{name}.shape.{format}"), &mesh::write_bytes(format, &shape, &[])?)?;
    }
    Ok(output.publish(&[], &[], context)?)
}

/// The example as a user would simplify it.
fn job(args: &Args, folder: &Path) -> simplify::Args {
    let name = args.example.0;
    simplify::Args {
        mesh: PolycubeArgs {
            polycube: folder.join(format!("{name}.polycube.mesh")),
            labels: LabelsArg::default(),
            tolerance: ToleranceArgs::default(),
        },
        shape: Some(folder.join(format!("{name}.shape.mesh"))),
        output: FolderArg { folder: args.output.join(name.to_string()) },
        strategy: StrategyArg::default(),
        scale: None,
        edge_length: None,
        choice: ChoiceArgs { simplicity: Some(1.0), ..ChoiceArgs::default() },
        pareto: false,
        search: SearchArgs::default(),
        format: None,
        quiet: args.quiet,
    }
}

fn next(args: &Args, folder: &Path) -> String {
    let file = |name: &str| folder.join(name).display().to_string();
    format!(
        "Try next:
  polycube inspect {}
  polycube validate {} --shape {}
  polycube simplify {} --scale 0.5 --format vtu -o {}
  polycube simplify --help
",
        file("ring.polycube.obj"),
        file("double-torus.polycube.mesh"),
        file("double-torus.shape.mesh"),
        file("stepped-l.polycube.obj"),
        args.output.join("coarse").display()
    )
}
