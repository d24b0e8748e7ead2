//! The meshes of one candidate, before they are judged.

use crate::context::Context;
use crate::error::Result;
use crate::measure::Quality;
use crate::mesh::Mesh;
use crate::optimise::Settings;
use crate::remesh::fit::{Aim, Fitted, Improved, improve};
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
    /// That of the hexahedra; without them of the quadrilaterals.
    pub(crate) quality: Quality,
    /// How sound the worst of these is.
    pub(crate) soundness: f64,
    /// How far the shape is from the surface; 0 if it is within the bound, as far as could be seen.
    pub(crate) far: f64,
    /// Vertices that had to leave their corners and edges.
    pub(crate) released: usize,
    /// Whether the levels were spaced by the shape.
    pub(crate) spaced: bool,
    /// Of a surface alone: how many triangles of its map are turned over if it is folded; 0 otherwise.
    pub(crate) folded: usize,
}

impl Meshed {
    /// How much of it is the wrong way round: of its cells, and of the map where it is folded.
    pub(crate) fn bad(&self) -> usize {
        self.quality.inverted + self.folded
    }
}

/// The quadrilaterals and patches of a surface alone.
pub(crate) fn mesh_surface(
    map: &LatticeMap,
    shape: &Mesh,
    folded: usize,
    options: &RemeshOptions,
    stages: &mut Stages,
    context: &Context,
) -> Result<Meshed> {
    let start = Instant::now();
    let remesher = Remesher::new(map, shape, &context.stage("mesh", 0.0, 0.1))?;
    let mut quads = remesher.quads(&context.stage("mesh", 0.1, 0.2))?;
    let optimising = Instant::now();
    stages.mesh += (optimising - start).as_secs_f64();
    let fitted = Fitted { mesh: &mut quads.mesh, carriers: &quads.carriers, facets: &remesher.facets() };
    let aim = Aim::Within(options.distance_bound(shape));
    let context = context.stage("optimise", 0.2, 1.0);
    let improved = improve(&remesher.map.polycube, fitted, remesher.shape, &Settings::default(), aim, &context)?;
    stages.optimise += optimising.elapsed().as_secs_f64();
    let Improved { released, far, soundness } = improved;
    let layout = Layout { blocks: None, ..remesher.layout(&remesher.points_of(&quads), 0)? };
    let quality = quads.quality();
    Ok(Meshed { layout, quads, hexes: None, quality, soundness, far, released, spaced: false, folded })
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
    let Improved { released, far, soundness } = finish(
        coarse,
        &remesher,
        &mut hexes,
        options.padding,
        Aim::Within(bound),
        &context.stage("optimise", 0.2, 0.97),
    )?;
    stages.optimise += optimising.elapsed().as_secs_f64();
    let context = context.stage("mesh", 0.97, 1.0);
    context.tick(0.0)?;
    quads.mesh = quads.mesh.with_points(remesher.surface_of(hexes.mesh.points(), options.padding))?;
    context.tick(0.3)?;
    let layout = remesher.layout(hexes.mesh.points(), options.padding)?;
    context.tick(0.7)?;
    let quality = hexes.quality();
    context.tick(1.0)?;
    Ok(Meshed { layout, quads, hexes: Some(hexes), quality, soundness, far, released, spaced: false, folded: 0 })
}
