//! Where a surface crosses itself.

use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use crate::spatial::{BoxTree, bounds};
use rayon::prelude::*;
use robust::{Coord3D, orient3d};

/// Pairs of triangles where an edge of the first passes from one side of the second to the other, through its inside or
/// through a side of it, each pair once or twice; decided exactly, in a fixed order. Triangles that only touch, or that
/// overlap in one plane, are no pair, and neither are those that cross in no more than a common vertex or along an
/// edge of both. O(n log n) for n triangles that are spread out.
///
/// # Errors
/// Only that the context was cancelled.
pub(crate) fn crossings(points: &[Point], triangles: &[[u32; 3]], context: &Context) -> Result<Vec<[u32; 2]>> {
    let at = |v: u32| <[f64; 3]>::from(points[v as usize].coords);
    let boxes = (0..).zip(triangles).map(|(i, t)| (i, bounds(&t.map(at))));
    let tree = BoxTree::new(boxes);
    let sides = sides(triangles);
    let pierced = |same: &[Side]| {
        context.check()?;
        let ([u, v], _) = same[0];
        let segment = [u, v].map(at);
        let mut found = Vec::new();
        let (low, high) = bounds(&segment);
        tree.meeting(low, high, |j| {
            let other = triangles[j as usize];
            let crossed = || match meeting(segment, other.map(at)) {
                Meeting::Inside => true,
                Meeting::Side(k) => {
                    let [a, b] = [other[k], other[(k + 1) % 3]];
                    across(triangles, &sides, j, [a, b])
                        .is_some_and(|d| passes_ridge(segment, [a, b, other[(k + 2) % 3], d].map(at)))
                }
                Meeting::No => false,
            };
            if !other.contains(&u) && !other.contains(&v) && crossed() {
                found.extend(same.iter().map(|(_, i)| [*i, j]));
            }
        });
        Ok(found)
    };
    let edges: Vec<_> = sides.chunk_by(|(a, _), (b, _)| a == b).collect();
    let found = edges.into_par_iter().with_min_len(256).map(pierced).collect::<Result<Vec<_>>>()?;
    Ok(found.concat())
}

/// An edge, lower end first, and a triangle that has it.
type Side = ([u32; 2], u32);

/// Those of all triangles, in ascending order.
fn sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let of =
        |(i, t): (u32, &[u32; 3])| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[u, v]| ([u.min(v), u.max(v)], i));
    let mut sides: Vec<_> = (0..).zip(triangles).flat_map(of).collect();
    sides.sort_unstable();
    sides
}

/// The third vertex of the other triangle at an edge of triangle `j`, where there are two.
fn across(triangles: &[[u32; 3]], sides: &[Side], j: u32, [a, b]: [u32; 2]) -> Option<u32> {
    let edge = [a.min(b), a.max(b)];
    let first = sides.partition_point(|(e, _)| *e < edge);
    let [one, two] = *sides[first..].chunk_by(|(e, _), (f, _)| e == f).next()? else { return None };
    let other = if one.1 == j { two.1 } else { one.1 };
    triangles[other as usize].into_iter().find(|v| *v != a && *v != b)
}

/// Where a segment that goes from one side of a triangle's plane to the other meets the triangle.
#[derive(Debug, PartialEq)]
enum Meeting {
    No,
    Inside,
    /// On the side from the vertex of this number to the next, between the two.
    Side(usize),
}

fn meeting([from, to]: [[f64; 3]; 2], [a, b, c]: [[f64; 3]; 3]) -> Meeting {
    if side(a, b, c, from) * side(a, b, c, to) != -1 {
        return Meeting::No;
    }
    let around = [side(from, to, a, b), side(from, to, b, c), side(from, to, c, a)];
    let least = *around.iter().min().expect("three");
    let most = *around.iter().max().expect("three");
    match around.iter().filter(|s| **s == 0).count() {
        0 if least == most => Meeting::Inside,
        1 if least * most == 0 => Meeting::Side(around.iter().position(|s| *s == 0).expect("one")),
        _ => Meeting::No,
    }
}

/// Whether a segment through the edge a, b of the triangles a, b, c and b, a, d goes from one side of the two to the
/// other, and does not only touch them.
fn passes_ridge(segment: [[f64; 3]; 2], [a, b, c, d]: [[f64; 3]; 4]) -> bool {
    // Positive where the two bend away from the side that `side` has as positive.
    let bend = -side(a, b, c, d);
    let depth = segment.map(|p| {
        let (first, second) = (side(a, b, c, p), side(b, a, d, p));
        if bend >= 0 { first.max(second) } else { first.min(second) }
    });
    depth[0] * depth[1] == -1
}

/// The side of the plane through a, b, c that a point is on: 1, -1, or 0 in it.
fn side(a: [f64; 3], b: [f64; 3], c: [f64; 3], point: [f64; 3]) -> i8 {
    let [a, b, c, point] = [a, b, c, point].map(|[x, y, z]| Coord3D { x, y, z });
    let volume = orient3d(a, b, c, point);
    i8::from(volume > 0.0) - i8::from(volume < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_segment_meets_the_inside_or_a_side() {
        let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let vertical = |x: f64, y: f64, low: f64| meeting([[x, y, low], [x, y, 1.0]], triangle);
        assert_eq!(vertical(0.2, 0.2, -1.0), Meeting::Inside);
        assert_eq!(vertical(0.2, 0.2, 0.5), Meeting::No, "it ends above");
        assert_eq!(vertical(0.2, 0.2, 0.0), Meeting::No, "it starts in the plane");
        assert_eq!(vertical(0.8, 0.8, -1.0), Meeting::No, "it passes beside");
        assert_eq!(vertical(0.5, 0.5, -1.0), Meeting::Side(1));
        assert_eq!(vertical(1.0, 0.0, -1.0), Meeting::No, "it passes through a vertex");
        assert_eq!(vertical(2.0, 0.0, -1.0), Meeting::No, "it passes beside, in the line of a side");
    }

    #[test]
    fn a_ridge_is_passed_or_touched() {
        let passes = |from, to, c, d| passes_ridge([from, to], [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], c, d]);
        let roof = ([1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]);
        let valley = ([1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]);
        let plane = ([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]);
        for (c, d) in [roof, valley, plane] {
            for (c, d) in [(c, d), (d, c)] {
                assert!(passes([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], c, d), "down");
                assert!(passes([0.1, 0.0, -1.0], [-0.1, 0.0, 1.0], c, d), "up");
            }
        }
        for (c, d) in [roof, valley] {
            assert!(!passes([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], c, d), "along the top");
            assert!(!passes([-1.0, 0.0, 0.5], [1.0, 0.0, -0.5], c, d), "touching, through the plane of one");
        }
        assert!(!passes([-1.0, 0.0, -1.0], [1.0, 0.0, 1.0], roof.0, roof.1), "along one of the two");
    }
}
