//! The whole way from a polycube and its shape to a block structure, quadrilaterals and hexahedra.

use super::choose::{Choice, GOOD, Verdict, WORTH, Wrong};
use super::climb::{Rung, finish};
use super::hexes::check_padding;
use super::improve::{Aim, Improved};
use super::report::{RemeshReport, Stages, cells_of, diagonal, measure};
use super::start::Start;

use super::{Hexes, Layout, Quads, Remesher, Size, hausdorff};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::layout::Objective;
use crate::mesh::Mesh;
use crate::optimise::Settings;
use crate::simplify::{self, Input, Simplified, simplify, untangle};
use std::time::Instant;

/// How a shape is meshed.
#[derive(Clone, Debug, PartialEq)]
pub struct RemeshOptions {
    /// How the polycube is simplified; [`Strategy::Naive`](crate::align::Strategy::Naive) meshes it as it is. Of `scale` only [`size`](Self::size) is used
    /// where that is given. Without an objective it is padded blocks that count, unless only the surface is meshed. Unless the options
    /// say where on the front, how far corners may move, or how distorted the map may be, more blocks than the fewest are taken where
    /// those make poor hexahedra, and a note says so.
    pub simplify: simplify::Options,
    /// How fine the mesh shall be; by default as [`simplify::Options::scale`] says.
    pub size: Option<Size>,
    /// Layers of hexahedra between the polycube and the surface, 0 to [`MAX_PADDING`](super::MAX_PADDING); 1 by default.
    pub padding: usize,
    /// Leave the hexahedra out.
    pub surface_only: bool,
    /// The largest Hausdorff distance to accept, as a **fraction** of the bounding box's diagonal; 0.005 by default, half a
    /// percent. (The command and Python take percent.)
    pub max_hausdorff: f64,
    /// How hard the hexahedra are optimised; `scope` is not looked at, both ways are tried.
    pub optimise: Settings,
}

impl Default for RemeshOptions {
    fn default() -> Self {
        Self {
            simplify: simplify::Options::default(),
            size: None,
            padding: 1,
            surface_only: false,
            max_hausdorff: 0.005,
            optimise: Settings::default(),
        }
    }
}

impl RemeshOptions {
    /// Refuses what is out of its range, before anything is done.
    ///
    /// # Errors
    /// [`ErrorKind::Option`].
    fn check(&self) -> Result<()> {
        if self.max_hausdorff.is_nan() || self.max_hausdorff <= 0.0 {
            let message = format!("{} is no bound for a distance", self.max_hausdorff);
            return Err(Error::new(ErrorKind::Option, message).remedy("give a positive number"));
        }
        self.size.map_or(Ok(()), Size::check)?;
        check_padding(self.padding)?;
        self.simplify.check()
    }
}

/// Meshes of a shape and the block structure that they have.
#[derive(Clone, Debug)]
pub struct Remeshed {
    /// The polycube on the lattice, its map untangled. Its levels are those of the meshes.
    pub simplified: Simplified,
    /// Blocks and patches as single cells on the shape.
    pub layout: Layout,
    /// The surface. With hexahedra it is theirs.
    pub quads: Quads,
    /// The volume, unless only the surface was asked for.
    pub hexes: Option<Hexes>,
    /// The scaled Jacobian of each hexahedron.
    pub scaled_jacobian: Vec<f64>,
    /// What was done and how good it is.
    pub report: RemeshReport,
}

