//! Every stage on its own: structure, neighbours, alignment and counts of real and generated polycubes, and the morph.
//!
//! Real polycubes are those of `$POLYCUBE_DATA`, or of `../shared/data` beside the project; they are left out where
//! there are none. `cargo bench -p polycube -- bunny` runs what has `bunny` in its name.

#[path = "../tests/common/data.rs"]
mod data;
#[path = "../tests/common/models.rs"]
mod models;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use polycube::Context;
use polycube::align::Strategy;
use polycube::layout::count;
use polycube::mesh::{CellKind, Mesh};
use polycube::parts::{AlignOptions, align, morph, neighbours, random_with_corners};
use polycube::structure::{Arrangement, Polycube, Tolerance};
use std::time::Duration;

fn read(mesh: &Mesh) -> Polycube {
    Polycube::new(mesh, None, &Tolerance::default()).expect("the mesh is a polycube")
}

/// The stages on one polycube, each named with the number of its corners.
fn stages(criterion: &mut Criterion, name: &str, mesh: &Mesh) {
    let polycube = read(mesh);
    let (structure, placement) = (&polycube.structure, &polycube.placement);
    let corner = |c: u32| structure.position(c, placement).map(|x| (x * 256.0).round() as i64);
    let corners: Vec<[i64; 3]> = (0..structure.corners.len() as u32).map(corner).collect();
    let arrangement = Arrangement::new(structure, placement);
    let context = Context::default();
    let mut group = criterion.benchmark_group(format!("{name} ({} corners)", corners.len()));
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    group.bench_function("structure", |b| b.iter(|| read(mesh)));
    group.bench_function("check", |b| b.iter(|| Arrangement::new(structure, placement).conflicts()));
    group.bench_function("neighbours", |b| b.iter(|| neighbours(&corners, &context)));
    // A search of 10,000 corners takes minutes.
    let strategies = if corners.len() < 2000 { &[Strategy::Paper, Strategy::Best][..] } else { &[Strategy::Paper] };
    for &strategy in strategies {
        let options = AlignOptions { strategy, ..AlignOptions::default() };
        let run = || align(structure, placement, &options, &context);
        group.bench_function(format!("align, {strategy:?}"), |b| b.iter(run));
    }
    group.bench_function("count", |b| b.iter(|| count(&arrangement)));
    group.finish();
}

fn real(criterion: &mut Criterion) {
    for (name, mesh) in models::models() {
        stages(criterion, &name, &mesh);
    }
}

fn generated(criterion: &mut Criterion) {
    for corners in [100, 1000, 10_000] {
        let voxels = random_with_corners(1, corners).expect("a random polycube");
        let mesh = voxels.mesh(CellKind::Quads, 1e9).expect("a mesh");
        stages(criterion, &format!("generated {corners}"), &mesh);
    }
}

/// Levels drawn apart unevenly, in their order.
fn morphs(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("morph");
    group.sample_size(10);
    for side in [16, 32] {
        let cube = [polycube::generate::Cuboid::new([0; 3], [side; 3])];
        let voxels = polycube::generate::Voxels::from_boxes(&cube).expect("a box");
        let mesh = voxels.mesh(CellKind::Tetrahedra, 1.0).expect("a mesh");
        let polycube = read(&mesh);
        let moved: Vec<f64> = polycube.placement.iter().map(|x| 1.5 * x + (x % 3.0)).collect();
        let fixed = polycube.prescribed(&moved);
        let id = BenchmarkId::from_parameter(format!("{} tetrahedra", mesh.cells().len()));
        group.bench_function(id, |b| b.iter(|| morph(&mesh, &fixed, &Context::default())));
    }
    group.finish();
}

criterion_group!(benches, real, generated, morphs);
criterion_main!(benches);
