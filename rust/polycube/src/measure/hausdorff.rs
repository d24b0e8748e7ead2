//! How far a mesh is from the shape it stands for.

use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Face, Mesh, Point};
use crate::spatial::Nearest;
use rayon::prelude::*;

/// Vertices or faces between two looks at the context: some milliseconds' work.
pub(crate) const AT_ONCE: usize = 1024;

/// Sides of the grid of samples on a quadrilateral.
const SAMPLES: usize = 4;

/// The Hausdorff distance between the surfaces of two meshes, in their units: how far the point of one that is farthest
/// from the other is from it, both ways.
///
/// Sampled: at the vertices, at a 4 × 4 grid over each quadrilateral and at the centre of each triangle; so it is a
/// lower bound, within the size of a face of the truth. The distance from each sample to the other surface is exact, a
/// quadrilateral counting as four triangles around its centre where it bends. O(n log n) for n faces of both.
///
/// # Errors
/// [`ErrorKind::Mesh`] when a mesh has no cells or three cells share a face; [`ErrorKind::Cancelled`].
pub fn hausdorff(mesh: &Mesh, shape: &Mesh, context: &Context) -> Result<f64> {
    let there = farthest(mesh, shape, &context.stage("hausdorff", 0.0, 0.5))?;
    let back = farthest(shape, mesh, &context.stage("hausdorff", 0.5, 1.0))?;
    Ok(there.max(back))
}

/// The largest distance from a sample of `from` to the surface of `to`.
///
/// The distance grows no faster than one walks, so samples that cannot be farther than the farthest yet are skipped.
fn farthest(from: &Mesh, to: &Mesh, context: &Context) -> Result<f64> {
    context.check()?;
    let faces = from.cells().boundary()?;
    context.check()?;
    let target = to.cells().boundary()?;
    if faces.is_empty() || target.is_empty() {
        return Err(Error::new(ErrorKind::Mesh, "a mesh without cells has no surface"));
    }
    context.check()?;
    let index = Nearest::new(target.iter().flat_map(|f| triangles(to, f)));
    context.check()?;
    let at_vertices = vertex_distances(from, &faces, &index, &context.stage("hausdorff", 0.0, 0.3))?;
    let context = context.stage("hausdorff", 0.3, 1.0);
    let mut worst = at_vertices.iter().copied().fold(0.0_f64, f64::max);
    for (i, some) in faces.chunks(AT_ONCE).enumerate() {
        context.tick((i * AT_ONCE) as f64 / faces.len() as f64)?;
        let far = |face: &Face| farthest_sample(from, face, &index, &at_vertices, worst);
        worst = some.par_iter().with_min_len(32).map(far).reduce(|| worst, f64::max);
    }
    Ok(worst)
}

/// The largest distance of a sample on a face that is farther than `least`, else `least`.
fn farthest_sample(mesh: &Mesh, face: &Face, index: &Nearest<3>, at_vertices: &[f64], least: f64) -> f64 {
    let mut worst = least;
    for sample in samples(mesh, face) {
        let reach = |&v: &u32| at_vertices[v as usize] + (sample - mesh.points()[v as usize]).norm();
        if face.vertices().iter().map(reach).fold(f64::INFINITY, f64::min) > worst {
            worst = worst.max(index.distance(&sample));
        }
    }
    worst
}

/// The distance of every vertex of `faces` from the index; 0 for vertices off the surface.
fn vertex_distances(mesh: &Mesh, faces: &[Face], index: &Nearest<3>, context: &Context) -> Result<Vec<f64>> {
    let mut used = vec![false; mesh.points().len()];
    faces.iter().flat_map(Face::vertices).for_each(|&v| used[v as usize] = true);
    let mut distances = vec![0.0; used.len()];
    let distance = |(distance, (point, used)): (&mut f64, (&Point, &bool))| {
        *distance = if *used { index.distance(point) } else { 0.0 };
    };
    let count = used.len();
    for (i, some) in distances.chunks_mut(AT_ONCE).enumerate() {
        let first = i * AT_ONCE;
        context.tick(first as f64 / count as f64)?;
        let inputs = mesh.points()[first..].par_iter().zip(&used[first..]);
        some.par_iter_mut().zip(inputs).with_min_len(64).for_each(distance);
    }
    Ok(distances)
}

/// Points of a face beside its vertices.
pub(crate) fn samples(mesh: &Mesh, face: &Face) -> Vec<Point> {
    let at = |v: u32| mesh.points()[v as usize];
    match *face {
        Face::Triangle(t) => {
            let [a, b, c] = t.map(at);
            vec![Point::from((a.coords + b.coords + c.coords) / 3.0)]
        }
        Face::Quad(q) => {
            let [a, b, c, d] = q.map(at);
            let point = |s: f64, t: f64| a.lerp(&b, s).lerp(&d.lerp(&c, s), t);
            let unit = |i: usize| i as f64 / SAMPLES as f64;
            let corner = |i: usize, j: usize| i.is_multiple_of(SAMPLES) && j.is_multiple_of(SAMPLES);
            let grid = (0..=SAMPLES).flat_map(|i| (0..=SAMPLES).map(move |j| (i, j)));
            grid.filter(|&(i, j)| !corner(i, j)).map(|(i, j)| point(unit(i), unit(j))).collect()
        }
    }
}

/// A face as triangles: a flat quadrilateral as two, a bent one as four around its centre.
pub(crate) fn triangles(mesh: &Mesh, face: &Face) -> Vec<[Point; 3]> {
    let at = |v: u32| mesh.points()[v as usize];
    match *face {
        Face::Triangle(t) => vec![t.map(at)],
        Face::Quad(q) => {
            let p = q.map(at);
            if (p[1] - p[0]).cross(&(p[3] - p[0])).dot(&(p[2] - p[0])) == 0.0 {
                return face.triangles().map(|t| t.map(at)).collect();
            }
            let centre = Point::from((p[0].coords + p[1].coords + p[2].coords + p[3].coords) / 4.0);
            (0..4).map(|k| [p[k], p[(k + 1) % 4], centre]).collect()
        }
    }
}

/// The diagonal of the bounding box of the points that cells use.
pub(crate) fn diagonal(mesh: &Mesh) -> f64 {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for v in (0..mesh.cells().len()).flat_map(|i| mesh.cells().cell(i)) {
        for a in 0..3 {
            let x = mesh.points()[*v as usize][a];
            (low[a], high[a]) = (low[a].min(x), high[a].max(x));
        }
    }
    (0..3).map(|a| (high[a] - low[a]).powi(2)).sum::<f64>().sqrt()
}
