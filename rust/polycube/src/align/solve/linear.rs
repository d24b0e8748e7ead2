//! Linear programs over integer breakpoints, through `good_lp`.
//!
//! Between consecutive integers `k` and `k + 1` each convex term is replaced by its chord, which costs nothing in
//! accuracy where only integers count. A term's value `y` (a level, or the distance of a pair) is written as a sum of
//! segments, each with the slope of one chord, so that all coefficients of the rows are ±1. With differences alone the
//! matrix is a network's, hence totally unimodular, and the vertices that a simplex method returns are integral.
//!
//! Chords are added lazily. The model never exceeds the true cost and equals it at `y` if the chords on both sides of
//! `y` are present. So once that holds for every term of the model's optimum, this optimum is the true one. Every round
//! adds a chord or is the last, and only finitely many lie within the bounds on levels.
//!
//! With [`Linear`] constraints vertices may be fractional; then levels are declared
//! integer and the backend branches.

use super::exact::descend;
use super::{Solution, Solver, begin, finish};
use crate::align::problem::{Linear, Problem};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
#[cfg(feature = "highs")]
use good_lp::highs as backend;
#[cfg(not(feature = "highs"))]
use good_lp::microlp as backend;
use good_lp::solvers::{SolutionStatus, WithMipGap, WithTimeLimit};
use good_lp::{Expression, ProblemVariables, ResolutionError, Solution as _, SolverModel, Variable, variable};
use std::collections::BTreeSet;
use std::time::Duration;

/// How far from an integer a level may be, and how much of the cost floating point may lose.
const TOLERANCE: f64 = 1e-6;

/// Solves [`Problem`] by linear programs, or by mixed-integer programs if there are linear constraints.
///
/// The backend is `microlp`, or HiGHS with the cargo feature `highs`. Both calculate in floating point, so without
/// linear constraints the result is then brought to the lowest optimal solution by exact steps; had that gained more
/// than a millionth of the cost, it would be reported as an internal error. With linear constraints there may be
/// several optimal solutions and the backend decides. Cancellation is noticed between programs.
#[derive(Clone, Copy, Debug)]
pub struct LinearSolver {
    /// The time one mixed-integer program may take; beyond it solving fails with [`ErrorKind::Unsupported`].
    /// Branching may never end where linear constraints leave a long strip without integers. One minute by default.
    pub time_limit: Duration,
}

impl Default for LinearSolver {
    fn default() -> Self {
        Self { time_limit: Duration::from_secs(60) }
    }
}

impl Solver for LinearSolver {
    fn solve(&self, problem: &Problem, start: Option<&[i64]>, context: &Context) -> Result<Solution> {
        let start = begin(problem, start)?;
        let mut model = Model::new(problem, &start);
        let mut steps = 0;
        let mut moves = loop {
            context.check()?;
            steps += 1;
            let moves = model.optimum(self.time_limit)?;
            if !model.refine(&moves) {
                break moves;
            }
        };
        for value in &mut moves {
            *value = whole(*value).ok_or_else(|| internal("a level of the linear program is fractional"))?;
        }
        let mut levels: Vec<i64> = start.iter().zip(&moves).map(|(x, &by)| x + by as i64).collect();
        if problem.linear.is_empty() {
            polish(problem, &mut levels, context)?;
        }
        finish(problem, levels, steps)
    }
}

/// Brings an optimum in floating point to the lowest exact one.
fn polish(problem: &Problem, levels: &mut [i64], context: &Context) -> Result<()> {
    if let Err(violation) = problem.is_feasible(levels) {
        return Err(internal(&format!("the linear program's result is wrong: {violation}")));
    }
    let before = problem.cost(levels);
    descend(problem, levels, context)?;
    let after = problem.cost(levels);
    if before - after > TOLERANCE * after.max(1.0) {
        return Err(internal(&format!("the linear program missed the optimum: {before} instead of {after}")));
    }
    Ok(())
}

