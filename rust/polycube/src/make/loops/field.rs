//! The functions whose level sets are the loops: coordinates that are flat where the surface faces their axis.

use super::sparse::{Laplacian, Values, weight};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use nalgebra::Vector3;

/// How sharply a function turns from following its coordinate to being flat, as the normal turns to its axis.
const SHARPNESS: f64 = 4.0;

/// What the three functions are solved from.
///
/// Level sets of plain coordinates cut a thin round rim into stairs, as no two chords of it meet. These functions are
/// near to the coordinates (Poisson's equation, screened), but their gradients are zero where the surface faces the
/// axis, as on the polycube that is looked for: on them the rim is a square.
#[derive(Clone, Debug)]
pub(super) struct Field {
    laplacian: Laplacian,
    /// Minus the divergence of the gradients wanted.
    sources: Values,
    coordinates: Values,
    /// The longest side of the box around the shape.
    size: f64,
}

impl Field {
    /// That of a closed surface.
    pub(super) fn new(points: &[Point], triangles: &[[u32; 3]]) -> Self {
        let mut sources = vec![[0.0; 3]; points.len()];
        for t in triangles {
            let p = t.map(|v| points[v as usize]);
            let Some(normal) = (p[1] - p[0]).cross(&(p[2] - p[0])).try_normalize(0.0) else { continue };
            let wanted = [0, 1, 2].map(|axis| gradient(&normal, axis));
            for k in 0..3 {
                let [i, j] = [(k + 1) % 3, (k + 2) % 3];
                let flow = wanted.map(|w| weight(&p, k) * w.dot(&(p[i] - p[j])));
                sources[t[i] as usize].iter_mut().zip(flow).for_each(|(source, f)| *source += f);
                sources[t[j] as usize].iter_mut().zip(flow).for_each(|(source, f)| *source -= f);
            }
        }
        let low = points.iter().fold([f64::INFINITY; 3], |l, p| [0, 1, 2].map(|a| l[a].min(p[a])));
        let high = points.iter().fold([f64::NEG_INFINITY; 3], |h, p| [0, 1, 2].map(|a| h[a].max(p[a])));
        let size = (0..3).map(|a| high[a] - low[a]).fold(0.0, f64::max);
        let coordinates = points.iter().map(|p| [p.x, p.y, p.z]).collect();
        Self { laplacian: Laplacian::new(points, triangles), sources, coordinates, size }
    }

    /// The three functions. `reach` is how far from a vertex others pull on it, `smooth` the size of what is smoothed
    /// away; both are shares of the longest side, and nothing is smoothed for 0.
    ///
    /// # Errors
    /// Only that the context was cancelled.
    pub(super) fn solve(&self, reach: f64, smooth: f64, context: &Context) -> Result<Values> {
        let screen = 1.0 / (reach * self.size * reach * self.size);
        let values = self.laplacian.solve(&self.sources, screen, &self.coordinates, context)?;
        if smooth == 0.0 {
            return Ok(values);
        }
        let none = vec![[0.0; 3]; values.len()];
        self.laplacian.solve(&none, 1.0 / (smooth * self.size * smooth * self.size), &values, context)
    }
}

/// The gradient wanted of the function of an axis: that of the coordinate, less the nearer the normal is to the axis.
fn gradient(normal: &Vector3<f64>, axis: usize) -> Vector3<f64> {
    let facing = normal[axis].abs();
    let share = ((std::f64::consts::FRAC_1_SQRT_2 - facing) * SHARPNESS + 0.5).clamp(0.0, 1.0);
    (Vector3::ith(axis, 1.0) - normal * normal[axis]) * share
}
