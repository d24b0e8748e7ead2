//! The whole method: read the structure, align it, morph the mesh onto the result, and say what happened.

use crate::align::{self, Alignment, Effort, Guides, LowerBound, Round, SolverKind, Strategy, TradeOff};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::layout::{Counts, Objective, count};
use crate::map::{Distortion, Flipped, distortion, flipped, morph};
use crate::mesh::{Mesh, Point};
use crate::structure::{Arrangement, Deviation, Polycube, Tolerance};
use std::time::Instant;

mod blame;
mod corners;
mod front;
mod regions;
mod untangle;

pub(crate) use blame::remedy;
use blame::{blame, first_of};
pub(crate) use corners::Corners;
pub use front::Located;

/// What is simplified.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The polycube.
    pub polycube: &'a Mesh,
    /// The shape it was deformed from, with the same cells; used to measure the distortion of the map.
    pub shape: Option<&'a Mesh>,
    /// One label per boundary face of the polycube (0 to 5, −1 for "by the normal").
    pub labels: Option<&'a [i8]>,
}

/// How it is simplified.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// How the levels find their places.
    pub strategy: Strategy,
    /// Lattice steps per unit of the polycube. By default 1 if all levels are integers, else such that a lattice step
    /// is the mean length of the polycube's mesh edges.
    pub scale: Option<f64>,
    /// Algorithm 1 stops before λ falls below this: 0 for the coarsest result.
    pub lambda_min: f64,
    /// Who solves the integer problems.
    pub solver: SolverKind,
    /// Which number shall be small; by default padded blocks for a volume and patches for a surface.
    pub objective: Option<Objective>,
    /// How long the strategy `best` searches.
    pub effort: Effort,
    /// How far the strategy `best` goes on the front between the fewest blocks (1, the default) and the least
    /// displacement (0).
    pub simplicity: Option<f64>,
    /// The farthest that the strategy `best` may move a corner, in units of the polycube.
    pub max_displacement: Option<f64>,
    /// The largest mean angle distortion ([`Distortion::angle`], at least 1) that the map from the shape to the result of the
    /// strategy `best` may have; of the front, the point with the fewest blocks that keeps it is taken.
    pub max_distortion: Option<f64>,
    /// Facets that must not move, that must or must not align, planes of symmetry.
    pub guides: Guides,
    /// Whether the strategy `best`, too, leaves elements as they are that the morph turned over, as the paper does.
    pub keep_flipped: bool,
    /// How far the input may be from a polycube.
    pub tolerance: Tolerance,
}

impl Options {
    fn alignment(&self, scale: f64, mesh: &Mesh) -> align::Options {
        align::Options {
            strategy: self.strategy,
            scale,
            lambda_min: self.lambda_min,
            solver: self.solver,
            objective: self.objective.unwrap_or_else(|| default_objective(mesh)),
            effort: self.effort,
            simplicity: self.simplicity.unwrap_or(1.0),
            max_displacement: self.max_displacement,
            guides: self.guides.clone(),
        }
    }
}

/// A simplified polycube.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The polycube as it came, with its structure.
    pub input: Polycube,
    /// The simplified polycube in lattice units, with the connectivity of the input; nothing when it is not valid.
    pub polycube: Option<Mesh>,
    /// The lattice coordinate of every level.
    pub levels: Vec<i64>,
    /// What was done.
    pub report: Report,
    /// How it was asked to be done.
    pub options: Options,
}

/// What was done, for people and programs.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Report {
    /// How the levels found their places.
    pub strategy: Strategy,
    /// Lattice steps per unit of the input.
    pub scale: f64,
    /// Whether the result is a valid polycube. Only `naive` can give one that is not.
    pub valid: bool,
    /// Counts of the input.
    pub before: Counts,
    /// Counts of the result, if it is valid.
    pub after: Option<Counts>,
    /// The rounds of Algorithm 1.
    pub rounds: Vec<Round>,
    /// The trade-off between the count and displacement that the strategy `best` met, from the fewest blocks on.
    pub front: Vec<TradeOff>,
    /// Which point of the front the result is, from 0; nothing if it is none.
    pub chosen: Option<usize>,
    /// How far the count can go down at most, as far as the strategy `best` could prove it.
    pub bound: Option<LowerBound>,
    /// Time spent, in seconds.
    pub seconds: Seconds,
    /// The farthest that a corner moved, in units of the input polycube.
    pub max_displacement: f64,
    /// Elements of the morphed mesh that are turned over or flat: cells of a volume and boundary faces.
    pub flipped_elements: usize,
    /// Which they are.
    pub flipped: Flipped,
    /// How far the input was from an exact polycube.
    pub deviation: Deviation,
    /// Distortion of the map from the shape to the polycube, before and after. Without a shape the polycube as it came
    /// stands for it.
    pub distortion: Option<[Distortion; 2]>,
    /// What was not possible or not as asked, in plain words.
    pub notes: Vec<String>,
}

