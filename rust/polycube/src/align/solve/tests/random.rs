//! Random problems: brute force, agreement of both solvers, shifts, mirroring.

use super::*;
use proptest::prelude::*;

/// Every point of a box, in lexicographic order.
fn boxes(n: usize, low: i64, high: i64) -> impl Iterator<Item = Vec<i64>> {
    let width = high - low + 1;
    (0..width.pow(n as u32)).map(move |mut code| {
        let mut x = vec![0; n];
        for value in x.iter_mut().rev() {
            *value = low + code % width;
            code /= width;
        }
        x
    })
}

/// The optimal cost and the variable-wise minimum of all optimal levels in a box.
fn brute_force(problem: &Problem, low: i64, high: i64) -> Option<(i128, Vec<i64>)> {
    let mut best: Option<(i128, Vec<i64>)> = None;
    for x in boxes(problem.len(), low, high).filter(|x| problem.is_feasible(x).is_ok()) {
        let cost = problem.exact_cost(&x);
        match &mut best {
            Some((least, lowest)) if *least == cost => {
                lowest.iter_mut().zip(&x).for_each(|(l, &v)| *l = v.min(*l));
            }
            Some((least, _)) if *least < cost => {}
            _ => best = Some((cost, x)),
        }
    }
    best
}

/// Up to `most` variables. Gaps agree with a hidden solution, so the problem is feasible.
fn problems(most: usize, spread: i64, halvings: u32) -> impl Strategy<Value = Problem> {
    (2..=most).prop_flat_map(move |n| {
        let v = 0..n as u32;
        let tenths = -10 * spread..=10 * spread;
        let target = prop_oneof![tenths.prop_map(|t| t as f64 / 10.0), (-spread..=spread).prop_map(|t| t as f64 + 0.5)];
        let shape = prop::collection::vec((1_u32..6, target), n);
        let pairs = prop::collection::vec((v.clone(), v.clone(), 1_u32..4), 0..2 * n);
        let hidden = prop::collection::vec(-spread..=spread, n);
        let slacks = prop::collection::vec((v.clone(), v, prop_oneof![Just(0_i64), 0..=2 * spread]), 0..2 * n);
        (shape, pairs, hidden, slacks, 0..=halvings).prop_map(|(shape, pairs, hidden, slacks, halvings)| {
            let apart = |low: u32, high: u32| hidden[high as usize] - hidden[low as usize];
            Problem {
                shape: shape.into_iter().map(|(w, t)| pull(w, t)).collect(),
                pairs: pairs.into_iter().map(|(a, b, weight)| PairTerm { a, b, weight }).collect(),
                halvings,
                differences: slacks.into_iter().map(|(l, h, s)| gap(l, h, apart(l, h) - s)).collect(),
                linear: Vec::new(),
            }
        })
    })
}

fn mirrored(problem: &Problem) -> Problem {
    let mut mirror = problem.clone();
    mirror.shape.iter_mut().for_each(|s| s.target = -s.target);
    mirror.differences.iter_mut().for_each(|d| std::mem::swap(&mut d.low, &mut d.high));
    mirror
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn both_find_the_lowest_optimum_of_tiny_problems(problem in problems(4, 2, 4)) {
        let (low, high) = problem.reach();
        let (cost, lowest) = brute_force(&problem, low, high).unwrap();
        let solution = exact(&problem);
        prop_assert_eq!(problem.exact_cost(&solution.levels), cost);
        prop_assert_eq!(&solution.levels, &lowest);
        prop_assert_eq!(linear(&problem).levels, lowest);
    }

    #[test]
    fn both_return_the_same_levels(problem in problems(15, 12, 12)) {
        let (one, other) = (exact(&problem), linear(&problem));
        prop_assert_eq!(one.levels, other.levels);
        prop_assert_eq!(one.cost, other.cost);
    }

    #[test]
    fn the_start_does_not_matter(problem in problems(12, 12, 12), seed in -40_i64..40) {
        let start: Vec<i64> = (0..problem.len() as i64).map(|i| (i * seed) % 50).collect();
        let from_there = ExactSolver.solve(&problem, Some(&start), &Context::default()).unwrap();
        let from_optimum = ExactSolver.solve(&problem, Some(&from_there.levels), &Context::default()).unwrap();
        prop_assert_eq!(&from_there.levels, &exact(&problem).levels);
        prop_assert_eq!(from_there.levels, from_optimum.levels);
    }

    #[test]
    fn shifting_the_targets_shifts_the_levels(problem in problems(12, 12, 12), by in -1000_i64..1000) {
        let before = exact(&problem);
        let mut moved = problem.clone();
        // Quantised targets shift exactly.
        for i in 0..moved.len() {
            moved.shape[i].target = problem.fixed_target(i) as f64 / f64::from(1 << Problem::FRACTION_BITS) + by as f64;
        }
        let shifted: Vec<i64> = before.levels.iter().map(|x| x + by).collect();
        prop_assert_eq!(exact(&moved).levels, shifted);
    }

    #[test]
    fn reversing_the_axis_keeps_the_cost(problem in problems(12, 12, 12)) {
        let (there, back) = (exact(&problem), exact(&mirrored(&problem)));
        prop_assert_eq!(problem.exact_cost(&there.levels), mirrored(&problem).exact_cost(&back.levels));
        prop_assert!(there.levels.iter().zip(&back.levels).all(|(low, high)| *low <= -high));
    }

    #[test]
    fn optima_lie_within_reach(problem in problems(12, 12, 12)) {
        let (low, high) = problem.reach();
        prop_assert!(exact(&problem).levels.iter().all(|x| (low..=high).contains(x)));
    }

    #[test]
    fn feasible_starts_are_feasible(problem in problems(15, 12, 0)) {
        let start = problem.feasible_start().unwrap();
        prop_assert_eq!(problem.is_feasible(&start), Ok(()));
        prop_assert_eq!(problem.feasible_near(&start).unwrap(), start);
    }

    #[test]
    fn linear_constraints_match_brute_force(
        problem in problems(3, 2, 3),
        rows in prop::collection::vec((-2_i32..3, -2_i32..3, -6_i32..6), 1..3),
    ) {
        let mut problem = problem;
        for (a, b, at_least) in rows {
            let terms = vec![(0, f64::from(a)), (1, f64::from(b))];
            problem.linear.push(Linear { terms, at_least: f64::from(at_least) / 2.0 });
        }
        let solver = LinearSolver { time_limit: std::time::Duration::from_secs(2) };
        let found = solver.solve(&problem, None, &Context::default());
        prop_assume!(!matches!(&found, Err(e) if e.kind == ErrorKind::Unsupported));
        match brute_force(&problem, -12, 12) {
            Some((cost, _)) => prop_assert_eq!(problem.exact_cost(&found.unwrap().levels), cost),
            None => prop_assert_eq!(found.unwrap_err().kind, ErrorKind::Infeasible),
        }
    }
}
