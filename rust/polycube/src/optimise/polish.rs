//! Moves single vertices of the worst cells by pattern search, where the worst quality around them gains.

use super::elements::Elements;
use super::freedom::Constraints;
use super::quality::edges;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use nalgebra::Vector3;

/// Elements looked after in a round, from the worst: few, as what they gain in the worst others lose in the average.
const WORST: usize = 64;
/// Step lengths tried, as shares of the shortest edge around the vertex.
const STEPS: [f64; 5] = [0.3, 0.1, 0.03, 0.01, 0.003];
/// A move must gain this much, so that rounds end.
const GAIN: f64 = 1e-5;

/// The elements around each vertex.
struct Stars {
    starts: Vec<u32>,
    elements: Vec<u32>,
}

impl Stars {
    fn new(elements: &Elements, count: usize) -> Self {
        let mut starts = vec![0_u32; count + 1];
        elements.corners.iter().flatten().for_each(|v| starts[*v as usize + 1] += 1);
        (0..count).for_each(|v| starts[v + 1] += starts[v]);
        let mut next = starts.clone();
        let mut around = vec![0; starts[count] as usize];
        for (e, corner) in elements.corners.iter().enumerate() {
            for v in corner {
                around[next[*v as usize] as usize] = e as u32;
                next[*v as usize] += 1;
            }
        }
        Self { starts, elements: around }
    }

    fn of(&self, vertex: usize) -> &[u32] {
        &self.elements[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}

/// The 26 directions to the neighbours in a grid.
fn directions() -> impl Iterator<Item = Vector3<f64>> {
    let all = (0..27).map(|i| Vector3::from([i % 3, i / 3 % 3, i / 9].map(|k| f64::from(k) - 1.0)));
    all.filter(|d| *d != Vector3::zeros()).map(|d| d.normalize())
}

/// Never lowers the worst quality around any vertex it moves; keeps sliding vertices on their guides.
pub(super) fn polish(
    elements: &Elements,
    constraints: &Constraints,
    points: &mut [Point],
    rounds: usize,
    context: &Context,
) -> Result<()> {
    let stars = Stars::new(elements, points.len());
    for round in 0..rounds {
        context.tick(round as f64 / rounds as f64)?;
        let mut moved = false;
        for v in worst_vertices(elements, points) {
            if context.is_cancelled() {
                break;
            }
            moved |= constraints.moves(v) && better(elements, constraints, stars.of(v), points, v);
        }
        if !moved {
            break;
        }
    }
    context.tick(1.0)
}

/// The vertices of the worst elements, each once, from the worst.
fn worst_vertices(elements: &Elements, points: &[Point]) -> Vec<usize> {
    let mut order: Vec<(f64, u32)> = (0..elements.len()).map(|e| (elements.quality(e, points), e as u32)).collect();
    let by_quality = |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    if order.len() > WORST {
        order.select_nth_unstable_by(WORST, by_quality);
        order.truncate(WORST);
    }
    order.sort_by(by_quality);
    let mut seen = std::collections::BTreeSet::new();
    let all = order.iter().flat_map(|(_, e)| elements.corners[*e as usize]);
    all.filter(|v| seen.insert(*v)).map(|v| v as usize).collect()
}

/// Tries to move the vertex; whether it did.
fn better(elements: &Elements, constraints: &Constraints, star: &[u32], points: &mut [Point], vertex: usize) -> bool {
    let reach = shortest(elements, star, points);
    let mut at = points[vertex];
    let (start, mut quality) = (at, worst(elements, star, points));
    for step in STEPS.map(|s| s * reach) {
        for direction in directions() {
            let to = at + constraints.allowed(vertex, direction) * step;
            points[vertex] = if to == at { at } else { constraints.placed(vertex, to) };
            let now = worst(elements, star, points);
            if now > quality + GAIN {
                (at, quality) = (points[vertex], now);
            }
        }
    }
    points[vertex] = at;
    at != start
}

fn worst(elements: &Elements, star: &[u32], points: &[Point]) -> f64 {
    star.iter().map(|e| elements.quality(*e as usize, points)).fold(1.0, f64::min)
}

fn shortest(elements: &Elements, star: &[u32], points: &[Point]) -> f64 {
    let each = |e: &u32| {
        let edges = edges(points, elements.corners[*e as usize]);
        (0..3).map(|i| edges.column(i).norm()).fold(f64::INFINITY, f64::min)
    };
    star.iter().map(each).fold(f64::INFINITY, f64::min)
}
