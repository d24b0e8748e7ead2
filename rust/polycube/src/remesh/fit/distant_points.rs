//! Where a shape is far from the mesh that stands for it.

use crate::context::Context;
use crate::error::Result;
use crate::measure::hausdorff::{self, AT_ONCE, triangles};
use crate::mesh::{Face, Mesh, Point};
use crate::optimise::Guide;
use crate::spatial::Nearest;
use crate::structure::Surface;
use rayon::prelude::*;

/// A place where a mesh cuts off or fills up what it should follow.
pub(crate) struct DistantPoint {
    /// The point of the shape there.
    pub(crate) at: Point,
    /// How far it is from the mesh.
    pub(crate) distance: f64,
    /// The face of the mesh nearest to it.
    pub(crate) face: Face,
}

/// The vertices of the shape's `surface` and the middles of its faces.
pub(crate) fn samples(surface: &Surface, shape: &[Point]) -> Vec<Point> {
    let mut used = vec![false; shape.len()];
    surface.faces().iter().flat_map(Face::vertices).for_each(|&v| used[v as usize] = true);
    let vertices = shape.iter().zip(used).filter(|(_, used)| *used).map(|(p, _)| *p);
    vertices.chain(surface.faces().iter().map(|f| f.middle(shape))).collect()
}

/// How far the farthest of some samples of a shape is from the `faces` of a mesh. O(n log n).
pub(crate) fn farthest(points: &[Point], faces: &[Face], samples: &[Point]) -> f64 {
    let triangles = faces.iter().flat_map(Face::triangles).map(|t| t.map(|v| points[v as usize]));
    let index = Nearest::new(triangles);
    samples.par_iter().map(|p| index.distance(p)).reduce(|| 0.0, f64::max)
}

/// Where samples of a shape are farther than `bound` from the `faces` around a `mesh`, or those of its faces from the
/// `shape`, the farthest first: the samples that [`hausdorff`](hausdorff::hausdorff) takes. O(n log n).
///
/// # Errors
/// [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
pub(crate) fn distant_points(
    (mesh, faces): (&Mesh, &[Face]),
    (shape, samples): (&dyn Guide, &[Point]),
    bound: f64,
    context: &Context,
) -> Result<Vec<DistantPoint>> {
    context.check()?;
    let pieces: Vec<_> = faces.iter().flat_map(|f| triangles(mesh, f).into_iter().map(move |t| (*f, t))).collect();
    context.check()?;
    let index = Nearest::new(pieces.iter().map(|(_, t)| *t));
    context.check()?;
    let distant = |at: &Point| {
        let foot = index.foot(at)?;
        let distance = (foot.point - at).norm();
        (distance > bound).then_some(DistantPoint { at: *at, distance, face: pieces[foot.index].0 })
    };
    let mut found: Vec<DistantPoint> = Vec::new();
    for some in samples.chunks(AT_ONCE) {
        context.check()?;
        found.par_extend(some.par_iter().filter_map(distant));
    }
    for some in faces.chunks(AT_ONCE) {
        context.check()?;
        found.par_extend(some.par_iter().filter_map(|face| bulge(mesh, face, shape, bound)));
    }
    found.sort_by(|a, b| b.distance.total_cmp(&a.distance));
    Ok(found)
}

/// The sample of a face that is farthest from the shape, if it is farther than `bound`. Vertices lie on the shape, so
/// what is near one is near the shape.
fn bulge(mesh: &Mesh, face: &Face, shape: &dyn Guide, bound: f64) -> Option<DistantPoint> {
    let corners = face.vertices();
    let away = |p: &Point| corners.iter().all(|&v| (mesh.points()[v as usize] - p).norm() > bound);
    let distant = |p: Point| {
        let at = shape.contact(&p).point;
        DistantPoint { at, distance: (p - at).norm(), face: *face }
    };
    let far = hausdorff::samples(mesh, face).into_iter().filter(away).map(distant).filter(|g| g.distance > bound);
    far.max_by(|a, b| a.distance.total_cmp(&b.distance))
}
