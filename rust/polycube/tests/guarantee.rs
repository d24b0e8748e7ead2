//! What every run promises, on random polycubes of any genus, with several components and voids.

mod common;

use common::{bits, cases, coarse, dense, labels, paper, read, simplify};
use nalgebra::Vector3;
use polycube::align::{Effort, Strategy};
use polycube::generate::random_polycube;
use polycube::layout::Objective;
use polycube::mesh::{CellKind, Format, Mesh, write_bytes};
use polycube::parts::{perturb, random_with_corners, scale, symmetries, transform, translate};
use polycube::structure::{Structure, placement_of};
use polycube::{Context, Input, Simplified, SimplifyOptions};
use proptest::prelude::*;

/// A random polycube; the seeds run through few and many boxes, dense and sparse.
fn sample(seed: u64, kind: CellKind) -> Mesh {
    let voxels = random_polycube(seed, 1 + seed as usize % 12, 4 + seed as i64 % 13);
    coarse(&voxels.expect("a random polycube"), kind)
}

/// Simplifies and checks the result on the lattice.
fn checked(mesh: &Mesh, options: &SimplifyOptions, what: &str) -> Simplified {
    let result = simplify(mesh, options).unwrap_or_else(|e| panic!("{what}: {e}"));
    assert_good(&result, what);
    result
}

fn assert_good(result: &Simplified, what: &str) {
    let report = &result.report;
    assert_eq!(dense::check(&result.input.structure, &result.levels), Ok(()), "{what}");
    let after = report.after.unwrap_or_else(|| panic!("{what}: no counts"));
    assert!(after.blocks_padded <= report.before.blocks_padded, "{what}: {:?} became {after:?}", report.before);
    let mesh = result.polycube.as_ref().unwrap_or_else(|| panic!("{what}: no mesh"));
    let placement = placement_of(&result.levels);
    for (p, fixed) in mesh.points().iter().zip(result.input.prescribed(&placement)) {
        assert!((0..3).all(|a| p[a].is_finite() && fixed[a].is_none_or(|x| x == p[a])), "{what}: {p} is not {fixed:?}");
    }
}

/// The file of the result.
fn bytes(result: &Simplified) -> Vec<u8> {
    let mesh = result.polycube.as_ref().expect("a valid result has a mesh");
    write_bytes(Format::Vtk, mesh, &[]).expect("the mesh can be written")
}

#[test]
fn random_polycubes_stay_valid_and_get_no_more_blocks() {
    let (mut handles, mut parts, mut better) = (0, 0, 0);
    for seed in 0..cases(1200) {
        let result = checked(&sample(seed, CellKind::Quads), &paper(), &format!("seed {seed}"));
        let structure = &result.input.structure;
        handles += usize::from(structure.genus() > 0);
        parts += usize::from(structure.components().iter().any(|&c| c > 0));
        better +=
            usize::from(result.report.after.is_some_and(|c| c.blocks_padded < result.report.before.blocks_padded));
    }
    println!("{handles} with handles, {parts} in parts, {better} with fewer blocks");
    assert!(handles > 0 && parts > 0 && better > 0);
}

#[test]
fn searched_polycubes_stay_valid_and_get_no_more_blocks() {
    let effort = Effort { steps_per_level: 50, ..Effort::default() };
    for objective in [Objective::BlocksPadded, Objective::SurfacePatches] {
        let options = SimplifyOptions { effort, objective: Some(objective), ..SimplifyOptions::default() };
        for seed in 0..cases(10) {
            checked(&sample(seed, CellKind::Quads), &options, &format!("seed {seed}, {objective:?}"));
        }
    }
}

/// Its symmetry makes the residual of the morph orthogonal to what the solver started with.
#[test]
fn a_polycube_on_which_the_solver_of_the_morph_starts_anew_stays_valid() {
    checked(&sample(43_650, CellKind::Quads), &paper(), "seed 43650");
}

#[test]
fn larger_polycubes_stay_valid() {
    for seed in 0..cases(25) {
        let voxels = random_with_corners(seed, 100 + 20 * seed as usize).unwrap();
        checked(&coarse(&voxels, CellKind::Quads), &paper(), &format!("seed {seed}"));
    }
}

