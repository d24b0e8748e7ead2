//! Raises the worst quality of a mesh without inverted elements.

use super::Settings;
use super::assembly::Census;
use super::energy::Law;
use super::lbfgs::Limits;
use super::optimisation::Optimisation;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;

/// A few iterations that gain less end the round.
const TOLERANCE: f64 = 1e-2;
/// No round may leave an element with less than this share of the worst quality before it.
const BAR: f64 = 0.5;
/// Largest exponent, as a power of two.
const SQUARINGS: u32 = 6;
/// Weight of the average against the worst quality.
const AVERAGE: f64 = 0.5;

/// How good a state is.
pub(super) fn score(census: &Census) -> f64 {
    census.worst + AVERAGE * census.average - census.tension
}

/// The states that rounds of improvement led to.
pub(super) struct BestPoints {
    /// The best one after a round.
    pub(super) best: Vec<Point>,
    /// The best one whose worst quality is not below that of the input.
    pub(super) safe: Vec<Point>,
}

/// Minimises the energy with a growing penalty on the elements near the worst, from `points`, which must be on the
/// guides with no element inverted; none is afterwards.
pub(super) fn improve(
    problem: &mut Optimisation,
    points: &[Point],
    settings: &Settings,
    context: &Context,
) -> Result<BestPoints> {
    let start = problem.assembly.census(points);
    let mut improved = BestPoints { best: points.to_vec(), safe: points.to_vec() };
    let (mut best, mut safe) = (f64::NEG_INFINITY, score(&start));
    let mut points = points.to_vec();
    let limits = Limits { iterations: settings.improve_iterations, tolerance: TOLERANCE };
    for round in 0..settings.improve_rounds {
        context.tick(round as f64 / settings.improve_rounds as f64)?;
        let census = step(problem, &mut points, law(settings, round, problem.elements.small()), limits, context)?;
        if score(&census) > best {
            best = score(&census);
            improved.best.copy_from_slice(&points);
        }
        if census.worst >= start.worst && score(&census) > safe {
            safe = score(&census);
            improved.safe.copy_from_slice(&points);
        }
    }
    Ok(improved)
}

/// The law of a round, for the worst quality 1: exponents double evenly over the rounds.
fn law(settings: &Settings, round: usize, small: f64) -> Law {
    let span = settings.improve_rounds.saturating_sub(1).max(1);
    let squarings = 1 + ((SQUARINGS - 1) as usize * round).div_ceil(span) as u32;
    let Settings { theta, average, strength, .. } = *settings;
    Law::Barrier { theta, average, strength, floor: 1.0, squarings, small }
}

/// One round from `points`.
fn step(
    problem: &mut Optimisation,
    points: &mut Vec<Point>,
    mut law: Law,
    limits: Limits,
    context: &Context,
) -> Result<Census> {
    let before = points.clone();
    let worst = problem.assembly.census(points).worst;
    if let Law::Barrier { floor, .. } = &mut law {
        *floor = worst;
    }
    problem.descend(points, &law, limits, context)?;
    problem.settle(&before, points, BAR * worst, context)?;
    Ok(problem.assembly.census(points))
}
