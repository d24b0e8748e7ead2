//! The whole way, on generated pairs and on real ones.

use super::{cells, distinct, quality};
use crate::align::{Effort, Strategy};
use crate::context::Context;
use crate::error::ErrorKind;
use crate::generate::{Example, example};
use crate::measure::{base_complex, hausdorff};
use crate::mesh::{CellKind, Mesh};
use crate::remesh::lattice::MOST_HEXES;
use crate::remesh::mesher::MAX_PADDING;
use crate::remesh::{Failure, RemeshOptions, Remeshed, Size, TriedPoint, remesh};
use crate::simplify::{Input, Note, SimplifyOptions};

fn options(strategy: Strategy, hexes: usize) -> RemeshOptions {
    let simplify = SimplifyOptions { strategy, ..SimplifyOptions::default() };
    RemeshOptions { simplify, size: Some(Size::Hexes(hexes)), max_hausdorff: 0.05, ..RemeshOptions::default() }
}

fn run((polycube, shape): &(Mesh, Mesh), options: &RemeshOptions) -> Remeshed {
    let input = Input { polycube, shape: Some(shape), labels: None };
    remesh(&input, options, &Context::default()).unwrap()
}

/// No inverted hexahedron by the tests' own measure, the blocks that the report says, a surface close to the shape.
fn check(name: &str, result: &Remeshed, shape: &Mesh) {
    let hexes = result.hexes.as_ref().unwrap();
    let (inverted, worst, mean) = quality(hexes);
    let report = &result.report;
    assert_eq!((inverted, report.inverted), (0, 0), "{name}: {:?}", report.inverted_cells);
    assert!((worst - report.min_sj.unwrap()).abs() < 1e-9 && (mean - report.avg_sj.unwrap()).abs() < 1e-9, "{name}");
    let blocks = distinct(&base_complex(cells(&hexes.mesh), &Context::default()).unwrap());
    assert_eq!(blocks, report.simplify.after.unwrap().blocks_padded, "{name}");
    assert_eq!(
        (blocks, result.layout.blocks.as_ref().map_or(0, |b| b.cells().len())),
        (report.hex_blocks, blocks),
        "{name}"
    );
    let distance = hausdorff(&result.quads.mesh, shape, &Context::default()).unwrap();
    assert_eq!(distance, report.hausdorff, "{name}");
    assert!(report.within_hausdorff && report.is_good(), "{name}: {} %", report.hausdorff_percent);
}

#[test]
fn examples_of_all_kinds_become_good_hexahedra() {
    for (i, name) in Example::ALL.into_iter().enumerate() {
        let kind = CellKind::ALL[i % 4];
        let pair = example(name, i as u64 + 1, kind).unwrap();
        let result = run(&pair, &options(Strategy::Paper, 3000));
        check(&format!("{name} {kind}"), &result, &pair.1);
    }
}

/// Before any work is done on them.
#[test]
fn more_than_a_million_hexahedra_must_be_asked_for() {
    let (polycube, shape) = example(Example::SteppedL, 1, CellKind::Triangles).unwrap();
    let input = Input { polycube: &polycube, shape: Some(&shape), labels: None };
    let fine = RemeshOptions { size: Some(Size::Scale(16.0)), ..options(Strategy::Paper, 0) };
    let error = remesh(&input, &fine, &Context::default()).unwrap_err();
    assert_eq!((error.kind, error.option), (ErrorKind::Option, Some("size")));
    let count: usize = error.remedy.rsplit(' ').next().unwrap().parse().unwrap();
    assert!(count > 1_000_000 && error.message.contains(&count.to_string()), "{error}");
}

#[test]
fn the_unsimplified_polycube_is_meshed_even_where_rounding_breaks_it() {
    let pair = example(Example::SteppedL, 1, CellKind::Triangles).unwrap();
    let coarse = RemeshOptions { size: Some(Size::Scale(0.05)), ..options(Strategy::Naive, 0) };
    let result = run(&pair, &RemeshOptions { surface_only: true, ..coarse });
    assert!(result.hexes.is_none() && result.report.min_sj.is_none() && result.report.quads > 0);
    assert!(result.report.simplify.notes.contains(&Note::InOrder));
    assert_eq!(result.report.simplify.after, Some(result.report.simplify.before));
    assert_eq!(result.report.simplify.strategy, Strategy::Naive);
}

