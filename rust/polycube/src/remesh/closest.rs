//! The distance from points to a surface, by an index over its triangles.

use crate::mesh::Point;
use rstar::{AABB, PointDistance, RTree, RTreeObject};

/// A triangle of the index.
struct Triangle([Point; 3]);

impl RTreeObject for Triangle {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_points(self.0.map(|p| p.coords.into()).iter())
    }
}

impl PointDistance for Triangle {
    fn distance_2(&self, point: &[f64; 3]) -> f64 {
        let point = Point::from(*point);
        (closest_point(&self.0, &point) - point).norm_squared()
    }
}

/// Triangles, indexed for nearest points.
pub(super) struct Closest {
    index: RTree<Triangle>,
}

impl Closest {
    /// Indexes triangles by their corners. O(n log n).
    pub(super) fn new(triangles: impl Iterator<Item = [Point; 3]>) -> Self {
        Self { index: RTree::bulk_load(triangles.map(Triangle).collect()) }
    }

    /// The distance from `point` to the nearest triangle; infinite where there is none. O(log n) in practice.
    pub(super) fn distance(&self, point: &Point) -> f64 {
        let at = point.coords.into();
        self.index.nearest_neighbor(at).map_or(f64::INFINITY, |t| t.distance_2(&at).sqrt())
    }
}

/// The point of a triangle nearest to `p`, flat or not: in its interior if `p` projects there, else on its border.
fn closest_point(&[a, b, c]: &[Point; 3], p: &Point) -> Point {
    let normal = (b - a).cross(&(c - a));
    let beside = |from: &Point, to: &Point| (to - from).cross(&(p - from)).dot(&normal) < 0.0;
    if normal.norm_squared() > 0.0 && !beside(&a, &b) && !beside(&b, &c) && !beside(&c, &a) {
        return p - normal * ((p - a).dot(&normal) / normal.norm_squared());
    }
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| on_segment(&from, &to, p));
    let nearer = |x: Point, y: Point| if (y - p).norm_squared() < (x - p).norm_squared() { y } else { x };
    nearer(nearer(sides[0], sides[1]), sides[2])
}

fn on_segment(a: &Point, b: &Point, p: &Point) -> Point {
    let along = b - a;
    let length = along.norm_squared();
    let t = if length > 0.0 { ((p - a).dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
    a + along * t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_points_of_a_triangle() {
        let triangle = [Point::origin(), Point::new(2.0, 0.0, 0.0), Point::new(0.0, 2.0, 0.0)];
        let near = |x, y, z| closest_point(&triangle, &Point::new(x, y, z));
        assert_eq!(near(0.5, 0.5, 3.0), Point::new(0.5, 0.5, 0.0));
        assert_eq!(near(-1.0, -1.0, 1.0), Point::origin());
        assert_eq!(near(1.0, -2.0, 0.0), Point::new(1.0, 0.0, 0.0));
        assert_eq!(near(2.0, 2.0, 0.0), Point::new(1.0, 1.0, 0.0));
        let flat = [Point::origin(), Point::new(1.0, 0.0, 0.0), Point::new(3.0, 0.0, 0.0)];
        assert_eq!(closest_point(&flat, &Point::new(2.0, 1.0, 0.0)), Point::new(2.0, 0.0, 0.0));
        assert_eq!(Closest::new([triangle].into_iter()).distance(&Point::new(0.0, 0.0, 2.0)), 2.0);
        assert_eq!(Closest::new([].into_iter()).distance(&Point::origin()), f64::INFINITY);
    }
}
