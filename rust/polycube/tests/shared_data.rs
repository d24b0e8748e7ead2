//! The sixteen real polycubes: published counts, the results asked for, and validity at every scale.

mod common;

use common::models::{models, reference};
use common::{dense, labels, paper, read, simplify};
use nalgebra::Vector3;
use polycube::layout::{Counts, count};
use polycube::mesh::Mesh;
use polycube::parts::morph;
use polycube::parts::{SplitMix64, perturb, scale};
use polycube::structure::{Arrangement, Polycube, Tolerance, placement_of};
use polycube::{Context, Input, Simplified, SimplifyOptions};
use serde_json::Value;

const SCALES: [f64; 4] = [0.37, 1.0, 1.7, 3.0];

/// The most padded blocks that the result may have.
const LIMITS: [(&str, usize); 5] = [
    ("marco2016sgp-asm", 122),
    ("marco2016sgp-block", 100),
    ("marco2016sgp-bunny", 197),
    ("marco2016sgp-cubespikes", 111),
    ("marco2016sgp-femur", 110),
];

/// Models whose result is the same structure at every scale.
const ALIKE: [&str; 4] = ["marco2016sgp-asm", "marco2016sgp-block", "marco2016sgp-bunny", "marco2016sgp-cubespikes"];

fn number(source: &Value, name: &str) -> usize {
    source[name].as_u64().expect("a number") as usize
}

#[test]
fn structure_and_counts_are_the_published_ones() {
    let Some(reference) = reference() else { return };
    for (name, mesh) in models() {
        let polycube = read(&mesh);
        let arrangement = Arrangement::new(&polycube.structure, &polycube.placement);
        assert!(arrangement.conflicts().is_empty() && arrangement.inside_out().is_empty(), "{name}");
        let source = &reference[&name]["source"];
        let counts = count(&arrangement);
        assert_eq!(counts.surface_patches, number(source, "surface_patches"), "{name}");
        assert_eq!(counts.blocks_padded, number(source, "blocks"), "{name}");
        assert_eq!(polycube.structure.corners.len(), number(source, "singular_vertices"), "{name}");
        assert_eq!(polycube.structure.genus(), number(source, "genus"), "{name}");
    }
}

/// Checks the result on the lattice, and that its mesh lies on it.
fn assert_valid(name: &str, result: &Simplified) -> Counts {
    let structure = &result.input.structure;
    assert_eq!(dense::check(structure, &result.levels), Ok(()), "{name}");
    let placement = placement_of(&result.levels);
    let arrangement = Arrangement::new(structure, &placement);
    assert!(arrangement.conflicts().is_empty() && arrangement.inside_out().is_empty(), "{name}");
    assert!(result.report.valid, "{name}");
    let mesh = result.polycube.as_ref().expect("a valid result has a mesh");
    for (p, fixed) in mesh.points().iter().zip(result.input.prescribed(&placement)) {
        let missed = (0..3).any(|a| fixed[a].is_some_and(|x| x != p[a]) || !p[a].is_finite());
        assert!(!missed, "{name}: a vertex at {p} should be at {fixed:?}");
    }
    let after = result.report.after.expect("a valid result has counts");
    assert_eq!(after, count(&arrangement), "{name}");
    let before = result.report.before;
    assert!(after.blocks_padded <= before.blocks_padded, "{name}: {} before", before.blocks_padded);
    assert!(after.blocks <= before.blocks, "{name}: {} blocks before", before.blocks);
    after
}

#[test]
fn every_model_gets_as_coarse_as_asked_at_every_scale() {
    for (name, mesh) in models() {
        let counts = SCALES.map(|scale| {
            let options = SimplifyOptions { scale: Some(scale), ..paper() };
            let result = simplify(&mesh, &options).expect("real polycubes can be simplified");
            assert_valid(&format!("{name} x {scale}"), &result)
        });
        println!("{name}: {:?}", counts.map(|c| c.blocks_padded));
        if let Some((_, limit)) = LIMITS.iter().find(|l| l.0 == name) {
            assert!(counts.iter().all(|c| c.blocks_padded <= *limit), "{name}: more than {limit} in {counts:?}");
        }
        if ALIKE.contains(&name.as_str()) {
            assert_eq!(counts, [counts[0]; 4], "{name}");
        }
    }
}

#[test]
fn models_off_the_lattice_stay_valid() {
    for (name, mesh) in models() {
        let own = labels(&read(&mesh));
        for seed in 0..common::cases(3) {
            let moved = perturb(&scale(&mesh, 0.37).unwrap(), &own, 0.3, seed).unwrap();
            let result = simplify(&moved, &paper()).expect("moved polycubes can be simplified");
            let after = assert_valid(&format!("{name}, moved with seed {seed}"), &result);
            println!("{name} {seed}: {} -> {}", result.report.before.blocks_padded, after.blocks_padded);
        }
    }
}

fn morphed(mesh: &Mesh, placement: &[f64]) -> Mesh {
    let polycube = read(mesh);
    let points = morph(mesh, &polycube.prescribed(placement), &Context::default()).expect("the morph succeeds");
    mesh.clone().with_points(points).expect("finite points")
}

#[test]
fn a_morph_onto_the_same_levels_changes_no_bit() {
    for (name, mesh) in models() {
        let polycube = read(&mesh);
        assert_eq!(common::bits(&morphed(&mesh, &polycube.placement)), common::bits(&mesh), "{name}");
    }
}

#[test]
fn simplifying_again_changes_nothing() {
    for (name, mesh) in models() {
        let once = simplify(&mesh, &paper()).unwrap();
        let result = once.polycube.clone().expect("a valid result has a mesh");
        let own = labels(&once.input);
        let input = Input { polycube: &result, shape: None, labels: Some(&own) };
        let twice = polycube::simplify::simplify(&input, &paper(), &Context::default()).unwrap();
        assert_eq!(twice.levels, once.levels, "{name}");
        assert_eq!(common::bits(&twice.polycube.unwrap()), common::bits(&result), "{name}");
    }
}

/// The vertices moved within and off their facets by up to two percent of the size, labels as they were: corners, edges
/// and facets are those of the model, and so are the counts as long as facets of one plane are known for such.
#[test]
fn models_with_noise_have_the_structure_of_the_models() {
    for (name, mesh) in models() {
        let clean = read(&mesh);
        let own = labels(&clean);
        let counts = |polycube: &Polycube| count(&Arrangement::new(&polycube.structure, &polycube.placement));
        let size = (0..3).map(|a| extent(&mesh, a).powi(2)).sum::<f64>().sqrt();
        for seed in 0..common::cases(3) {
            let mut random = SplitMix64::new(seed);
            for reach in [1e-9, 1e-4, 0.02] {
                let mut off = || reach * size * (2.0 * random.unit() - 1.0);
                let moved = mesh.moved(|p| p + Vector3::new(off(), off(), off())).unwrap();
                let found = Polycube::new(&moved, Some(&own), &Tolerance::default());
                let found = found.unwrap_or_else(|v| panic!("{name} {seed} {reach}: {}", v[0]));
                assert_eq!(found.structure, clean.structure, "{name} {seed} {reach}");
                assert!(found.deviation.distance > 0.0 && found.deviation.distance <= 0.05 * size, "{name}");
                assert!(reach > 1e-9 || counts(&found) == counts(&clean), "{name} {seed}");
            }
        }
    }
}

fn extent(mesh: &Mesh, axis: usize) -> f64 {
    let along = mesh.points().iter().map(|p| p[axis]);
    along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
}
