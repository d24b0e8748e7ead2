//! Minimises a smooth function of points: L-BFGS (Nocedal and Wright, "Numerical Optimization", algorithm 7.4) with the
//! bisecting line search of Lewis and Overton (2013) for the weak Wolfe conditions.

use super::field::{Field, dot, paired, update};
use crate::error::Result;
use crate::mesh::Point;
use nalgebra::Vector3;
use std::collections::VecDeque;

/// Pairs of steps and gradient changes remembered.
const MEMORY: usize = 8;
/// Evaluations in one line search.
const TRIALS: usize = 40;
/// Share of the promised descent that a step must bring.
const DESCENT: f64 = 1e-4;
/// Share of the slope that may be left after a step.
const CURVATURE: f64 = 0.9;
/// Iterations over which slowness shows: the first ones after a start are short.
const PATIENCE: usize = 5;
/// Length of the first step at the vertex that moves farthest, in its own scale.
const FIRST_STEP: f64 = 0.1;

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Most iterations.
    pub(super) iterations: usize,
    /// Stops when [`PATIENCE`] iterations lower the energy by less than this share.
    pub(super) tolerance: f64,
}

/// What was done.
#[derive(Clone, Debug, Default)]
pub(super) struct Outcome {
    /// The energy at the start and after every iteration; never rises.
    pub(super) energies: Vec<f64>,
}

impl Outcome {
    fn is_slow(&self, tolerance: f64) -> bool {
        let [first, .., last] = self.energies[self.energies.len().saturating_sub(PATIENCE + 1)..] else { return false };
        self.energies.len() > PATIENCE && first - last < tolerance * first.abs()
    }
}

struct Pair {
    step: Field,
    change: Field,
    /// `1 / (step · change)`.
    rho: f64,
    /// Of the scales, the multiple that fits the inverse Hessian along `change` best.
    factor: f64,
}

/// Minus the approximate inverse Hessian times the gradient. `scales` are squared lengths a vertex: the first guess of
/// that inverse, up to a factor.
fn direction(pairs: &VecDeque<Pair>, gradient: &[Vector3<f64>], scales: &[f64]) -> Field {
    let mut d: Field = gradient.iter().map(|g| -g).collect();
    let mut alphas = Vec::with_capacity(pairs.len());
    for pair in pairs.iter().rev() {
        let alpha = pair.rho * dot(&pair.step, &d);
        update(&mut d, &pair.change, |d, change| *d -= change * alpha);
        alphas.push(alpha);
    }
    let factor = pairs.back().map_or_else(|| first_factor(&d, scales), |pair| pair.factor);
    update(&mut d, scales, |d, s| *d *= factor * s);
    for (pair, alpha) in pairs.iter().zip(alphas.into_iter().rev()) {
        let beta = pair.rho * dot(&pair.change, &d);
        update(&mut d, &pair.step, |d, step| *d += step * (alpha - beta));
    }
    d
}

fn first_factor(d: &[Vector3<f64>], scales: &[f64]) -> f64 {
    let longest = d.iter().zip(scales).map(|(d, s)| d.norm() * s.sqrt()).fold(0.0, f64::max);
    if longest > 0.0 { FIRST_STEP / longest } else { 0.0 }
}

/// A place with its energy and gradient.
#[derive(Clone)]
struct Iterate {
    points: Vec<Point>,
    energy: f64,
    gradient: Field,
}

