//! The meshes of one candidate, before they are judged.

use crate::context::Context;
use crate::error::Result;
use crate::measure::Quality;
use crate::measure::hausdorff::hausdorff;
use crate::mesh::Mesh;
use crate::remesh::fit::{Aim, Improved};
use crate::remesh::map::LatticeMap;
use crate::remesh::mesher::{Hexes, Layout, Quads, Remesher};
use crate::remesh::options::RemeshOptions;
use crate::remesh::select::{CoarseMesh, finish};
use crate::remesh::stages::Stages;
use std::time::Instant;

/// The meshes before they are judged.
pub(crate) struct Meshed {
    pub(crate) layout: Layout,
    pub(crate) quads: Quads,
    pub(crate) hexes: Option<Hexes>,
    /// That of the hexahedra; of no cell without them.
    pub(crate) quality: Quality,
    /// How sound the worst hexahedron is; 1 without them.
    pub(crate) soundness: f64,
    /// How far the shape is from the surface; 0 if it is within the bound, as far as could be seen, or, without
    /// hexahedra, within the length of a quadrilateral's side.
    pub(crate) far: f64,
    /// Vertices that had to leave their corners and edges.
    pub(crate) released: usize,
    /// Whether the levels were spaced by the shape.
    pub(crate) spaced: bool,
    /// Of a surface alone: how many triangles of its map are turned over if it is folded; 0 otherwise.
    pub(crate) folded: usize,
}

impl Meshed {
    /// How much of it is the wrong way round: of hexahedra, or of the map where there are none.
    pub(crate) fn bad(&self) -> usize {
        self.quality.inverted + self.folded
    }
}

/// The quadrilaterals and patches of a surface alone.
pub(crate) fn mesh_surface(
    map: &LatticeMap,
    shape: &Mesh,
    folded: usize,
    stages: &mut Stages,
    context: &Context,
) -> Result<Meshed> {
    let start = Instant::now();
    let remesher = Remesher::new(map, shape, &context.stage("mesh", 0.0, 0.5))?;
    let quads = remesher.quads(&context.stage("mesh", 0.5, 0.8))?;
    let points = remesher.surface_points(&context.stage("mesh", 0.8, 1.0))?.points;
    let layout = Layout { blocks: None, ..remesher.layout(&points, 0)? };
    // A distorted map may be one to one and still lead quadrilaterals astray.
    let distance = if quads.quality().inverted > 0 { hausdorff(&quads.mesh, shape, context)? } else { 0.0 };
    let far = if distance > quads.mean_side() { distance } else { 0.0 };
    stages.mesh += start.elapsed().as_secs_f64();
    let quality = Quality::new(Vec::new());
    Ok(Meshed { layout, quads, hexes: None, quality, soundness: 1.0, far, released: 0, spaced: false, folded })
}

/// The hexahedra of a solid with the quadrilaterals and patches of their surface.
pub(crate) fn mesh_volume(
    map: &LatticeMap,
    shape: &Mesh,
    coarse: Option<CoarseMesh>,
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
    let bound = options.distance_bound(shape);
    let Improved { released, far } =
        finish(coarse, &remesher, &mut hexes, Aim::Within(bound), &context.stage("optimise", 0.2, 0.97))?;
    stages.optimise += optimising.elapsed().as_secs_f64();
    let context = context.stage("mesh", 0.97, 1.0);
    context.tick(0.0)?;
    quads.mesh = quads.mesh.with_points(remesher.surface_of(hexes.mesh.points(), options.padding))?;
    context.tick(0.3)?;
    let layout = remesher.layout(hexes.mesh.points(), options.padding)?;
    context.tick(0.7)?;
    let (quality, soundness) = (hexes.quality(), hexes.soundness().worst);
    context.tick(1.0)?;
    Ok(Meshed { layout, quads, hexes: Some(hexes), quality, soundness, far, released, spaced: false, folded: 0 })
}
