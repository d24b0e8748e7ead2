//! The morph on real polycubes.

use super::testing::{labels, real_polycubes, tri_box};
use super::{distortion, flipped, morph};
use crate::context::Context;
use crate::mesh::{Mesh, Point};
use std::sync::{Arc, Mutex};
use std::time::Instant;

/// Every boundary vertex on the level of each of its facets, moved by `level(axis, coordinate)`.
fn levels(mesh: &Mesh, level: impl Fn(usize, f64) -> f64) -> Vec<[Option<f64>; 3]> {
    let mut fixed = vec![[None; 3]; mesh.points.len()];
    for (face, label) in mesh.cells.boundary().unwrap().iter().zip(labels(mesh)) {
        for &v in face.vertices().iter().filter(|_| label >= 0) {
            let axis = label as usize / 2;
            fixed[v as usize][axis] = Some(level(axis, mesh.points[v as usize][axis]));
        }
    }
    fixed
}

/// Levels drawn apart unevenly, so that their order stays.
fn uneven(axis: usize, x: f64) -> f64 {
    x + 0.4 * (x * 1.7 + axis as f64).sin()
}

fn largest_step(mesh: &Mesh, points: &[Point]) -> f64 {
    mesh.points.iter().zip(points).fold(0.0, |m, (a, b)| m.max((a - b).amax()))
}

#[test]
fn real_polycubes_stay_and_move() {
    for (name, mesh) in real_polycubes() {
        let context = Context::default();
        let same = morph(&mesh, &levels(&mesh, |_, x| x), &context).unwrap();
        assert!(largest_step(&mesh, &same) < 1e-12, "{name}");
        let affine = morph(&mesh, &levels(&mesh, |k, x| (2.0 + k as f64) * x - 1.0), &context).unwrap();
        let expected = mesh.points.iter().map(|p| Point::new(2.0 * p.x - 1.0, 3.0 * p.y - 1.0, 4.0 * p.z - 1.0));
        let span = 4.0 * mesh.points.iter().fold(0.0_f64, |m, p| m.max(p.coords.amax()));
        let error = expected.zip(&affine).fold(0.0_f64, |m, (a, b)| m.max((a - b).amax()));
        println!("{name}: affine map missed by {:.1e} of the size", error / span);
        assert!(error < 1e-8 * span, "{name}");
        let moved = morph(&mesh, &levels(&mesh, uneven), &context).unwrap();
        let moved = Mesh { points: moved, cells: mesh.cells.clone() };
        let flips = flipped(&moved, &labels(&mesh)).unwrap();
        let before = flipped(&mesh, &labels(&mesh)).unwrap();
        println!(
            "{name}: flipped before {} {} after {} {}",
            before.cells.len(),
            before.faces.len(),
            flips.cells.len(),
            flips.faces.len()
        );
        println!("{name}: {:?}", distortion(&mesh, &moved).unwrap());
    }
}

/// Run with `cargo test --release -p polycube -- --ignored --nocapture time_and_memory`.
#[test]
#[ignore = "prints time and memory; run in release mode"]
fn time_and_memory() {
    for (name, mesh) in real_polycubes().into_iter().filter(|(name, _)| name.contains("bunny")) {
        let start = Instant::now();
        let faces = mesh.cells.boundary().unwrap().len();
        println!("{name}: {} tetrahedra, {faces} boundary faces in {:.0?}", mesh.cells.len(), start.elapsed());
        let fixed = levels(&mesh, uneven);
        for _ in 0..3 {
            let before = resident("VmRSS");
            let (start, gap) = (Instant::now(), Arc::new(Mutex::new((Instant::now(), 0.0))));
            let log = Arc::clone(&gap);
            let context = Context::new(move |_, _| {
                let mut last = log.lock().unwrap();
                *last = (Instant::now(), last.0.elapsed().as_secs_f64().max(last.1));
            });
            morph(&mesh, &fixed, &context).unwrap();
            println!(
                "morph in {:.0?}, longest silence {:.3} s, resident {before} kB before, peak {} kB",
                start.elapsed(),
                gap.lock().unwrap().1,
                resident("VmHWM")
            );
        }
    }
}

/// Two large sheets, the worst surface for an iterative solver.
#[test]
#[ignore = "prints time and memory; run in release mode"]
fn time_of_a_large_surface() {
    for n in [150, 300] {
        let mesh = tri_box([n, n, 1]);
        let bend = |x: f64| x + 10.0 * (x * 0.01).sin();
        let fixed = levels(&mesh, |axis, x| if axis < 2 { bend(x) } else { x });
        let mut fixed = fixed;
        for (f, p) in fixed.iter_mut().zip(&mesh.points) {
            f[0] = f[0].map(|x| x + (p.y * 0.1).cos());
        }
        let start = Instant::now();
        morph(&mesh, &fixed, &Context::default()).unwrap();
        println!("{} surface vertices in {:.0?}, peak {} kB", mesh.points.len(), start.elapsed(), resident("VmHWM"));
    }
}

/// A number of `/proc/self/status`, in kB; 0 where there is none.
fn resident(key: &str) -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|l| l.starts_with(key));
    line.and_then(|l| l.split_ascii_whitespace().nth(1)?.parse().ok()).unwrap_or(0)
}
