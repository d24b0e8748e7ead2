//! Where the facets of a polycube lie: near to where their charts are, in the order that the loops give.

use super::spans::Span;
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
/// Sweeps over the levels; they settle within some hundred.
const SWEEPS: usize = 1000;
/// Lattice steps that matter no more.
const SETTLED: f64 = 0.01;
/// The least length of a span that is aimed at, in lattice steps.
const SHORTEST: f64 = 0.01;
/// How strongly a level is pulled to where it was, for each squared lattice step, as a share of the whole surface.
const PULL: f64 = 1e-9;
/// How strongly the order of two levels without an edge between them pushes, as a share of the whole surface.
const ORDER: f64 = 1e-5;
/// The total weight of all levels.
const WEIGHT: f64 = 10_000.0;

/// What holds a level apart from another one, and near to it.
#[derive(Clone, Copy)]
struct Spring {
    to: u32,
    /// Whether the other level lies above.
    up: bool,
    length: f64,
    pull: f64,
    push: f64,
}

/// The levels of a polycube, one for each zone of the loops, and how they must lie.
#[derive(Clone)]
pub(in crate::make) struct Levels {
    /// The level of each chart.
    pub(super) of_chart: Vec<u32>,
    /// Where each level lies on the shape, and the area that lies there.
    places: Vec<(f64, f64)>,
    differences: Vec<Difference>,
    /// The levels that must lie above each.
    above: Vec<Vec<u32>>,
    /// Lattice steps a unit of the shape.
    pub(super) scale: f64,
}

impl Levels {
    /// Reads places off the charts and the order off the loops.
    pub(in crate::make) fn new(charts: &ChartedSurface, loops: &LoopSet) -> Self {
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
            differences.push(Self::below(low, high));
            beside.extend([(low, cut.at), (high, cut.at)]);
        }
        differences.sort_by_key(|d| (d.low, d.high));
        differences.dedup();
        Self::measured(charts, of_chart, numbers.len(), differences, &beside)
    }

    /// The levels of charts, in a given order.
    pub(in crate::make) fn ordered(charts: &ChartedSurface, of_chart: Vec<u32>, differences: Vec<Difference>) -> Self {
        let count = of_chart.iter().max().map_or(0, |last| *last as usize + 1);
        Self::measured(charts, of_chart, count, differences, &[])
    }

    fn measured(
        charts: &ChartedSurface,
        of_chart: Vec<u32>,
        count: usize,
        differences: Vec<Difference>,
        beside: &[(u32, f64)],
    ) -> Self {
        let mut above = vec![Vec::new(); count];
        differences.iter().for_each(|d| above[d.low as usize].push(d.high));
        let mut levels = Self { of_chart, places: vec![(0.0, 0.0); count], differences, above, scale: 1.0 };
        levels.measure(charts, beside);
        levels
    }

    /// That one level lies below another.
    pub(in crate::make) fn below(low: u32, high: u32) -> Difference {
        Difference { low, high, gap: GAP }
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

    /// Where levels lie so that edges of the polycube are about as long as on the shape, from `start`, which keeps the
    /// order: the least Σ area · (r + 1/r) for the ratio r of the two lengths, so that nothing is squashed, by Newton's
    /// method for one level after the other.
    pub(super) fn as_long_as(&self, spans: &[Span], start: &[f64]) -> Vec<f64> {
        let beside = self.springs(spans, start.len());
        let total: f64 = spans.iter().map(|s| s.area).sum();
        let mut at = start.to_vec();
        for _ in 0..SWEEPS {
            let mut moved = 0.0_f64;
            for (level, springs) in beside.iter().enumerate() {
                let step = step(springs, &at, level, (PULL * total, start[level]));
                at[level] += step;
                moved = moved.max(step.abs());
            }
            if moved < SETTLED {
                break;
            }
        }
        at
    }

    /// What holds each level: edges, and more weakly the loops that keep two levels in order.
    fn springs(&self, spans: &[Span], levels: usize) -> Vec<Vec<Spring>> {
        let mut beside: Vec<Vec<Spring>> = vec![Vec::new(); levels];
        let mut tie = |[low, high]: [u32; 2], length: f64, pull: f64, push: f64| {
            beside[low as usize].push(Spring { to: high, up: true, length, pull, push });
            beside[high as usize].push(Spring { to: low, up: false, length, pull, push });
        };
        for s in spans {
            tie([s.low, s.high], (s.length * self.scale).max(SHORTEST), s.area, s.area);
        }
        let total: f64 = spans.iter().map(|s| s.area).sum();
        for d in &self.differences {
            tie([d.low, d.high], d.gap as f64, 0.0, ORDER * total);
        }
        beside
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

    /// Whether the order says that one level lies below another.
    pub(super) fn is_below(&self, low: u32, high: u32) -> bool {
        let mut seen = vec![false; self.places.len()];
        let mut waiting = vec![low];
        while let Some(at) = waiting.pop() {
            for &next in &self.above[at as usize] {
                if next == high {
                    return true;
                }
                if !std::mem::replace(&mut seen[next as usize], true) {
                    waiting.push(next);
                }
            }
        }
        false
    }

    /// Keeps one level below another from now on.
    pub(super) fn separate(&mut self, low: u32, high: u32) {
        self.differences.push(Self::below(low, high));
        self.above[low as usize].push(high);
    }
}

/// Newton's step of one level, no farther than half way to the next.
fn step(springs: &[Spring], at: &[f64], level: usize, (pull, home): (f64, f64)) -> f64 {
    let (mut slope, mut bend) = (2.0 * pull * (at[level] - home), 2.0 * pull);
    let mut room = [f64::INFINITY; 2];
    for s in springs {
        let sign = if s.up { -1.0 } else { 1.0 };
        let gap = sign * (at[level] - at[s.to as usize]);
        let r = gap / s.length;
        slope += sign * (s.pull - s.push / (r * r)) / s.length;
        bend += 2.0 * s.push / (r * r * r * s.length * s.length);
        let room = &mut room[usize::from(s.up)];
        *room = room.min(0.5 * gap);
    }
    (-slope / bend).clamp(-room[0], room[1])
}
