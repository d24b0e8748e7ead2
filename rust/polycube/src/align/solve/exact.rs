//! Steepest descent by minimum cuts: exact, in integers, with a proof of optimality at the end.
//!
//! The cost with its difference constraints is L♮-convex: it is the sum of convex functions of single variables and of
//! differences of two. Such a function is minimal at `x` as soon as no set of variables improves it by moving up by 1 as
//! one, and none by moving down (Murota, *Discrete Convex Analysis*, 2003, theorem 7.14). The best set to move by `±s`
//! is a minimum cut, because with `g` the derivative of the cost at `x`
//!
//! ```text
//! cost(x ± s·S) − cost(x) = s · [ Σ_{i∈S} (weight_i λ s ± g_i)  +  Σ_{pairs cut by S} weight s ]
//! ```
//!
//! and a difference with slack below `s` forbids that only one of its two variables moves. Steps are powers of two,
//! long ones first (Murota 2003, section 10.3; Kolmogorov & Shioura, *Discrete Optimization* 6, 2009), so the number
//! of cuts grows with the logarithm of the distance.
//!
//! The last phase moves down by 1 for as long as that does not cost anything, taking the largest set each time.
//! It ends at the lowest of all optimal solutions.

use super::cut::{Network, UNLIMITED};
use super::parts::{Part, split};
use super::{Solution, Solver, begin, finish};
use crate::align::problem::Problem;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};

/// The default solver; the method is in the documentation of [`super`].
///
/// Each step is one minimum cut, O(n² m) at worst for n variables and m pairs and differences, nearly linear as a rule.
/// Cancellation is noticed between cuts.
#[derive(Clone, Copy, Debug, Default)]
pub struct ExactSolver;

impl Solver for ExactSolver {
    fn solve(
        &self,
        problem: &Problem,
        start: Option<&[i64]>,
        context: &Context,
    ) -> Result<Solution> {
        if !problem.linear.is_empty() {
            let message = "this solver knows differences of two levels only";
            return Err(Error::new(ErrorKind::Unsupported, message).remedy("use LinearSolver"));
        }
        let mut levels = begin(problem, start)?;
        let steps = descend(problem, &mut levels, context)?;
        finish(problem, levels, steps)
    }
}

/// Moves feasible `levels` to the lowest optimal solution; returns the number of cuts.
pub(super) fn descend(problem: &Problem, levels: &mut [i64], context: &Context) -> Result<u32> {
    let parts = split(problem);
    let reach = problem.reach();
    let mut network = Network::default();
    let (mut steps, mut done) = (0, 0);
    for part in &parts {
        context.tick(done as f64 / levels.len() as f64)?;
        done += part.variables.len();
        if settle(problem, part, levels) {
            continue;
        }
        let at: Vec<i64> = part.variables.iter().map(|&v| levels[v]).collect();
        let mut descent = Descent::new(problem, part, at, &mut network, context);
        descent.run(reach)?;
        steps += descent.steps;
        for (&v, &x) in part.variables.iter().zip(&descent.x) {
            levels[v] = x;
        }
    }
    Ok(steps)
}

/// Puts a part without pairs on its rounded targets if they keep their distances; whether that solved it.
fn settle(problem: &Problem, part: &Part, levels: &mut [i64]) -> bool {
    let near = |i: u32| problem.rounded_target(part.variables[i as usize]);
    let solved = part.pairs.is_empty()
        && part
            .differences
            .iter()
            .all(|d| near(d.high) - near(d.low) >= d.gap);
    if solved {
        for &v in &part.variables {
            levels[v] = problem.rounded_target(v);
        }
    }
    solved
}

#[derive(Clone, Copy, PartialEq)]
enum Way {
    Up,
    Down,
}

/// The search within one part. Costs are in units of `2^−(halvings + FRACTION_BITS)`.
struct Descent<'a> {
    part: &'a Part,
    context: &'a Context,
    network: &'a mut Network,
    /// Weight and target of each variable, as integers.
    shape: Vec<(i128, i128)>,
    /// What a pair of weight 1 costs at distance 1.
    unit: i128,
    x: Vec<i64>,
    slope: Vec<i128>,
    steps: u32,
}

impl<'a> Descent<'a> {
    fn new(
        problem: &Problem,
        part: &'a Part,
        x: Vec<i64>,
        network: &'a mut Network,
        context: &'a Context,
    ) -> Self {
        let term = |&v: &usize| {
            (
                i128::from(problem.shape[v].weight),
                i128::from(problem.fixed_target(v)),
            )
        };
        Self {
            shape: part.variables.iter().map(term).collect(),
            unit: 1 << (problem.halvings + Problem::FRACTION_BITS),
            slope: vec![0; x.len()],
            steps: 0,
            part,
            context,
            network,
            x,
        }
    }

