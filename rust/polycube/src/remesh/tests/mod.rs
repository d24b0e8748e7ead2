//! Tests of the whole part, on generated and on real polycubes.

mod carried;
mod counts;
mod on_real_data;
mod pipeline;
mod quality;
mod surface;
mod uv;

use super::Hexes;
use super::lattice::scale_for;
use super::map::LatticeMap;
use super::mesher::Remesher;
use crate::align::Strategy;
use crate::context::Context;
use crate::generate::{Example, example};
use crate::mesh::{CellKind, Cells, Mesh, Point};
use crate::simplify::{Input, Simplified, SimplifyOptions, simplify};
use std::sync::OnceLock;

/// Algorithm 1, which takes less time than the default.
fn paper() -> SimplifyOptions {
    SimplifyOptions { strategy: Strategy::Paper, ..SimplifyOptions::default() }
}

/// A pair, simplified.
struct Case {
    name: String,
    polycube: Mesh,
    shape: Mesh,
    simplified: Simplified,
    /// What it is meshed from, made when it is.
    map: OnceLock<LatticeMap>,
}

impl Case {
    fn new(name: String, pair: (Mesh, Mesh)) -> Self {
        Self::with(&paper(), name, pair)
    }

    fn with(options: &SimplifyOptions, name: String, (polycube, shape): (Mesh, Mesh)) -> Self {
        let input = Input { polycube: &polycube, shape: Some(&shape), labels: None };
        let simplified = simplify(&input, options, &Context::default()).unwrap();
        Self { name, polycube, shape, simplified, map: OnceLock::new() }
    }

    fn input(&self) -> Input<'_> {
        Input { polycube: &self.polycube, shape: Some(&self.shape), labels: None }
    }

    /// The same at a scale that gives about `hexes` hexahedra.
    fn sized(mut self, hexes: usize, padding: usize) -> Self {
        let context = Context::default();
        let size = super::Size::Hexes(hexes);
        let scale = scale_for(&self.input(), &self.simplified, size, padding, &context).unwrap();
        self.simplified = self.simplified.rescaled(&self.input(), scale, &context).unwrap();
        self.map = OnceLock::new();
        self
    }

    fn remesher(&self) -> Remesher<'_> {
        let map = self.map.get_or_init(|| LatticeMap::new(&self.simplified).unwrap());
        Remesher::new(map, &self.shape, &Context::default()).unwrap()
    }
}

/// Every example in a surface and in a volume kind, all kinds in turn, at a coarse size.
fn generated() -> impl Iterator<Item = Case> {
    let kinds = |i: usize| [CellKind::ALL[i % 2], CellKind::ALL[2 + (i / 2) % 2]];
    let all = Example::ALL.into_iter().enumerate().flat_map(move |(i, e)| kinds(i).map(|kind| (e, i as u64 + 1, kind)));
    all.map(|(e, seed, kind)| Case::new(format!("{e} {kind}"), example(e, seed, kind).unwrap()).sized(4000, 1))
}

fn cells(mesh: &Mesh) -> &[[u32; 8]] {
    let Cells::Hexahedra(cells) = mesh.cells() else { panic!("not hexahedra") };
    cells
}

/// The scaled Jacobian at each corner of a hexahedron.
fn corner_jacobians(points: &[Point], hex: &[u32; 8]) -> [f64; 8] {
    let around = [[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]];
    std::array::from_fn(|k| {
        let at = |i: usize| points[hex[i] as usize];
        let [a, b, c] = around[k].map(|i| at(i) - at(k));
        let lengths = a.norm() * b.norm() * c.norm();
        if lengths > 0.0 { a.cross(&b).dot(&c) / lengths } else { 0.0 }
    })
}

fn scaled_jacobian(points: &[Point], hex: &[u32; 8]) -> f64 {
    corner_jacobians(points, hex).into_iter().fold(f64::INFINITY, f64::min)
}

/// How many are turned over, the smallest and the mean scaled Jacobian.
fn quality(hexes: &Hexes) -> (usize, f64, f64) {
    let all: Vec<f64> = cells(&hexes.mesh).iter().map(|h| scaled_jacobian(hexes.mesh.points(), h)).collect();
    let inverted = all.iter().filter(|s| **s <= 0.0).count();
    let worst = all.iter().copied().fold(f64::INFINITY, f64::min);
    (inverted, worst, all.iter().sum::<f64>() / all.len() as f64)
}

fn distinct(ids: &[u32]) -> usize {
    let mut ids = ids.to_vec();
    ids.sort_unstable();
    ids.dedup();
    ids.len()
}
