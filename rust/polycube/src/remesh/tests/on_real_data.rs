//! Real pairs of shared data; without the folder these tests say so and pass (`POLYCUBE_REQUIRE_DATA=1`: fail).

use super::{Case, paper, quality};
use crate::align::Strategy;
use crate::context::Context;
use crate::data::folder;
use crate::measure::hausdorff::{diagonal, hausdorff};
use crate::mesh::{Mesh, read_pair};
use crate::remesh::mesher::Remesher;
use crate::simplify::SimplifyOptions;
use std::time::Instant;

/// The names of the pairs, each with the endings of its files.
pub(crate) fn pairs() -> Vec<(String, &'static str)> {
    let Some(folder) = folder() else { return Vec::new() };
    let names: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    let ending = |n: &String, e: &'static str| Some((n.strip_suffix(e)?.strip_suffix(".polycube.")?.to_owned(), e));
    let mut pairs: Vec<_> = names.iter().filter_map(|n| ending(n, "mesh").or_else(|| ending(n, "obj"))).collect();
    pairs.sort();
    pairs
}

/// The polycube and the shape of a pair.
pub(crate) fn pair(name: &str, extension: &str) -> (Mesh, Mesh) {
    let file = |part: &str| folder().unwrap().join(format!("{name}.{part}.{extension}"));
    read_pair(&file("polycube"), &file("shape")).unwrap()
}

fn load(name: &str, extension: &str, options: &SimplifyOptions) -> Case {
    Case::with(options, format!("{name}.{extension}"), pair(name, extension))
}

/// The published number of hexahedra.
pub(crate) fn published(name: &str) -> usize {
    let text = std::fs::read_to_string(folder().unwrap().join("reference.json")).unwrap();
    let all: serde_json::Value = serde_json::from_str(&text).unwrap();
    let own = &all[name];
    own["paper_output"]["hexes"].as_u64().or(own["source"]["hexes"].as_u64()).unwrap() as usize
}

#[test]
fn meshes_of_real_pairs_have_the_reported_structure() {
    for (name, extension) in pairs().into_iter().filter(|(n, _)| n.contains("kitty") || n.contains("angel_1")) {
        let case = load(&name, extension, &paper()).sized(6000, 1);
        super::counts::check(&case);
        super::surface::check(&case);
    }
}

/// Run with `cargo test --release -p polycube -- --ignored --nocapture numbers_of_real_pairs`, for the unsimplified
/// polycubes with `POLYCUBE_NAIVE=1`, for one pair with its name in `POLYCUBE_ONLY`.
#[test]
#[ignore = "prints numbers; run in release mode"]
fn numbers_of_real_pairs() {
    let context = Context::default();
    let naive = std::env::var_os("POLYCUBE_NAIVE").is_some();
    let options = if naive { SimplifyOptions { strategy: Strategy::Naive, ..paper() } } else { paper() };
    let only = std::env::var("POLYCUBE_ONLY").unwrap_or_default();
    for (name, extension) in pairs().into_iter().filter(|(n, _)| n.contains(&only)) {
        let start = Instant::now();
        let mut last = start;
        let mut lap = || {
            let now = Instant::now();
            let seconds = (now - std::mem::replace(&mut last, now)).as_secs_f64();
            format!("{seconds:.2}")
        };
        let case = load(&name, extension, &options);
        let simplified = lap();
        let case = case.sized(published(&name), 1);
        let sized = lap();
        let remesher: Remesher = case.remesher();
        let grid = lap();
        let quads = remesher.quads(&context).unwrap();
        let quad_time = lap();
        let hexes = remesher.hexes(1, &context).unwrap();
        let hex_time = lap();
        let distance = hausdorff(&quads.mesh, &case.shape, &context).unwrap();
        let diagonal = diagonal(&case.shape);
        let (inverted, worst, mean) = quality(&hexes);
        let blocks =
            super::distinct(&crate::measure::base_complex(super::cells(&hexes.mesh), &Context::default()).unwrap());
        assert_eq!(blocks, case.simplified.report.after.unwrap().blocks_padded, "{}", case.name);
        println!(
            "{} wanted {} got {} inverted {inverted} min {worst:.3} avg {mean:.3} guessed {} \
             flipped in {} hausdorff {:.3}% | simplify {simplified} size {sized} grid {grid} quads {quad_time} \
             hexes {hex_time} hausdorff {} total {:.2} | {:?}",
            case.name,
            published(&name),
            hexes.mesh.cells().len(),
            hexes.guessed,
            case.simplified.report.flipped_elements,
            100.0 * distance / diagonal,
            lap(),
            start.elapsed().as_secs_f64(),
            case.simplified.report.after.unwrap(),
        );
    }
}
