//! Polygons as triangles over their own corners.

use crate::mesh::Point;
use earcut::Earcut;
use nalgebra::Vector3;

/// The triangles of a polygon, two fewer than its corners: the fan around its first corner where all of that looks to
/// one side, as it does for a convex polygon without straight corners there, else ears, so that concave and straight
/// corners do no harm. A polygon that crosses itself or has no area gives the fan.
pub(super) fn triangles(points: &[Point], corners: &[u32]) -> Vec<[u32; 3]> {
    let fan: Vec<[usize; 3]> = (1..corners.len() - 1).map(|i| [0, i, i + 1]).collect();
    let cut = match corners.len() {
        3 => fan,
        _ => {
            let flat = flattened(points, corners);
            let clear = |t: &[usize; 3]| area(&flat, t) > THINNEST * longest(&flat, t);
            if fan.iter().all(clear) { fan } else { ears(&flat).unwrap_or(fan) }
        }
    };
    cut.into_iter().map(|t| t.map(|i| corners[i])).collect()
}

/// A triangle whose doubled area is below this part of its longest side squared is no good.
const THINNEST: f64 = 1e-9;

/// The corners in the coordinate plane that the polygon lies in most nearly, counter-clockwise.
fn flattened(points: &[Point], corners: &[u32]) -> Vec<[f64; 2]> {
    let at = |i: usize| points[corners[i % corners.len()] as usize];
    let origin = at(0);
    // The area vector (Newell).
    let normal: Vector3<f64> = (1..corners.len()).map(|i| (at(i) - origin).cross(&(at(i + 1) - origin))).sum();
    let axis = normal.iamax();
    let [u, v] = if normal[axis] < 0.0 { [(axis + 2) % 3, (axis + 1) % 3] } else { [(axis + 1) % 3, (axis + 2) % 3] };
    (0..corners.len()).map(|i| [at(i)[u] - origin[u], at(i)[v] - origin[v]]).collect()
}

