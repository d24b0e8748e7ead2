//! The whole method: read the structure, align it, morph the mesh onto the result, and say what happened.

use crate::align::{self, Alignment, Effort, Guides, Round, SolverKind, Strategy};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::layout::{Objective, count};
use crate::map::morph;
use crate::mesh::{Mesh, Point};
use crate::range::Range;
use crate::repair::{Repaired, repair};
use crate::structure::{Arrangement, Edge, Overlaps, Polycube, Tolerance, ascending, placement_of};
use std::time::Instant;

mod compatibility;
mod corner_tetrahedra;
mod diagnosis;
mod front;
mod note;
mod report;
mod state;
#[cfg(test)]
mod tests;
mod untangling;

pub use crate::input::Input;
pub(crate) use compatibility::{Misfit, check_compatible, check_side};
pub(crate) use corner_tetrahedra::CornerTetrahedra;
pub(crate) use diagnosis::remedy;
use diagnosis::{diagnose, first_of_many};
pub use front::Located;
pub use note::{Alternative, Cause, Note};
pub use report::{Seconds, SimplifyReport};
pub(crate) use untangling::untangle_morphed;

/// How it is simplified.
#[derive(Clone, Debug, Default, PartialEq, bitcode::Encode, bitcode::Decode)]
pub struct SimplifyOptions {
    /// How the levels find their places.
    pub strategy: Strategy,
    /// Lattice steps per unit of the polycube. By default such that a lattice step is the mean length of the polycube's
    /// mesh edges; 1 if all levels are integers and the edges are not much longer than 1.
    pub scale: Option<f64>,
    /// Algorithm 1 stops before λ falls below this, from 0 for the coarsest result to 1 for one round.
    pub lambda_min: f64,
    /// Who solves the integer problems.
    pub solver: SolverKind,
    /// Which number the strategy `best` makes small; by default padded blocks for a volume and patches for a surface.
    pub objective: Option<Objective>,
    /// How long the strategy `best` searches.
    pub effort: Effort,
    /// How far the strategy `best` goes on the front between the fewest blocks (1, the default) and the least
    /// displacement (0).
    pub simplicity: Option<f64>,
    /// The farthest that the strategy `best` may move a corner, in units of the polycube; 0 where none shall move.
    pub max_displacement: Option<f64>,
    /// The largest mean angle distortion ([`Distortion::angle`](crate::measure::Distortion::angle), at least 1) that
    /// the map from the shape to the result of the strategy `best` may have; of the front, the point with the fewest
    /// blocks that keeps it is taken.
    pub max_distortion: Option<f64>,
    /// Facets that must not move, that must or must not align, planes of symmetry.
    pub guides: Guides,
    /// Whether the strategy `best`, too, leaves elements as they are that the morph turned over, as the paper does.
    pub keep_flipped: bool,
    /// How far the input may be from a polycube.
    pub tolerance: Tolerance,
    /// Whether the input is taken as it is, without [repairs](crate::repair::repair).
    pub no_repair: bool,
}

impl SimplifyOptions {
    /// Refuses what is out of its range. [`simplify`] does so before anything else.
    ///
    /// # Errors
    /// [`ErrorKind::Option`], which names the field.
    pub fn check(&self) -> Result<()> {
        let given = |option, range: Range, x: Option<f64>| x.map_or(Ok(()), |x| range.check(option, x));
        given("scale", Range::Positive, self.scale)?;
        Range::Within(0.0, 1.0).check("lambda_min", self.lambda_min)?;
        given("simplicity", Range::Within(0.0, 1.0), self.simplicity)?;
        given("max_displacement", Range::AtLeast(0.0), self.max_displacement)?;
        given("max_distortion", Range::AtLeast(1.0), self.max_distortion)?;
        self.tolerance.check()
    }

    /// The input after repairs, where there is something to repair and that is wanted.
    pub(crate) fn repaired(&self, input: &Input) -> Option<Repaired> {
        if self.no_repair { None } else { repair(input) }
    }

