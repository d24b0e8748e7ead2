//! Makes room for the last inverted cells: all others are improved as if these were not there.

use super::Settings;
use super::freedom::Constraints;
use super::improve::improve;
use super::local::untangle_near;
use super::optimisation::Optimisation;
use super::polish::polish;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;

/// How often.
const ROUNDS: usize = 3;
/// Rounds of improvement each time.
const IMPROVE_ROUNDS: usize = 2;
/// Not where more than this part of all cells is inverted: they are no longer the exception.
const MOST: f64 = 0.02;

/// Improves the cells that are not inverted, which may leave no room to the others, and untangles again what is near
/// these; a few times. No more are inverted than before. Whether none is left.
pub(super) fn make_room(
    problem: &mut Optimisation,
    points: &mut Vec<Point>,
    settings: &Settings,
    context: &Context,
) -> Result<bool> {
    let mut bad = problem.assembly.inverted(points);
    for round in 0..ROUNDS {
        if bad.is_empty() || bad.len() as f64 > MOST * problem.elements.cells() as f64 {
            break;
        }
        let [from, to] = [round, round + 1].map(|r| r as f64 / ROUNDS as f64);
        let context = context.stage("untangle", from, to);
        improve_others(problem, points, &bad, settings, &context.stage("untangle", 0.0, 0.7))?;
        untangle_near(problem, points, settings, &context.stage("untangle", 0.7, 0.9))?;
        polish(problem.elements, &problem.constraints, points, settings.polish_rounds, 0.0, &context)?;
        problem.constraints.project(points);
        bad = problem.assembly.inverted(points);
    }
    Ok(bad.is_empty())
}

fn improve_others(
    problem: &mut Optimisation,
    points: &mut Vec<Point>,
    bad: &[usize],
    settings: &Settings,
    context: &Context,
) -> Result<()> {
    let good: Vec<u32> =
        (0..problem.elements.cells()).filter(|c| bad.binary_search(c).is_err()).map(|c| c as u32).collect();
    let elements = problem.elements.some(&good, |v| v);
    let mut constraints = Constraints::new(problem.constraints.freedom, problem.constraints.guides)?;
    constraints.project(points);
    let mut others = Optimisation::new(&elements, constraints, points.len());
    let few = Settings { improve_rounds: settings.improve_rounds.min(IMPROVE_ROUNDS), ..settings.clone() };
    *points = improve(&mut others, points, &few, context)?.best;
    problem.iterations += others.iterations;
    problem.constraints.project(points);
    Ok(())
}
