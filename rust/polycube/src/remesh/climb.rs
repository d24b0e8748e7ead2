//! From coarse lattices to fine ones: what a coarse mesh costs little to find is where a fine one starts.

use super::grid::Grid;
use super::improve::{Aim, Improved, improve, inverted};
use super::interior::interpolate;
use super::keys::{Keys, rank};
use super::padding::Padding;
use super::pipeline::RemeshOptions;
use super::report::{cells_of, worst};
use super::spacing::{spaced, tamed};
use super::start::is_flexible;
use super::warp::{Warp, on_levels};
use super::{Hexes, Remesher, count_hexes};
use crate::align::{self, Options, Strategy};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Mesh, Point};
use crate::optimise::{Scope, Settings, scaled_jacobian};
use crate::simplify::Simplified;

/// A mesh of fewer hexahedra needs none coarser to start from,
const FEW: u64 = 600;
/// nor does one of fewer a block: the shape of its surface is lost.
const FEW_PER_BLOCK: usize = 16;
/// A lattice of half the levels must have no more than this share of the hexahedra, or it is no help.
const FEWER: f64 = 0.6;
/// The part that a padding layer keeps of its thickness on a finer lattice, where it has less to keep away.
const THINNER: f64 = 0.6;

/// The map onto coarser and coarser lattices of the same order of levels, each about half as fine: the coarsest first, `map`
/// itself left out. The points between levels are moved in proportion.
///
/// # Errors
/// Those of [`align::rescale`].
fn coarser(map: &Simplified, padding: usize, context: &Context) -> Result<Vec<Simplified>> {
    let structure = &map.input.structure;
    let halving = Options { strategy: Strategy::Paper, scale: 0.5, ..Options::default() };
    let blocks = map.report.after.map_or(0, |counts| counts.blocks_padded);
    let mut maps: Vec<Simplified> = Vec::new();
    loop {
        let fine = maps.last().unwrap_or(map);
        let count = count_hexes(structure, &fine.levels, padding);
        if count <= FEW.max((FEW_PER_BLOCK * blocks) as u64) {
            break;
        }
        let targets: Vec<f64> = fine.levels.iter().map(|&x| x as f64).collect();
        let levels = align::rescale(structure, &targets, &fine.levels, &halving, context)?;
        if count_hexes(structure, &levels, padding) as f64 > FEWER * count as f64 {
            break;
        }
        maps.push(on_levels(fine, levels));
    }
    maps.reverse();
    Ok(maps)
}

/// A finished mesh of a coarse lattice.
pub(super) struct Rung {
    grid: Grid,
    pub(super) levels: Vec<i64>,
    /// The lattice's vertices; those on its surface under each padding layer in turn, the outermost last.
    layers: Vec<Vec<Point>>,
    /// Its worst scaled Jacobian.
    pub(super) worst: f64,
    /// Its mean scaled Jacobian.
    pub(super) average: f64,
}

impl Rung {
    /// Keeps what a finer mesh can start from.
    pub(super) fn new(remesher: Remesher, hexes: &Hexes, layers: usize) -> Self {
        let (grid, levels) = (remesher.grid, remesher.simplified.levels.clone());
        let padding = Padding::new(&grid, layers);
        let points = &hexes.mesh.points;
        let mut lattice = points[..grid.vertices.len()].to_vec();
        let mut all = vec![lattice.clone()];
        for layer in 1..=layers {
            for &v in &padding.ring {
                lattice[v as usize] = points[padding.number(&grid, v, layer) as usize];
            }
            all.push(lattice.clone());
        }
        Self { grid, levels, layers: all, worst: worst(hexes), average: average(hexes) }
    }

    /// How long the lattice edges along each axis are in each layer of cells, from the lowest: root mean squares.
    pub(super) fn lengths(&self) -> [Vec<f64>; 3] {
        let planes = |axis: usize| (0..self.grid.vertices.len()).map(move |v| self.grid.position(v)[axis] as i64);
        let ends = [0, 1, 2].map(|a| [planes(a).min().unwrap_or(0), planes(a).max().unwrap_or(0)]);
        let mut sums = ends.map(|[low, high]| vec![[0.0; 2]; (high - low) as usize]);
        let points = &self.layers[self.layers.len() - 1];
        for (v, &key) in self.grid.vertices.iter().enumerate() {
            for axis in 0..3 {
                let Some(next) = rank(&self.grid.vertices, key + Keys::step(axis)) else { continue };
                let layer = (self.grid.position(v)[axis] as i64 - ends[axis][0]) as usize;
                let sum = &mut sums[axis][layer];
                sum[0] += (points[next as usize] - points[v]).norm_squared();
                sum[1] += 1.0;
            }
        }
        tamed(sums.map(|own| own.into_iter().map(|[sum, n]| if n > 0.0 { (sum / n).sqrt() } else { 0.0 }).collect()))
    }