/// `curvature (y − centre)²` of the value `y = x[plus] − x[minus]`, or `x[plus]`, counted from the start.
struct Term {
    plus: usize,
    minus: Option<usize>,
    curvature: f64,
    centre: f64,
    /// The chords present: `k` stands for the one from `k` to `k + 1`. Always holds −1 and 0.
    chords: BTreeSet<i64>,
}

impl Term {
    /// A term with chords at doubling distances up to `far`, so that the first optimum is near the last.
    fn new(plus: usize, minus: Option<usize>, curvature: f64, centre: f64, far: i64) -> Self {
        let doubling = || std::iter::successors(Some(0), |k| Some(2 * k + 1)).take_while(|&k| k <= far);
        let chords = doubling().flat_map(|k| [k, -1 - k]).chain([-1, 0]).collect();
        Self { plus, minus, curvature, centre, chords }
    }

    fn slope(&self, chord: i64) -> f64 {
        self.curvature * ((2 * chord + 1) as f64 - 2.0 * self.centre)
    }

    fn value(&self, moves: &[f64]) -> f64 {
        moves[self.plus] - self.minus.map_or(0.0, |v| moves[v])
    }

    /// Adds the chords around `y` that are missing; whether there were any.
    fn refine(&mut self, y: f64) -> bool {
        match whole(y) {
            Some(y) => self.chords.insert(y as i64) | self.chords.insert(y as i64 - 1),
            None => self.chords.insert(y.floor() as i64),
        }
    }

    /// Adds the segments to the objective; returns `y` as their signed sum.
    fn segments(&self, columns: &mut ProblemVariables, objective: &mut Expression) -> Expression {
        let mut y = Expression::default();
        let up: Vec<i64> = self.chords.range(0..).copied().collect();
        let down: Vec<i64> = self.chords.range(..0).rev().copied().collect();
        for (chords, sign) in [(up, 1.0), (down, -1.0)] {
            for (i, &k) in chords.iter().enumerate() {
                // Chords k and m of a parabola meet at (k + m + 1) / 2; the first begins at 0.
                let meet = |m: i64| (k + m + 1) as f64 / 2.0;
                let from = if i == 0 { 0.0 } else { meet(chords[i - 1]) };
                let width = chords.get(i + 1).map_or(f64::INFINITY, |&m| (meet(m) - from).abs());
                let segment = columns.add(variable().min(0.0).max(width));
                y.add_mul(sign, segment);
                objective.add_mul(sign * self.slope(k), segment);
            }
        }
        y
    }
}

/// The program in terms of moves from a start, which keeps its numbers small. Costs are divided by λ.
struct Model<'a> {
    problem: &'a Problem,
    start: &'a [i64],
    terms: Vec<Term>,
}

impl<'a> Model<'a> {
    fn new(problem: &'a Problem, start: &'a [i64]) -> Self {
        let (low, high) = problem.reach();
        let far = high - low;
        let inverse = f64::from(1_u32 << problem.halvings);
        let shape = problem.shape.iter().enumerate().map(|(i, s)| {
            let apart = problem.fixed_target(i) - (start[i] << Problem::FRACTION_BITS);
            let centre = apart as f64 / f64::from(1 << Problem::FRACTION_BITS);
            Term::new(i, None, f64::from(s.weight), centre, far)
        });
        let pairs = problem.pairs.iter().filter(|p| p.a != p.b).map(|p| {
            let (a, b) = (p.a as usize, p.b as usize);
            Term::new(a, Some(b), inverse * f64::from(p.weight), (start[b] - start[a]) as f64, far)
        });
        Self { problem, start, terms: shape.chain(pairs).collect() }
    }

    /// Adds what the model lacks to be exact at `moves`; whether it lacked anything.
    fn refine(&mut self, moves: &[f64]) -> bool {
        let refined = |any: bool, term: &mut Term| term.refine(term.value(moves)) | any;
        self.terms.iter_mut().fold(false, refined)
    }