    /// The options of the alignment on a lattice with `scale` steps per unit.
    fn alignment(&self, scale: f64) -> align::AlignOptions {
        align::AlignOptions {
            strategy: self.strategy,
            scale,
            lambda_min: self.lambda_min,
            solver: self.solver,
            objective: self.objective.unwrap_or_default(),
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
    pub report: SimplifyReport,
    /// How it was asked to be done, with the objective that was chosen and the guides by their facets.
    pub options: SimplifyOptions,
}

/// Reads the structure of a valid polycube and checks that shape and labels fit it.
///
/// # Errors
/// The first violation, with the number of others, as [`ErrorKind::Mesh`] or [`ErrorKind::Polycube`];
/// [`ErrorKind::Mismatch`] if shape or labels do not fit; [`ErrorKind::Option`] for a number that is no label;
/// [`ErrorKind::Mesh`] for a shape that is mirrored and for coordinates beyond `LARGEST_COORDINATE`;
/// [`ErrorKind::Option`] for a
/// tolerance out of its range.
pub fn read_structure(input: &Input, tolerance: &Tolerance) -> Result<Polycube> {
    tolerance.check()?;
    read_in_steps(input, tolerance, &Context::default())
}

fn read_in_steps(input: &Input, tolerance: &Tolerance, context: &Context) -> Result<Polycube> {
    context.tick(0.0)?;
    check_compatible(input)?;
    let polycube = Polycube::new(input.polycube, input.labels, tolerance).map_err(|v| diagnose(v, input, tolerance))?;
    context.tick(0.9)?;
    let points = input.polycube.points();
    let overlaps = Overlaps::of(&polycube);
    context.tick(0.95)?;
    if let Some(first) = overlaps.first(points) {
        return Err(first_of_many(first, overlaps.len()));
    }
    input.shape.map_or(Ok(()), |shape| check_side(&polycube, points, shape.points()))?;
    context.tick(1.0)?;
    Ok(polycube)
}

/// Simplifies a polycube (paper, Algorithm 1): finds its structure, aligns its corners on the integer lattice, and
/// morphs the mesh onto the result.
///
/// # Errors
/// [`ErrorKind::Option`] for an option out of its range; those of [`read_structure`] and [`align::align`];
/// [`ErrorKind::Cancelled`].
pub fn simplify(input: &Input, options: &SimplifyOptions, context: &Context) -> Result<Simplified> {
    let start = Instant::now();
    options.check()?;
    let repaired = options.repaired(input);
    let input = &repaired.as_ref().map_or(*input, Repaired::input);
    let polycube = read_in_steps(input, &options.tolerance, &context.stage("structure", 0.0, 0.1))?;
    let scale = options.scale.unwrap_or_else(|| default_scale(&polycube, input.polycube));
    let structured = start.elapsed().as_secs_f64();
    let objective = options.objective.unwrap_or_else(|| default_objective(input.polycube));
    let guides = options.guides.by_facets(&polycube)?;
    let options = SimplifyOptions { objective: Some(objective), guides, ..options.clone() };
    let aligning = context.stage("align", 0.1, 0.5);
    let alignment = align::align(&polycube.structure, &polycube.placement, &options.alignment(scale), &aligning)?;
    let aligned = start.elapsed().as_secs_f64();
    let mut report = SimplifyReport::new(&polycube, &alignment, options.strategy, scale);
    report.note_repairs(Repaired::repairs(&repaired));
    if options.strategy == Strategy::Best && alignment.bound.is_none() {
        report.notes.push(Note::Unsearched);
    }
    report.note_displacement(&options, Cause::Search);
    let morphing = context.stage("morph", 0.5, 1.0);
    let result = finish(input, polycube, alignment.levels, report, &options, &morphing)?;
    let mut result = result.within_distortion(input, &morphing)?;
    let total = start.elapsed().as_secs_f64();
    let stages =
        Seconds { structure: structured, align: aligned - structured, morph: total - aligned, ..Seconds::default() };
    result.report.seconds = Seconds { total, ..stages };
    Ok(result)
}

impl Simplified {
    fn check_input(&self, input: &Input) -> Result<()> {
        check_compatible(input)?;
        let Polycube { surface, vertex_levels, .. } = &self.input;
        let polycube = input.polycube;
        let is_own = || polycube.cells().boundary().is_ok_and(|faces| faces == surface.faces());
        if polycube.points().len() != vertex_levels.len() || !is_own() {
            return Err(Error::new(ErrorKind::Mismatch, "this is not the polycube that was simplified")
                .remedy("give the meshes that the result was made from"));
        }
        input.shape.map_or(Ok(()), |shape| check_side(&self.input, polycube.points(), shape.points()))?;
        Ok(())
    }

    /// The same result at another scale (lattice steps per unit of the input): the same block structure, on a finer or
    /// coarser lattice. Its notes name limits that are not kept at this scale, and what was said of the search stays.
    /// `input` must be what was simplified. Much faster than [`simplify`]: the order of the levels is known.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] if `input` has other cells; those of `align::rescale`; [`ErrorKind::Cancelled`].
    pub fn rescaled(&self, input: &Input, scale: f64, context: &Context) -> Result<Self> {
        let repaired = self.options.repaired(input);
        let input = &repaired.as_ref().map_or(*input, Repaired::input);
        self.check_input(input)?;
        let start = Instant::now();
        let Self { input: polycube, report: old, .. } = self;
        let levels = self.levels_at(&polycube.placement, scale, &context.stage("align", 0.0, 0.2))?;
        let placement = placement_of(&levels);
        let arrangement = Arrangement::new(&polycube.structure, &placement);
        let broken = arrangement.conflicts();
        let after = broken.is_empty().then(|| count(&arrangement));
        let (rounds, front, chosen, bound) = (old.rounds.clone(), old.front.clone(), old.chosen, old.bound);
        let alignment = Alignment { levels, before: old.before, after, rounds, broken, front, chosen, bound };
        let aligned = start.elapsed().as_secs_f64();
        let mut report = SimplifyReport::new(polycube, &alignment, old.strategy, scale);
        report.notes.extend(old.notes.iter().filter(|n| n.is_of_order()).cloned());
        report.note_displacement(&self.options, old.cause_of_displacement().unwrap_or(Cause::Scale));
        let morphing = context.stage("morph", 0.2, 1.0);
        let mut result = finish(input, polycube.clone(), alignment.levels, report, &self.options, &morphing)?;
        result.report.note_distortion(&self.options, old.cause_of_distortion().unwrap_or(Cause::Scale));
        let total = start.elapsed().as_secs_f64();
        result.report.seconds = Seconds { align: aligned, morph: total - aligned, total, ..old.seconds };
        Ok(result)
    }
}

impl Simplified {
    /// The levels after a round of Algorithm 1 on the lattice of this result, without any guides.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for a scale that is too large for the lattice; [`ErrorKind::Cancelled`].
    pub fn levels_after(&self, round: &Round, context: &Context) -> Result<Vec<i64>> {
        let Polycube { structure, placement, .. } = &self.input;
        align::rescale(structure, placement, &round.levels, self.report.scale, &Guides::default(), context)
    }

    /// The levels in the same order as near as possible to `targets` times `scale`; where the order does not matter,
    /// `targets` rounded.
    ///
    /// # Errors
    /// Those of [`align::rescale`].
    pub(crate) fn levels_at(&self, targets: &[f64], scale: f64, context: &Context) -> Result<Vec<i64>> {
        let (structure, guides) = (&self.input.structure, &self.options.guides);
        if self.report.strategy == Strategy::Naive {
            return align::round(structure, targets, scale, guides);
        }
        align::rescale(structure, targets, &self.levels, scale, guides, context)
    }
}

/// Morphs the mesh onto the levels if they are valid, and judges it.
fn finish(
    input: &Input,
    polycube: Polycube,
    levels: Vec<i64>,
    mut report: SimplifyReport,
    options: &SimplifyOptions,
    context: &Context,
) -> Result<Simplified> {
    let mut result = None;
    if report.valid {
        let placement = placement_of(&levels);
        let mut mesh = fit(&polycube, input.polycube, &placement, report.scale, &context.stage("morph", 0.0, 0.6))?;
        if report.strategy == Strategy::Best && !options.keep_flipped {
            let shape = input.shape.unwrap_or(input.polycube);
            untangle_morphed(&polycube, &mut mesh, shape, &context.stage("untangle", 0.6, 0.9))?;
        }
        report.judge(input, &polycube, &mesh, &context.stage("judge", 0.9, 1.0))?;
        result = Some(mesh);
    }
    Ok(Simplified { input: polycube, polycube: result, levels, report, options: options.clone() })
}

/// The objective where none is given: padded blocks for a volume, patches for a surface.
pub fn default_objective(mesh: &Mesh) -> Objective {
    if mesh.cells().is_volume() { Objective::BlocksPadded } else { Objective::SurfacePatches }
}

/// Mesh edges of this many units on the mean are too long to be steps of a lattice of units.
const LONG: f64 = 8.0;
/// The same of the shortest.
const ALL_LONG: f64 = 2.0;

/// One step per mean mesh edge; 1 for a polycube that lies on the lattice already, in a mesh about as fine.
fn default_scale(polycube: &Polycube, mesh: &Mesh) -> f64 {
    let surface = &polycube.surface;
    let at = |v: u32| mesh.points()[v as usize];
    let lengths = surface.half_edges().map(|h| (at(surface.end(h)) - at(surface.start(h))).norm());
    let (sum, count, shortest) =
        lengths.fold((0.0, 0.0, f64::INFINITY), |(s, n, least), l| (s + l, n + 1.0, least.min(l)));
    let on_lattice = polycube.placement.iter().all(|x| x.fract() == 0.0);
    if on_lattice && sum < LONG * count && shortest < ALL_LONG { 1.0 } else { count / sum }
}

/// The mesh that `polycube` was read from, scaled by `scale` and morphed onto `placement`, which is in scaled units:
/// how [`simplify`] makes its result, for any other placement of the levels.
///
/// # Errors
/// [`ErrorKind::Mismatch`] for a mesh with another number of vertices, [`ErrorKind::Option`] for a placement that has
/// not one finite number for each level or turns a polycube edge round; those of [`morph()`].
pub fn fit(polycube: &Polycube, mesh: &Mesh, placement: &[f64], scale: f64, context: &Context) -> Result<Mesh> {
    if mesh.points().len() != polycube.vertex_levels.len() {
        return Err(Error::new(ErrorKind::Mismatch, "this is not the mesh that the polycube was read from"));
    }
    check_placement(polycube, placement)?;
    let scaled = mesh.moved(|p| p * scale)?;
    let fixed = straight_edges(polycube, scaled.points(), placement, scale);
    let fitted = morph(&scaled, &fixed, context)?;
    scaled.with_points(fitted)
}

fn check_placement(polycube: &Polycube, placement: &[f64]) -> Result<()> {
    let structure = &polycube.structure;
    if placement.len() != structure.levels.len() || !placement.iter().all(|x| x.is_finite()) {
        let message = format!("a placement is one finite number for each of {} levels", structure.levels.len());
        return Err(Error::new(ErrorKind::Option, message));
    }
    let turned = |edge: &Edge| {
        let [from, to] = structure.ends(edge).map(|l| placement[l as usize]);
        from > to
    };
    let Some(edge) = structure.edges.iter().position(turned) else { return Ok(()) };
    Err(Error::new(ErrorKind::Option, "the placement turns the edge round")
        .at(Place::PolycubeEdge(edge as u32))
        .remedy("keep the upper level of every edge above its lower one"))
}

/// What the morph must meet: corners and facets, and along every polycube edge the vertices, put in order and stretched
/// evenly between its ends. Left free, they overshoot where triangles are obtuse, and the edge turns back on itself.
fn straight_edges(polycube: &Polycube, points: &[Point], placement: &[f64], scale: f64) -> Vec<[Option<f64>; 3]> {
    let mut fixed = polycube.prescribed(placement);
    for (edge, chain) in polycube.structure.edges.iter().zip(&polycube.chains) {
        let mut at: Vec<f64> = chain.iter().map(|&v| points[v as usize][edge.axis]).collect();
        if !at.is_sorted_by(|a, b| a < b) {
            let [low, high] = polycube.structure.ends(edge).map(|l| polycube.placement[l as usize] * scale);
            let inner = ascending(&at[1..at.len() - 1], [low, high]);
            at = [&[low], &inner[..], &[high]].concat();
        }
        let (low, high) = (at[0], at[at.len() - 1]);
        let [from, to] = polycube.structure.ends(edge).map(|l| placement[l as usize]);
        for (&v, x) in chain.iter().zip(&at).take(chain.len() - 1).skip(1) {
            let part = ((x - low) / (high - low)).clamp(0.0, 1.0);
            let moved = (from - low) * (1.0 - part) + (to - high) * part;
            fixed[v as usize][edge.axis] = Some((x + moved).clamp(from, to));
        }
    }
    fixed
}
