//! The integer problems of alignments as files, for `bench/run` to have other programs solve them.

use super::{PaperSettings, run};
use crate::align::guides::Guided;
use crate::align::problem::Problem;
use crate::align::solve::{ExactSolver, Solution, Solver};
use crate::align::unit::Unit;
use crate::context::Context;
use crate::error::Result;
use crate::generate::Example;
use crate::generate::random::random_with_corners;
use crate::mesh::CellKind;
use crate::structure::{Polycube, Tolerance};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Writes every problem that it solves.
struct Recorder {
    stem: PathBuf,
    count: AtomicUsize,
}

impl Solver for Recorder {
    fn solve(&self, problem: &Problem, start: Option<&[i64]>, context: &Context) -> Result<Solution> {
        let number = self.count.fetch_add(1, Ordering::Relaxed);
        let file = self.stem.with_extension(format!("{number:03}.json"));
        std::fs::write(file, serde_json::to_string(problem).unwrap()).unwrap();
        ExactSolver.solve(problem, start, context)
    }
}

/// Writes to `$POLYCUBE_BENCH` the problems of Algorithm 1 on generated polycubes, as NAME.NUMBER.json.
#[test]
#[ignore = "writes files; bench/run asks for them"]
fn for_bench() {
    let folder = PathBuf::from(std::env::var_os("POLYCUBE_BENCH").expect("POLYCUBE_BENCH names a folder"));
    let named = [Example::Ring, Example::CubeSpikes].map(|e| (e.to_string(), e.voxels(1).unwrap()));
    let sized = [60, 120, 240].map(|n| (format!("random-{n}"), random_with_corners(1, n).unwrap()));
    for (name, voxels) in named.into_iter().chain(sized) {
        let polycube = Polycube::new(&voxels.mesh(CellKind::Quads, 1e9).unwrap(), None, &Tolerance::default()).unwrap();
        let (structure, placement) = (&polycube.structure, &polycube.placement);
        let solver = Recorder { stem: folder.join(name), count: AtomicUsize::new(0) };
        let guided = Guided::free(structure);
        let settings = PaperSettings { lambda_min: 0.0, solver: &solver, guided: &guided, oblique_planes: false };
        let input = Unit::of(structure, placement).apply(structure, placement);
        run(structure, &input, &settings, &Context::default()).unwrap();
    }
}
