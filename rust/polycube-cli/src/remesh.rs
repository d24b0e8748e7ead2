//! `polycube remesh`.

use crate::args::{ToleranceArgs, at_least_one, fraction, percent, positive, whole};
use crate::colour;
use crate::failure::{Failure, INFERIOR, Result};
use crate::mesh_files::MeshFiles;
use crate::output::{Output, REPORT};
use crate::progress::Progress;
use crate::report::{Files, RemeshRun};
use crate::search::SearchArgs;
use crate::simplify::{LABELS, ObjectiveArg, StrategyArg, format};
use crate::{table, terminal};
use clap::ValueHint;
use polycube::mesh::{self, CellField, CellKind, Format, Mesh};
use polycube::remesh::{RemeshOptions, Remeshed, Size, remesh};
use polycube::simplify::Options;
use polycube::{Context, Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

const NOTES: &str = "\
In the output folder:
  layout.vtk      the coarse layout: one hexahedron per block
  layout.obj      the same on the surface: one quadrilateral per patch
  quads.obj       the quadrilateral mesh, its vertices on the shape
  hexes.mesh      the hexahedral mesh, and as
  hexes.vtu       with the cell arrays scaled_jacobian, block_id and label
  polycube.EXT    the polycube on the lattice, with the connectivity of the input
  polycube.labels the label of each of its boundary faces, one a line, for --labels
  report.json     that of `simplify`, and hexes, inverted, min_sj, avg_sj, hausdorff, quads,
                  histogram, times
They appear together when all is done, or not at all. With --surface-only there are no hexahedra
and no layout.vtk. --format EXT writes hexahedra (or, if it holds surfaces only, quadrilaterals) in
that format, too; quads.ply has a colour for each patch.
--hexes N with --surface-only: the lattice is as fine as for N hexahedra, and the quadrilaterals
are those of its surface, not N.
Exit code 4: the meshes are written, but hexahedra are inverted (scaled_jacobian of 0 or less in
hexes.vtu) or the surface is farther from the shape than --max-hausdorff.
`polycube --help` lists the exit codes, `polycube simplify --help` shows a file of guides.";

/// What to mesh and how.
#[derive(clap::Args, Clone, Debug)]
#[command(after_help = NOTES)]
pub struct Args {
    /// The shape: a mesh file with the vertices and cells of the polycube
    #[arg(value_name = "SHAPE", value_hint = ValueHint::FilePath)]
    pub shape: PathBuf,

    /// The polycube: a mesh file whose boundary faces look along the axes
    #[arg(long, value_name = "POLYCUBE", value_hint = ValueHint::FilePath)]
    pub polycube: PathBuf,

    /// Label file: one integer a line for each boundary face, 0 to 5 for +X -X +Y -Y +Z -Z, -1 for "by the normal"
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub labels: Option<PathBuf>,

    /// How far the polycube may be from an exact one.
    #[command(flatten)]
    pub tolerance: ToleranceArgs,

    /// Folder for the results; made if it is not there
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub output: PathBuf,

    /// How fine the mesh is.
    #[command(flatten)]
    pub size: SizeArgs,

    /// Layers of hexahedra between the polycube and the surface, 0 to 16
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole::<u8>(0..=16))]
    pub padding: u8,

    /// Leave the hexahedra out
    #[arg(long)]
    pub surface_only: bool,

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

    /// Write the mesh in this format, too: obj, off, ply, mesh, vtk or vtu
    #[arg(long, value_name = "EXT", value_parser = format)]
    pub format: Option<Format>,

    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// Which of the results between the fewest blocks and the least displacement is meshed.
#[derive(clap::Args, Clone, Debug)]
pub struct ChoiceArgs {
    /// Which number `best` makes small [default: blocks_padded for hexahedra, surface_patches for --surface-only]
    #[arg(long, value_enum)]
    objective: Option<ObjectiveArg>,

    /// Trade blocks for closeness: from 1, the fewest blocks that `best` finds, to 0, the least displacement [default: the
    /// fewest whose hexahedra are good]
    #[arg(long, value_name = "S", value_parser = fraction)]
    simplicity: Option<f64>,

    /// The farthest that `best` may move a corner, in units of the polycube [default: no limit]
    #[arg(long, value_name = "D", value_parser = positive)]
    max_displacement: Option<f64>,