/// Goes along `d` to a better state; none when there is none within rounding.
fn search(
    from: &Iterate,
    d: &[Vector3<f64>],
    evaluate: &mut impl FnMut(&[Point], &mut [Vector3<f64>]) -> Result<f64>,
) -> Result<Option<Iterate>> {
    let slope = dot(&from.gradient, d);
    if slope.is_nan() || slope >= 0.0 {
        return Ok(None);
    }
    let (mut low, mut high, mut step) = (0.0, f64::INFINITY, 1.0);
    let (mut next, mut best) = (from.clone(), None);
    for _ in 0..TRIALS {
        next.points = paired(&from.points, d, |p, d| p + d * step);
        next.energy = evaluate(&next.points, &mut next.gradient)?;
        let descends = next.energy < from.energy && next.energy <= from.energy + DESCENT * step * slope;
        if !descends {
            high = step;
        } else if dot(&next.gradient, d) < CURVATURE * slope {
            low = step;
            best = Some(next.clone());
        } else {
            return Ok(Some(next));
        }
        // Once something better is known, a few halvings are enough to look for more.
        if best.is_some() && high.is_finite() && high < low * 1.5 {
            break;
        }
        step = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * low };
    }
    Ok(best)
}

/// Minimises the energy that `evaluate` gives together with its gradient, starting at and returning in `points`. Steps
/// are sums of gradients, so they stay in any linear space the gradients lie in.
///
/// # Errors
/// Those of `evaluate`; the points are unchanged then.
pub(super) fn minimise(
    points: &mut Vec<Point>,
    scales: &[f64],
    limits: Limits,
    evaluate: &mut impl FnMut(&[Point], &mut [Vector3<f64>]) -> Result<f64>,
) -> Result<Outcome> {
    let mut gradient = vec![Vector3::zeros(); points.len()];
    let energy = evaluate(points, &mut gradient)?;
    let mut state = Iterate { points: points.clone(), energy, gradient };
    let mut outcome = Outcome { energies: vec![energy] };
    let mut pairs = VecDeque::new();
    while outcome.energies.len() <= limits.iterations && state.energy.is_finite() {
        let d = direction(&pairs, &state.gradient, scales);
        match search(&state, &d, evaluate)? {
            Some(next) => {
                remember(&mut pairs, &state, &next, scales);
                outcome.energies.push(next.energy);
                state = next;
                if outcome.is_slow(limits.tolerance) {
                    break;
                }
            }
            // The curvature may mislead; without it the way is straight down.
            None if pairs.is_empty() => break,
            None => pairs.clear(),
        }
    }
    *points = state.points;
    Ok(outcome)
}

fn remember(pairs: &mut VecDeque<Pair>, from: &Iterate, to: &Iterate, scales: &[f64]) {
    let step = paired(&to.points, &from.points, |a, b| a - b);
    let change = paired(&to.gradient, &from.gradient, |a, b| a - b);
    let product = dot(&step, &change);
    if product > 1e-12 * (dot(&step, &step) * dot(&change, &change)).sqrt() {
        if pairs.len() == MEMORY {
            pairs.pop_front();
        }
        let scaled = paired(&change, scales, |c, s| c * *s);
        pairs.push_back(Pair { rho: 1.0 / product, factor: product / dot(&change, &scaled), step, change });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_bottom_of_a_curved_valley_and_never_climbs() {
        let mut points = vec![Point::new(-1.2, 1.0, 3.0); 5];
        let mut evaluate = |p: &[Point], g: &mut [Vector3<f64>]| {
            let mut energy = 0.0;
            for (p, g) in p.iter().zip(g) {
                let (u, v) = (1.0 - p.x, p.y - p.x * p.x);
                energy += u * u + 100.0 * v * v + p.z.powi(4);
                *g = Vector3::new(-2.0 * u - 400.0 * v * p.x, 200.0 * v, 4.0 * p.z.powi(3));
            }
            Ok(energy)
        };
        let limits = Limits { iterations: 500, tolerance: 0.0 };
        let outcome = minimise(&mut points, &[1.0; 5], limits, &mut evaluate).unwrap();
        assert!(outcome.energies.windows(2).all(|e| e[1] <= e[0]));
        assert!(points.iter().all(|p| (p.xy() - Point::new(1.0, 1.0, 0.0).xy()).norm() < 1e-5), "{points:?}");
    }
}
