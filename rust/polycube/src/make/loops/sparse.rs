//! The Laplacian of a surface, and linear systems with it.

use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;

/// Values of three functions at the vertices.
pub(super) type Values = Vec<[f64; 3]>;

/// Iterations of the solver, and by how much it reduces the squared residual.
const ITERATIONS: usize = 300;
const REDUCTION: f64 = 1e-7;

/// The cotangent Laplacian of a triangle mesh (Pinkall and Polthier, 1993) with weights kept positive, and lumped
/// areas.
#[derive(Clone, Debug)]
pub(super) struct Laplacian {
    start: Vec<u32>,
    neighbours: Vec<(u32, f64)>,
    areas: Vec<f64>,
}

/// The weight of the side opposite corner `k` of a triangle.
pub(super) fn weight(p: &[Point; 3], k: usize) -> f64 {
    let (a, b) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
    let double = a.cross(&b).norm();
    if double > 0.0 { (0.5 * a.dot(&b) / double).clamp(1e-3, 1e3) } else { 1e3 }
}

impl Laplacian {
    /// That of a mesh. Linear in the triangles but for sorting.
    pub(super) fn new(points: &[Point], triangles: &[[u32; 3]]) -> Self {
        let mut areas = vec![0.0; points.len()];
        let mut sides: Vec<(u32, u32, f64)> = Vec::with_capacity(6 * triangles.len());
        for t in triangles {
            let p = t.map(|v| points[v as usize]);
            let third = (p[1] - p[0]).cross(&(p[2] - p[0])).norm() / 6.0;
            for k in 0..3 {
                let (i, j, w) = (t[(k + 1) % 3], t[(k + 2) % 3], weight(&p, k));
                sides.extend([(i, j, w), (j, i, w)]);
                areas[t[k] as usize] += third;
            }
        }
        // Stable: weights of one side are added in the order of the triangles.
        sides.sort_by_key(|s| (s.0, s.1));
        let mut start = vec![0; points.len() + 1];
        let mut neighbours: Vec<(u32, f64)> = Vec::with_capacity(sides.len() / 2);
        for own in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            neighbours.push((own[0].1, own.iter().map(|s| s.2).sum()));
            start[own[0].0 as usize + 1] += 1;
        }
        (0..points.len()).for_each(|i| start[i + 1] += start[i]);
        let floor = 1e-9 * areas.iter().sum::<f64>() / points.len().max(1) as f64;
        areas.iter_mut().for_each(|a| *a += floor);
        Self { start, neighbours, areas }
    }

    fn row(&self, i: usize) -> &[(u32, f64)] {
        &self.neighbours[self.start[i] as usize..self.start[i + 1] as usize]
    }

    /// The functions `u` with `screen * area * (u - near) + laplacian(u) = right`, by conjugate gradients from `near`.
    ///
    /// # Errors
    /// Only that the context was cancelled.
    pub(super) fn solve(&self, right: &Values, screen: f64, near: &Values, context: &Context) -> Result<Values> {
        let mut u = near.clone();
        let diagonal: Vec<f64> =
            (0..u.len()).map(|i| screen * self.areas[i] + self.row(i).iter().map(|n| n.1).sum::<f64>()).collect();
        let apply = |x: &Values| -> Values {
            let entry = |i: usize| {
                let mut sum = x[i].map(|v| v * diagonal[i]);
                for &(j, w) in self.row(i) {
                    (0..3).for_each(|c| sum[c] -= w * x[j as usize][c]);
                }
                sum
            };
            (0..x.len()).map(entry).collect()
        };
        let applied = apply(&u);
        let wanted = |i: usize, c: usize| right[i][c] + screen * self.areas[i] * near[i][c];
        let mut residual: Values =
            (0..u.len()).map(|i| std::array::from_fn(|c| wanted(i, c) - applied[i][c])).collect();
        let scaled = |r: &Values| -> Values { r.iter().zip(&diagonal).map(|(r, d)| r.map(|x| x / d)).collect() };
        let mut step = scaled(&residual);
        let mut size = dot(&residual, &step);
        let goal = size.map(|s| s * REDUCTION);
        for _ in 0..ITERATIONS {
            if (0..3).all(|c| size[c] <= goal[c]) {
                break;
            }
            context.check()?;
            let applied = apply(&step);
            let length = ratio(size, dot(&step, &applied));
            add(&mut u, length, &step);
            add(&mut residual, length.map(|l| -l), &applied);
            let next = scaled(&residual);
            let before = std::mem::replace(&mut size, dot(&residual, &next));
            let keep = ratio(size, before);
            step.iter_mut().zip(&next).for_each(|(s, n)| (0..3).for_each(|c| s[c] = n[c] + keep[c] * s[c]));
        }
        Ok(u)
    }
}

fn dot(a: &Values, b: &Values) -> [f64; 3] {
    a.iter().zip(b).fold([0.0; 3], |sum, (a, b)| std::array::from_fn(|c| sum[c] + a[c] * b[c]))
}

fn ratio(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| if b[c] > 0.0 { a[c] / b[c] } else { 0.0 })
}

fn add(to: &mut Values, factor: [f64; 3], what: &Values) {
    to.iter_mut().zip(what).for_each(|(t, w)| (0..3).for_each(|c| t[c] += factor[c] * w[c]));
}
