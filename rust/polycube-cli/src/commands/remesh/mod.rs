//! `polycube remesh`.

mod files;

use crate::failure::{Failure, INFERIOR, Result};
use crate::input::meshes::MeshFiles;
use crate::options::choice::ChoiceArgs;
use crate::options::format::{OutputFormat, output_format};
use crate::options::make::MakeArgs;
use crate::options::mesh::MeshArgs;
use crate::options::number::percent;
use crate::options::polycube::{LabelsArg, ToleranceArgs};
use crate::options::run::{FolderArg, QuietArg};
use crate::options::search::SearchArgs;
use crate::options::strategy::StrategyArg;
use crate::output::folder::{LABELS, Output, REPORT};
use crate::output::progress::Progress;
use crate::output::report::{Files, RemeshRun};
use crate::output::{table, terminal};
use clap::ValueHint;
use files::{Formats, MESHES, all_solver_files, files, solver_files};
use polycube::Context;
use polycube::make;
use polycube::remesh::{RemeshOptions, Remeshed, remesh};
use polycube::simplify::SimplifyOptions;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

const NOTES: &str = "\
In the output folder:
  layout.vtk      the coarse layout: one hexahedron per block
  layout.obj      the same on the surface: one quadrilateral per patch
  quads.obj       the quadrilateral mesh, its vertices on the shape
  hexes.mesh      the hexahedral mesh, and as
  hexes.vtu       with the cell arrays scaled_jacobian, edge_ratio, determinant, non_orthogonality,
                  skewness, block_id and label
  polycube.EXT    the polycube on the lattice, with the connectivity of the input
  polycube.labels the label of each of its boundary faces, one a line, for --labels
  report.json     that of `simplify`, and hexes, inverted, min_sj, avg_sj, hausdorff, quads,
                  histogram, least, largest and mean of the other arrays, times
Without --polycube one is made of SHAPE, a closed surface, which is cut finer where its map needs
room; `polycube make` writes it down instead. --labels are then those of SHAPE, whose charts become
the facets of the polycube.
They appear together when all is done, or not at all. With --surface-only there are no hexahedra
and no layout.vtk. --format EXT writes hexahedra (or, if it holds surfaces only, quadrilaterals) in
that format, too, and may be given several times; quads.ply has a colour for each patch.
For solvers, with blocks and boundary by name (block_0 …; facet_0 …, and minus_x to plus_z for all
facets that look one way on the polycube):
  msh    hexes.msh, of Gmsh 4.1: physical groups
  inp    hexes.inp, of Abaqus and CalculiX: C3D8, with ELSET, NSET and SURFACE
  su2    hexes.su2, of SU2: markers minus_x to plus_z, no blocks
  foam   foam/constant/polyMesh, of OpenFOAM: a patch for each facet, in the group of its direction;
         cell zones
--groups FILE takes the groups of a mesh file that lies on the shape, such as SHAPE itself, for these
names: materials, groups or objects of OBJ, references of MEDIT, physical groups of Gmsh, element
sets of Abaqus, arrays of the cells of VTK; faces in none are in `other`.
The block structure itself, for solvers that want grids:
  json       blocks.json: points, grids of vertices, edge classes, neighbours, names; see the guide
  xyz        hexes.xyz, of Plot3D: many blocks, text, no names
  blockmesh  blockmesh/system/blockMeshDict, of OpenFOAM's blockMesh: names as in foam
--hexes N with --surface-only: the lattice is as fine as for N hexahedra, and the quadrilaterals
are those of its surface, not N.
Exit code 4: the meshes are written, but hexahedra are inverted (scaled_jacobian of 0 or less in
hexes.vtu) or the surface is farther from the shape than --max-hausdorff.
`polycube --help` lists the exit codes, `polycube simplify --help` shows a file of guides.";

/// What to mesh and how.
#[derive(clap::Args, Clone, Debug)]
#[command(
    after_help = NOTES,
    mut_arg("detail", |detail| detail.conflicts_with_all(["polycube", "labels"])),
    mut_arg("corners", |corners| corners.conflicts_with_all(["polycube", "labels"])),
    mut_arg("axes", |axes| axes.conflicts_with_all(["polycube", "labels"]))
)]
pub struct Args {
    /// The shape: a mesh file with the vertices and cells of the polycube, or any closed surface without one
    #[arg(value_name = "SHAPE", value_hint = ValueHint::FilePath)]
    pub shape: PathBuf,

    /// The polycube: a mesh file whose boundary faces look along the axes [default: one is made, as `make` does]
    #[arg(long, value_name = "POLYCUBE", value_hint = ValueHint::FilePath)]
    pub polycube: Option<PathBuf>,

    /// How closely a polycube that is made follows the shape.
    #[command(flatten)]
    pub make: MakeArgs,

    /// What its boundary faces look along.
    #[command(flatten)]
    pub labels: LabelsArg,

    /// How far the polycube may be from an exact one.
    #[command(flatten)]
    pub tolerance: ToleranceArgs,

    /// Where the results go.
    #[command(flatten)]
    pub output: FolderArg,

    /// What is meshed, and how fine.
    #[command(flatten)]
    pub mesh: MeshArgs,

    /// How the levels find their places; `naive` meshes the polycube as it is, for comparison
    #[arg(long, value_enum, default_value_t)]
    pub strategy: StrategyArg,

    /// Which result of `best` is meshed.
    #[command(flatten)]
    pub choice: ChoiceArgs,

    /// How long and how it is searched, and what must stay.
    #[command(flatten)]
    pub search: SearchArgs,

    /// The largest Hausdorff distance between mesh and shape to accept, in percent of the bounding box's diagonal
    #[arg(long, value_name = "PERCENT", value_parser = percent, default_value_t = 0.5)]
    pub max_hausdorff: f64,

