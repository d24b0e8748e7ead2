//! Solvers of the integer problem, interchangeable behind [`Solver`].
//!
//! | solver | method | accepts `linear` constraints | use |
//! |---|---|---|---|
//! | [`ExactSolver`] | minimum cuts in integer arithmetic | no | default |
//! | [`LinearSolver`] | linear programs through `good_lp` | yes | check, and oblique separation planes |
//!
//! Without linear constraints both return the same levels: of all optimal solutions the lowest. It is unique, because
//! with two optimal solutions their minimum, variable by variable, is optimal too (the cost is L♮-convex). The mirrored
//! problem therefore has the mirrored cost, while its levels are the mirrored *highest* solution if there are several.

mod cut;
mod exact;
mod linear;
mod subproblems;
#[cfg(test)]
mod tests;

pub use exact::ExactSolver;
pub use linear::LinearSolver;

use super::problem::Problem;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};

/// An optimal solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The integer level of each variable.
    pub levels: Vec<i64>,
    /// [`Problem::cost`] of the levels.
    pub cost: f64,
    /// Number of minimum cuts or linear programs solved.
    pub steps: u32,
}

/// Something that solves a [`Problem`] to optimality.
pub trait Solver: Sync {
    /// Minimises the cost of `problem`.
    ///
    /// `start` is where the search begins: the nearer to the optimum, the fewer steps. If it breaks a difference a
    /// solution near it is used; without it, one near the targets. It never changes the result of a problem without
    /// linear constraints.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for numbers out of range, [`ErrorKind::Infeasible`] for contradictory constraints,
    /// [`ErrorKind::Unsupported`] for constraints this solver does not know, [`ErrorKind::Cancelled`], and
    /// [`ErrorKind::Internal`] should the result fail its checks.
    fn solve(&self, problem: &Problem, start: Option<&[i64]>, context: &Context) -> Result<Solution>;
}

/// The feasible point where a search begins.
fn begin(problem: &Problem, start: Option<&[i64]>) -> Result<Vec<i64>> {
    match start {
        Some(near) => problem.feasible_near(near),
        None => problem.feasible_start(),
    }
}

/// Checks the result of a solver before it is handed out.
fn finish(problem: &Problem, levels: Vec<i64>, steps: u32) -> Result<Solution> {
    problem
        .is_feasible(&levels)
        .map_err(|violation| Error::new(ErrorKind::Internal, format!("the solver's result is wrong: {violation}")))?;
    let cost = problem.cost(&levels);
    Ok(Solution { levels, cost, steps })
}
