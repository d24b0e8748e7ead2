//! Where the facets of a polycube lie: near to where their charts are, in the order that the loops give.

use crate::align::problem::{Difference, Problem, ShapeTerm};
use crate::align::solve::{ExactSolver, Solver};
use crate::context::Context;
use crate::error::Result;
use crate::make::charts::ChartedSurface;
use crate::make::loops::LoopSet;
use std::collections::BTreeMap;

/// Lattice steps along the longest side of the shape.
const STEPS: f64 = 512.0;
/// The least distance of two levels that a loop separates, in lattice steps.
const GAP: i64 = 8;
/// Sweeps over the edges; they settle within some hundred.
const SWEEPS: usize = 2000;
/// How strongly levels are pulled to where their charts are, against lengths of edges.
const PULL: f64 = 0.1;
/// The total weight of all levels.
const WEIGHT: f64 = 10_000.0;

/// An edge of the polycube: the levels at its ends and its length on the shape.
pub(super) struct Span {
    pub(super) low: u32,
    pub(super) high: u32,
    pub(super) length: f64,
}

/// The levels of a polycube, one for each zone of the loops, and how they must lie.
pub(super) struct Levels {
    /// The level of each chart.
    pub(super) of_chart: Vec<u32>,
    /// Where each level lies on the shape, and the area that lies there.
    places: Vec<(f64, f64)>,
    differences: Vec<Difference>,
    /// Lattice steps a unit of the shape.
    pub(super) scale: f64,
}

impl Levels {
    /// Reads places off the charts and the order off the loops.
    pub(super) fn new(charts: &ChartedSurface, loops: &LoopSet) -> Self {
        let mut numbers = BTreeMap::new();
        let mut number = |zone: u32| {
            let next = numbers.len() as u32;
            *numbers.entry(zone).or_insert(next)
        };
        let zone = |&q: &u32| loops.zone_of_crossing[q as usize];
        let of_chart = charts.crossings.iter().map(|q| number(zone(q))).collect();
        let mut differences = Vec::new();
        let mut beside = Vec::new();
        for (own, cut) in loops.graph.loops.iter().zip(&loops.mesh.cuts).filter(|(own, _)| own.alive) {
            let [low, high] = own.zones.map(&mut number);
            differences.push(Difference { low, high, gap: GAP });
            beside.extend([(low, cut.at), (high, cut.at)]);
        }
        differences.sort_by_key(|d| (d.low, d.high));
        differences.dedup();
        let mut levels = Self { of_chart, places: vec![(0.0, 0.0); numbers.len()], differences, scale: 1.0 };
        levels.measure(charts, &beside);
        levels
    }

    /// Finds the places: the mean of the charts of a level, or of the loops `beside` one without charts.
    fn measure(&mut self, charts: &ChartedSurface, beside: &[(u32, f64)]) {
        for (t, &chart) in charts.triangles.iter().zip(&charts.chart) {
            let [a, b, c] = t.map(|v| charts.points[v as usize]);
            let area = (b - a).cross(&(c - a)).norm() * 0.5;
            let axis = usize::from(charts.labels[chart as usize]) / 2;
            let place = &mut self.places[self.of_chart[chart as usize] as usize];
            *place = (place.0 + area * (a[axis] + b[axis] + c[axis]) / 3.0, place.1 + area);
        }
        let bare: Vec<bool> = self.places.iter().map(|p| p.1 == 0.0).collect();
        for &(level, at) in beside.iter().filter(|b| bare[b.0 as usize]) {
            let place = &mut self.places[level as usize];
            *place = (place.0 + 1e-9 * at, place.1 + 1e-9);
        }
        self.places.iter_mut().for_each(|p| p.0 /= p.1.max(f64::MIN_POSITIVE));
        let extent = |axis: usize| {
            let all = charts.points.iter().map(|p| p[axis]);
            all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
        };
        self.scale = STEPS / extent(0).max(extent(1)).max(extent(2));
    }

    /// Where charts lie on the shape, in lattice steps.
    pub(super) fn as_on_the_shape(&self) -> Vec<f64> {
        self.places.iter().map(|p| self.scale * p.0).collect()
    }

    /// Where levels lie so that edges of the polycube are about as long as on the shape: least squares of relative
    /// lengths, by Jacobi's iteration with damping.
    pub(super) fn as_long_as(&self, spans: &[Span]) -> Vec<f64> {
        let mean = spans.iter().map(|s| s.length).sum::<f64>() / spans.len().max(1) as f64;
        let total: f64 = self.places.iter().map(|p| p.1).sum();
        let start = self.as_on_the_shape();
        let mut at = start.clone();
        for _ in 0..SWEEPS {
            let pulls = self.places.iter().map(|p| PULL * p.1 / total + 1e-9);
            let mut sums: Vec<(f64, f64)> = pulls.zip(&start).map(|(w, x)| (w * x, w)).collect();
            for Span { low, high, length } in spans {
                let weight = mean / (spans.len() as f64 * length.max(1e-3 * mean));
                let [x, y] = [low, high].map(|&l| at[l as usize]);
                for (l, goal) in [(low, y - length * self.scale), (high, x + length * self.scale)] {
                    let sum = &mut sums[*l as usize];
                    *sum = (sum.0 + weight * goal, sum.1 + weight);
                }
            }
            at.iter_mut().zip(sums).for_each(|(x, (sum, weight))| *x += 0.5 * (sum / weight - *x));
        }
        at
    }

    /// The nearest levels to `targets` that keep the order, in lattice steps.
    ///
    /// # Errors
    /// Those of [`Solver::solve`].
    pub(super) fn solve(&self, targets: &[f64], context: &Context) -> Result<Vec<i64>> {
        let total: f64 = self.places.iter().map(|p| p.1).sum();
        let weight = |area: f64| 1 + (WEIGHT * area / total) as u32;
        let term = |(p, &target): (&(f64, f64), &f64)| ShapeTerm { weight: weight(p.1), target };
        let shape = self.places.iter().zip(targets).map(term).collect();
        let problem = Problem { shape, differences: self.differences.clone(), ..Problem::default() };
        Ok(ExactSolver.solve(&problem, None, context)?.levels)
    }

    /// Keeps one level below another from now on.
    pub(super) fn separate(&mut self, low: u32, high: u32) {
        self.differences.push(Difference { low, high, gap: GAP });
    }
}
