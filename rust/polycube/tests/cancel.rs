//! Cancelling, at any tick of any stage.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use polycube::generate::{Example, example};
use polycube::mesh::CellKind;
use polycube::remesh::{RemeshOptions, Size, remesh};
use polycube::{Context, ErrorKind, Input, Result};
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

/// What was told to an observer that cancels at the tick `last`, from 0.
struct Run {
    result: Result<()>,
    ticks: usize,
    stages: BTreeSet<String>,
}

/// Meshing runs every stage there is.
fn run(last: usize) -> Run {
    let (polycube, shape) = example(Example::SteppedL, 1, CellKind::Tetrahedra).unwrap();
    let input = Input { polycube: &polycube, shape: Some(&shape), labels: None };
    let ticks = Arc::new(AtomicUsize::new(0));
    let stages = Arc::new(Mutex::new(BTreeSet::new()));
    let own: Arc<OnceLock<Context>> = Arc::default();
    let (count, seen, handle) = (Arc::clone(&ticks), Arc::clone(&stages), Arc::clone(&own));
    let context = Context::new(move |stage, _| {
        seen.lock().unwrap().insert(stage.to_owned());
        if count.fetch_add(1, Ordering::SeqCst) == last {
            handle.get().unwrap().cancel();
        }
    });
    own.set(context.clone()).unwrap();
    let options = RemeshOptions { size: Some(Size::Hexes(60)), ..RemeshOptions::default() };
    let result = remesh(&input, &options, &context).map(drop);
    let stages = stages.lock().unwrap().clone();
    Run { result, ticks: ticks.load(Ordering::SeqCst), stages }
}

#[test]
fn every_stage_stops_at_the_tick_at_which_it_is_cancelled() {
    let whole = run(usize::MAX);
    whole.result.unwrap();
    for stage in ["structure", "align", "search", "morph", "judge", "map", "mesh", "optimise", "hausdorff"] {
        assert!(whole.stages.contains(stage), "no {stage} in {:?}", whole.stages);
    }
    // The number of ticks need not be the same every time where threads share the work; the last ones are left out.
    let last = whole.ticks * 9 / 10;
    for at in (0..6).map(|i| last * i / 5) {
        let run = run(at);
        let kind = run.result.map_err(|e| e.kind);
        assert_eq!(kind, Err(ErrorKind::Cancelled), "at tick {at} of {}", whole.ticks);
        // Other threads may be in the middle of one.
        assert!(run.ticks <= at + 8, "{} ticks after tick {at}", run.ticks - at);
    }
}