/// Simplifies a polycube and meshes its shape with the block structure found (paper, sections 6 and 7).
///
/// The map from shape to polycube is made one to one on every facet; the lattice of the wanted size is mapped back
/// through it, padded, and optimised with the surface sliding on the shape until no hexahedron is inverted and the worst is
/// as good as can be had; where the mesh cuts off more of the shape than the bound, surface vertices are put there.
/// Levels are spaced by the shape, unless the scale is given. Where inverted hexahedra remain or the surface is farther from the shape than asked for, the result
/// is given all the same and the report says so. Without a shape the polycube itself is meshed.
///
/// The result is the same for any number of threads.
///
/// ```
/// use polycube::generate::{Example, example};
/// use polycube::mesh::CellKind;
/// use polycube::remesh::{RemeshOptions, Size, remesh};
/// use polycube::{Context, Input};
///
/// let (cube, shape) = example(Example::SteppedL, 1, CellKind::Quads)?;
/// let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
/// let options = RemeshOptions { size: Some(Size::Hexes(400)), ..RemeshOptions::default() };
/// let meshes = remesh(&input, &options, &Context::default())?;
///
/// let hexes = meshes.hexes.expect("`surface_only` alone leaves them out");
/// assert_eq!(hexes.mesh.cells.len(), meshes.scaled_jacobian.len());
/// assert_eq!(meshes.report.inverted, 0);
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// Those of [`simplify()`], [`scale_for`](super::scale_for()), [`Remesher`] and [`optimise`](crate::optimise::optimise()); [`ErrorKind::Option`] for any
/// option out of its range, before anything is done, and for a size that takes more hexahedra than [`MOST_HEXES`](super::MOST_HEXES); [`ErrorKind::Cancelled`].
pub fn remesh(input: &Input, options: &RemeshOptions, context: &Context) -> Result<Remeshed> {
    options.check()?;
    let start = Instant::now();
    let seconds = || start.elapsed().as_secs_f64();
    let found = simplify(input, &simplifying(options), &context.stage("simplify", 0.0, 0.2))?;
    let mut stages = Stages { simplify: seconds(), ..Stages::default() };
    let spent = found.report.seconds;
    let mut choice = Choice::new(input, found, options, &context.stage("map", 0.2, 0.5))?;
    stages.map = seconds() - stages.simplify;
    let (mut simplified, meshed) = best(&mut choice, options, &mut stages, &context.stage("mesh", 0.5, 0.9))?;
    choice.explain(&mut simplified);
    simplified.report.seconds = spent;
    let shape = input.shape.unwrap_or(input.polycube);
    untangle_volume(&mut simplified, input, &context.stage("map", 0.9, 0.95))?;
    let report = measure(&simplified, &meshed, shape, options, stages, &context.stage("measure", 0.95, 1.0))?;
    let Meshed { layout, quads, hexes, scaled_jacobian, .. } = meshed;
    let mut result = Remeshed { simplified, layout, quads, hexes, scaled_jacobian, report };
    result.report.set_seconds(seconds());
    Ok(result)
}

/// How the polycube is simplified: for hexahedra it is padded blocks that count, whatever the cells of the polycube are.
fn simplifying(options: &RemeshOptions) -> simplify::Options {
    let blocks = (!options.surface_only).then_some(Objective::BlocksPadded);
    let objective = options.simplify.objective.or(blocks);
    simplify::Options { objective, keep_flipped: true, ..options.simplify.clone() }
}

/// A mesh and what it is of.
struct Made {
    simplified: Simplified,
    meshed: Meshed,
}

impl Made {
    /// What is wrong with it. A worst hexahedron that lacks little to be good is not worth another mesh.
    fn wrong(&self) -> Option<Wrong> {
        match &self.meshed {
            meshed if meshed.bad() > 0 => Some(Wrong::Inverted),
            Meshed { far, .. } if *far > 0.0 => Some(Wrong::Far),
            Meshed { worst, .. } if *worst < GOOD - WORTH => Some(Wrong::Poor),
            _ => None,
        }
    }

    fn blocks(&self) -> usize {
        self.simplified.report.after.map_or(0, |counts| counts.blocks_padded)
    }

    /// Worst and average scaled Jacobian in sum, the worst as far as it is not good.
    fn value(&self) -> f64 {
        let all = &self.meshed.scaled_jacobian;
        self.meshed.worst.min(GOOD) + all.iter().sum::<f64>() / all.len().max(1) as f64
    }

    /// Whether it is rather to be had than `other`: one with fewer inverted hexahedra, then one nearer to the shape, then the one with
    /// fewer blocks, unless the other is clearly better.
    fn is_better(&self, other: &Self) -> bool {
        let rank = |made: &Self| (made.meshed.bad(), made.meshed.far);
        let more = if self.blocks() > other.blocks() { WORTH } else { -WORTH };
        rank(self) < rank(other) || rank(self) == rank(other) && self.value() > other.value() + more
    }
}

/// The first mesh that is uninverted, good, and as near to the shape as asked for, else the best of those that were tried.
fn best(
    choice: &mut Choice,
    options: &RemeshOptions,
    stages: &mut Stages,
    context: &Context,
) -> Result<(Simplified, Meshed)> {
    let mut best: Option<Made> = None;
    let mut last = None;
    // Each takes half of the progress that is left: mostly there is one.
    let mut done = 0.0;
    while let Some(start) = choice.next(last, &context.stage("mesh", done, done))? {
        let Start { simplified, map, shape, rung, spaced, folded, .. } = start;
        let share = (1.0 - done) / 2.0;
        let context = context.stage("mesh", done, done + share);
        let mut meshed = if options.surface_only {
            mesh_surface(&map, &shape, folded, stages, &context)?
        } else {
            mesh_volume(&map, &shape, rung, options, stages, &context)?
        };
        meshed.spaced = spaced;
        done += share;
        let made = Made { simplified, meshed };
        let (at, wrong) = (made.simplified.report.chosen.unwrap_or(0), made.wrong());
        if best.as_ref().is_none_or(|best| made.is_better(best)) {
            best = Some(made);
        } else if wrong == Some(Wrong::Poor) && best.as_ref().is_some_and(|best| best.wrong() == wrong) {
            break;
        }
        last = Some(Verdict { at, wrong, inverted: best.as_ref().is_some_and(|b| b.meshed.bad() > 0) });
    }
    let found = best.map(|Made { simplified, meshed }| (simplified, meshed));
    found.ok_or_else(|| Error::new(ErrorKind::Internal, "there was nothing to mesh"))
}

