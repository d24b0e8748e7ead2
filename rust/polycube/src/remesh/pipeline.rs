//! The whole way from a polycube and its shape to a block structure, quadrilaterals and hexahedra.

use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::layout::Objective;
use crate::measure::GOOD;
use crate::measure::hausdorff::diagonal;
use crate::mesh::Mesh;
use crate::remesh::meshed::{Meshed, mesh_surface, mesh_volume};
use crate::remesh::mesher::{Hexes, Layout, Quads};
use crate::remesh::options::RemeshOptions;
use crate::remesh::report::{RemeshReport, measure};
use crate::remesh::select::{Candidate, Candidates, Failure, TriedPoint, Verdict, WORTH, alternatives};
use crate::remesh::stages::Stages;
use crate::repair::Repaired;
use crate::simplify::{self, Input, Simplified, simplify, untangle_morphed};
use std::time::Instant;

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
    /// What was done and how good it is.
    pub report: RemeshReport,
}

/// Simplifies a polycube and meshes its shape with the block structure found (paper, sections 6 and 7).
///
/// The map from shape to polycube is made one to one on every facet; the lattice of the wanted size is mapped back
/// through it, padded, and optimised with the surface sliding on the shape until no hexahedron is inverted and the
/// worst is as good as can be had; where the mesh cuts off more of the shape than the bound, surface vertices are put
/// there. Of a surface alone the quadrilaterals are optimised the same way. Levels are spaced by the shape, unless the
/// scale is given. Where inverted hexahedra remain or the surface is farther from the shape than asked for, the result
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
/// assert_eq!(hexes.quality().inverted, 0);
/// assert_eq!(meshes.report.inverted, 0);
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// Those of [`simplify()`], `scale_for`, `Remesher` and
/// `optimise`; [`ErrorKind::Option`] for any option out of its range, before anything is
/// done, and for a size that takes more hexahedra than 536,870,911; [`ErrorKind::Cancelled`].
pub fn remesh(input: &Input, options: &RemeshOptions, context: &Context) -> Result<Remeshed> {
    options.check()?;
    let start = Instant::now();
    let seconds = || start.elapsed().as_secs_f64();
    let repaired = options.simplify.repaired(input);
    let input = &repaired.as_ref().map_or(*input, Repaired::input);
    let found = simplify(input, &simplifying(options), &context.stage("simplify", 0.0, 0.2))?;
    let mut stages = Stages { simplify: seconds(), ..Stages::default() };
    let spent = found.report.seconds;
    let mut candidates = Candidates::new(input, found, options, &context.stage("map", 0.2, 0.5))?;
    stages.map = seconds() - stages.simplify;
    let (mut simplified, meshed) = best(&mut candidates, options, &mut stages, &context.stage("mesh", 0.5, 0.9))?;
    candidates.explain(&mut simplified);
    let tried = candidates.tried(&simplified);
    simplified.report.notes.extend(alternatives(&tried, options.cells()));
    simplified.report.seconds = spent;
    let shape = input.shape.unwrap_or(input.polycube);
    untangle_volume(&mut simplified, input, &context.stage("map", 0.9, 0.95))?;
    simplified.report.note_repairs(Repaired::repairs(&repaired));
    let measured = measure(&simplified, &meshed, shape, options, stages, &context.stage("measure", 0.95, 1.0))?;
    let report = RemeshReport { tried, ..measured };
    let Meshed { layout, quads, hexes, .. } = meshed;
    let mut result = Remeshed { simplified, layout, quads, hexes, report };
    result.report.set_seconds(seconds());
    Ok(result)
}

/// How the polycube is simplified: for hexahedra it is padded blocks that count, whatever the cells of the polycube
/// are.
fn simplifying(options: &RemeshOptions) -> simplify::SimplifyOptions {
    let blocks = (!options.surface_only).then_some(Objective::BlocksPadded);
    let objective = options.simplify.objective.or(blocks);
    simplify::SimplifyOptions { objective, keep_flipped: true, ..options.simplify.clone() }
}

/// Where no mesh is near enough to the shape, the nearest is taken of those with at most this many times the blocks of
/// the first.
const HARDLY_MORE: f64 = 1.25;

/// A mesh and what it is of.
struct Made {
    simplified: Simplified,
    meshed: Meshed,
}