    fn run(&mut self, reach: (i64, i64)) -> Result<()> {
        self.differentiate();
        let mut stride = self.longest(reach);
        while stride > 1 {
            self.phase(stride)?;
            stride /= 2;
        }
        self.phase(1)?;
        while self.shift(Way::Down, 1, true)? {}
        // Free moves down cannot open a way up; this cut proves it.
        if self.shift(Way::Up, 1, false)? {
            return Err(Error::new(
                ErrorKind::Internal,
                "the descent did not end at an optimum",
            ));
        }
        Ok(())
    }

    /// Moves by `stride` until neither way improves.
    fn phase(&mut self, stride: i64) -> Result<()> {
        loop {
            while self.shift(Way::Up, stride, false)? {}
            if !self.shift(Way::Down, stride, false)? {
                return Ok(());
            }
            while self.shift(Way::Down, stride, false)? {}
        }
    }

    /// The longest power of two that may still improve: no further than optimal levels lie apart, and short enough
    /// for the slope of some variable to outweigh its own shape term.
    fn longest(&self, (low, high): (i64, i64)) -> i64 {
        let far = self
            .x
            .iter()
            .map(|&x| (x - low).max(high - x))
            .max()
            .unwrap_or(1);
        let steep = |(&(weight, _), slope): (&(i128, i128), &i128)| {
            slope.abs() / (weight << Problem::FRACTION_BITS)
        };
        let steep = self
            .shape
            .iter()
            .zip(&self.slope)
            .map(steep)
            .max()
            .unwrap_or(1);
        let bound = i128::from(far).min(steep).max(1);
        1 << bound.ilog2()
    }

    /// Moves the best set by `stride`, if that improves the cost, or leaves it as it is and `free` moves are allowed.
    fn shift(&mut self, way: Way, stride: i64, free: bool) -> Result<bool> {
        let supply = self.supply(way, stride);
        let hopeless = |s: &i128| *s < 0 || (*s == 0 && !free);
        if supply.iter().all(hopeless) {
            return Ok(false);
        }
        self.context.tick(0.0)?;
        self.steps += 1;
        self.network.reset(supply.into_iter());
        self.join_pairs(stride);
        self.join_differences(way, stride);
        self.network.saturate();
        if !free && !self.network.has_supply() {
            return Ok(false);
        }
        Ok(self.displace(way, stride))
    }

    /// What each variable gains by moving alone, pairs' convexity aside.
    fn supply(&self, way: Way, stride: i64) -> Vec<i128> {
        let gain = |(&(weight, _), &slope): (&(i128, i128), &i128)| {
            let own = (weight << Problem::FRACTION_BITS) * i128::from(stride);
            if way == Way::Up {
                -slope - own
            } else {
                slope - own
            }
        };
        self.shape.iter().zip(&self.slope).map(gain).collect()
    }

    fn join_pairs(&mut self, stride: i64) {
        for p in &self.part.pairs {
            let room = self.unit * i128::from(p.weight) * i128::from(stride);
            self.network.join(p.a, p.b, room, room);
        }
    }

    fn join_differences(&mut self, way: Way, stride: i64) {
        for d in &self.part.differences {
            if self.x[d.high as usize] - self.x[d.low as usize] - d.gap < stride {
                // Whoever moves towards the other takes it along.
                let (from, to) = if way == Way::Up {
                    (d.low, d.high)
                } else {
                    (d.high, d.low)
                };
                self.network.join(from, to, UNLIMITED, 0);
            }
        }
    }

    /// Moves the source side of the cut; whether it holds any variable.
    fn displace(&mut self, way: Way, stride: i64) -> bool {
        let stride = if way == Way::Up { stride } else { -stride };
        let mut moved = false;
        for (v, x) in self.x.iter_mut().enumerate() {
            if self.network.on_source_side(v) {
                *x += stride;
                moved = true;
            }
        }
        if moved {
            self.differentiate();
        }
        moved
    }

    /// Recomputes the slope of the cost along every variable.
    fn differentiate(&mut self) {
        for (i, &(weight, target)) in self.shape.iter().enumerate() {
            let apart = (i128::from(self.x[i]) << Problem::FRACTION_BITS) - target;
            self.slope[i] = 2 * weight * apart;
        }
        for p in &self.part.pairs {
            let apart = i128::from(self.x[p.a as usize]) - i128::from(self.x[p.b as usize]);
            let pull = 2 * self.unit * i128::from(p.weight) * apart;
            self.slope[p.a as usize] += pull;
            self.slope[p.b as usize] -= pull;
        }
    }
}