/// Turns flipped cells of a volume's polycube the right way round, as far as that goes.
fn untangle_volume(simplified: &mut Simplified, input: &Input, context: &Context) -> Result<()> {
    let shape = input.shape.unwrap_or(input.polycube);
    let Simplified { input: polycube, polycube: Some(mesh), report, .. } = simplified else { return Ok(()) };
    if mesh.cells.is_volume() && !report.flipped.cells.is_empty() {
        untangle(polycube, mesh, shape, context)?;
    }
    context.tick(1.0)?;
    report.rejudge(input, polycube, mesh)
}

/// The meshes before they are judged.
pub(super) struct Meshed {
    pub(super) layout: Layout,
    pub(super) quads: Quads,
    pub(super) hexes: Option<Hexes>,
    pub(super) scaled_jacobian: Vec<f64>,
    /// How many of them are not positive.
    inverted: usize,
    /// The worst; 1 where there are none.
    worst: f64,
    /// How far the shape is from the surface; 0 if it is within the bound, as far as could be seen, or, without hexahedra, within the
    /// length of a quadrilateral's side.
    far: f64,
    /// Vertices that had to leave their corners and edges.
    pub(super) released: usize,
    /// Whether the levels were spaced by the shape.
    pub(super) spaced: bool,
    /// Of a surface alone: how many triangles of its map are turned over if it is folded; 0 otherwise.
    pub(super) folded: usize,
}

impl Meshed {
    /// How much of it is the wrong way round: of hexahedra, or of the map where there are none.
    fn bad(&self) -> usize {
        self.inverted + self.folded
    }
}

/// The quadrilaterals and patches of a surface alone.
fn mesh_surface(
    map: &Simplified,
    shape: &Mesh,
    folded: usize,
    stages: &mut Stages,
    context: &Context,
) -> Result<Meshed> {
    let start = Instant::now();
    let remesher = Remesher::new(map, shape, &context.stage("mesh", 0.0, 0.5))?;
    let quads = remesher.quads(&context.stage("mesh", 0.5, 0.8))?;
    let points = remesher.surface_points(&context.stage("mesh", 0.8, 1.0))?.points;
    let layout = remesher.layout(&points, 0)?;
    // A distorted map may be one to one and still lead quadrilaterals astray.
    let distance = if quads.inverted() > 0 { hausdorff(&quads.mesh, shape, context)? } else { 0.0 };
    let far = if distance > quads.mean_side() { distance } else { 0.0 };
    stages.mesh += start.elapsed().as_secs_f64();
    let scaled_jacobian = Vec::new();
    Ok(Meshed {
        layout,
        quads,
        hexes: None,
        scaled_jacobian,
        inverted: 0,
        worst: 1.0,
        far,
        released: 0,
        spaced: false,
        folded,
    })
}

/// The hexahedra of a solid with the quadrilaterals and patches of their surface.
fn mesh_volume(
    map: &Simplified,
    shape: &Mesh,
    rung: Option<Rung>,
    options: &RemeshOptions,
    stages: &mut Stages,
    context: &Context,
) -> Result<Meshed> {
    let start = Instant::now();
    let remesher = Remesher::new(map, shape, &context.stage("mesh", 0.0, 0.05))?;
    let mut quads = remesher.quads(&context.stage("mesh", 0.05, 0.1))?;
    let mut hexes = remesher.hexes(options.padding, &context.stage("mesh", 0.1, 0.2))?;
    let optimising = Instant::now();
    stages.mesh += (optimising - start).as_secs_f64();
    let bound = options.max_hausdorff * diagonal(shape);
    let Improved { released, far } =
        finish(rung, &remesher, &mut hexes, options, Aim::Within(bound), &context.stage("optimise", 0.2, 0.97))?;
    stages.optimise += optimising.elapsed().as_secs_f64();
    let context = context.stage("mesh", 0.97, 1.0);
    context.tick(0.0)?;
    quads.mesh.points = remesher.surface_of(&hexes.mesh.points, options.padding);
    context.tick(0.3)?;
    let layout = remesher.layout(&hexes.mesh.points, options.padding)?;
    context.tick(0.7)?;
    let cells = cells_of(&hexes);
    let scaled_jacobian: Vec<f64> =
        cells.iter().map(|c| crate::optimise::scaled_jacobian(&hexes.mesh.points, c)).collect();
    let inverted = scaled_jacobian.iter().filter(|q| q.is_nan() || **q <= 0.0).count();
    let worst = scaled_jacobian.iter().copied().fold(1.0, f64::min);
    context.tick(1.0)?;
    Ok(Meshed {
        layout,
        quads,
        hexes: Some(hexes),
        scaled_jacobian,
        inverted,
        worst,
        far,
        released,
        spaced: false,
        folded: 0,
    })
}