    /// The optimal moves of the program as it stands.
    fn optimum(&self, time_limit: Duration) -> Result<Vec<f64>> {
        if self.start.is_empty() {
            // HiGHS takes a program without columns for an error.
            return Ok(Vec::new());
        }
        let mut columns = ProblemVariables::new();
        let moves: Vec<Variable> = self.start.iter().map(|&x| columns.add(self.level(x))).collect();
        let mut objective = Expression::default();
        let segments = |t: &Term| t.segments(&mut columns, &mut objective);
        let sums: Vec<Expression> = self.terms.iter().map(segments).collect();
        let mut program = columns.minimise(objective).using(backend);
        if self.is_mixed() {
            program = program.with_time_limit(time_limit.as_secs_f64());
            program = program.with_mip_gap(0.0).map_err(|e| internal(&e.to_string()))?;
        }
        for (term, mut row) in self.terms.iter().zip(sums) {
            row.add_mul(-1.0, moves[term.plus]);
            if let Some(minus) = term.minus {
                row.add_mul(1.0, moves[minus]);
            }
            program.add_constraint(row.eq(0.0));
        }
        self.constrain(&mut program, &moves);
        let solution = program.solve().map_err(failure)?;
        if matches!(solution.status(), SolutionStatus::TimeLimit) {
            return Err(too_long());
        }
        Ok(moves.iter().map(|&v| solution.value(v)).collect())
    }

    /// The column of a level that starts at `x`.
    fn level(&self, x: i64) -> good_lp::VariableDefinition {
        let bound = Problem::MAX_LEVEL;
        let column = variable().bounds((-bound - x) as f64..=(bound - x) as f64);
        if self.is_mixed() { column.integer() } else { column }
    }

    fn is_mixed(&self) -> bool {
        !self.problem.linear.is_empty()
    }

    fn constrain(&self, program: &mut impl SolverModel, moves: &[Variable]) {
        for d in self.problem.differences.iter().filter(|d| d.low != d.high) {
            let (low, high) = (d.low as usize, d.high as usize);
            let slack = self.start[high] - self.start[low] - d.gap;
            program.add_constraint((moves[high] - moves[low]).geq(-slack as f64));
        }
        for l in &self.problem.linear {
            let l = tighten(l);
            let mut sum = Expression::default();
            let mut at_start = 0.0;
            for &(v, coefficient) in &l.terms {
                sum.add_mul(coefficient, moves[v as usize]);
                at_start += coefficient * self.start[v as usize] as f64;
            }
            program.add_constraint(sum.geq(l.at_least - at_start));
        }
    }
}

/// With integer coefficients: divides by their common divisor and rounds the bound up. No integer point is lost
/// (Chvátal–Gomory), and strips without integers become empty instead of endless to branch in.
fn tighten(row: &Linear) -> Linear {
    let small = |c: f64| c == c.trunc() && c.abs() < 1e9;
    if !row.terms.iter().all(|t| small(t.1)) {
        return row.clone();
    }
    let divisor = row.terms.iter().fold(0, |g, t| common_divisor(g, t.1.abs() as u64)).max(1) as f64;
    Linear {
        terms: row.terms.iter().map(|&(v, c)| (v, c / divisor)).collect(),
        at_least: ((row.at_least - Problem::LINEAR_TOLERANCE) / divisor).ceil(),
    }
}

fn common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

/// The integer that `value` stands for.
fn whole(value: f64) -> Option<f64> {
    let near = value.round();
    ((value - near).abs() <= TOLERANCE).then_some(near)
}

fn internal(message: &str) -> Error {
    Error::new(ErrorKind::Internal, message)
}

fn too_long() -> Error {
    Error::new(ErrorKind::Unsupported, "the mixed-integer program takes longer than the time limit")
        .remedy("leave out separation planes, or raise the time limit")
}

fn failure(error: ResolutionError) -> Error {
    match error {
        ResolutionError::Infeasible => Error::new(ErrorKind::Infeasible, "no levels satisfy all linear constraints")
            .remedy("leave out separation planes, or keep distances only"),
        ResolutionError::Other(reason) if reason.contains("ime limit") || reason == "NoSolutionFound" => too_long(),
        other => internal(&format!("linear program: {other}")),
    }
}
