//! What a mesh is made from: the polycube at the wanted size, the map of its surface, and a coarser mesh.

use super::coarse_mesh::CoarseMesh;
use super::multilevel::mesh_coarsely;
use super::spacing::spaced;
use crate::align::Strategy;
use crate::align::ranks::Ranks;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Mesh;
use crate::remesh::fit::Aim;
use crate::remesh::lattice::{Size, check_count, scale_for};
use crate::remesh::map::{LatticeMap, LevelInterpolation, Refined, untangle_surface};
use crate::remesh::options::RemeshOptions;
use crate::simplify::{Input, Note, Simplified};
use std::sync::Arc;

/// What a mesh is made from.
pub(crate) struct Candidate {
    /// The polycube at the wanted size.
    pub(crate) simplified: Simplified,
    /// Its mesh with a better map of the surface, refined for meshing.
    pub(crate) map: LatticeMap,
    /// The shape that goes with it.
    pub(crate) shape: Mesh,
    /// A coarser mesh to start from.
    pub(crate) coarse: Option<CoarseMesh>,
    /// Whether the levels were spaced by the shape.
    pub(crate) spaced: bool,
    /// How many triangles of the map of the surface are turned over if it stayed folded; 0 otherwise.
    pub(crate) folded: usize,
    /// Whether no coarse mesh was made because of that.
    hopeless: bool,
}

impl Candidate {
    /// Places the levels of `found` at the wanted size, untangles the map of the surface, and makes the coarse mesh; if
    /// it is one of `several`, only where that looks promising.
    ///
    /// # Errors
    /// Those of [`scale_for`] and [`optimise`](crate::optimise::optimise()).
    pub(crate) fn new(
        input: &Input,
        found: Simplified,
        options: &RemeshOptions,
        several: bool,
        context: &Context,
    ) -> Result<Self> {
        let mut simplified = sized(input, found, options, &context.stage("scale", 0.0, 0.2))?;
        let shape = input.shape.unwrap_or(input.polycube);
        let (mut map, shape, folded) = improve_map(&mut simplified, shape, &context.stage("map", 0.2, 0.4))?;
        let mut coarse = None;
        let hopeless = folded > 0 && several;
        let blocks = simplified.report.after.map_or(0, |counts| counts.blocks_padded);
        let bound = options.distance_bound(&shape);
        let aim = if several { Aim::Trial(bound) } else { Aim::Coarse(bound) };
        if !options.surface_only && !hopeless {
            coarse = mesh_coarsely(&map, blocks, &shape, options, aim, &context.stage("map", 0.4, 1.0))?;
        }
        let flexible = coarse.as_ref().filter(|_| options.has_flexible_levels());
        let is_spaced = flexible.is_some();
        if let Some(coarse) = flexible {
            let levels = spaced(&map, coarse, options.padding, context)?;
            put_on(&mut simplified, &levels);
            map = map.on_levels(levels);
        }
        Ok(Self { simplified, map, shape, coarse, spaced: is_spaced, folded, hopeless })
    }

    /// The worst scaled Jacobian of the coarse mesh, if there is one; as bad as can be where the map is folded.
    pub(crate) fn worst(&self) -> Option<f64> {
        self.coarse.as_ref().map(|c| c.quality.worst).or(self.hopeless.then_some(-1.0))
    }
}

/// The simplified polycube at the wanted size, which can be meshed.
fn sized(input: &Input, found: Simplified, options: &RemeshOptions, context: &Context) -> Result<Simplified> {
    let result = placed(input, found, options, context)?;
    let padding = if options.surface_only { 0 } else { options.padding };
    check_count(&result, padding, options.surface_only || matches!(options.size, Some(Size::Hexes(_))))?;
    Ok(result)
}

fn placed(input: &Input, found: Simplified, options: &RemeshOptions, context: &Context) -> Result<Simplified> {
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
    let ranks = Ranks::new(&found.input.structure, &found.input.placement);
    found.levels = ranks.of_level.into_iter().map(i64::from).collect();
    found.report.strategy = Strategy::Paper;
    let scale = match options.size {
        Some(size) => scale_for(input, &found, size, options.padding, context)?,
        None => scale,
    };
    let mut result = found.rescaled(input, scale, context)?;
    result.report.strategy = options.simplify.strategy;
    result.report.notes.push(Note::InOrder);
    Ok(result)
}

/// Untangles the map of the surface. What is returned has a better one, refined for meshing, and the shape to go with
/// it; and how many triangles are turned over if it is folded all the same.
fn improve_map(simplified: &mut Simplified, shape: &Mesh, context: &Context) -> Result<(LatticeMap, Mesh, usize)> {
    let mut map = LatticeMap::new(simplified)?;
    let mut refined = Refined::new(&map.polycube, map.mesh.points(), shape.points())?;
    let folded = untangle_surface(&mut refined, context)?;
    if let Some(mesh) = simplified.polycube.as_mut().filter(|mesh| !mesh.cells().is_volume()) {
        mesh.points_mut().iter_mut().zip(&refined.points).for_each(|(to, from)| *to = *from);
    }
    let [mesh, shape] = refined.meshes()?;
    (map.polycube, map.mesh) = (Arc::new(refined.polycube), mesh);
    Ok((map, shape, folded))
}

/// Moves a simplified polycube onto other levels in the same order.
fn put_on(simplified: &mut Simplified, levels: &[i64]) {
    let between = LevelInterpolation::new(&simplified.input.structure, &simplified.levels, levels);
    if let Some(mesh) = &mut simplified.polycube {
        between.move_all(mesh.points_mut());
    }
    simplified.levels = levels.to_vec();
}
