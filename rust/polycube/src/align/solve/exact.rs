//! Steepest descent by minimum cuts: exact, in integers, with a proof of optimality at the end.
//!
//! The cost with its difference constraints is L♮-convex: it is the sum of convex functions of single variables and of
//! differences of two. Such a function is minimal at `x` as soon as no set of variables improves it by moving up by 1
//! as one, and none by moving down (Murota, *Discrete Convex Analysis*, 2003, theorem 7.14). The best set to move by
//! `±s` is a minimum cut, because with `g` the derivative of the cost at `x`
//!
//! ```text
//! cost(x ± s·S) − cost(x) = s · [ Σ_{i∈S} (weight_i λ s ± g_i)  +  Σ_{pairs cut by S} weight s ]
//! ```
//!
//! and a difference with slack below `s` forbids that only one of its two variables moves. Steps are powers of two,
//! long ones first (Murota 2003, section 10.3), so the number of cuts grows with the logarithm of the distance, and
//! each cut continues the flow of the one before (Kolmogorov & Shioura, *Discrete Optimization* 6, 2009).
//!
//! The last phase moves down by 1 for as long as that does not cost anything, taking the largest set each time.
//! It ends at the lowest of all optimal solutions.

use super::cut::{Network, UNLIMITED};
use super::subproblems::{Subproblem, split};
use super::{Solution, Solver, begin, finish};
use crate::align::problem::Problem;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};

/// The default solver: steepest descent, each step the best set of levels to move together, found by a minimum cut.
/// It ends with a proof: no set improves the cost by moving up or down by 1, which suffices for an L♮-convex cost.
///
/// Each step is one minimum cut, O(n² m) at worst for n variables and m pairs and differences, nearly linear as a rule.
/// Cancellation is noticed between cuts.
#[derive(Clone, Copy, Debug, Default)]
pub struct ExactSolver;

