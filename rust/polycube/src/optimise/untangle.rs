//! Turns inverted elements the right way round.

use super::Settings;
use super::energy::Law;
use super::lbfgs::Limits;
use super::optimisation::Optimisation;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;

/// Where ε starts: from a hundredth of the mean determinant up to all of it.
const FIRST_EPSILON: [f64; 2] = [0.01, 1.0];
/// Where ε ends: as good as the true energy.
const LEAST_EPSILON: f64 = 1e-10;
/// See [`Untangling::patience`].
const SLOW: f64 = 0.7;
/// A few iterations that gain less end the round.
const TOLERANCE: f64 = 1e-3;

/// How an untangling goes about it.
pub(super) struct Untangling {
    /// Weight of equal volumes against similar shapes.
    pub(super) theta: f64,
    /// Most rounds.
    pub(super) rounds: usize,
    /// Most iterations of a round.
    pub(super) iterations: usize,
    /// Least share of the energy that a round is taken to gain (σ of Garanzha et al.): the larger, the faster ε falls.
    pub(super) least_gain: f64,
    /// Where so many rounds leave more than [`SLOW`] of the cells inverted, there is no room, and no more rounds are
    /// made.
    pub(super) patience: usize,
}

impl Untangling {
    /// All rounds of the settings.
    pub(super) fn new(settings: &Settings) -> Self {
        let Settings { theta, untangle_rounds, untangle_iterations, least_gain, .. } = *settings;
        Self { theta, rounds: untangle_rounds, iterations: untangle_iterations, least_gain, patience: usize::MAX }
    }
}

/// Minimises the regularised energy for falling ε until no element is inverted or the rounds are used up. Returns
/// whether none is. Sliding vertices are on their guides before and after.
pub(super) fn untangle_all(
    problem: &mut Optimisation,
    points: &mut Vec<Point>,
    untangling: &Untangling,
    context: &Context,
) -> Result<bool> {
    let limits = Limits { iterations: untangling.iterations, tolerance: TOLERANCE };
    // Few and slight inversions need not soften the energy of the whole mesh.
    let least = problem.assembly.census(points).least;
    let mut epsilon = (2.0 * least.abs()).clamp(FIRST_EPSILON[0], FIRST_EPSILON[1]);
    let mut counts = Vec::new();
    for round in 0..untangling.rounds {
        context.tick(round as f64 / untangling.rounds as f64)?;
        let law = Law::Regularised { theta: untangling.theta, epsilon };
        let gain = problem.descend(points, &law, limits, context)?;
        problem.constraints.project(points);
        let census = problem.assembly.census(points);
        if census.inverted == 0 && census.least > 0.0 {
            return Ok(true);
        }
        counts.push(census.inverted);
        if round >= untangling.patience && census.inverted as f64 > SLOW * counts[round - untangling.patience] as f64 {
            break;
        }
        epsilon = next_epsilon(epsilon, census.least, gain.clamp(untangling.least_gain, 1.0));
    }
    Ok(false)
}

/// The schedule of Garanzha et al. 2021, equation 8: with it finitely many rounds suffice if each is solved well.
/// `sigma` is the share of the energy that the last one gained.
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