#[test]
fn wrong_options_and_cancelling_are_errors() {
    let (polycube, shape) = example(Example::Ring, 1, CellKind::Triangles).unwrap();
    let input = Input { polycube: &polycube, shape: Some(&shape), labels: None };
    let sized = |size| RemeshOptions { size: Some(size), ..RemeshOptions::default() };
    let simplified = |simplify| RemeshOptions { simplify, ..RemeshOptions::default() };
    let bad = [
        RemeshOptions { max_hausdorff: 0.0, ..RemeshOptions::default() },
        RemeshOptions { padding: MAX_PADDING + 1, ..RemeshOptions::default() },
        sized(Size::Hexes(0)),
        sized(Size::Hexes(MOST_HEXES + 1)),
        sized(Size::EdgeLength(f64::NAN)),
        sized(Size::Scale(-1.0)),
        simplified(SimplifyOptions { scale: Some(0.0), ..SimplifyOptions::default() }),
        simplified(SimplifyOptions { simplicity: Some(1.5), ..SimplifyOptions::default() }),
        simplified(SimplifyOptions { max_displacement: Some(-1.0), ..SimplifyOptions::default() }),
        simplified(SimplifyOptions { max_displacement: Some(f64::INFINITY), ..SimplifyOptions::default() }),
        simplified(SimplifyOptions { max_distortion: Some(f64::NAN), ..SimplifyOptions::default() }),
        simplified(SimplifyOptions { lambda_min: -7.0, ..SimplifyOptions::default() }),
    ];
    for bad in bad {
        // Nothing is begun.
        let begun = Context::new(|stage, _| panic!("{stage} was begun"));
        assert_eq!(remesh(&input, &bad, &begun).unwrap_err().kind, ErrorKind::Option, "{bad:?}");
    }
    let context = Context::default();
    context.cancel();
    assert_eq!(remesh(&input, &options(Strategy::Paper, 500), &context).unwrap_err().kind, ErrorKind::Cancelled);
}

#[test]
fn a_lattice_too_fine_is_refused_before_anything_is_meshed() {
    let (polycube, shape) = example(Example::Ring, 1, CellKind::Triangles).unwrap();
    let input = Input { polycube: &polycube, shape: Some(&shape), labels: None };
    for padding in [0, 1] {
        let fine = RemeshOptions { size: Some(Size::Scale(1e4)), padding, ..options(Strategy::Paper, 0) };
        let meshing = Context::new(|stage, _| assert!(stage != "map" && stage != "mesh", "{stage}"));
        let error = remesh(&input, &fine, &meshing).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Option, "{error}");
        assert!(error.message.contains(&MOST_HEXES.to_string()), "{error}");
    }
}

#[test]
fn the_fewest_blocks_are_meshed_where_that_is_asked_for_and_good_ones_where_not() {
    for (name, kind) in [(Example::Ring, CellKind::Triangles), (Example::SteppedL, CellKind::Tetrahedra)] {
        let pair = example(name, 2, kind).unwrap();
        let good = run(&pair, &options(Strategy::Best, 2500));
        check(&name.to_string(), &good, &pair.1);
        assert!(good.report.min_sj > Some(0.4), "{name}: {:?}", good.report.min_sj);
        let blocks = |r: &Remeshed| r.report.simplify.after.unwrap().blocks_padded;
        for simplicity in [1.0, 0.0] {
            let mut told = options(Strategy::Best, 2500);
            told.simplify.simplicity = Some(simplicity);
            let told = run(&pair, &told);
            let front = &told.report.simplify.front;
            let chosen = if simplicity == 1.0 { 0 } else { front.len() - 1 };
            assert_eq!(told.report.simplify.chosen, Some(chosen), "{name}");
            assert!(blocks(&told) <= front[chosen].count && blocks(&good) >= front[0].count, "{name}");
        }
    }
}

#[test]
fn blocks_stay_few_where_none_bring_the_mesh_near_enough() {
    let pair = example(Example::SteppedL, 1, CellKind::Triangles).unwrap();
    let within = |max_hausdorff: f64| {
        let options = RemeshOptions { max_hausdorff, ..options(Strategy::Best, 500) };
        run(&pair, &options).report
    };
    let (any, near) = (within(1.0), within(1e-4));
    assert!(
        any.within_hausdorff && !near.within_hausdorff,
        "{} and {} %",
        any.hausdorff_percent,
        near.hausdorff_percent
    );
    assert!(near.hex_blocks * 4 <= any.hex_blocks * 5, "{} and {} blocks", any.hex_blocks, near.hex_blocks);
}

/// A bound that no mesh meets has several points meshed.
#[test]
fn what_was_tried_is_told_and_can_be_asked_for() {
    let pair = example(Example::SteppedL, 1, CellKind::Triangles).unwrap();
    let asked = RemeshOptions { max_hausdorff: 1e-4, ..options(Strategy::Best, 500) };
    let Remeshed { simplified, report, .. } = run(&pair, &asked);
    let tried = &report.tried;
    assert!(tried.len() > 1 && tried.is_sorted_by(|a, b| a.point < b.point), "{tried:?}");
    for point in tried {
        let located = simplified.locate(point.simplicity, &Context::default()).unwrap();
        assert_eq!((located.index, located.counts.blocks_padded), (point.point, point.blocks));
        assert!(!point.fine || point.failed == Some(Failure::Far), "{point:?}");
    }
    let taken: Vec<&TriedPoint> = tried.iter().filter(|point| point.taken).collect();
    assert_eq!(taken.len(), 1);
    assert_eq!((taken[0].min_sj, taken[0].blocks), (report.min_sj, report.hex_blocks));
    let beside = report.simplify.notes.iter().find_map(|note| match note {
        Note::Alternatives(others) => Some(others),
        _ => None,
    });
    let beside = beside.expect("others were tried");
    assert!(beside.iter().all(|other| tried.iter().any(|p| !p.taken && p.blocks == other.count)));
}

