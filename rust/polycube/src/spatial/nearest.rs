//! Nearest points of segments and triangles, by an index over their boxes.

use crate::mesh::Point;
use nalgebra::Vector3;
use rstar::{AABB, PointDistance, RTree, RTreeObject};

/// A segment or triangle in the tree, by its vertices.
#[derive(Clone, Debug)]
struct Piece<const N: usize> {
    index: u32,
    at: [Point; N],
}

impl<const N: usize> RTreeObject for Piece<N> {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_points(self.at.map(|p| [p.x, p.y, p.z]).iter())
    }
}

impl<const N: usize> PointDistance for Piece<N> {
    fn distance_2(&self, point: &[f64; 3]) -> f64 {
        let point = Point::from(*point);
        (foot(&self.at, &point).0 - point).norm_squared()
    }
}

/// Segments (`N` = 2) or triangles (`N` = 3), indexed for nearest points (rstar).
#[derive(Clone, Debug)]
pub(crate) struct Nearest<const N: usize> {
    tree: RTree<Piece<N>>,
}

/// Where an index is nearest to a point.
pub(crate) struct Foot<const N: usize> {
    /// The number of the segment or triangle.
    pub(crate) index: usize,
    pub(crate) point: Point,
    /// Its barycentric coordinates there.
    pub(crate) weights: [f64; N],
}

impl<const N: usize> Nearest<N> {
    /// Indexes pieces by their vertices. O(n log n).
    pub(crate) fn new(pieces: impl Iterator<Item = [Point; N]>) -> Self {
        Self { tree: RTree::bulk_load((0..).zip(pieces).map(|(index, at)| Piece { index, at }).collect()) }
    }

    /// The nearest point of the nearest piece; none only for an empty index. O(log n) in practice.
    pub(crate) fn foot(&self, point: &Point) -> Option<Foot<N>> {
        let piece = self.tree.nearest_neighbor([point.x, point.y, point.z])?;
        let (at, weights) = foot(&piece.at, point);
        Some(Foot { index: piece.index as usize, point: at, weights })
    }

    /// The number of the nearest piece that is `accepted`, or else of the nearest; none only for an empty index. As
    /// [`foot`](Self::foot) where one of the nearest is accepted, linear time where none is.
    pub(crate) fn nearest_of(&self, point: &Point, accepted: impl Fn(usize) -> bool) -> Option<usize> {
        let all = || self.tree.nearest_neighbor_iter([point.x, point.y, point.z]).map(|piece| piece.index as usize);
        all().find(|&index| accepted(index)).or_else(|| all().next())
    }

    /// The distance from `point` to the nearest piece; infinite where there is none.
    pub(crate) fn distance(&self, point: &Point) -> f64 {
        self.foot(point).map_or(f64::INFINITY, |foot| (foot.point - point).norm())
    }
}

/// The nearest point of a segment or triangle, and its barycentric coordinates.
fn foot<const N: usize>(at: &[Point; N], point: &Point) -> (Point, [f64; N]) {
    let mut weights = [0.0; N];
    match at[..] {
        [a, b] => {
            let t = along(a, b, point);
            (weights[0], weights[1]) = (1.0 - t, t);
        }
        [a, b, c] => weights.copy_from_slice(&in_triangle(a, b, c, point)),
        _ => weights[0] = 1.0,
    }
    let sum: Vector3<f64> = at.iter().zip(weights).map(|(p, w)| (p - at[0]) * w).sum();
    (at[0] + sum, weights)
}

/// Where on the segment the point is nearest, in 0..1.
fn along(a: Point, b: Point, point: &Point) -> f64 {
    let edge = b - a;
    let square = edge.norm_squared();
    if square > 0.0 { ((point - a).dot(&edge) / square).clamp(0.0, 1.0) } else { 0.0 }
}

/// Barycentric coordinates of the nearest point of a triangle: the foot inside, or the best of the three edges.
fn in_triangle(a: Point, b: Point, c: Point, point: &Point) -> [f64; 3] {
    let (u, v, w) = (b - a, c - a, point - a);
    let normal = u.cross(&v);
    let area = normal.norm_squared();
    if area > 0.0 {
        let (s, t) = (w.cross(&v).dot(&normal) / area, u.cross(&w).dot(&normal) / area);
        if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
            return [1.0 - s - t, s, t];
        }
    }
    let (ab, bc, ca) = (along(a, b, point), along(b, c, point), along(c, a, point));
    let candidates = [[1.0 - ab, ab, 0.0], [0.0, 1.0 - bc, bc], [ca, 0.0, 1.0 - ca]];
    let distance = |k: &[f64; 3]| (w - u * k[1] - v * k[2]).norm_squared();
    candidates.into_iter().min_by(|x, y| distance(x).total_cmp(&distance(y))).unwrap_or(candidates[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::SplitMix64;

    #[test]
    fn nearest_point_of_a_triangle_beats_all_samples() {
        let mut rng = SplitMix64::new(5);
        let mut random = || Point::new(rng.unit(), rng.unit(), rng.unit());
        for _ in 0..200 {
            let (at, p) = ([random(), random(), random()], random());
            let (foot, weights) = foot(&at, &p);
            assert!(weights.iter().all(|w| (-1e-12..=1.0 + 1e-12).contains(w)));
            let best = (foot - p).norm();
            for (i, j) in (0..=20).flat_map(|i| (0..=20 - i).map(move |j| (i, j))) {
                let sample = at[0] + (at[1] - at[0]) * (f64::from(i) / 20.0) + (at[2] - at[0]) * (f64::from(j) / 20.0);
                assert!((sample - p).norm() >= best - 1e-12);
            }
        }
    }

    #[test]
    fn nearest_points_of_a_triangle() {
        let triangle = [Point::origin(), Point::new(2.0, 0.0, 0.0), Point::new(0.0, 2.0, 0.0)];
        let near = |x, y, z| foot(&triangle, &Point::new(x, y, z)).0;
        assert_eq!(near(0.5, 0.5, 3.0), Point::new(0.5, 0.5, 0.0));
        assert_eq!(near(-1.0, -1.0, 1.0), Point::origin());
        assert_eq!(near(1.0, -2.0, 0.0), Point::new(1.0, 0.0, 0.0));
        assert_eq!(near(2.0, 2.0, 0.0), Point::new(1.0, 1.0, 0.0));
        let flat = [Point::origin(), Point::new(1.0, 0.0, 0.0), Point::new(3.0, 0.0, 0.0)];
        assert_eq!(foot(&flat, &Point::new(2.0, 1.0, 0.0)).0, Point::new(2.0, 0.0, 0.0));
        assert_eq!(Nearest::new([triangle].into_iter()).distance(&Point::new(0.0, 0.0, 2.0)), 2.0);
        assert_eq!(Nearest::<3>::new([].into_iter()).distance(&Point::origin()), f64::INFINITY);
    }
}
