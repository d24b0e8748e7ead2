//! The whole way from a polycube and its shape to a block structure, quadrilaterals and hexahedra.

use super::choose::{Start, choose};
use super::climb::{Rung, finish};
use super::report::{RemeshReport, Stages, cells_of, diagonal, measure};

use super::{Hexes, Layout, Quads, Remesher, Size, untangle};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::optimise::Settings;
use crate::simplify::{self, Input, Simplified, simplify};
use std::time::Instant;

/// How a shape is meshed.
#[derive(Clone, Debug, PartialEq)]
pub struct RemeshOptions {
    /// How the polycube is simplified; [`Strategy::Naive`](crate::align::Strategy::Naive) meshes it as it is. Of `scale` only [`size`](Self::size) is used
    /// where that is given. Unless it bounds the displacement, corners move by a twelfth of the polycube's diagonal at most,
    /// as far as that can be had; and unless it says where on the front or how far, they move less where a coarse mesh of the
    /// fewest blocks is poor, and a note says so.
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
/// as good as can be had. Surface vertices leave the shape, by less than the bound, where quadrilaterals would cut off more.
/// Levels are spaced by the shape, unless the scale is given. Where inverted hexahedra remain or the surface is farther from the shape than asked for, the result
/// is given all the same and the report says so. Without a shape the polycube itself is meshed.
///
/// The result is the same for any number of threads.
///
/// # Errors
/// Those of [`simplify()`], [`scale_for`](super::scale_for()), [`Remesher`] and [`optimise`](crate::optimise::optimise()); [`ErrorKind::Option`] for a bound on the
/// Hausdorff distance that is not positive; [`ErrorKind::Cancelled`].
pub fn remesh(input: &Input, options: &RemeshOptions, context: &Context) -> Result<Remeshed> {
    if options.max_hausdorff.is_nan() || options.max_hausdorff <= 0.0 {
        let message = format!("{} is no bound for a distance", options.max_hausdorff);
        return Err(Error::new(ErrorKind::Option, message).remedy("give a positive number"));
    }
    let start = Instant::now();
    let seconds = || start.elapsed().as_secs_f64();
    let found = simplify(input, &simplifying(input, options), &context.stage("simplify", 0.0, 0.2))?;
    let mut stages = Stages { simplify: seconds(), ..Stages::default() };
    let spent = found.report.seconds;
    let Start { mut simplified, map, shape: fine, rung } =
        choose(input, found, options, &context.stage("map", 0.2, 0.5))?;
    stages.map = seconds() - stages.simplify;
    simplified.report.seconds = spent;
    let shape = input.shape.unwrap_or(input.polycube);
    let meshed = mesh(&map, &fine, rung, options, &mut stages, &context.stage("mesh", 0.5, 0.9))?;
    untangle(&mut simplified, input, &context.stage("map", 0.9, 0.95))?;
    let report = measure(&simplified, &meshed, shape, options, stages, &context.stage("measure", 0.95, 1.0))?;
    let Meshed { layout, quads, hexes, scaled_jacobian, .. } = meshed;
    let mut result = Remeshed { simplified, layout, quads, hexes, scaled_jacobian, report };
    result.report.set_seconds(seconds());
    Ok(result)
}

/// How the polycube is simplified: corners stay near unless the options say otherwise.
fn simplifying(input: &Input, options: &RemeshOptions) -> simplify::Options {
    let near = diagonal(input.polycube) / 12.0;
    simplify::Options { max_displacement: options.simplify.max_displacement.or(Some(near)), ..options.simplify.clone() }
}

/// Turns flipped tetrahedra of the polycube the right way round, as far as that goes.
fn untangle(simplified: &mut Simplified, input: &Input, context: &Context) -> Result<()> {
    let shape = input.shape.unwrap_or(input.polycube);
    let Simplified { input: polycube, polycube: Some(mesh), report, .. } = simplified else { return Ok(()) };
    if mesh.cells.is_volume() && !report.flipped.cells.is_empty() {
        untangle::volume(polycube, mesh, &shape.points, context)?;
    }
    report.rejudge(input, polycube, mesh)
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

fn mesh(
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
    if options.surface_only {
        let points = remesher.surface_points(&context.stage("mesh", 0.1, 1.0))?.points;
        let layout = remesher.layout(&points, 0)?;
        stages.mesh = start.elapsed().as_secs_f64();
        return Ok(Meshed { layout, quads, hexes: None, scaled_jacobian: Vec::new(), released: 0 });
    }
    let mut hexes = remesher.hexes(options.padding, &context.stage("mesh", 0.1, 0.2))?;
    stages.mesh = start.elapsed().as_secs_f64();
    let released = finish(rung, &remesher, &mut hexes, options, &context.stage("optimise", 0.2, 1.0))?;
    stages.optimise = start.elapsed().as_secs_f64() - stages.mesh;
    quads.mesh.points = remesher.surface_of(&hexes.mesh.points, options.padding);
    let layout = remesher.layout(&hexes.mesh.points, options.padding)?;
    let cells = cells_of(&hexes);
    let scaled_jacobian = cells.iter().map(|c| crate::optimise::scaled_jacobian(&hexes.mesh.points, c)).collect();
    Ok(Meshed { layout, quads, hexes: Some(hexes), scaled_jacobian, released })
}
