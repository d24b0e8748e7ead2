//! The linear systems of the morph as files, for `bench/run` to have other libraries solve them.

use super::cotangent::cotangent_weights;
use super::harmonic::System;
use super::mean_value::mean_value_weights;
use super::solve::solve;
use super::sparse::{SparseRows, Values};
use super::testing::{on_levels, real_polycubes, tet_box, tri_box, uneven};
use crate::context::Context;
use crate::map::morph;
use crate::mesh::{Cells, Mesh};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Writes to `$POLYCUBE_BENCH`, in Matrix Market's format, NAME.matrix.mtx, NAME.sides.mtx, and NAME.ours.mtx, our
/// solution; prints a line of JSON with our seconds for each.
#[test]
#[ignore = "writes large files; bench/run asks for them"]
fn for_bench() {
    let folder = PathBuf::from(std::env::var_os("POLYCUBE_BENCH").expect("POLYCUBE_BENCH names a folder"));
    for n in [100, 300] {
        surface(&folder, &format!("sheet-{n}"), &tri_box([n, n, 1]));
    }
    for n in [16, 32] {
        inside(&folder, &format!("box-{n}"), &tet_box([n, n, n]));
    }
    for (name, mesh) in real_polycubes().iter().filter(|(name, _)| name.contains("bunny")) {
        inside(&folder, name.trim_end_matches(".polycube.mesh"), mesh);
    }
}

/// The x coordinate on the surface, where it is free.
fn surface(folder: &Path, name: &str, mesh: &Mesh) {
    let Cells::Triangles(triangles) = mesh.cells() else { panic!("{name} is no surface") };
    let weights = cotangent_weights(mesh.points(), triangles, &Context::default()).unwrap();
    let fixed = on_levels(mesh, uneven);
    let known: Vec<_> = fixed.iter().map(|f| f.map(|c| c.is_some())).collect();
    let moves: Vec<Values<3>> =
        fixed.iter().zip(mesh.points()).map(|(f, p)| [0, 1, 2].map(|k| f[k].map_or(0.0, |c| c - p[k]))).collect();
    record(folder, name, &System::new(&weights, &known, [0], &moves).unwrap());
}

/// All coordinates inside, where the surface is held.
fn inside(folder: &Path, name: &str, mesh: &Mesh) {
    let Cells::Tetrahedra(tetrahedra) = mesh.cells() else { panic!("{name} is no volume") };
    let fixed = on_levels(mesh, uneven);
    let inner: Vec<bool> = fixed.iter().map(|f| *f == [None; 3]).collect();
    let weights = mean_value_weights(mesh.points(), tetrahedra, &inner, &Context::default()).unwrap();
    let known: Vec<_> = inner.iter().map(|&inner| [!inner; 3]).collect();
    let moved = morph(mesh, &fixed, &Context::default()).unwrap();
    let moves: Vec<Values<3>> = moved.iter().zip(mesh.points()).map(|(to, from)| (to - from).into()).collect();
    record(folder, name, &System::new(&weights, &known, [0, 1, 2], &moves).unwrap());
}

fn record<const N: usize>(folder: &Path, name: &str, system: &System<N>) {
    let (start, mut runs, mut solution) = (processor_seconds(), 0, Vec::new());
    while processor_seconds() < start + 0.5 {
        solution = solve(&system.matrix, &system.sides, &Context::default()).unwrap();
        runs += 1;
    }
    let seconds = (processor_seconds() - start) / f64::from(runs);
    let save = |what: &str, text: String| std::fs::write(folder.join(format!("{name}.{what}.mtx")), text).unwrap();
    save("matrix", coordinates(&system.matrix));
    save("sides", array(&system.sides));
    save("ours", array(&solution));
    println!("{{\"name\": \"{name}\", \"unknowns\": {}, \"seconds\": {seconds}}}", solution.len());
}

fn coordinates(matrix: &SparseRows) -> String {
    let size = matrix.len();
    let mut text = format!("%%MatrixMarket matrix coordinate real general\n{size} {size} {}\n", matrix.values().len());
    for i in 0..size {
        for (j, value) in matrix.row(i) {
            writeln!(text, "{} {} {value:e}", i + 1, j + 1).unwrap();
        }
    }
    text
}

/// Column after column.
fn array<const N: usize>(rows: &[Values<N>]) -> String {
    let mut text = format!("%%MatrixMarket matrix array real general\n{} {N}\n", rows.len());
    for value in (0..N).flat_map(|k| rows.iter().map(move |row| row[k])) {
        writeln!(text, "{value:e}").unwrap();
    }
    text
}

/// How long this thread has run, on a machine that may be busy with other work, to some milliseconds.
fn processor_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux");
    1e-9 * text.split_whitespace().next().unwrap().parse::<f64>().unwrap()
}