impl Report {
    /// What is known before the mesh is morphed.
    fn new(polycube: &Polycube, alignment: &Alignment, strategy: Strategy, scale: f64) -> Self {
        let notes = match alignment.broken.len() {
            0 => Vec::new(),
            n => vec![format!("rounding to the lattice made the surface touch or cross itself in {n} places")],
        };
        Self {
            strategy,
            scale,
            valid: alignment.after.is_some(),
            before: alignment.before,
            after: alignment.after,
            rounds: alignment.rounds.clone(),
            front: alignment.front.clone(),
            chosen: alignment.chosen,
            bound: alignment.bound,
            seconds: Seconds::default(),
            max_displacement: max_displacement(polycube, &alignment.levels, scale),
            flipped_elements: 0,
            flipped: Flipped::default(),
            deviation: polycube.deviation,
            distortion: None,
            notes,
        }
    }

    fn note_displacement(&mut self, options: &Options) {
        let least = self.max_displacement;
        if let Some(limit) = options.max_displacement.filter(|&l| l < least) {
            let note = format!("no result found moves the corners by {limit} or less; this one moves them by {least}");
            self.notes.push(note);
        }
    }

    /// Lists the flipped elements and measures the distortion anew, after `mesh` was changed.
    pub(crate) fn rejudge(&mut self, input: &Input, polycube: &Polycube, mesh: &Mesh) -> Result<()> {
        self.notes.retain(|note| !note.contains(FLIPPED_NOTE));
        if let Some([_, after]) = &mut self.distortion {
            *after = distortion(input.shape.unwrap_or(input.polycube), mesh)?;
        }
        self.list_flipped(polycube, mesh)
    }

    fn list_flipped(&mut self, polycube: &Polycube, mesh: &Mesh) -> Result<()> {
        let labels: Vec<i8> = polycube.labels().map(|l| l.index() as i8).collect();
        self.flipped = flipped(mesh, &labels)?;
        self.flipped_elements = self.flipped.cells.len() + self.flipped.faces.len();
        if self.flipped_elements > 0 {
            let remedy = if self.strategy == Strategy::Best { "; lower the simplicity to move less" } else { "" };
            self.notes.push(format!("{}{FLIPPED_NOTE}{remedy}", self.flipped_elements));
        }
        Ok(())
    }
}

/// What the note about flipped elements says after their number.
const FLIPPED_NOTE: &str = " elements of the morphed mesh are turned over or flat";

/// Time spent in each stage, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Seconds {
    /// Reading the files.
    pub read: f64,
    /// Finding and checking the structure.
    pub structure: f64,
    /// Pairing, aligning, counting.
    pub align: f64,
    /// Morphing the mesh and judging it; for a remeshing, making its map one to one, too.
    pub morph: f64,
    /// Making the meshes of a remeshing.
    #[serde(skip_serializing_if = "is_zero")]
    pub mesh: f64,
    /// Optimising its hexahedra.
    #[serde(skip_serializing_if = "is_zero")]
    pub optimise: f64,
    /// Measuring them.
    #[serde(skip_serializing_if = "is_zero")]
    pub measure: f64,
    /// Writing the files.
    pub write: f64,
    /// All of it.
    pub total: f64,
}

/// Whether no time was spent.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(seconds: &f64) -> bool {
    *seconds == 0.0
}

/// Reads the structure of a valid polycube and checks that shape and labels fit it.
///
/// # Errors
/// The first violation, with the number of others, as [`ErrorKind::Mesh`] or [`ErrorKind::Polycube`];
/// [`ErrorKind::Mismatch`] if shape or labels do not fit.
pub fn read_structure(input: &Input, tolerance: &Tolerance) -> Result<Polycube> {
    read_in_steps(input, tolerance, &Context::default())
}

fn read_in_steps(input: &Input, tolerance: &Tolerance, context: &Context) -> Result<Polycube> {
    context.tick(0.0)?;
    check_fit(input)?;
    let polycube = Polycube::new(input.polycube, input.labels, tolerance).map_err(|v| blame(v, input, tolerance))?;
    context.tick(0.9)?;
    match polycube.overlaps(&input.polycube.points) {
        overlaps if overlaps.is_empty() => Ok(polycube),
        overlaps => Err(first_of(overlaps)),
    }
}

