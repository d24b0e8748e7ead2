//! From coarse lattices to fine ones: what a coarse mesh costs little to find is where a fine one starts.

use super::coarse_mesh::CoarseMesh;
use super::spacing::spaced;
use crate::align::{self, Guides};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::optimise::{Scope, Settings};
use crate::remesh::fit::{Aim, Fitted, Improved, NEARER, improve};
use crate::remesh::lattice::count_hexes;
use crate::remesh::map::LatticeMap;
use crate::remesh::mesher::{Hexes, Remesher};
use crate::remesh::options::RemeshOptions;

/// A mesh of fewer hexahedra needs none coarser to start from,
const FEW: u64 = 600;
/// nor does one of fewer a block: the shape of its surface is lost.
const FEW_PER_BLOCK: usize = 16;
/// A lattice of half the levels must have no more than this share of the hexahedra, or it is no help.
const FEWER: f64 = 0.6;

/// The map onto coarser and coarser lattices of the same order of levels, each about half as fine: the coarsest first,
/// `map` itself left out. The points between levels are moved in proportion.
///
/// # Errors
/// Those of [`align::rescale`].
fn coarser(map: &LatticeMap, blocks: usize, padding: usize, context: &Context) -> Result<Vec<LatticeMap>> {
    let structure = map.structure();
    let free = Guides::default();
    let mut maps: Vec<LatticeMap> = Vec::new();
    loop {
        let fine = maps.last().unwrap_or(map);
        let count = count_hexes(structure, &fine.levels, padding);
        if count <= FEW.max((FEW_PER_BLOCK * blocks) as u64) {
            break;
        }
        let targets: Vec<f64> = fine.levels.iter().map(|&x| x as f64).collect();
        let levels = align::rescale(structure, &targets, &fine.levels, 0.5, &free, context)?;
        if count_hexes(structure, &levels, padding) as f64 > FEWER * count as f64 {
            break;
        }
        maps.push(fine.on_levels(levels));
    }
    maps.reverse();
    Ok(maps)
}

/// The finished mesh of a lattice about half as fine, which started from one half as fine again, and so on; nothing if
/// there is none. `aim` says how hard to try.
///
/// # Errors
/// Those of [`Remesher`] and [`optimise`](crate::optimise::optimise()).
pub(crate) fn mesh_coarsely(
    map: &LatticeMap,
    blocks: usize,
    shape: &Mesh,
    options: &RemeshOptions,
    aim: Aim,
    context: &Context,
) -> Result<Option<CoarseMesh>> {
    let maps = coarser(map, blocks, options.padding, context)?;
    let mut coarse: Option<CoarseMesh> = None;
    for (i, map) in maps.iter().enumerate() {
        let [from, to] = [i, i + 1].map(|k| k as f64 / maps.len() as f64);
        let context = context.stage("map", from, to);
        let map = match &coarse {
            Some(coarse) if options.has_flexible_levels() => {
                map.on_levels(spaced(map, coarse, options.padding, &context)?)
            }
            _ => map.clone(),
        };
        let remesher = Remesher::new(&map, shape, &context)?;
        let mut hexes = remesher.hexes(options.padding, &context)?;
        finish(coarse, &remesher, &mut hexes, options.padding, aim, &context)?;
        coarse = Some(CoarseMesh::new(remesher, &hexes, options.padding));
    }
    Ok(coarse)
}

/// Where a mesh starts from before it is improved.
enum Start<'a> {
    /// The mesh of a coarser lattice.
    Coarse(&'a CoarseMesh),
    /// The map, with all moving at once to untangle it or not.
    Map(Scope),
    /// The surface by itself, improved first, with the inside solved for.
    Surface,
}

/// Improves `hexes`, starting from the mesh of a coarser lattice; where that leaves hexahedra inverted, as they are;
/// then from their surface, improved first by itself; and then by moving all of the mesh to untangle it, which takes
/// longer, unless it is only a trial. The one with the fewest inverted hexahedra is kept.
///
/// # Errors
/// Those of [`optimise`](crate::optimise::optimise()).
pub(crate) fn finish(
    coarse: Option<CoarseMesh>,
    remesher: &Remesher,
    hexes: &mut Hexes,
    padding: usize,
    aim: Aim,
    context: &Context,
) -> Result<Improved> {
    let coarse = coarse.filter(|r| r.quality.worst > 0.0);
    let mut ways: Vec<Start> = coarse.iter().map(Start::Coarse).collect();
    ways.extend([Start::Map(Scope::NearFirst), Start::Surface]);
    if !matches!(aim, Aim::Trial(_)) {
        ways.push(Start::Map(Scope::Whole));
    }
    let mut best: Option<((usize, f64), Hexes, Improved)> = None;
    for start in ways {
        let must_turn = best.as_ref().is_some_and(|best| best.0.0 > 0);
        let (mut tried, scope) = match start {
            Start::Coarse(coarse) => (coarse.started(remesher, hexes)?, Scope::NearFirst),
            Start::Map(Scope::NearFirst) => (hexes.clone(), Scope::NearFirst),
            // Only what is inverted is worth that.
            _ if !must_turn => break,
            Start::Map(scope) => (hexes.clone(), scope),
            Start::Surface => (with_surface_first(remesher, padding, aim, context)?, Scope::NearFirst),
        };
        let settings = Settings { scope, ..Settings::default() };
        let fitted = Fitted { mesh: &mut tried.mesh, carriers: &tried.carriers, facets: &[] };
        let improved = improve(&remesher.map.polycube, fitted, remesher.shape, &settings, aim, context)?;
        let (inverted, lost) = (tried.quality().inverted, improved.lost(aim));
        if best.as_ref().is_none_or(|&((most, far), ..)| inverted < most || inverted == most && lost < NEARER * far) {
            best = Some(((inverted, lost), tried, improved));
        }
        if inverted == 0 && lost == 0.0 {
            break;
        }
    }
    let (_, found, improved) = best.ok_or_else(|| Error::new(ErrorKind::Internal, "there was nothing to improve"))?;
    *hexes = found;
    Ok(improved)
}

/// Hexahedra within the surface as it is best by itself.
fn with_surface_first(remesher: &Remesher, padding: usize, aim: Aim, context: &Context) -> Result<Hexes> {
    let mut quads = remesher.quads(context)?;
    let fitted = Fitted { mesh: &mut quads.mesh, carriers: &quads.carriers, facets: &remesher.facets() };
    improve(&remesher.map.polycube, fitted, remesher.shape, &Settings::default(), Aim::Coarse(aim.bound()), context)?;
    remesher.hexes_within(&quads, padding, context)
}