impl Made {
    /// What is wrong with it. A worst hexahedron that lacks little to be good is not worth another mesh.
    fn failed(&self) -> Option<Failure> {
        match &self.meshed {
            Meshed { folded, .. } if *folded > 0 => Some(Failure::Folded),
            meshed if meshed.bad() > 0 => Some(Failure::Inverted),
            Meshed { far, .. } if *far > 0.0 => Some(Failure::Far),
            Meshed { soundness, .. } if *soundness < GOOD - WORTH => Some(Failure::Poor),
            _ => None,
        }
    }

    /// What the report says of it, if it is a point of a front.
    fn tried(&self, shape: &Mesh) -> Option<TriedPoint> {
        let Meshed { hexes, quality, far, .. } = &self.meshed;
        Some(TriedPoint {
            failed: self.failed(),
            min_sj: hexes.as_ref().map(|_| quality.worst),
            avg_sj: hexes.as_ref().map(|_| quality.mean),
            hausdorff_percent: (*far > 0.0).then(|| 100.0 * far / diagonal(shape)),
            ..TriedPoint::new(&self.simplified, hexes.is_none())?
        })
    }

    fn blocks(&self) -> usize {
        self.simplified.report.after.map_or(0, |counts| counts.blocks_padded)
    }

    /// Least soundness and average scaled Jacobian in sum, the least as far as it is not good.
    fn value(&self) -> f64 {
        self.meshed.soundness.min(GOOD) + self.meshed.quality.mean
    }

    /// Whether it is rather to be had than `other`: one with fewer inverted hexahedra; then one as near to the shape as
    /// asked for, or else the nearest of those with hardly more than the `fewest` blocks; then the one with fewer
    /// blocks, unless the other is clearly better.
    fn is_better(&self, other: &Self, fewest: usize) -> bool {
        let is_many = |made: &Self| made.meshed.far > 0.0 && made.blocks() as f64 > HARDLY_MORE * fewest as f64;
        let rank = |made: &Self| (made.meshed.bad(), made.meshed.far > 0.0, is_many(made), made.meshed.far);
        let more = if self.blocks() > other.blocks() { WORTH } else { -WORTH };
        rank(self) < rank(other) || rank(self) == rank(other) && self.value() > other.value() + more
    }
}

/// The first mesh that is uninverted, good, and as near to the shape as asked for, else the best of those that were
/// tried.
fn best(
    candidates: &mut Candidates,
    options: &RemeshOptions,
    stages: &mut Stages,
    context: &Context,
) -> Result<(Simplified, Meshed)> {
    let mut best: Option<Made> = None;
    let mut fewest = None;
    let mut last = None;
    // Each takes half of the progress that is left: mostly there is one.
    let mut done = 0.0;
    while let Some(candidate) = candidates.next(last, &context.stage("mesh", done, done))? {
        let Candidate { simplified, map, shape, coarse, spaced, folded, .. } = candidate;
        let share = (1.0 - done) / 2.0;
        let context = context.stage("mesh", done, done + share);
        let mut meshed = if options.surface_only {
            mesh_surface(&map, &shape, folded, options, stages, &context)?
        } else {
            mesh_volume(&map, &shape, coarse, options, stages, &context)?
        };
        meshed.spaced = spaced;
        done += share;
        let made = Made { simplified, meshed };
        let (at, failed) = (made.simplified.report.chosen.unwrap_or(0), made.failed());
        let far = made.meshed.far / options.distance_bound(&shape);
        candidates.note(made.tried(&shape));
        let fewest = *fewest.get_or_insert(made.blocks());
        if best.as_ref().is_none_or(|best| made.is_better(best, fewest)) {
            best = Some(made);
        } else if failed == Some(Failure::Poor) && best.as_ref().is_some_and(|best| best.failed() == failed) {
            break;
        }
        last = Some(Verdict { at, failed, far, inverted: best.as_ref().is_some_and(|b| b.meshed.bad() > 0) });
    }
    let found = best.map(|Made { simplified, meshed }| (simplified, meshed));
    found.ok_or_else(|| Error::new(ErrorKind::Internal, "there was nothing to mesh"))
}

/// Turns flipped cells of a volume's polycube the right way round, as far as that goes.
fn untangle_volume(simplified: &mut Simplified, input: &Input, context: &Context) -> Result<()> {
    let shape = input.shape.unwrap_or(input.polycube);
    let Simplified { input: polycube, polycube: Some(mesh), report, .. } = simplified else { return Ok(()) };
    if mesh.cells().is_volume() && !report.flipped.cells.is_empty() {
        untangle_morphed(polycube, mesh, shape, context)?;
    }
    context.tick(1.0)?;
    report.rejudge(input, polycube, mesh)
}
