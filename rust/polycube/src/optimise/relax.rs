//! Distortion lowered for its own sake.

use super::elements::Elements;
use super::energy::Law;
use super::freedom::{Constraints, Freedom};
use super::lbfgs::Limits;
use super::optimisation::Optimisation;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;

/// A few iterations that gain less end it.
const TOLERANCE: f64 = 1e-3;

/// Moves `points` to where elements differ least from what they should be, in shape and, with weight `theta` in `0..1`,
/// in volume, in so many `iterations` at most. No element becomes inverted; if one is, nothing moves.
///
/// # Errors
/// [`ErrorKind::Option`](crate::ErrorKind::Option) for freedom on a guide;
/// [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
pub(crate) fn relax(
    points: &mut [Point],
    elements: &Elements,
    freedom: &[Freedom],
    theta: f64,
    iterations: usize,
    context: &Context,
) -> Result<()> {
    let mut elements = elements.clone();
    elements.match_size(points);
    let mut problem = Optimisation::new(&elements, Constraints::new(freedom, &[])?, points.len());
    if problem.assembly.census(points).inverted > 0 {
        return Ok(());
    }
    let small = elements.small();
    let law = Law::Barrier { theta, average: 0.0, strength: 0.0, floor: 1.0, squarings: 1, small };
    let mut moved = points.to_vec();
    problem.descend(&mut moved, &law, Limits { iterations, tolerance: TOLERANCE }, context)?;
    problem.constraints.restore(&mut moved, points);
    if problem.assembly.census(&moved).inverted == 0 {
        points.copy_from_slice(&moved);
    }
    Ok(())
}