/// Simplifies a polycube (paper, Algorithm 1): finds its structure, aligns its corners on the integer
/// lattice, and morphs the mesh onto the result.
///
/// # Errors
/// See [`read_structure`] and [`align::align`]; [`ErrorKind::Cancelled`].
pub fn simplify(input: &Input, options: &Options, context: &Context) -> Result<Simplified> {
    let start = Instant::now();
    let polycube = read_in_steps(input, &options.tolerance, &context.stage("structure", 0.0, 0.1))?;
    let scale = options.scale.unwrap_or_else(|| default_scale(&polycube, input.polycube));
    let structured = start.elapsed().as_secs_f64();
    let settings = options.alignment(scale, input.polycube);
    let aligning = context.stage("align", 0.1, 0.5);
    let alignment = align::align(&polycube.structure, &polycube.placement, &settings, &aligning)?;
    let aligned = start.elapsed().as_secs_f64();
    let mut report = Report::new(&polycube, &alignment, options.strategy, scale);
    if options.strategy == Strategy::Best && alignment.bound.is_none() {
        let note = "the result is that of Algorithm 1: there are more than 1022 levels on every axis, too many to search, or \
                    fewer patches would have meant more blocks";
        report.notes.push(note.into());
    }
    report.note_displacement(options);
    let morphing = context.stage("morph", 0.5, 1.0);
    let asked = Options { objective: Some(settings.objective), ..options.clone() };
    let result = finish(input, polycube, alignment.levels, report, &asked, &morphing)?;
    let mut result = result.within_distortion(input, &morphing)?;
    let total = start.elapsed().as_secs_f64();
    let stages =
        Seconds { structure: structured, align: aligned - structured, morph: total - aligned, ..Seconds::default() };
    result.report.seconds = Seconds { total, ..stages };
    Ok(result)
}

impl Simplified {
    fn check_input(&self, input: &Input) -> Result<()> {
        check_fit(input)?;
        if input.polycube.points.len() == self.input.vertex_levels.len() {
            return Ok(());
        }
        Err(Error::new(ErrorKind::Mismatch, "this is not the polycube that was simplified"))
    }

    /// The same result at another scale (lattice steps per unit of the input): the same block structure, on a finer or
    /// coarser lattice. `input` must be what was simplified. Much faster than [`simplify`]: the order of the levels is known.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] if `input` has other cells; those of [`align::rescale`]; [`ErrorKind::Cancelled`].
    pub fn rescaled(&self, input: &Input, scale: f64, context: &Context) -> Result<Self> {
        self.check_input(input)?;
        let start = Instant::now();
        let Self { input: polycube, report: old, .. } = self;
        let options = align::Options { strategy: old.strategy, ..self.options.alignment(scale, input.polycube) };
        let aligning = context.stage("align", 0.0, 0.2);
        let levels = align::rescale(&polycube.structure, &polycube.placement, &self.levels, &options, &aligning)?;
        let placement: Vec<f64> = levels.iter().map(|&x| x as f64).collect();
        let arrangement = Arrangement::new(&polycube.structure, &placement);
        let broken = arrangement.conflicts();
        let after = broken.is_empty().then(|| count(&arrangement));
        let (rounds, front, chosen, bound) = (old.rounds.clone(), old.front.clone(), old.chosen, old.bound);
        let alignment = Alignment { levels, before: old.before, after, rounds, broken, front, chosen, bound };
        let aligned = start.elapsed().as_secs_f64();
        let report = Report::new(polycube, &alignment, old.strategy, scale);
        let morphing = context.stage("morph", 0.2, 1.0);
        let mut result = finish(input, polycube.clone(), alignment.levels, report, &self.options, &morphing)?;
        let total = start.elapsed().as_secs_f64();
        result.report.seconds = Seconds { align: aligned, morph: total - aligned, total, ..old.seconds };
        Ok(result)
    }
}

/// Morphs the mesh onto the levels if they are valid, and judges it.
fn finish(
    input: &Input,
    polycube: Polycube,
    levels: Vec<i64>,
    mut report: Report,
    options: &Options,
    context: &Context,
) -> Result<Simplified> {
    let mut result = None;
    if report.valid {
        let placement: Vec<f64> = levels.iter().map(|&x| x as f64).collect();
        let mut mesh = fit(&polycube, input.polycube, &placement, report.scale, &context.stage("morph", 0.0, 0.6))?;
        if report.strategy == Strategy::Best && !options.keep_flipped {
            let shape = input.shape.unwrap_or(input.polycube);
            untangle::untangle(&polycube, &mut mesh, shape, &context.stage("untangle", 0.6, 0.9))?;
        }
        judge(&mut report, input, &polycube, &mesh, &context.stage("judge", 0.9, 1.0))?;
        result = Some(mesh);
    }
    Ok(Simplified { input: polycube, polycube: result, levels, report, options: options.clone() })
}