    /// The largest mean angle distortion of the map from the shape that a result of `best` may have, 1 or more
    /// [default: no limit]
    #[arg(long, value_name = "D", value_parser = at_least_one)]
    max_distortion: Option<f64>,
}

impl ChoiceArgs {
    /// These options for `simplify`.
    pub fn set(&self, options: Options) -> Options {
        let Self { simplicity, max_displacement, max_distortion, .. } = *self;
        Options { objective: self.objective.map(|o| o.0), simplicity, max_displacement, max_distortion, ..options }
    }
}

/// How fine a mesh is: one of three.
#[derive(clap::Args, Clone, Debug)]
#[group(multiple = false)]
pub struct SizeArgs {
    /// Mean length of the mesh's edges, in units of the shape [default: see --scale]
    #[arg(long, value_name = "H", value_parser = positive)]
    pub edge_length: Option<f64>,

    /// Lattice steps per unit of the polycube [default: 1 if all its levels are integers, else one step per mean mesh
    /// edge]
    #[arg(long, value_name = "S", value_parser = positive)]
    pub scale: Option<f64>,

    /// About how many hexahedra there shall be, padding included; with --surface-only, would be
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1..=u64::from(u32::MAX)))]
    pub hexes: Option<u32>,
}

impl SizeArgs {
    /// The size asked for.
    pub fn get(&self) -> Option<Size> {
        let length = self.edge_length.map(Size::EdgeLength);
        length.or(self.scale.map(Size::Scale)).or(self.hexes.map(|n| Size::Hexes(n as usize)))
    }
}

impl Args {
    fn options(&self) -> RemeshOptions {
        RemeshOptions {
            simplify: self.search.set(self.choice.set(Options {
                strategy: self.strategy.0,
                tolerance: self.tolerance.get(),
                ..Options::default()
            })),
            size: self.size.get(),
            padding: usize::from(self.padding),
            surface_only: self.surface_only,
            max_hausdorff: self.max_hausdorff / 100.0,
            ..RemeshOptions::default()
        }
    }

    fn inputs(&self) -> Vec<&Path> {
        [&self.shape, &self.polycube].into_iter().chain(&self.labels).map(PathBuf::as_path).collect()
    }

