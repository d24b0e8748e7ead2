//! Both solvers on cases with known answers; [`random`] has the properties.

mod random;

use super::*;
use crate::align::problem::{Difference, Linear, PairTerm, ShapeTerm};

fn exact(problem: &Problem) -> Solution {
    ExactSolver.solve(problem, None, &Context::default()).unwrap()
}

fn linear(problem: &Problem) -> Solution {
    LinearSolver::default().solve(problem, None, &Context::default()).unwrap()
}

fn pull(weight: u32, target: f64) -> ShapeTerm {
    ShapeTerm { weight, target }
}

fn gap(low: u32, high: u32, gap: i64) -> Difference {
    Difference { low, high, gap }
}

#[test]
fn contradictions_are_named_by_both() {
    let differences = vec![gap(0, 1, 2), gap(1, 2, -1), gap(2, 0, 0), gap(2, 3, 1)];
    let problem = Problem { shape: vec![pull(1, 0.0); 4], differences, ..Problem::default() };
    let errors = [
        ExactSolver.solve(&problem, None, &Context::default()).unwrap_err(),
        LinearSolver::default().solve(&problem, Some(&[0; 4]), &Context::default()).unwrap_err(),
        problem.validate().unwrap_err(),
    ];
    for error in errors {
        assert_eq!(error.kind, ErrorKind::Infeasible);
        assert!(error.message.contains("x0 → x1 → x2 → x0"), "{error}");
        assert!(error.message.contains("add up to 1"), "{error}");
    }
}

#[test]
fn a_loop_on_one_variable_and_a_slow_cycle_are_contradictions() {
    let own = Problem { shape: vec![pull(1, 0.0)], differences: vec![gap(0, 0, 1)], ..Problem::default() };
    assert!(own.validate().unwrap_err().message.contains("x0 → x0"));
    let differences = vec![gap(0, 1, 1_000_000), gap(1, 0, -999_999)];
    let slow = Problem { shape: vec![pull(1, 0.0); 2], differences, ..Problem::default() };
    assert_eq!(slow.validate().unwrap_err().kind, ErrorKind::Infeasible);
}

#[test]
fn of_many_optima_the_lowest_is_returned() {
    // Halfway targets: each variable alone may round up or down, and each pair prefers equal levels.
    let shape = vec![pull(2, 0.5); 6];
    let pairs = (0..5).map(|a| PairTerm { a, b: a + 1, weight: 1 }).collect();
    let problem = Problem { shape, pairs, halvings: 3, ..Problem::default() };
    assert_eq!(exact(&problem).levels, vec![0; 6]);
    assert_eq!(linear(&problem).levels, vec![0; 6]);
    let free = Problem { pairs: Vec::new(), ..problem };
    assert_eq!(exact(&free).levels, vec![0; 6]);
}

#[test]
fn large_targets_are_exact() {
    let shape = vec![pull(1, 1e6), pull(3, -1e6), pull(2, 999_999.75), pull(1, 0.3)];
    let pairs = vec![PairTerm { a: 0, b: 1, weight: 2 }, PairTerm { a: 2, b: 3, weight: 1 }];
    let problem = Problem { shape, pairs, halvings: 12, differences: vec![gap(1, 2, 7)], ..Problem::default() };
    assert_eq!(exact(&problem).levels, linear(&problem).levels);
}

#[test]
fn numbers_out_of_range_are_refused() {
    let fine = Problem { shape: vec![pull(1, 0.0); 2], ..Problem::default() };
    let broken: [fn(&mut Problem); 10] = [
        |p| p.linear.push(Linear { terms: vec![], at_least: 1.0 }),
        |p| p.shape[0].target = f64::NAN,
        |p| p.shape[0].target = 1e12,
        |p| p.shape[0].weight = 0,
        |p| p.shape[0].weight = u32::MAX,
        |p| p.halvings = 21,
        |p| p.pairs.push(PairTerm { a: 0, b: 2, weight: 1 }),
        |p| p.differences.push(gap(0, 1, i64::MIN)),
        |p| p.differences.push(gap(0, 1, 3_000_000)),
        |p| p.linear.push(Linear { terms: vec![(0, f64::INFINITY)], at_least: 0.0 }),
    ];
    for spoil in broken {
        let mut problem = fine.clone();
        spoil(&mut problem);
        assert_eq!(problem.validate().unwrap_err().kind, ErrorKind::Option, "{problem:?}");
    }
    assert!(ExactSolver.solve(&fine, Some(&[0]), &Context::default()).is_err());
    assert!(exact(&Problem::default()).levels.is_empty());
    assert!(linear(&Problem::default()).levels.is_empty());
}

#[test]
fn the_exact_solver_refuses_linear_constraints_and_both_stop_when_cancelled() {
    let linear = vec![Linear { terms: vec![(0, 1.0)], at_least: 0.5 }];
    let mut problem = Problem { shape: vec![pull(1, 0.0); 2], linear, ..Problem::default() };
    let context = Context::default();
    assert_eq!(ExactSolver.solve(&problem, None, &context).unwrap_err().kind, ErrorKind::Unsupported);
    assert_eq!(LinearSolver::default().solve(&problem, None, &context).unwrap().levels, vec![1, 0]);
    problem.linear.clear();
    context.cancel();
    assert_eq!(ExactSolver.solve(&problem, None, &context).unwrap_err().kind, ErrorKind::Cancelled);
    assert_eq!(LinearSolver::default().solve(&problem, None, &context).unwrap_err().kind, ErrorKind::Cancelled);
}

#[test]
fn the_exact_cost_does_not_overflow_at_its_limits() {
    let far = Problem::MAX_LEVEL;
    let weight = (Problem::MAX_WEIGHT / 3) as u32;
    let shape = vec![pull(weight, far as f64), pull(weight, -far as f64)];
    let pairs = vec![PairTerm { a: 0, b: 1, weight }];
    let problem = Problem { shape, pairs, halvings: Problem::MAX_HALVINGS, ..Problem::default() };
    let cost = problem.exact_cost(&[-far, far]);
    assert!(cost > 0 && cost < i128::MAX, "{cost}");
}
