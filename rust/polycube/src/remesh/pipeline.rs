//! The whole way from a polycube and its shape to a block structure, quadrilaterals and hexahedra.

use super::improve::improve;
use super::refine::Refined;
use super::report::diagonal;
use super::report::{RemeshReport, Stages, cells_of, measure};

use super::{Hexes, Layout, Quads, Remesher, Size, scale_for, untangle};
use crate::align::Strategy;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::optimise::Settings;
use crate::simplify::{self, Input, Simplified, simplify};
use std::time::Instant;

/// How a shape is meshed.
#[derive(Clone, Debug, PartialEq)]
pub struct RemeshOptions {
    /// How the polycube is simplified; [`Strategy::Naive`] meshes it as it is. Of `scale` only [`size`](Self::size) is used
    /// where that is given. Unless it bounds the displacement, corners move by a twelfth of the polycube's diagonal at most,
    /// as far as that can be had: fewer blocks than that allows make bad hexahedra.
    pub simplify: simplify::Options,
    /// How fine the mesh shall be; by default as [`simplify::Options::scale`] says.
    pub size: Option<Size>,
    /// Layers of hexahedra between the polycube and the surface, 0 to [`MAX_PADDING`](super::MAX_PADDING); 1 by default.
    pub padding: usize,
    /// Leave the hexahedra out.
    pub surface_only: bool,
    /// The largest Hausdorff distance to accept, as a part of the bounding box's diagonal; 0.005 by default.
    pub max_hausdorff: f64,
    /// How hard the hexahedra are optimised.
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
/// as good as can be had. Where inverted hexahedra remain or the surface is farther from the shape than asked for, the result
/// is given all the same and the report says so. Without a shape the polycube itself is meshed.
///
/// The result is the same for any number of threads.
///
/// # Errors
/// Those of [`simplify()`], [`scale_for`], [`Remesher`] and [`optimise`](crate::optimise::optimise()); [`ErrorKind::Option`] for a bound on the
/// Hausdorff distance that is not positive; [`ErrorKind::Cancelled`].
pub fn remesh(input: &Input, options: &RemeshOptions, context: &Context) -> Result<Remeshed> {
    if options.max_hausdorff.is_nan() || options.max_hausdorff <= 0.0 {
        let message = format!("{} is no bound for a distance", options.max_hausdorff);
        return Err(Error::new(ErrorKind::Option, message).remedy("give a positive number"));
    }
    let start = Instant::now();
    let mut simplified = sized(input, options, &context.stage("simplify", 0.0, 0.3))?;
    let mut stages = Stages { simplify: start.elapsed().as_secs_f64(), ..Stages::default() };
    let shape = input.shape.unwrap_or(input.polycube);
    let (map, fine) = improve_map(&mut simplified, shape, &context.stage("map", 0.3, 0.4))?;
    stages.map = start.elapsed().as_secs_f64() - stages.simplify;
    let meshed = mesh(&map, &fine, options, &mut stages, &context.stage("mesh", 0.4, 0.9))?;
    let report = measure(&map, &meshed, shape, options, stages, &context.stage("measure", 0.9, 1.0))?;
    let Meshed { layout, quads, hexes, scaled_jacobian, .. } = meshed;
    let mut result = Remeshed { simplified, layout, quads, hexes, scaled_jacobian, report };
    result.report.seconds.total = start.elapsed().as_secs_f64();
    Ok(result)
}

/// The meshes before they are judged.
pub(super) struct Meshed {
    pub(super) layout: Layout,
    pub(super) quads: Quads,
    pub(super) hexes: Option<Hexes>,
    pub(super) scaled_jacobian: Vec<f64>,
    /// Vertices that had to leave their corners and edges.
    pub(super) released: usize,
}

/// The simplified polycube at the wanted size.
fn sized(input: &Input, options: &RemeshOptions, context: &Context) -> Result<Simplified> {
    let near = diagonal(input.polycube) / 12.0;
    let simplifying = simplify::Options {
        max_displacement: options.simplify.max_displacement.or(Some(near)),
        ..options.simplify.clone()
    };
    let found = simplify(input, &simplifying, &context.stage("simplify", 0.0, 0.6))?;
    let scale = match options.size {
        Some(size) => scale_for(input, &found, size, options.padding, &context.stage("scale", 0.6, 0.7))?,
        None if found.report.valid => return Ok(found),
        None => found.report.scale,
    };
    let fitted = found.rescaled(input, scale, &context.stage("scale", 0.7, 0.9))?;
    if fitted.report.valid {
        return Ok(fitted);
    }
    in_order(input, found, options, scale, &context.stage("scale", 0.9, 1.0))
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

/// Untangles the map. What is returned has a better map of the surface, refined for meshing, and the shape to go with it.
fn improve_map(simplified: &mut Simplified, shape: &Mesh, context: &Context) -> Result<(Simplified, Mesh)> {
    let Simplified { input, polycube: Some(mesh), report, .. } = simplified else {
        return Ok((simplified.clone(), shape.clone()));
    };
    if !report.flipped.cells.is_empty() {
        untangle::volume(input, mesh, &shape.points, &context.stage("map", 0.0, 0.5))?;
    }
    let mut refined = Refined::new(input, &mesh.points, &shape.points)?;
    untangle::surface(&mut refined, &context.stage("map", 0.5, 1.0))?;
    if !mesh.cells.is_volume() {
        mesh.points.iter_mut().zip(&refined.points).for_each(|(to, from)| *to = *from);
    }
    report.rejudge(input, mesh)?;
    let [polycube, shape] = refined.meshes();
    let mut map = simplified.clone();
    (map.input, map.polycube) = (refined.polycube, Some(polycube));
    Ok((map, shape))
}

fn mesh(
    map: &Simplified,
    shape: &Mesh,
    options: &RemeshOptions,
    stages: &mut Stages,
    context: &Context,
) -> Result<Meshed> {
    let start = Instant::now();
    let remesher = Remesher::new(map, shape, &context.stage("mesh", 0.0, 0.05))?;
    let mut quads = remesher.quads(&context.stage("mesh", 0.05, 0.1))?;
    if options.surface_only {
        let points = remesher.surface_points(&context.stage("mesh", 0.1, 1.0))?.points;
        let layout = remesher.layout(&points, 0)?;
        stages.mesh = start.elapsed().as_secs_f64();
        return Ok(Meshed { layout, quads, hexes: None, scaled_jacobian: Vec::new(), released: 0 });
    }
    let mut hexes = remesher.hexes(options.padding, &context.stage("mesh", 0.1, 0.2))?;
    stages.mesh = start.elapsed().as_secs_f64();
    let released = improve(map, &mut hexes, &shape.points, &options.optimise, &context.stage("optimise", 0.2, 1.0))?;
    stages.optimise = start.elapsed().as_secs_f64() - stages.mesh;
    quads.mesh.points = remesher.surface_of(&hexes.mesh.points, options.padding);
    let layout = remesher.layout(&hexes.mesh.points, options.padding)?;
    let cells = cells_of(&hexes);
    let scaled_jacobian = cells.iter().map(|c| crate::optimise::scaled_jacobian(&hexes.mesh.points, c)).collect();
    Ok(Meshed { layout, quads, hexes: Some(hexes), scaled_jacobian, released })
}
