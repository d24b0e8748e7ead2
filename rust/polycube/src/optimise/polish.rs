//! Moves single vertices of the worst cells by pattern search, where the worst quality around them gains.

use super::elements::Elements;
use super::freedom::Constraints;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::{Point, Stars};
use nalgebra::Vector3;

/// Elements looked after in a round, from the worst: few, as what they gain in the worst others lose in the average.
const WORST: usize = 64;
/// Step lengths tried, as shares of the shortest edge around the vertex.
const STEPS: [f64; 5] = [0.3, 0.1, 0.03, 0.01, 0.003];
/// How much longer polishing may take to reach what is wanted.
const LONGER: usize = 4;
/// A move must gain this much, so that rounds end.
const GAIN: f64 = 1e-5;

/// The 26 directions to the neighbours in a grid.
fn directions() -> impl Iterator<Item = Vector3<f64>> {
    let all = (0..27).map(|i| Vector3::from([i % 3, i / 3 % 3, i / 9].map(|k| f64::from(k) - 1.0)));
    all.filter(|d| *d != Vector3::zeros()).map(|d| d.normalize())
}

/// Never lowers the worst quality around any vertex it moves; keeps sliding vertices on their guides. Goes on for
/// longer than the given rounds while the worst quality is below `wanted`.
pub(super) fn polish(
    elements: &Elements,
    constraints: &Constraints,
    points: &mut [Point],
    rounds: usize,
    wanted: f64,
    context: &Context,
) -> Result<()> {
    if rounds == 0 {
        return Ok(());
    }
    let stars = Stars::new(points.len(), elements.corners.iter().copied());
    let mut stuck: Vec<bool> = (0..points.len()).map(|v| !constraints.moves(v)).collect();
    for round in 0..LONGER * rounds {
        context.tick(round as f64 / (LONGER * rounds) as f64)?;
        let (least, worst) = worst_elements(elements, points, &stuck);
        if worst.is_empty() || round >= rounds && least >= wanted {
            break;
        }
        for v in vertices(elements, &worst).into_iter().filter(|v| constraints.moves(*v)) {
            if context.is_cancelled() {
                break;
            }
            let star = stars.of(v);
            if !stuck[v] && better(elements, constraints, star, points, v) {
                // Those around may have room now.
                star.iter()
                    .flat_map(|e| elements.corners[*e as usize])
                    .for_each(|w| stuck[w as usize] = !constraints.moves(w as usize));
            } else {
                stuck[v] = true;
            }
        }
    }
    context.tick(1.0)
}

/// The worst quality, and of the elements with a vertex that is not `stuck` the worst with theirs, from the worst.
fn worst_elements(elements: &Elements, points: &[Point], stuck: &[bool]) -> (f64, Vec<(f64, u32)>) {
    let all = elements.each(|e| (elements.quality(e, points), e as u32));
    let least = all.iter().map(|(quality, _)| *quality).fold(1.0, f64::min);
    let is_stuck = |e: u32| elements.corners[e as usize].iter().all(|v| stuck[*v as usize]);
    let mut order: Vec<_> = all.into_iter().filter(|(_, e)| !is_stuck(*e)).collect();
    let by_quality = |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    if order.len() > WORST {
        order.select_nth_unstable_by(WORST, by_quality);
        order.truncate(WORST);
    }
    order.sort_by(by_quality);
    (least, order)
}

/// The vertices of some elements, each once.
fn vertices(elements: &Elements, some: &[(f64, u32)]) -> Vec<usize> {
    let mut seen = std::collections::BTreeSet::new();
    let all = some.iter().flat_map(|(_, e)| elements.corners[*e as usize]);
    all.filter(|v| seen.insert(*v)).map(|v| v as usize).collect()
}

/// Tries to move the vertex; whether it did.
fn better(elements: &Elements, constraints: &Constraints, star: &[u32], points: &mut [Point], vertex: usize) -> bool {
    let reach = shortest(elements, star, points);
    let (mut at, start) = (points[vertex], points[vertex]);
    let mut star = star.to_vec();
    let mut quality = worst(elements, &mut star, points, f64::NEG_INFINITY);
    for step in STEPS.map(|s| s * reach) {
        for direction in directions() {
            points[vertex] = at + constraints.allowed(vertex, direction) * step;
            // Guides are near their tangents, and far more costly to ask than the elements.
            if points[vertex] == at || worst(elements, &mut star, points, quality + GAIN) <= quality + GAIN {
                continue;
            }
            points[vertex] = constraints.placed(vertex, points[vertex]);
            let now = worst(elements, &mut star, points, quality + GAIN);
            if now > quality + GAIN {
                (at, quality) = (points[vertex], now);
            }
        }
    }
    points[vertex] = at;
    at != start
}

/// The worst quality in a star, or one of at most `bar` once it is seen. Puts that element first: it may well be the
/// worst next time.
fn worst(elements: &Elements, star: &mut [u32], points: &[Point], bar: f64) -> f64 {
    let mut worst = 1.0_f64;
    for i in 0..star.len() {
        worst = worst.min(elements.quality(star[i] as usize, points));
        if worst <= bar {
            star.swap(0, i);
            break;
        }
    }
    worst
}

fn shortest(elements: &Elements, star: &[u32], points: &[Point]) -> f64 {
    let each = |e: &u32| {
        let edges = elements.edges(*e as usize, points);
        (0..3).map(|i| edges.column(i).norm()).fold(f64::INFINITY, f64::min)
    };
    star.iter().map(each).fold(f64::INFINITY, f64::min)
}