#[test]
fn polycubes_off_the_lattice_stay_valid_at_any_scale() {
    for seed in 0..cases(200) {
        let mesh = scale(&sample(seed, CellKind::Quads), 0.37).unwrap();
        let moved = perturb(&mesh, &labels(&read(&mesh)), 0.45, seed).unwrap();
        for steps in [None, Some(0.2), Some(1.0), Some(4.7)] {
            let options = SimplifyOptions { scale: steps, ..paper() };
            checked(&moved, &options, &format!("seed {seed} at {steps:?}"));
        }
    }
}

#[test]
fn every_symmetry_gives_a_valid_result() {
    for seed in 0..cases(12) {
        let mesh = sample(100 + seed, CellKind::Quads);
        for (i, matrix) in symmetries().iter().enumerate() {
            checked(&transform(&mesh, matrix).unwrap(), &paper(), &format!("seed {seed}, symmetry {i}"));
        }
    }
}

#[test]
fn translation_by_whole_steps_moves_the_result() {
    for seed in 0..cases(150) {
        let mesh = sample(seed, CellKind::Quads);
        let by = [7, -30, 101];
        // By default the steps are as long as the edges of the mesh.
        let options = SimplifyOptions { scale: Some(1.0), ..paper() };
        let one = checked(&mesh, &options, "in place");
        let moved = translate(&mesh, Vector3::from(by.map(f64::from))).unwrap();
        let other = checked(&moved, &options, "moved");
        let axes = one.input.structure.levels.iter().map(|l| l.axis);
        let expected: Vec<i64> = one.levels.iter().zip(axes).map(|(x, a)| x + i64::from(by[a])).collect();
        assert_eq!(other.levels, expected, "seed {seed}");
    }
}

/// Twice the size at half the steps per unit is the same lattice.
#[test]
fn uniform_scaling_with_its_inverse_scale_changes_no_level() {
    for seed in 0..cases(150) {
        let mesh = sample(seed, CellKind::Quads);
        let one = checked(&mesh, &SimplifyOptions { scale: Some(2.0), ..paper() }, "as it is");
        for factor in [0.125, 4.0] {
            let options = SimplifyOptions { scale: Some(2.0 / factor), ..paper() };
            let other = checked(&scale(&mesh, factor).unwrap(), &options, "scaled");
            assert_eq!(other.levels, one.levels, "seed {seed} times {factor}");
        }
    }
}

#[test]
fn labels_in_a_file_do_the_same_as_normals() {
    for seed in 0..cases(100) {
        let mesh = sample(seed, CellKind::Triangles);
        let own = labels(&read(&mesh));
        let input = Input { polycube: &mesh, shape: Some(&mesh), labels: Some(&own) };
        let given = polycube::simplify::simplify(&input, &paper(), &Context::default()).unwrap();
        assert_eq!(bytes(&given), bytes(&checked(&mesh, &paper(), "normals")), "seed {seed}");
    }
}

/// What a structure looks like whatever the kind of the cells: the corners with their levels, by place.
fn by_place(structure: &Structure, placement: &[f64], levels: &[i64]) -> Vec<([u64; 3], [i64; 3])> {
    let at = |c: u32| structure.position(c, placement).map(f64::to_bits);
    let now = |c: u32| structure.corners[c as usize].levels.map(|l| levels[l as usize]);
    let mut corners: Vec<_> = (0..structure.corners.len() as u32).map(|c| (at(c), now(c))).collect();
    corners.sort_unstable();
    corners
}

#[test]
fn every_kind_of_cells_stays_valid() {
    for seed in 0..cases(120) {
        let results = CellKind::ALL.map(|kind| {
            let mesh = random_polycube(seed, 1 + seed as usize % 7, 9).unwrap().mesh(kind, 2.0).unwrap();
            let result = checked(&mesh, &paper(), &format!("seed {seed} of {kind}"));
            let input = &result.input;
            by_place(&input.structure, &input.placement, &result.levels)
        });
        // Corners are numbered by their vertices, which all kinds have in the same order.
        assert!(results.iter().all(|r| *r == results[0]), "seed {seed}");
    }
}

