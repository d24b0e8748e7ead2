//! The order of the vertices along a polycube edge, kept where noise has mixed it up.

use super::{Polycube, Structure, Violation};
use crate::mesh::{Mesh, Point};
use std::ops::Range;

/// Vertices of an edge that are out of order by less than this part of its length are so by rounding.
const ROUNDING: f64 = 1e-12;

/// How far the vertices along edges are out of order.
#[derive(Default)]
pub(super) struct Disorder {
    pub(super) vertices: usize,
    pub(super) distance: f64,
}

/// Vertices along an edge that share one place when they are put in order with as little movement as can be.
#[derive(Clone, Debug, PartialEq)]
struct Run {
    /// Which they are, counted from the start of the edge.
    vertices: Range<usize>,
    /// Their place.
    at: f64,
}

/// The runs of `along`, the coordinates of vertices that should ascend from `low` to `high`: isotonic regression by
/// pooling adjacent violators (Ayer et al. 1955). Coordinates that ascend already are runs of one. O(n).
fn runs(along: &[f64], [low, high]: [f64; 2]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::with_capacity(along.len());
    for (i, x) in along.iter().enumerate() {
        let mut run = Run { vertices: i..i + 1, at: x.clamp(low, high) };
        while let Some(before) = runs.pop_if(|before| before.at >= run.at) {
            let [n, m] = [&before, &run].map(|r| r.vertices.len() as f64);
            run = Run { vertices: before.vertices.start..run.vertices.end, at: (n * before.at + m * run.at) / (n + m) };
        }
        runs.push(run);
    }
    runs
}

/// The coordinates `along` an edge from `low` to `high`, in order and apart from each other and from both ends: each
/// near its run, those of one run spread over no more than half of the room to the next.
pub(crate) fn ascending(along: &[f64], [low, high]: [f64; 2]) -> Vec<f64> {
    let runs = runs(along, [low, high]);
    let mut ordered = Vec::with_capacity(along.len());
    for (i, run) in runs.iter().enumerate() {
        let before = i.checked_sub(1).map_or(low, |i| runs[i].at);
        let after = runs.get(i + 1).map_or(high, |next| next.at);
        let [mut from, mut to] = [before, after].map(|beside| f64::midpoint(beside, run.at));
        // As much room on either side, unless an end of the edge leaves none on one.
        let room = (run.at - from).min(to - run.at);
        if room > 0.0 {
            [from, to] = [run.at - room, run.at + room];
        }
        let count = run.vertices.len();
        let place = |k: usize| if count == 1 && room > 0.0 { run.at } else { between(from, to, k, count) };
        ordered.extend((1..=count).map(place));
    }
    ordered
}

/// What is out of order along the edges of `structure` with the vertices `chains`, or the runs that are out of it by
/// more than `tolerance`.
pub(super) fn disorder(
    points: &[Point],
    structure: &Structure,
    chains: &[Vec<u32>],
    placement: &[f64],
    tolerance: f64,
) -> Result<Disorder, Vec<Violation>> {
    let (mut found, mut violations) = (Disorder::default(), Vec::new());
    for (edge, chain) in structure.edges.iter().zip(chains) {
        let ends = structure.ends(edge).map(|l| placement[l as usize]);
        let at: Vec<f64> = chain.iter().map(|&v| points[v as usize][edge.axis]).collect();
        let inner = &at[1..at.len() - 1];
        for run in runs(inner, ends) {
            let distance = inner[run.vertices.clone()].iter().map(|x| (x - run.at).abs()).fold(0.0, f64::max);
            if distance > tolerance {
                violations.push(fold(chain, &at, run.vertices, distance));
            } else if distance > ROUNDING * (ends[1] - ends[0]) {
                found.vertices += run.vertices.len();
                found.distance = found.distance.max(distance);
            }
        }
    }
    if violations.is_empty() { Ok(found) } else { Err(violations) }
}

impl Polycube {
    /// The mesh with the vertices along edges in order; nothing where they are.
    pub(crate) fn in_order(&self, mesh: &Mesh) -> Option<Mesh> {
        if self.deviation.out_of_order == 0 {
            return None;
        }
        let mut points = mesh.points().to_vec();
        for (edge, chain) in self.structure.edges.iter().zip(&self.chains) {
            let at: Vec<f64> = chain.iter().map(|&v| points[v as usize][edge.axis]).collect();
            if !at.is_sorted_by(|a, b| a < b) {
                let ends = self.structure.ends(edge).map(|l| self.placement[l as usize]);
                let inner = chain.iter().skip(1).zip(ascending(&at[1..at.len() - 1], ends));
                inner.for_each(|(&v, x)| points[v as usize][edge.axis] = x);
            }
        }
        mesh.clone().with_points(points).ok()
    }
}

/// The run of `inner` vertices of a chain that lie `at` places out of order, by up to `distance`.
fn fold(chain: &[u32], at: &[f64], inner: Range<usize>, distance: f64) -> Violation {
    let [first, last] = [inner.start + 1, inner.end];
    // A single vertex is out of order with an end of the edge beside it.
    let back = (first - 1..=last).min_by(|&i, &j| (at[i + 1] - at[i]).total_cmp(&(at[j + 1] - at[j])));
    let back = back.unwrap_or(first - 1);
    Violation::NonMonotoneEdge {
        edge: [chain[back], chain[back + 1]],
        run: [chain[first], chain[last]],
        vertices: inner.len(),
        distance,
    }
}

/// The `k`-th of `count` places spread evenly between two.
fn between(from: f64, to: f64, k: usize, count: usize) -> f64 {
    from + (to - from) * (k as f64 / (count + 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_is_in_order_stays() {
        let along = [0.5, 1.0, 2.25, 2.5];
        assert_eq!(ascending(&along, [0.0, 3.0]), along);
        assert_eq!(runs(&along, [0.0, 3.0]).len(), 4);
    }

    #[test]
    fn neighbours_out_of_order_meet_half_way() {
        let found = runs(&[1.0, 2.5, 2.0, 3.0], [0.0, 4.0]);
        let expected = [(0..1, 1.0), (1..3, 2.25), (3..4, 3.0)].map(|(vertices, at)| Run { vertices, at });
        assert_eq!(found, expected);
    }

    #[test]
    fn vertices_at_or_beyond_an_end_make_room() {
        for along in [[-1.0, 0.0, 0.0], [4.0, 5.0, 4.0], [2.0, 2.0, 2.0]] {
            let found = ascending(&along, [0.0, 4.0]);
            assert!(found.is_sorted_by(|a, b| a < b) && 0.0 < found[0] && found[2] < 4.0, "{found:?}");
        }
    }

    proptest! {
        /// The result ascends, and no other order moves the vertices by less: what they are pulled by in each run
        /// cancels out, and each beginning of a run pulls up.
        #[test]
        fn the_order_is_strict_and_the_least_movement(along in prop::collection::vec(-0.5_f64..10.5, 1..20)) {
            let ends = [0.0, 10.0];
            let found = ascending(&along, ends);
            prop_assert!(found.is_sorted_by(|a, b| a < b) && ends[0] < found[0] && found[found.len() - 1] < ends[1]);
            for run in runs(&along, ends) {
                let mut pull = 0.0;
                for x in &along[run.vertices.clone()] {
                    pull += x.clamp(ends[0], ends[1]) - run.at;
                    prop_assert!(pull > -1e-9);
                }
                prop_assert!(pull.abs() < 1e-9);
            }
        }
    }
}
