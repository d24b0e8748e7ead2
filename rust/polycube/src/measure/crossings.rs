//! Where a surface crosses itself.

use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use crate::spatial::{BoxTree, bounds};
use rayon::prelude::*;
use robust::{Coord3D, orient3d};

/// Pairs of triangles where an edge of the first passes through the inside of the second, decided exactly; in a fixed
/// order. Triangles that only touch, or overlap in one plane, are no pair. O(n log n) for n triangles that are spread
/// out.
///
/// # Errors
/// Only that the context was cancelled.
pub(crate) fn crossings(points: &[Point], triangles: &[[u32; 3]], context: &Context) -> Result<Vec<[u32; 2]>> {
    let at = |v: u32| <[f64; 3]>::from(points[v as usize].coords);
    let boxes = (0..).zip(triangles).map(|(i, t)| (i, bounds(&t.map(at))));
    let tree = BoxTree::new(boxes);
    let pierced = |&([u, v], i): &([u32; 2], u32)| {
        context.check()?;
        let mut found = Vec::new();
        let (low, high) = bounds(&[at(u), at(v)]);
        tree.meeting(low, high, |j| {
            let other = triangles[j as usize];
            if !other.contains(&u) && !other.contains(&v) && passes([u, v].map(at), other.map(at)) {
                found.push([i, j]);
            }
        });
        Ok(found)
    };
    let found = edges(triangles).par_iter().with_min_len(256).map(pierced).collect::<Result<Vec<_>>>()?;
    Ok(found.concat())
}

/// Every edge once, with a triangle that has it.
fn edges(triangles: &[[u32; 3]]) -> Vec<([u32; 2], u32)> {
    let of =
        |(i, t): (u32, &[u32; 3])| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[u, v]| ([u.min(v), u.max(v)], i));
    let mut edges: Vec<_> = (0..).zip(triangles).flat_map(of).collect();
    edges.sort_unstable();
    edges.dedup_by_key(|(edge, _)| *edge);
    edges
}

/// Whether a segment passes through the inside of a triangle from one side to the other.
fn passes([from, to]: [[f64; 3]; 2], [a, b, c]: [[f64; 3]; 3]) -> bool {
    let side = |a, b, c, d| {
        let [a, b, c, d] = [a, b, c, d].map(|[x, y, z]: [f64; 3]| Coord3D { x, y, z });
        orient3d(a, b, c, d)
    };
    let (before, after) = (side(a, b, c, from), side(a, b, c, to));
    if !(before < 0.0 && after > 0.0 || before > 0.0 && after < 0.0) {
        return false;
    }
    let around = [side(from, to, a, b), side(from, to, b, c), side(from, to, c, a)];
    around.iter().all(|s| *s > 0.0) || around.iter().all(|s| *s < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_segment_passes_through_the_inside_alone() {
        let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let vertical = |x: f64, y: f64, low: f64| passes([[x, y, low], [x, y, 1.0]], triangle);
        assert!(vertical(0.2, 0.2, -1.0));
        assert!(!vertical(0.2, 0.2, 0.5), "it ends above");
        assert!(!vertical(0.2, 0.2, 0.0), "it starts in the plane");
        assert!(!vertical(0.8, 0.8, -1.0), "it passes beside");
        assert!(!vertical(0.5, 0.5, -1.0), "it passes through a side");
    }
}