    fn files(&self) -> Files {
        let name = |path: &Path| path.display().to_string();
        Files {
            polycube: name(&self.polycube),
            shape: Some(name(&self.shape)),
            labels: self.labels.as_deref().map(name),
        }
    }
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<ExitCode> {
    let progress = Progress::start(args.quiet)?;
    let result = work(args, &progress.context)?;
    drop(progress);
    if !args.quiet {
        let place = format!("written to {}\n", args.output.display());
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

/// Reads, meshes, writes.
pub fn work(args: &Args, context: &Context) -> Result<Remeshed> {
    let start = Instant::now();
    context.stage("read", 0.0, 0.05).tick(0.0)?;
    let meshes = MeshFiles::read(&args.polycube, Some(&args.shape), args.labels.as_deref())?;
    let formats = Formats::new(args, &meshes)?;
    let read = start.elapsed().as_secs_f64();
    let middle = context.stage("read", 0.05, 0.95);
    let about = Failure::in_files(&args.polycube, args.search.guides.as_deref());
    let (input, mut options) = (meshes.input(), args.options());
    options.simplify.guides = args.search.guides(&args.polycube, &input, &options.simplify.tolerance)?;
    let mut result = remesh(&input, &options, &middle).map_err(about)?;
    result.report.simplify.seconds.read = read;
    let done = start.elapsed().as_secs_f64();
    let elapsed = || start.elapsed().as_secs_f64() - done;
    write(args, (&mut result, &options), &formats, &context.stage("write", 0.95, 1.0), elapsed)?;
    Ok(result)
}

/// The formats of the files whose formats can be chosen.
struct Formats {
    polycube: Format,
    /// One more of the hexahedra or, where it cannot hold them, of the quadrilaterals.
    extra: Option<Format>,
}

impl Formats {
    fn new(args: &Args, meshes: &MeshFiles) -> Result<Self> {
        let polycube = Format::from_path(&args.polycube)?;
        if !polycube.holds(meshes.polycube.cells.kind()) {
            let kind = meshes.polycube.cells.kind();
            return Err(Error::new(ErrorKind::Option, format!("a .{polycube} file cannot hold {kind}")).into());
        }
        if args.format == Some(Format::Stl) {
            return Err(Error::new(ErrorKind::Option, "a .stl file cannot hold quadrilaterals or hexahedra")
                .remedy("choose --format from obj, off, ply, mesh, vtk, vtu")
                .into());
        }
        Ok(Self { polycube, extra: args.format })
    }
}

/// The names of the meshes that may be written, and what their formats must be able to hold.
const MESHES: [(&str, &[CellKind]); 4] = [
    ("layout", &[CellKind::Quads, CellKind::Hexahedra]),
    ("quads", &[CellKind::Quads]),
    ("hexes", &[CellKind::Hexahedra]),
    ("polycube", &CellKind::ALL),
];

/// A file of the result by its name without extension.
struct File<'a> {
    name: &'static str,
    format: Format,
    mesh: &'a Mesh,
    fields: Vec<CellField>,
}

fn files<'a>(result: &'a Remeshed, formats: &Formats) -> Vec<File<'a>> {
    let file = |name, format, mesh, fields| File { name, format, mesh, fields };
    let mut files = vec![
        file("layout", Format::Obj, &result.layout.patches, Vec::new()),
        file("quads", Format::Obj, &result.quads.mesh, Vec::new()),
    ];
    if let Some(mesh) = &result.simplified.polycube {
        files.push(file("polycube", formats.polycube, mesh, Vec::new()));
    }
    let extra = formats.extra.filter(|f| !matches!((f, &result.hexes), (Format::Obj, _)));
    let Some(hexes) = &result.hexes else {
        files.extend(extra.map(|f| file("quads", f, &result.quads.mesh, quad_fields(result, f))));
        return files;
    };
    let mut fields = hexes.fields();
    fields.push(CellField::real("scaled_jacobian", result.scaled_jacobian.clone()));
    files.push(file("layout", Format::Vtk, &result.layout.blocks, result.layout.block_fields()));
    files.push(file("hexes", Format::Medit, &hexes.mesh, Vec::new()));
    files.push(file("hexes", Format::Vtu, &hexes.mesh, fields.clone()));
    match extra {
        None | Some(Format::Medit | Format::Vtu) => {}
        Some(f) if f.holds(hexes.mesh.cells.kind()) => files.push(file("hexes", f, &hexes.mesh, fields)),
        Some(f) => files.push(file("quads", f, &result.quads.mesh, quad_fields(result, f))),
    }
    files
}

/// The fields of the quadrilaterals, and in PLY a colour for each patch.
fn quad_fields(result: &Remeshed, format: Format) -> Vec<CellField> {
    let mut fields = result.quads.fields();
    if format == Format::Ply {
        let colours: Vec<[u8; 3]> = result.quads.patch_id.iter().map(|&id| colour::bytes(colour::pastel(id))).collect();
        let channel = |c: usize| colours.iter().map(|colour| i32::from(colour[c])).collect();
        let names = ["red", "green", "blue"].into_iter().enumerate();
        fields.extend(names.map(|(c, name)| CellField::integer(name, channel(c))));
    }
    fields
}

fn write(
    args: &Args,
    (result, options): (&mut Remeshed, &RemeshOptions),
    formats: &Formats,
    context: &Context,
    elapsed: impl Fn() -> f64,
) -> Result<()> {
    let mut output = Output::new(&args.output)?;
    let files = files(result, formats);
    for (i, file) in files.iter().enumerate() {
        context.tick(i as f64 / files.len() as f64)?;
        let name = format!("{}.{}", file.name, file.format);
        output.add(&name, &mesh::write_bytes(file.format, file.mesh, &file.fields)?)?;
    }
    let labels: String = result.simplified.input.labels().map(|l| format!("{}\n", l.index())).collect();
    output.add(LABELS, labels.as_bytes())?;
    let polycube = format!("polycube.{}", formats.polycube);
    drop(files);
    let seconds = &mut result.report.simplify.seconds;
    seconds.write = elapsed();
    seconds.total += seconds.read + seconds.write;
    let run = RemeshRun { input: &args.files(), options: options.into(), output: &polycube, report: &result.report };
    output.add(REPORT, terminal::to_json(&run)?.as_bytes())?;
    let stale = output.meshes_left(&MESHES);
    Ok(output.publish(&stale, &args.inputs(), context)?)
}
