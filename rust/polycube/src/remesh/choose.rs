//! Which of the simplified polycubes is meshed: the coarsest one that a quick coarse mesh finds good.

use super::climb::{Rung, climb};
use super::pipeline::RemeshOptions;
use super::refine::Refined;
use super::spacing::spaced;
use super::warp::on_levels;
use super::{Size, scale_for, untangle};
use crate::align::Strategy;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Mesh;
use crate::simplify::{Input, Simplified};

/// A coarse mesh whose worst scaled Jacobian is below this is poor.
const GOOD: f64 = 0.5;
/// A mesh with more blocks must be better by this to be taken instead of another poor one.
const WORTH: f64 = 0.05;
/// Points of the front that are tried after a poor one.
const TRIES: usize = 2;

/// What a mesh is made from.
pub(super) struct Start {
    /// The polycube at the wanted size.
    pub(super) simplified: Simplified,
    /// The same with a better map of the surface, refined for meshing.
    pub(super) map: Simplified,
    /// The shape that goes with it.
    pub(super) shape: Mesh,
    /// A coarser mesh to start from.
    pub(super) rung: Option<Rung>,
}

/// The polycube `found`, or one with more blocks from the same front if its coarse mesh is poor and theirs is better. The choice
/// is left to the options where they say which point of the front, how far corners may move, or what must hold.
///
/// # Errors
/// Those of [`scale_for`], [`Simplified::at`], and [`optimise`](crate::optimise::optimise()).
pub(super) fn choose(input: &Input, found: Simplified, options: &RemeshOptions, context: &Context) -> Result<Start> {
    let mut others = others(&found, options);
    let share = 1.0 / (others.len() + 1) as f64;
    let first = found.clone();
    let mut best = Start::new(input, found, options, &context.stage("map", 0.0, share))?;
    let mut tried = 0;
    while best.quality() < GOOD && !others.is_empty() {
        tried += 1;
        let own = context.stage("map", tried as f64 * share, (tried + 1) as f64 * share);
        let other = first.at_index(input, others.remove(0), &own)?;
        let other = Start::new(input, other, options, &own)?;
        if other.quality() > best.quality() + WORTH {
            best = other;
        }
    }
    best.explain(&first);
    Ok(best)
}

/// The points of the front to try after the one chosen: halfway to the least displacement, and that.
fn others(found: &Simplified, options: &RemeshOptions) -> Vec<usize> {
    let wanted = &options.simplify;
    let told = wanted.simplicity.is_some() || wanted.max_displacement.is_some() || wanted.max_distortion.is_some();
    let Some(chosen) = found.report.chosen.filter(|_| !told && !options.surface_only) else { return Vec::new() };
    let last = found.report.front.len() - 1;
    let mut points: Vec<usize> = (1..=TRIES).map(|k| chosen + (last - chosen) * k / TRIES).collect();
    points.dedup();
    points.retain(|p| *p > chosen);
    points
}

impl Start {
    fn new(input: &Input, found: Simplified, options: &RemeshOptions, context: &Context) -> Result<Self> {
        let mut simplified = sized(input, found, options, &context.stage("scale", 0.0, 0.2))?;
        let shape = input.shape.unwrap_or(input.polycube);
        let (mut map, shape) = improve_map(&mut simplified, shape, &context.stage("map", 0.2, 0.4))?;
        let mut rung = None;
        if !options.surface_only {
            rung = climb(&map, &shape, options, &context.stage("map", 0.4, 1.0))?;
        }
        if let Some(rung) = rung.as_ref().filter(|_| is_flexible(options)) {
            let levels = spaced(&map, rung, options.padding, context)?;
            simplified = on_levels(&simplified, levels.clone());
            map = on_levels(&map, levels);
        }
        Ok(Self { simplified, map, shape, rung })
    }

    /// The worst scaled Jacobian of the coarse mesh; that of boxes where there is none.
    fn quality(&self) -> f64 {
        self.rung.as_ref().map_or(1.0, |r| r.worst)
    }

    /// Says so if it is not the `first` choice.
    fn explain(&mut self, first: &Simplified) {
        let report = &mut self.simplified.report;
        if let (Some(ours), Some(least)) =
            (report.after.filter(|_| report.chosen != first.report.chosen), first.report.after)
        {
            let note = format!(
                "{} blocks instead of {}: fewer made bad hexahedra; a limit on the displacement or a simplicity chooses otherwise",
                ours.blocks_padded, least.blocks_padded
            );
            report.notes.push(note);
        }
    }
}

/// Whether levels may lie where the shape wants them: not if the scale was given, the polycube is meshed as it is, or some
/// facets have their places.
pub(super) fn is_flexible(options: &RemeshOptions) -> bool {
    let sized = matches!(options.size, Some(Size::Hexes(_) | Size::EdgeLength(_)));
    sized && options.simplify.strategy != Strategy::Naive && options.simplify.guides == Default::default()
}

/// The simplified polycube at the wanted size.
fn sized(input: &Input, found: Simplified, options: &RemeshOptions, context: &Context) -> Result<Simplified> {
    let scale = match options.size {
        Some(size) => scale_for(input, &found, size, options.padding, &context.stage("scale", 0.0, 0.3))?,
        None if found.report.valid => return Ok(found),
        None => found.report.scale,
    };
    let fitted = found.rescaled(input, scale, &context.stage("scale", 0.3, 0.6))?;
    if fitted.report.valid {
        return Ok(fitted);
    }
    in_order(input, found, options, scale, &context.stage("scale", 0.6, 1.0))
}

/// The levels of the input in their own order, where plain rounding broke the polycube.
fn in_order(
    input: &Input,
    mut found: Simplified,
    options: &RemeshOptions,
    scale: f64,
    context: &Context,
) -> Result<Simplified> {
    found.levels = ranks(&found);
    found.report.strategy = Strategy::Paper;
    let scale = match options.size {
        Some(size) => scale_for(input, &found, size, options.padding, context)?,
        None => scale,
    };
    let mut result = found.rescaled(input, scale, context)?;
    result.report.strategy = options.simplify.strategy;
    let note = "rounding to the lattice broke the polycube, so the levels were placed in the order they have";
    result.report.notes.push(note.to_owned());
    Ok(result)
}

/// The number of every level among those of its axis.
fn ranks(found: &Simplified) -> Vec<i64> {
    let placement = &found.input.placement;
    let levels = &found.input.structure.levels;
    let rank = |l: usize| {
        let own = (0..levels.len()).filter(|&k| levels[k].axis == levels[l].axis).map(|k| placement[k]);
        let mut below: Vec<f64> = own.filter(|x| *x < placement[l]).collect();
        below.sort_by(f64::total_cmp);
        below.dedup();
        below.len() as i64
    };
    (0..levels.len()).map(rank).collect()
}

/// Untangles the map of the surface. What is returned has a better one, refined for meshing, and the shape to go with it.
fn improve_map(simplified: &mut Simplified, shape: &Mesh, context: &Context) -> Result<(Simplified, Mesh)> {
    let Simplified { input, polycube: Some(mesh), .. } = simplified else {
        return Ok((simplified.clone(), shape.clone()));
    };
    let mut refined = Refined::new(input, &mesh.points, &shape.points)?;
    untangle::surface(&mut refined, context)?;
    if !mesh.cells.is_volume() {
        mesh.points.iter_mut().zip(&refined.points).for_each(|(to, from)| *to = *from);
    }
    let [polycube, shape] = refined.meshes();
    let mut map = simplified.clone();
    (map.input, map.polycube) = (refined.polycube, Some(polycube));
    Ok((map, shape))
}
