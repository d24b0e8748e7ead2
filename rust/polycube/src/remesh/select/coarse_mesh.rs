//! A finished mesh of a coarse lattice, from which a finer one starts.

use crate::error::Result;
use crate::measure::Quality;
use crate::mesh::Point;
use crate::remesh::lattice::{Grid, Keys, Padding, rank};
use crate::remesh::map::{LevelInterpolation, interpolate};
use crate::remesh::mesher::{Hexes, Remesher};

/// The part that a padding layer keeps of its thickness on a finer lattice, where it has less to keep away.
const THINNER: f64 = 0.6;
/// A slab counts as no shorter than this part of the mean step, and no longer than one over it.
const LEAST: f64 = 0.2;

/// A finished mesh of a coarse lattice.
pub(crate) struct CoarseMesh {
    grid: Grid,
    pub(crate) levels: Vec<i64>,
    /// The lattice's vertices; those on its surface under each padding layer in turn, the outermost last.
    layers: Vec<Vec<Point>>,
    /// Its scaled Jacobians.
    pub(crate) quality: Quality,
}

impl CoarseMesh {
    /// Keeps what a finer mesh can start from.
    pub(crate) fn new(remesher: Remesher, hexes: &Hexes, layers: usize) -> Self {
        let (grid, levels) = (remesher.grid, remesher.map.levels.clone());
        let padding = Padding::new(&grid, layers);
        let points = hexes.mesh.points();
        let mut lattice = points[..grid.vertices.len()].to_vec();
        let mut all = vec![lattice.clone()];
        for layer in 1..=layers {
            for &v in &padding.ring {
                lattice[v as usize] = points[padding.number(&grid, v, layer) as usize];
            }
            all.push(lattice.clone());
        }
        Self { grid, levels, layers: all, quality: hexes.quality() }
    }

    /// How long the lattice edges along each axis are in each layer of cells, from the lowest: root mean squares.
    pub(crate) fn lengths(&self) -> [Vec<f64>; 3] {
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

    /// A finer mesh with its vertices placed as in this one.
    ///
    /// # Errors
    /// Those of [`interpolate`].
    pub(crate) fn started(&self, remesher: &Remesher, hexes: &Hexes) -> Result<Hexes> {
        let grid = &remesher.grid;
        let between = LevelInterpolation::new(remesher.map.structure(), &remesher.map.levels, &self.levels);
        let layers = self.layers.len() - 1;
        let padding = Padding::new(grid, layers);
        let place = |v: u32, layer: usize| {
            interpolate(&self.grid, &self.layers[layer], between.apply(grid.position(v as usize)))
        };
        let mut points = hexes.mesh.points().to_vec();
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
        let mut started = hexes.clone();
        started.mesh.points_mut().copy_from_slice(&points);
        Ok(started)
    }
}

/// Keeps odd lengths within bounds and replaces unknown ones by the mean.
fn tamed(lengths: [Vec<f64>; 3]) -> [Vec<f64>; 3] {
    let known = || lengths.iter().flatten().copied().filter(|l| *l > 0.0);
    let mean = known().sum::<f64>() / known().count().max(1) as f64;
    let tame = |l: f64| if l > 0.0 { l.clamp(LEAST * mean, mean / LEAST) } else { mean };
    lengths.map(|own| own.into_iter().map(tame).collect())
}
