//! What surface vertices slide on: any closest-point map, a triangle surface, or a feature curve.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Point;
use crate::spatial::Nearest;
use nalgebra::Vector3;

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

fn tree<const N: usize>(points: &[Point], pieces: &[[u32; N]]) -> Result<Nearest<N>> {
    if pieces.is_empty() {
        return Err(Error::new(ErrorKind::Mesh, "a guide needs a triangle or segment at least"));
    }
    let finite = |v: &u32| points.get(*v as usize).is_some_and(|p| p.coords.iter().all(|x| x.is_finite()));
    if let Some(i) = pieces.iter().position(|piece| !piece.iter().all(finite)) {
        let message = "a vertex of the guide is missing or not finite";
        return Err(Error::new(ErrorKind::Mesh, message).at(Place::Face(i as u32)));
    }
    Ok(Nearest::new(pieces.iter().map(|piece| piece.map(|v| points[v as usize]))))
}

/// A surface of triangles with an index of its boxes (rstar): O(log n) a query, O(n log n) to build.
#[derive(Clone, Debug)]
pub struct SurfaceGuide {
    tree: Nearest<3>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<Vector3<f64>>,
}

impl SurfaceGuide {
    /// The surface of `triangles`; normals are interpolated between the vertices, so that sliding is smooth across
    /// edges.
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
        let Some(foot) = self.tree.foot(point) else {
            return Contact { point: *point, tangent: Tangent::Point };
        };
        let vertices = self.triangles[foot.index];
        let normal: Vector3<f64> = vertices.iter().zip(foot.weights).map(|(v, w)| self.normals[*v as usize] * w).sum();
        let tangent = normal.try_normalize(1e-9).map_or(Tangent::Point, Tangent::Plane);
        Contact { point: foot.point, tangent }
    }
}

/// A feature curve of segments with an index as in [`SurfaceGuide`].
#[derive(Clone, Debug)]
pub struct CurveGuide {
    tree: Nearest<2>,
    directions: Vec<Tangent>,
}

impl CurveGuide {
    /// The curve of `segments`, in any order.
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`] when there is no segment or one has a vertex that is missing or not finite.
    pub fn new(points: &[Point], segments: &[[u32; 2]]) -> Result<Self> {
        let tree = tree(points, segments)?;
        let direction = |s: &[u32; 2]| {
            let [a, b] = s.map(|v| points[v as usize]);
            (b - a).try_normalize(0.0).map_or(Tangent::Point, Tangent::Line)
        };
        Ok(Self { tree, directions: segments.iter().map(direction).collect() })
    }
}

impl Guide for CurveGuide {
    fn contact(&self, point: &Point) -> Contact {
        let Some(foot) = self.tree.foot(point) else {
            return Contact { point: *point, tangent: Tangent::Point };
        };
        Contact { point: foot.point, tangent: self.directions[foot.index] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