/// Refuses a shape that does not go with the polycube or has coordinates that are no numbers.
pub(crate) fn check_fit(input: &Input) -> Result<()> {
    let Some(shape) = input.shape else { return Ok(()) };
    if shape.cells != input.polycube.cells || shape.points.len() != input.polycube.points.len() {
        return Err(Error::new(ErrorKind::Mismatch, "shape and polycube do not have the same vertices and cells")
            .remedy("give the pair that one deformation connects, with the same numbering"));
    }
    let bad = (0..).zip(&shape.points).find(|(_, p)| !p.iter().all(|x| x.is_finite()));
    let Some((vertex, _)) = bad else { return Ok(()) };
    Err(Error::new(ErrorKind::Mesh, "a coordinate of the shape is not a finite number")
        .at(Place::Vertex(vertex))
        .remedy("repair or remove the vertex and export the mesh again"))
}

/// The objective where none is given: padded blocks for a volume, patches for a surface.
pub fn default_objective(mesh: &Mesh) -> Objective {
    if mesh.cells.is_volume() { Objective::BlocksPadded } else { Objective::SurfacePatches }
}

/// 1 for a polycube that lies on the lattice already, else one step per mean mesh edge.
fn default_scale(polycube: &Polycube, mesh: &Mesh) -> f64 {
    if polycube.placement.iter().all(|x| x.fract() == 0.0) {
        return 1.0;
    }
    let surface = &polycube.surface;
    let at = |v: u32| mesh.points[v as usize];
    let lengths = surface.half_edges().map(|h| (at(surface.end(h)) - at(surface.start(h))).norm());
    let (sum, count) = lengths.fold((0.0, 0.0), |(s, n), l| (s + l, n + 1.0));
    count / sum
}

/// The mesh that `polycube` was read from, scaled by `scale` and morphed onto `placement`, which is in scaled units: how
/// [`simplify`] makes its result, for any other placement of the levels.
///
/// # Errors
/// Those of [`morph()`].
pub fn fit(polycube: &Polycube, mesh: &Mesh, placement: &[f64], scale: f64, context: &Context) -> Result<Mesh> {
    let points: Vec<Point> = mesh.points.iter().map(|p| p * scale).collect();
    let mut fitted = Mesh { points, cells: mesh.cells.clone() };
    let fixed = straight_edges(polycube, &fitted.points, placement);
    fitted.points = morph(&fitted, &fixed, context)?;
    Ok(fitted)
}

/// What the morph must meet: corners and facets, and along every polycube edge the vertices stretched evenly between
/// its ends. Left free, they overshoot where triangles are obtuse, and the edge turns back on itself.
fn straight_edges(polycube: &Polycube, points: &[Point], placement: &[f64]) -> Vec<[Option<f64>; 3]> {
    let mut fixed = polycube.prescribed(placement);
    for (edge, chain) in polycube.structure.edges.iter().zip(&polycube.chains) {
        let at = |v: u32| points[v as usize][edge.axis];
        let (low, high) = (at(chain[0]), at(chain[chain.len() - 1]));
        let [from, to] = polycube.structure.ends(edge).map(|l| placement[l as usize]);
        for &v in &chain[1..chain.len() - 1] {
            let part = if low < high { ((at(v) - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 };
            let moved = (from - low) * (1.0 - part) + (to - high) * part;
            fixed[v as usize][edge.axis] = Some((at(v) + moved).clamp(from, to));
        }
    }
    fixed
}

fn max_displacement(polycube: &Polycube, levels: &[i64], scale: f64) -> f64 {
    let after: Vec<f64> = levels.iter().map(|&x| x as f64 / scale).collect();
    polycube.structure.max_displacement(&polycube.placement, &after)
}

/// Counts what the morph turned over and measures the map before and after.
fn judge(report: &mut Report, input: &Input, polycube: &Polycube, mesh: &Mesh, context: &Context) -> Result<()> {
    let from = input.shape.unwrap_or(input.polycube);
    let before = distortion(from, input.polycube)?;
    context.tick(0.3)?;
    let after = distortion(from, mesh)?;
    context.tick(0.6)?;
    report.distortion = Some([before, after]);
    report.list_flipped(polycube, mesh)?;
    context.tick(1.0)
}
