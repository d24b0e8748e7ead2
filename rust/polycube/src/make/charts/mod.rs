//! Charts on the shape: what a set of loops stands for, drawn, thinned out and moved to where the surface suits them.

mod relabel;
mod shortest;
mod thin;
mod trace;
mod triangulation;

use super::loops::{LoopSet, along, cost};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Face, Point};
use crate::structure::area_vector;
use nalgebra::Vector3;
use triangulation::{NONE, Triangulation};

/// How long a border may be made to gain a mean triangle that looks along its label, in mean sides of triangles.
const STIFFNESS: f64 = 0.1;

/// Triangles of a surface in charts, each with a label.
pub(super) struct ChartedSurface {
    /// The vertices; those of the shape come first.
    pub(super) points: Vec<Point>,
    /// The triangles, in the order of those of the shape that they are part of.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The triangle of the shape that each is part of.
    pub(super) origins: Vec<u32>,
    /// The chart of each triangle.
    pub(super) chart: Vec<u32>,
    /// The label of each chart, 0 to 5.
    pub(super) labels: Vec<u8>,
    /// A crossing of loops in each chart; none where charts do not come of loops.
    pub(super) crossings: Vec<u32>,
}

impl ChartedSurface {
    /// What the labels cost, as a share of the surface.
    pub(super) fn cost(&self) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        for (t, &chart) in self.triangles.iter().zip(&self.chart) {
            let normal = area_vector(&self.points, &Face::Triangle(*t));
            sum += cost(normal.norm(), along(&normal, self.labels[chart as usize]));
            total += normal.norm();
        }
        sum / f64::max(total, f64::MIN_POSITIVE)
    }
}

/// Draws the charts that loops stand for on the surface that they lie on.
///
/// Every edge of the polycube becomes a path of sides of triangles. Triangles are cut where there is no room for a
/// path, and made whole again where that can be; what stays cut is a refinement of the shape. O(n log n) for n
/// triangles of the cut mesh.
///
/// # Errors
/// [`ErrorKind::Internal`] if the charts do not come out as the loops say; [`ErrorKind::Cancelled`].
pub(super) fn charts(
    points: &[Point],
    triangles: &[[u32; 3]],
    loops: &LoopSet,
    context: &Context,
) -> Result<ChartedSurface> {
    context.tick(0.0)?;
    let mut traced = trace::trace(loops, context)
        .ok_or_else(|| Error::new(ErrorKind::Internal, "the charts are not those that the loops stand for"))?;
    context.tick(0.6)?;
    let normals: Vec<Vector3<f64>> = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| points[v as usize]);
            (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_default()
        })
        .collect();
    thin::thin_out(&mut traced, points.len(), &normals);
    context.tick(0.8)?;
    relabel::relabel(&mut traced, STIFFNESS * mean_side(points, triangles));
    context.tick(0.9)?;
    thin::thin_out(&mut traced, points.len(), &normals);
    context.tick(1.0)?;
    Ok(traced.compact(points.len()))
}

fn mean_side(points: &[Point], triangles: &[[u32; 3]]) -> f64 {
    let side = |t: &[u32; 3], k: usize| (points[t[k] as usize] - points[t[(k + 1) % 3] as usize]).norm();
    let sum: f64 = triangles.iter().map(|t| (0..3).map(|k| side(t, k)).sum::<f64>()).sum();
    sum / (3 * triangles.len().max(1)) as f64
}

/// Charts while they are worked on: `patch` of a triangle is its chart.
struct Traced {
    mesh: Triangulation,
    labels: Vec<u8>,
    crossings: Vec<u32>,
}

impl Traced {
    /// The charts without gaps in the numbering; the first `kept` vertices keep their numbers.
    fn compact(self, kept: usize) -> ChartedSurface {
        let Self { mesh, labels, crossings } = self;
        let mut number = vec![NONE; mesh.points.len()];
        let mut points = Vec::new();
        for v in (0..mesh.points.len()).filter(|&v| v < kept || mesh.at[v] != NONE) {
            number[v] = points.len() as u32;
            points.push(mesh.points[v]);
        }
        let mut order: Vec<usize> = (0..mesh.triangles.len()).filter(|&t| !mesh.triangles[t].is_gone()).collect();
        order.sort_by_key(|&t| (mesh.triangles[t].origin, t));
        let triangles = order.iter().map(|&t| mesh.triangles[t].vertices.map(|v| number[v as usize])).collect();
        let origins = order.iter().map(|&t| mesh.triangles[t].origin).collect();
        let chart = order.iter().map(|&t| mesh.triangles[t].patch).collect();
        ChartedSurface { points, triangles, origins, chart, labels, crossings }
    }
}
