//! What surface vertices slide on: any closest-point map, a triangle surface, or a feature curve.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Point;
use nalgebra::Vector3;
use rstar::{AABB, PointDistance, RTree, RTreeObject};

/// The directions in which a vertex may move on a guide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangent {
    /// Across the unit normal.
    Plane(Vector3<f64>),
    /// Along the unit direction.
    Line(Vector3<f64>),
    /// Not at all.
    Point,
}

/// Where a guide is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The nearest point of the guide.
    pub point: Point,
    /// Where the guide goes from there.
    pub tangent: Tangent,
}

/// A surface, curve or point to slide on. Must give the same answer each time.
pub trait Guide: Sync {
    /// The nearest place on the guide.
    fn contact(&self, point: &Point) -> Contact;
}

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
        (nearest(&self.at, &point).0 - point).norm_squared()
    }
}

/// The nearest point of a segment or triangle, and its barycentric coordinates.
fn nearest<const N: usize>(at: &[Point; N], point: &Point) -> (Point, [f64; N]) {
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

fn tree<const N: usize>(points: &[Point], pieces: &[[u32; N]]) -> Result<RTree<Piece<N>>> {
    if pieces.is_empty() {
        return Err(Error::new(ErrorKind::Mesh, "a guide needs a triangle or segment at least"));
    }
    let finite = |v: &u32| points.get(*v as usize).is_some_and(|p| p.coords.iter().all(|x| x.is_finite()));
    if let Some(i) = pieces.iter().position(|piece| !piece.iter().all(finite)) {
        let message = "a vertex of the guide is missing or not finite";
        return Err(Error::new(ErrorKind::Mesh, message).at(Place::Face(i as u32)));
    }
    let piece = |(i, vertices): (usize, &[u32; N])| Piece { index: i as u32, at: vertices.map(|v| points[v as usize]) };
    Ok(RTree::bulk_load(pieces.iter().enumerate().map(piece).collect()))
}

/// Nearest piece, nearest point and its barycentric coordinates; none only for an empty tree.
fn closest<const N: usize>(tree: &RTree<Piece<N>>, point: &Point) -> Option<(usize, Point, [f64; N])> {
    let piece = tree.nearest_neighbor([point.x, point.y, point.z])?;
    let (foot, weights) = nearest(&piece.at, point);
    Some((piece.index as usize, foot, weights))
}

/// A surface of triangles with an index of its boxes (rstar): O(log n) a query, O(n log n) to build.
#[derive(Clone, Debug)]
pub struct SurfaceGuide {
    tree: RTree<Piece<3>>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<Vector3<f64>>,
}

impl SurfaceGuide {
    /// The surface of `triangles`; normals are interpolated between the vertices, so that sliding is smooth across edges.
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`] when there is no triangle or one has a vertex that is missing or not finite.
    pub fn new(points: &[Point], triangles: &[[u32; 3]]) -> Result<Self> {
        let tree = tree(points, triangles)?;
        let mut normals = vec![Vector3::zeros(); points.len()];
        for t in triangles {
            let [a, b, c] = t.map(|v| points[v as usize]);
            t.iter().for_each(|v| normals[*v as usize] += (b - a).cross(&(c - a)));
        }
        normals.iter_mut().for_each(|n| *n = n.try_normalize(0.0).unwrap_or_default());
        Ok(Self { tree, triangles: triangles.to_vec(), normals })
    }
}

impl Guide for SurfaceGuide {
    fn contact(&self, point: &Point) -> Contact {
        let Some((index, foot, weights)) = closest(&self.tree, point) else {
            return Contact { point: *point, tangent: Tangent::Point };
        };
        let vertices = self.triangles[index];
        let normal: Vector3<f64> = vertices.iter().zip(weights).map(|(v, w)| self.normals[*v as usize] * w).sum();
        let tangent = normal.try_normalize(1e-9).map_or(Tangent::Point, Tangent::Plane);
        Contact { point: foot, tangent }
    }
}

/// A feature curve of segments with an index as in [`SurfaceGuide`].
#[derive(Clone, Debug)]
pub struct CurveGuide {
    tree: RTree<Piece<2>>,
}

impl CurveGuide {
    /// The curve of `segments`, in any order.
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`] when there is no segment or one has a vertex that is missing or not finite.
    pub fn new(points: &[Point], segments: &[[u32; 2]]) -> Result<Self> {
        Ok(Self { tree: tree(points, segments)? })
    }
}

impl Guide for CurveGuide {
    fn contact(&self, point: &Point) -> Contact {
        let Some(piece) = self.tree.nearest_neighbor([point.x, point.y, point.z]) else {
            return Contact { point: *point, tangent: Tangent::Point };
        };
        let [a, b] = piece.at;
        let tangent = (b - a).try_normalize(0.0).map_or(Tangent::Point, Tangent::Line);
        Contact { point: nearest(&piece.at, point).0, tangent }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::SplitMix64;

    #[test]
    fn nearest_point_of_a_triangle_beats_all_samples() {
        let mut rng = SplitMix64::new(5);
        let mut random = || Point::new(rng.unit(), rng.unit(), rng.unit());
        for _ in 0..200 {
            let (at, p) = ([random(), random(), random()], random());
            let (foot, weights) = nearest(&at, &p);
            assert!(weights.iter().all(|w| (-1e-12..=1.0 + 1e-12).contains(w)));
            let best = (foot - p).norm();
            for (i, j) in (0..=20).flat_map(|i| (0..=20 - i).map(move |j| (i, j))) {
                let sample = at[0] + (at[1] - at[0]) * (f64::from(i) / 20.0) + (at[2] - at[0]) * (f64::from(j) / 20.0);
                assert!((sample - p).norm() >= best - 1e-12);
            }
        }
    }

    #[test]
    fn guides_refuse_nothing_and_nan() {
        assert!(SurfaceGuide::new(&[], &[]).is_err());
        assert!(CurveGuide::new(&[Point::origin()], &[[0, 1]]).is_err());
        assert!(CurveGuide::new(&[Point::origin(), Point::new(f64::NAN, 0.0, 0.0)], &[[0, 1]]).is_err());
    }

    #[test]
    fn curves_give_their_direction() {
        let points = [Point::origin(), Point::new(2.0, 0.0, 0.0), Point::new(2.0, 2.0, 0.0)];
        let guide = CurveGuide::new(&points, &[[0, 1], [1, 2]]).unwrap();
        let contact = guide.contact(&Point::new(0.5, 0.5, 1.0));
        assert_eq!(contact, Contact { point: Point::new(0.5, 0.0, 0.0), tangent: Tangent::Line(Vector3::x()) });
    }
}
