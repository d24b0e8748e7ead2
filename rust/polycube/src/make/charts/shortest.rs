//! Shortest paths over vertices.

use super::triangulation::NONE;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A vertex waiting at a distance; the nearest, then the lowest, comes first.
#[derive(PartialEq)]
struct Waiting(f64, u32);

impl Eq for Waiting {}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.total_cmp(&self.0).then(other.1.cmp(&self.1))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Dijkstra's algorithm, with memory that serves for many searches.
#[derive(Default)]
pub(super) struct Shortest {
    distance: Vec<f64>,
    parent: Vec<u32>,
    reached: Vec<u32>,
}

impl Shortest {
    /// Searches from `from` among `count` vertices; `neighbours` calls back with each neighbour of a vertex and the
    /// length of the step there. O(n log n) for the n steps met.
    pub(super) fn run(&mut self, count: usize, from: u32, neighbours: impl Fn(u32, &mut dyn FnMut(u32, f64))) {
        for v in self.reached.drain(..) {
            self.distance[v as usize] = f64::INFINITY;
        }
        self.distance.resize(count, f64::INFINITY);
        self.parent.resize(count, NONE);
        let mut waiting = BinaryHeap::from([Waiting(0.0, from)]);
        self.distance[from as usize] = 0.0;
        self.parent[from as usize] = NONE;
        self.reached.push(from);
        while let Some(Waiting(at, v)) = waiting.pop() {
            if at > self.distance[v as usize] {
                continue;
            }
            neighbours(v, &mut |w, step| {
                let far = at + step;
                let known = &mut self.distance[w as usize];
                if far < *known {
                    if known.is_infinite() {
                        self.reached.push(w);
                    }
                    *known = far;
                    self.parent[w as usize] = v;
                    waiting.push(Waiting(far, w));
                }
            });
        }
    }

    /// The vertices that the last search reached.
    pub(super) fn reached(&self) -> &[u32] {
        &self.reached
    }

    /// How far a vertex is; infinite where it was not reached.
    pub(super) fn distance(&self, v: u32) -> f64 {
        self.distance[v as usize]
    }

    /// The vertices from the start of the last search to `to`, if that was reached.
    pub(super) fn path(&self, to: u32) -> Option<Vec<u32>> {
        if self.distance(to).is_infinite() {
            return None;
        }
        let mut path = vec![to];
        while let Some(&v) = path.last().filter(|&&v| self.parent[v as usize] != NONE) {
            path.push(self.parent[v as usize]);
        }
        path.reverse();
        Some(path)
    }
}