/// Twice the area of a triangle, negative where it is clockwise.
fn area(flat: &[[f64; 2]], t: &[usize; 3]) -> f64 {
    let [a, b, c] = t.map(|i| flat[i]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The longest side of a triangle, squared.
fn longest(flat: &[[f64; 2]], t: &[usize; 3]) -> f64 {
    let side = |k: usize| {
        let [a, b] = [t[k], t[(k + 1) % 3]].map(|i| flat[i]);
        (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)
    };
    side(0).max(side(1)).max(side(2))
}

/// The triangles of a polygon by cutting ears, with the corners put back that the method leaves out as they are
/// straight. Nothing where that does not fill the polygon.
fn ears(flat: &[[f64; 2]]) -> Option<Vec<[usize; 3]>> {
    let mut cut: Vec<u32> = Vec::new();
    Earcut::new().earcut(flat.iter().copied(), &[], &mut cut);
    let mut open: Vec<[usize; 3]> = cut.as_chunks().0.iter().map(|t| t.map(|i| i as usize)).collect();
    let clockwise = open.iter().any(|t| area(flat, t) < -THINNEST * longest(flat, t));
    if clockwise {
        open.iter_mut().for_each(|t| t.reverse());
    }
    let mut used = vec![false; flat.len()];
    open.iter().flatten().for_each(|&i| used[i] = true);
    let mut whole = Vec::with_capacity(flat.len() - 2);
    while let Some(t) = open.pop() {
        let missing = |k: &usize| left_out(flat, &t, *k) && !used[(t[*k] + 1) % flat.len()];
        let Some(k) = (0..3).find(missing) else {
            whole.push(t);
            continue;
        };
        let [from, to, top] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
        let next = (from + 1) % flat.len();
        used[next] = true;
        open.extend([[from, next, top], [next, to, top]]);
    }
    widen(flat, &mut whole);
    (whole.len() == flat.len() - 2).then_some(whole)
}

/// Swaps the longest side of each triangle without area, on which its third corner lies, for the side to the corner
/// beyond.
fn widen(flat: &[[f64; 2]], triangles: &mut [[usize; 3]]) {
    // Each swap takes a corner off a side; more than that would go round in circles.
    for _ in 0..triangles.len() {
        let thin = |t: &[usize; 3]| area(flat, t) <= THINNEST * longest(flat, t);
        let swap = |i: usize| {
            let t = triangles[i];
            let length = |k: usize| {
                let [a, b] = [t[k], t[(k + 1) % 3]].map(|i| flat[i]);
                (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)
            };
            let k = (0..3).max_by(|&i, &j| length(i).total_cmp(&length(j)))?;
            let [a, b, c] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
            let other = triangles.iter().position(|o| (0..3).any(|m| [o[m], o[(m + 1) % 3]] == [b, a]))?;
            let d = *triangles[other].iter().find(|v| **v != a && **v != b)?;
            Some((i, other, [[a, d, c], [d, b, c]]))
        };
        let found = (0..triangles.len()).filter(|&i| thin(&triangles[i])).find_map(swap);
        let Some((i, other, [first, second])) = found else { return };
        (triangles[i], triangles[other]) = (first, second);
    }
}

/// Whether the corner that follows the first of side `k` of a triangle lies on that side.
fn left_out(flat: &[[f64; 2]], t: &[usize; 3], k: usize) -> bool {
    let [from, to] = [t[k], t[(k + 1) % 3]];
    let next = (from + 1) % flat.len();
    let [side, step] = [to, next].map(|i| [flat[i][0] - flat[from][0], flat[i][1] - flat[from][1]]);
    let length = side[0] * side[0] + side[1] * side[1];
    let along = side[0] * step[0] + side[1] * step[1];
    area(flat, &[from, to, next]).abs() <= THINNEST * length && (0.0..=length).contains(&along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::SplitMix64;

    fn points(flat: &[[f64; 2]]) -> Vec<Point> {
        flat.iter().map(|&[x, y]| Point::new(0.3 * x - y, y, x + 0.1 * y)).collect()
    }

    /// Cut from each first corner, and from the other side, there are triangles enough, all look to one side, fill the
    /// polygon, and leave no side of it out.
    fn assert_cut(flat: &[[f64; 2]]) {
        let (points, n) = (points(flat), flat.len());
        for first in 0..n {
            for reversed in [false, true] {
                let mut corners: Vec<u32> = (0..n as u32).collect();
                corners.rotate_left(first);
                if reversed {
                    corners.reverse();
                }
                let cut = triangles(&points, &corners);
                assert_eq!(cut.len(), n - 2, "{flat:?} from {first}");
                let doubled = |t: &[u32; 3]| area(flat, &t.map(|v| v as usize)) * if reversed { -1.0 } else { 1.0 };
                assert!(cut.iter().all(|t| doubled(t) > 0.0), "{flat:?} from {first}: {cut:?}");
                let whole: f64 = (1..n - 1).map(|i| area(flat, &[0, i, i + 1])).sum();
                assert!((cut.iter().map(doubled).sum::<f64>() - whole).abs() < 1e-9 * whole);
                let sides: Vec<[u32; 2]> = cut.iter().flat_map(|t| [0, 1, 2].map(|k| [t[k], t[(k + 1) % 3]])).collect();
                for i in 0..n {
                    let side = [corners[i], corners[(i + 1) % n]];
                    assert_eq!(sides.iter().filter(|s| **s == side).count(), 1, "{flat:?} from {first}: {side:?}");
                }
            }
        }
    }

    #[test]
    fn concave_polygons_and_straight_corners_are_cut_from_any_first_corner() {
        assert_cut(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
        assert_cut(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.0]]);
        assert_cut(&[[0.0, 0.0], [4.0, 1.0], [0.0, 2.0], [1.0, 1.0]]);
        assert_cut(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [0.0, 1.0]]);
        let comb = [[0.0, 0.0], [5.0, 0.0], [5.0, 3.0], [4.0, 3.0], [4.0, 1.0], [3.0, 1.0], [3.0, 3.0], [2.0, 3.0]];
        let rest = [[2.0, 1.0], [1.5, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0], [0.0, 1.5]];
        assert_cut(&[&comb[..], &rest].concat());
    }

    #[test]
    fn stars_with_straight_corners_are_cut() {
        let mut random = SplitMix64::new(5);
        for n in 4..40 {
            let corner = |(i, r): (u32, f64)| {
                let turn = std::f64::consts::TAU * f64::from(i) / f64::from(n);
                [r * turn.cos(), r * turn.sin()]
            };
            let star: Vec<[f64; 2]> = (0..n).map(|i| corner((i, 0.3 + random.unit()))).collect();
            let middles = (0..n as usize).flat_map(|i| {
                let [a, b] = [star[i], star[(i + 1) % n as usize]];
                [a, [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])]]
            });
            // Middles of sides are straight to rounding only, so triangles there may be turned over by as much.
            assert_cut(&star);
            let points = points(&middles.collect::<Vec<_>>());
            let corners: Vec<u32> = (0..2 * n).collect();
            assert_eq!(triangles(&points, &corners).len(), 2 * n as usize - 2);
        }
    }

    #[test]
    fn a_polygon_without_area_gives_its_fan() {
        let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0]];
        assert_eq!(triangles(&points(&flat), &[0, 1, 2, 3]), [[0, 1, 2], [0, 2, 3]]);
    }
}