    /// Places the vertices of a finer mesh as in this one.
    ///
    /// # Errors
    /// Those of [`interpolate`].
    pub(super) fn start(&self, remesher: &Remesher, hexes: &mut Hexes) -> Result<()> {
        let grid = &remesher.grid;
        let warp = Warp::new(remesher.simplified, &remesher.simplified.levels, &self.levels);
        let layers = self.layers.len() - 1;
        let padding = Padding::new(grid, layers);
        let place =
            |v: u32, layer: usize| interpolate(&self.grid, &self.layers[layer], warp.apply(grid.position(v as usize)));
        let mut points = hexes.mesh.points.clone();
        for v in 0..grid.vertices.len() as u32 {
            points[v as usize] = place(v, 0)?;
        }
        for &v in &padding.ring {
            let outermost = place(v, layers)?;
            for layer in 0..=layers {
                let at = place(v, layer)?;
                points[padding.number(grid, v, layer) as usize] = outermost + (at - outermost) * THINNER;
            }
        }
        hexes.mesh.points = points;
        Ok(())
    }
}

/// The mean scaled Jacobian of a mesh.
fn average(hexes: &Hexes) -> f64 {
    let cells = cells_of(hexes);
    cells.iter().map(|c| scaled_jacobian(&hexes.mesh.points, c)).sum::<f64>() / cells.len().max(1) as f64
}

/// The finished mesh of a lattice about half as fine, which started from one half as fine again, and so on; nothing if there
/// is none. `aim` says how hard to try.
///
/// # Errors
/// Those of [`Remesher`] and [`optimise`](crate::optimise::optimise()).
pub(super) fn climb(
    map: &Simplified,
    shape: &Mesh,
    options: &RemeshOptions,
    aim: Aim,
    context: &Context,
) -> Result<Option<Rung>> {
    let maps = coarser(map, options.padding, context)?;
    let mut rung: Option<Rung> = None;
    for (i, map) in maps.iter().enumerate() {
        let [from, to] = [i, i + 1].map(|k| k as f64 / maps.len() as f64);
        let context = context.stage("map", from, to);
        let map = match &rung {
            Some(rung) if is_flexible(options) => on_levels(map, spaced(map, rung, options.padding, &context)?),
            _ => map.clone(),
        };
        let remesher = Remesher::new(&map, shape, &context)?;
        let mut hexes = remesher.hexes(options.padding, &context)?;
        finish(rung, &remesher, &mut hexes, options, aim, &context)?;
        rung = Some(Rung::new(remesher, &hexes, options.padding));
    }
    Ok(rung)
}

/// Improves `hexes`, starting from the mesh of a coarser lattice; where that leaves hexahedra inverted, as they are; and then by moving
/// all of the mesh to untangle it, which takes longer, unless it is only a trial. The one with the fewest inverted hexahedra is kept.
///
/// # Errors
/// Those of [`optimise`](crate::optimise::optimise()).
pub(super) fn finish(
    rung: Option<Rung>,
    remesher: &Remesher,
    hexes: &mut Hexes,
    options: &RemeshOptions,
    aim: Aim,
    context: &Context,
) -> Result<Improved> {
    let rung = rung.filter(|r| r.worst > 0.0);
    let started = rung.as_ref().map(|rung| (Some(rung), Scope::NearFirst));
    let ways = [started, Some((None, Scope::NearFirst)), (aim != Aim::Trial).then_some((None, Scope::Whole))];
    let mut best: Option<(usize, Hexes, Improved)> = None;
    for (rung, scope) in ways.into_iter().flatten() {
        let mut tried = hexes.clone();
        rung.map_or(Ok(()), |rung| rung.start(remesher, &mut tried))?;
        let settings = Settings { scope, ..options.optimise.clone() };
        let improved = improve(remesher.simplified, &mut tried, remesher.shape, &settings, aim, context)?;
        let inverted = inverted(&tried);
        if best.as_ref().is_none_or(|best| inverted < best.0) {
            best = Some((inverted, tried, improved));
        }
        if inverted == 0 {
            break;
        }
    }
    let (_, found, improved) = best.ok_or_else(|| Error::new(ErrorKind::Internal, "there was nothing to improve"))?;
    *hexes = found;
    Ok(improved)
}