/// Of each example the fewest patches there are fold the map (the cube with spikes apart).
#[test]
fn surfaces_are_sound_and_near_where_more_patches_help() {
    for name in Example::ALL {
        let pair = example(name, 1, CellKind::Triangles).unwrap();
        let quick = SimplifyOptions {
            effort: Effort { steps_per_level: 50, ..Effort::default() },
            ..SimplifyOptions::default()
        };
        // The small size is too coarse to be near.
        for (size, is_fine) in [(3000, false), (20_000, true)] {
            let simplify = quick.clone();
            let options = RemeshOptions { simplify, surface_only: true, ..options(Strategy::Best, size) };
            let Remeshed { quads, report, .. } = run(&pair, &options);
            assert_eq!((report.folded, report.inverted_quads, quads.quality().inverted), (0, 0, 0), "{name} {size}");
            assert!(!is_fine || quads.quality().worst > 0.34, "{name}: an angle below 20 degrees");
            assert!(!is_fine || report.within_hausdorff, "{name}: {} %", report.hausdorff_percent);
        }
    }
}

#[test]
fn a_surface_that_is_folded_as_asked_says_so() {
    let pair = example(Example::Ring, 1, CellKind::Triangles).unwrap();
    let fewest = SimplifyOptions { simplicity: Some(1.0), ..SimplifyOptions::default() };
    let options = RemeshOptions { simplify: fewest, surface_only: true, ..options(Strategy::Best, 3000) };
    let report = run(&pair, &options).report;
    assert!(report.folded > 0 && report.inverted_quads > 0 && !report.is_good());
    let notes = report.simplify.notes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    assert!(
        notes.contains("folded") && notes.contains("lower the simplicity") && !notes.contains("near enough"),
        "{notes}"
    );
}

#[test]
fn vertices_reach_what_a_coarse_mesh_cuts_off() {
    let mut nearer = 0;
    for (i, name) in Example::ALL.into_iter().enumerate() {
        let pair = example(name, i as u64 + 1, CellKind::Triangles).unwrap();
        let loose = run(&pair, &options(Strategy::Paper, 1500));
        let bound = 0.8 * loose.report.hausdorff_percent / 100.0;
        let tight = run(&pair, &RemeshOptions { max_hausdorff: bound, ..options(Strategy::Paper, 1500) });
        assert_eq!(tight.report.inverted, 0, "{name}");
        assert!(tight.report.hausdorff <= loose.report.hausdorff * (1.0 + 1e-9), "{name}");
        nearer += usize::from(tight.report.hausdorff < 0.9 * loose.report.hausdorff);
        if !tight.report.within_hausdorff {
            let is_advice = |f: &Note| matches!(f, Note::Far { enough: Some((_, CellKind::Hexahedra)), .. });
            assert!(tight.report.faults().iter().any(is_advice), "{name}");
        }
    }
    assert!(nearer > 0, "vertices reach something");
}

#[test]
fn small_real_pairs_have_no_inverted_hexahedron() {
    for (name, extension) in super::on_real_data::pairs() {
        let small = ["kitty", "fertility", "block", "bunny"].iter().any(|n| name.contains(n));
        if !small || extension != "obj" {
            continue;
        }
        let pair = super::on_real_data::pair(&name, extension);
        let wanted = super::on_real_data::published(&name);
        let result = run(&pair, &options(Strategy::Best, wanted));
        check(&name, &result, &pair.1);
        if name.contains("bunny") {
            // The published simplified mesh: 197 blocks, worst 0.205, mean 0.935.
            let report = &result.report;
            let good = report.min_sj > Some(0.4) && report.avg_sj > Some(0.935);
            assert!(good && report.hex_blocks < 250, "{:?} {:?} {}", report.min_sj, report.avg_sj, report.hex_blocks);
        }
        if name.contains("block") {
            let off = (result.report.hexes as f64 / wanted as f64 - 1.0).abs();
            let (min, average) = (result.report.min_sj.unwrap(), result.report.avg_sj.unwrap());
            assert!(off < 0.25 && min > 0.179 && average > 0.94, "{name}: {min} {average}");
        }
    }
}