impl Solver for ExactSolver {
    fn solve(&self, problem: &Problem, start: Option<&[i64]>, context: &Context) -> Result<Solution> {
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
fn settle(problem: &Problem, part: &Subproblem, levels: &mut [i64]) -> bool {
    let near = |i: u32| problem.rounded_target(part.variables[i as usize]);
    let solved = part.pairs.is_empty() && part.differences.iter().all(|d| near(d.high) - near(d.low) >= d.gap);
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

impl Way {
    /// Moving down is moving up with every axis, and so every arc, reversed.
    fn order(self, (a, b): (u32, u32)) -> (u32, u32) {
        if self == Self::Up { (a, b) } else { (b, a) }
    }
}

/// The search within one part. Costs are in units of `2^−(halvings + FRACTION_BITS)`.
///
/// Flows survive from cut to cut: with `d = x_a − x_b` the pull of a pair may be anything from `weight (2d − s)` to
/// `weight (2d + s)`, its derivatives half a step to either side. A pair cut by a move has its pull at the end of that
/// range which is also an end of the range after the move, so pulls stay valid and the next cut starts almost solved.
struct Descent<'a> {
    part: &'a Subproblem,
    context: &'a Context,
    network: &'a mut Network,
    /// Weight and target of each variable, as integers.
    shape: Vec<(i128, i128)>,
    /// What a pair of weight 1 costs at distance 1.
    unit: i128,
    x: Vec<i64>,
    /// How strongly each pair draws `a` down and `b` up.
    pull: Vec<i128>,
    /// How strongly each difference pushes `low` down and `high` up; at least 0, and 0 where there is slack.
    push: Vec<i128>,
    supply: Vec<i128>,
    steps: u32,
}

impl<'a> Descent<'a> {
    fn new(
        problem: &Problem,
        part: &'a Subproblem,
        x: Vec<i64>,
        network: &'a mut Network,
        context: &'a Context,
    ) -> Self {
        let fixed = |v: usize| i128::from(problem.fixed_target(v));
        let term = |&v: &usize| (i128::from(problem.shape[v].weight), fixed(v));
        Self {
            shape: part.variables.iter().map(term).collect(),
            unit: 1 << (problem.halvings + Problem::FRACTION_BITS),
            pull: vec![0; part.pairs.len()],
            push: vec![0; part.differences.len()],
            supply: vec![0; x.len()],
            steps: 0,
            part,
            context,
            network,
            x,
        }
    }

    /// Strides double while they improve, so that a start near the optimum costs few cuts, and are halved then.
    fn run(&mut self, (low, high): (i64, i64)) -> Result<()> {
        let far = self.x.iter().map(|&x| (x - low).max(high - x)).max();
        let far = far.unwrap_or(1);
        let mut stride = 1;
        while stride < far && self.shift(Way::Up, stride, false)? | self.shift(Way::Down, stride, false)? {
            stride *= 2;
        }
        while stride > 1 {
            self.phase(stride)?;
            stride /= 2;
        }
        self.phase(1)?;
        while self.shift(Way::Down, 1, true)? {}
        // Free moves down cannot open a way up; this cut proves it.
        if self.shift(Way::Up, 1, false)? {
            return Err(Error::new(ErrorKind::Internal, "the descent did not end at an optimum"));
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

    /// Moves the best set by `stride`, if that improves the cost, or leaves it as it is and `free` moves are allowed.
    fn shift(&mut self, way: Way, stride: i64, free: bool) -> Result<bool> {
        self.clamp(stride);
        self.weigh(way, stride);
        if self.supply.iter().all(|&s| s < 0 || (s == 0 && !free)) {
            return Ok(false);
        }
        self.context.check()?;
        self.steps += 1;
        self.network.reset(&self.supply);
        self.join(way, stride);
        self.network.saturate();
        self.remember(stride);
        if !free && !self.network.has_supply() {
            return Ok(false);
        }
        Ok(self.displace(way, stride))
    }

    /// The least and the greatest pull of pair `i` for a step of `stride`.
    fn range(&self, i: usize, stride: i64) -> (i128, i128) {
        let p = &self.part.pairs[i];
        let twice = 2 * (self.x[p.a as usize] - self.x[p.b as usize]);
        let weight = self.unit * i128::from(p.weight);
        (weight * i128::from(twice - stride), weight * i128::from(twice + stride))
    }

    fn is_tight(&self, i: usize, stride: i64) -> bool {
        let d = &self.part.differences[i];
        self.x[d.high as usize] - self.x[d.low as usize] - d.gap < stride
    }

    /// Brings pulls and pushes into their ranges.
    fn clamp(&mut self, stride: i64) {
        for i in 0..self.pull.len() {
            let (least, most) = self.range(i, stride);
            self.pull[i] = self.pull[i].clamp(least, most);
        }
        for i in 0..self.push.len() {
            if !self.is_tight(i, stride) {
                self.push[i] = 0;
            }
        }
    }

    /// What each variable gains by moving, given the pulls and pushes.
    fn weigh(&mut self, way: Way, stride: i64) {
        for (i, &(weight, target)) in self.shape.iter().enumerate() {
            let apart = (i128::from(self.x[i]) << Problem::FRACTION_BITS) - target;
            let own = i128::from(stride) << Problem::FRACTION_BITS;
            self.supply[i] = weight * (if way == Way::Up { -2 * apart } else { 2 * apart } - own);
        }
        let pairs = self.part.pairs.iter().map(|p| (p.a, p.b)).zip(&self.pull);
        let differences = self.part.differences.iter().map(|d| (d.low, d.high)).zip(&self.push);
        for (ends, &force) in pairs.chain(differences) {
            let (from, to) = way.order(ends);
            self.supply[from as usize] -= force;
            self.supply[to as usize] += force;
        }
    }

    /// Arcs in the order of [`remember`](Self::remember): pairs, then tight differences.
    fn join(&mut self, way: Way, stride: i64) {
        for (i, p) in self.part.pairs.iter().enumerate() {
            let (least, most) = self.range(i, stride);
            let (from, to) = way.order((p.a, p.b));
            self.network.join(from, to, most - self.pull[i], self.pull[i] - least);
        }
        for (i, d) in self.part.differences.iter().enumerate() {
            if self.is_tight(i, stride) {
                // Whoever moves towards the other takes it along.
                let (from, to) = way.order((d.low, d.high));
                self.network.join(from, to, UNLIMITED, self.push[i]);
            }
        }
    }

    /// Keeps the flows as pulls and pushes.
    fn remember(&mut self, stride: i64) {
        let mut arc = 0;
        for i in 0..self.pull.len() {
            self.pull[i] = self.range(i, stride).0 + self.network.room_back(arc);
            arc += 1;
        }
        for i in 0..self.push.len() {
            if self.is_tight(i, stride) {
                self.push[i] = self.network.room_back(arc);
                arc += 1;
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
        moved
    }
}