    /// Write the mesh in this format, too (may be repeated): obj, off, ply, mesh, meshb, vtk, vtu, vtp; msh, inp, su2,
    /// foam; json, xyz or blockmesh
    #[arg(long, value_name = "EXT", value_parser = output_format)]
    pub format: Vec<OutputFormat>,

    /// Name the boundary in msh, inp, su2 and foam by the groups of faces in this mesh file, most often SHAPE itself
    /// [default: by facets and directions]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub groups: Option<PathBuf>,

    /// Write texture coordinates to quads.obj: a chart of equal squares for each patch of the layout, 0 to 1
    #[arg(long)]
    pub uv: bool,

    /// Whether it is silent.
    #[command(flatten)]
    pub quiet: QuietArg,
}

impl Args {
    fn options(&self) -> RemeshOptions {
        let simplify = SimplifyOptions {
            strategy: self.strategy.0,
            tolerance: self.tolerance.get(),
            no_repair: self.tolerance.repair.off,
            ..SimplifyOptions::default()
        };
        self.mesh.set(RemeshOptions {
            simplify: self.search.set(self.choice.set(simplify)),
            max_hausdorff: self.max_hausdorff / 100.0,
            ..RemeshOptions::default()
        })
    }

    fn inputs(&self) -> Vec<&Path> {
        std::iter::once(&self.shape)
            .chain(&self.polycube)
            .chain(&self.labels.file)
            .chain(&self.groups)
            .map(PathBuf::as_path)
            .collect()
    }

    fn files(&self) -> Files {
        let name = |path: &Path| path.display().to_string();
        Files {
            polycube: self.polycube.as_deref().map(name),
            shape: Some(name(&self.shape)),
            labels: self.labels.file.as_deref().map(name),
            groups: self.groups.as_deref().map(name),
        }
    }
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<ExitCode> {
    let progress = Progress::start(args.quiet.on)?;
    let result = work(args, &progress.context)?;
    drop(progress);
    if !args.quiet.on {
        let place = format!("written to {}\n", args.output.folder.display());
        terminal::print(&(table::remesh_summary(&result.report) + &place))?;
    }
    if result.report.is_good() {
        return Ok(ExitCode::SUCCESS);
    }
    for note in result.report.faults() {
        terminal::print_error(&format!("warning: {note}"));
    }
    Ok(ExitCode::from(INFERIOR))
}

/// Meshes the pair, or the shape alone.
fn meshed(args: &Args, meshes: MeshFiles, options: &RemeshOptions, context: &Context) -> polycube::Result<Remeshed> {
    if args.polycube.is_some() {
        return remesh(&meshes.input(), options, context);
    }
    let MeshFiles { polycube: shape, labels, .. } = meshes;
    Ok(make::remesh(&shape, &args.make.get(labels, args.tolerance.repair), options, context)?.1)
}

/// Reads, meshes, writes.
pub fn work(args: &Args, context: &Context) -> Result<Remeshed> {
    let start = Instant::now();
    context.stage("read", 0.0, 0.05).tick(0.0)?;
    // Alone, the shape stands where the polycube would.
    let shape = args.polycube.as_ref().map(|_| args.shape.as_path());
    let polycube = args.polycube.as_ref().unwrap_or(&args.shape);
    let meshes = MeshFiles::read(polycube, shape, args.labels.given())?;
    let formats = Formats::new(polycube, &args.format, args.options().surface_only, &meshes)?;
    let formats = formats.with_groups(args.groups.as_deref())?;
    let read = start.elapsed().as_secs_f64();
    let about = Failure::in_files(polycube, args.search.guides.as_deref());
    let mut options = args.options();
    options.simplify.guides = args.search.guides()?;
    let mut result = meshed(args, meshes, &options, &context.stage("read", 0.05, 0.95)).map_err(about)?;
    options.simplify.guides = result.simplified.options.guides.clone();
    result.report.simplify.seconds.read = read;
    let done = start.elapsed().as_secs_f64();
    let elapsed = || start.elapsed().as_secs_f64() - done;
    write(args, (&mut result, &options), &formats, &context.stage("write", 0.95, 1.0), elapsed)?;
    Ok(result)
}

fn write(
    args: &Args,
    (result, options): (&mut Remeshed, &RemeshOptions),
    formats: &Formats,
    context: &Context,
    elapsed: impl Fn() -> f64,
) -> Result<()> {
    let mut output = Output::new(&args.output.folder)?;
    let files = files(result, formats, args.uv);
    for (i, file) in files.iter().enumerate() {
        context.tick(i as f64 / files.len() as f64)?;
        let name = format!("{}.{}", file.name, file.format);
        output.add(&name, &file.bytes()?)?;
    }
    let labels: String = result.simplified.input.labels().map(|l| format!("{}\n", l.index())).collect();
    output.add(LABELS, labels.as_bytes())?;
    let polycube = format!("polycube.{}", formats.polycube);
    drop(files);
    for (name, bytes) in solver_files(result, formats)? {
        context.tick(1.0)?;
        output.add(&name, &bytes)?;
    }
    let seconds = &mut result.report.simplify.seconds;
    seconds.write = elapsed();
    seconds.total += seconds.read + seconds.write;
    let run = RemeshRun { input: &args.files(), options: options.into(), output: &polycube, report: &result.report };
    output.add(REPORT, terminal::to_json(&run)?.as_bytes())?;
    let mut stale = output.meshes_left(&MESHES);
    stale.extend(output.left(all_solver_files()));
    Ok(output.publish(&stale, &args.inputs(), context)?)
}
