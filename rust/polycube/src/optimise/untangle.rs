//! Turns inverted elements the right way round.

use super::Settings;
use super::energy::Law;
use super::lbfgs::Limits;
use super::problem::Problem;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;

/// Where ε starts: from a hundredth of the mean determinant up to all of it.
const FIRST_EPSILON: [f64; 2] = [0.01, 1.0];
/// Where ε ends: as good as the true energy.
const LEAST_EPSILON: f64 = 1e-10;
/// A few iterations that gain less end the round.
const TOLERANCE: f64 = 1e-3;

/// Minimises the regularised energy for falling ε until no element is inverted or the rounds are used up. Returns whether
/// none is. Sliding vertices are on their guides before and after.
pub(super) fn untangle(
    problem: &mut Problem,
    points: &mut Vec<Point>,
    settings: &Settings,
    context: &Context,
) -> Result<bool> {
    let limits = Limits { iterations: settings.untangle_iterations, tolerance: TOLERANCE };
    // Few and slight inversions need not soften the energy of the whole mesh.
    let least = problem.assembly.census(points).least;
    let mut epsilon = (2.0 * least.abs()).clamp(FIRST_EPSILON[0], FIRST_EPSILON[1]);
    for round in 0..settings.untangle_rounds {
        context.tick(round as f64 / settings.untangle_rounds as f64)?;
        let law = Law::Regularised { theta: settings.theta, epsilon };
        let gain = problem.descend(points, &law, limits, context)?;
        problem.constraints.project(points);
        let census = problem.assembly.census(points);
        if census.inverted == 0 && census.least > 0.0 {
            return Ok(true);
        }
        epsilon = next_epsilon(epsilon, census.least, gain.clamp(settings.least_gain, 1.0));
    }
    Ok(false)
}

/// The schedule of Garanzha et al. 2021, equation 8: with it finitely many rounds suffice if each is solved well. `sigma` is the share
/// of the energy that the last one gained.
fn next_epsilon(epsilon: f64, least: f64, sigma: f64) -> f64 {
    let root = (epsilon * epsilon + least * least).sqrt();
    let chi = if least > 0.0 { 0.5 * (least + root) } else { 0.5 * epsilon * epsilon / (root - least) };
    let mu = (1.0 - sigma) * chi;
    let next = if least < mu { 2.0 * (mu * (mu - least)).sqrt() } else { LEAST_EPSILON };
    // Not `clamp`, which panics where one of them is not a number.
    next.max(LEAST_EPSILON).min(epsilon.max(LEAST_EPSILON))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn epsilon_falls_to_its_end() {
        let (mut epsilon, mut least) = (1.0, -3.0);
        for _ in 0..200 {
            let next = next_epsilon(epsilon, least, 0.1);
            assert!(next <= epsilon);
            (epsilon, least) = (next, least * 0.9);
        }
        assert!(epsilon < 1e-6);
        assert_eq!(next_epsilon(0.1, 0.5, 0.5), LEAST_EPSILON);
        assert_eq!(next_epsilon(f64::NAN, f64::NAN, 0.5), LEAST_EPSILON);
    }
}
