//! Solves problems in JSON files with both solvers and prints cost and seconds as JSON, one line for each file.
//!
//! ```text
//! cargo run --release --example solve_problem -- [--exact-only] problem.json…
//! ```

use polycube::Context;
use polycube::parts::{ExactSolver, LinearSolver, Problem, Solver};
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

/// Short solves are repeated for this long and averaged.
const SECONDS: f64 = 0.05;

fn measure(solver: &dyn Solver, problem: &Problem, start: Option<&[i64]>) -> serde_json::Value {
    let (clock, mut times) = (Instant::now(), 0);
    loop {
        let result = black_box(solver.solve(problem, start, &Context::default()));
        times += 1;
        let seconds = clock.elapsed().as_secs_f64();
        match result {
            Err(error) => return serde_json::json!({ "error": error.to_string() }),
            Ok(_) if seconds < SECONDS => {}
            Ok(s) => {
                let seconds = seconds / f64::from(times);
                return serde_json::json!({ "cost": s.cost, "levels": s.levels, "seconds": seconds, "steps": s.steps });
            }
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut files: Vec<String> = std::env::args().skip(1).collect();
    let exact_only = files.iter().any(|f| f == "--exact-only");
    files.retain(|f| f != "--exact-only");
    for file in files {
        let problem: Problem = serde_json::from_str(&std::fs::read_to_string(&file)?)?;
        let exact = measure(&ExactSolver, &problem, None);
        let optimum: Option<Vec<i64>> = serde_json::from_value(exact["levels"].clone())?;
        let mut line = serde_json::json!({ "file": file, "exact": exact });
        if optimum.is_some() {
            line["exact_warm"] = measure(&ExactSolver, &problem, optimum.as_deref());
        }
        if !exact_only {
            line["linear"] = measure(&LinearSolver::default(), &problem, None);
        }
        println!("{line}");
    }
    Ok(())
}