#[test]
fn a_second_run_changes_nothing() {
    for seed in 0..cases(300) {
        let once = checked(&sample(seed, CellKind::Quads), &paper(), "first");
        let mesh = once.polycube.clone().unwrap();
        let own = labels(&once.input);
        let input = Input { polycube: &mesh, shape: None, labels: Some(&own) };
        let twice = polycube::simplify::simplify(&input, &paper(), &Context::default()).unwrap();
        assert_eq!(twice.levels, once.levels, "seed {seed}");
        assert_eq!(bytes(&twice), bytes(&once), "seed {seed}");
    }
}

#[test]
fn a_repeated_run_gives_the_same_bytes() {
    for seed in 0..cases(100) {
        let mesh = random_polycube(seed, 6, 12).unwrap().mesh(CellKind::Tetrahedra, 2.0).unwrap();
        let [one, two] = [(); 2].map(|()| checked(&mesh, &paper(), "either"));
        assert_eq!(bytes(&one), bytes(&two), "seed {seed}");
        assert_eq!(bits(one.polycube.as_ref().unwrap()), bits(two.polycube.as_ref().unwrap()));
        assert_eq!(one.report.rounds, two.report.rounds, "seed {seed}");
    }
}

/// A higher bound of λ stops earlier. The result stays valid, and over many polycubes it is less simplified.
#[test]
fn a_bound_of_lambda_trades_blocks_for_fidelity() {
    let mut blocks = [0; 4];
    for seed in 0..cases(150) {
        let mesh = sample(seed, CellKind::Quads);
        for (sum, lambda_min) in blocks.iter_mut().zip([1.0, 0.5, 0.125, 0.0]) {
            let result = checked(&mesh, &SimplifyOptions { lambda_min, ..paper() }, &format!("seed {seed}"));
            *sum += result.report.after.map_or(0, |c| c.blocks_padded);
            assert!(result.report.rounds.iter().all(|r| r.lambda >= lambda_min), "seed {seed}");
        }
    }
    println!("blocks by bound: {blocks:?}");
    assert!(blocks.is_sorted_by(|a, b| a >= b), "{blocks:?}");
    assert!(blocks[0] > blocks[3]);
}

#[test]
fn naive_rounding_is_valid_or_says_that_it_is_not() {
    let mut broken = 0;
    for seed in 0..cases(600) {
        let mesh = sample(seed, CellKind::Quads);
        let options = SimplifyOptions { strategy: Strategy::Naive, scale: Some(0.3), ..paper() };
        let result = simplify(&mesh, &options).unwrap();
        let independent = dense::check(&result.input.structure, &result.levels);
        assert_eq!(result.report.valid, independent.is_ok(), "seed {seed}: {independent:?}");
        assert_eq!(result.polycube.is_some(), result.report.valid);
        assert!(result.report.valid || !result.report.notes.is_empty(), "seed {seed}");
        broken += u32::from(!result.report.valid);
    }
    println!("{broken} broken");
    assert!(broken > 0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(300) as u32))]

    /// Any polycube, symmetry, place, size, scale, and disorder at once.
    #[test]
    fn anything_stays_valid(
        seed: u64, boxes in 1..14_usize, extent in 3..18_i64, symmetry in 0..48_usize, fraction in 0.0..0.49,
        by in prop::array::uniform3(-1e3..1e3), size in 1e-3..1e3, steps in prop::option::of(0.05..20.0),
    ) {
        let mesh = coarse(&random_polycube(seed, boxes, extent).unwrap(), CellKind::Quads);
        let turned = transform(&mesh, &symmetries()[symmetry]).unwrap();
        let moved = perturb(&turned, &labels(&read(&turned)), fraction, seed).unwrap();
        let placed = scale(&translate(&moved, Vector3::from(by)).unwrap(), size).unwrap();
        let options = SimplifyOptions { scale: steps.map(|s| s / size), ..paper() };
        checked(&placed, &options, "random");
    }
}
