//! Measures the library and prints one JSON object per line.
//!
//! ```text
//! cargo run --release --example timings -- models FILE…        structure, alignment, counts of each polycube
//! cargo run --release --example timings -- corners COUNT…      the same for generated polycubes, with peak memory
//! cargo run --release --example timings -- tetrahedra COUNT…   simplifying generated polycubes, with peak memory
//! cargo run --release --example timings -- neighbours COUNT…   neighbouring corners, on degenerate point sets, too
//! cargo run --release --example timings -- morph FILE          a morph of the mesh, with peak memory
//! cargo run --release --example timings -- front FILE SHAPE    moving along the front, point by point
//! cargo run --release --example timings -- copy FILE FOLDER    reading and writing
//! ```
//!
//! Times are in milliseconds: the shortest run or, where that is less because the machine was busy with other work, the
//! mean processor time of all runs, over all threads.

use polycube::align::Strategy;
use polycube::generate::Example;
use polycube::layout::count;
use polycube::mesh::{CellKind, Mesh, read, write};
use polycube::parts::{AlignOptions, SplitMix64, align, morph, neighbours, random_with_corners};
use polycube::simplify::simplify;
use polycube::structure::{Arrangement, Polycube, Tolerance};
use polycube::{Context, Error, ErrorKind, Input, Result};
use serde_json::{Value, json};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// Everything is repeated for this long, three times at least.
const SECONDS: f64 = 0.3;

/// The result of `work` and the time it takes, in milliseconds.
fn best<T>(mut work: impl FnMut() -> Result<T>) -> Result<(T, f64)> {
    let (clock, processor) = (Instant::now(), processor_time());
    let (mut best, mut runs) = (f64::INFINITY, 0.0);
    loop {
        let start = Instant::now();
        let result = black_box(work()?);
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
        runs += 1.0;
        let spent = clock.elapsed().as_secs_f64();
        if spent > 10.0 * SECONDS || (spent > SECONDS && runs >= 3.0) {
            let mean = processor_time().zip(processor).map_or(best, |(end, start)| (end - start) / runs);
            return Ok((result, best.min(mean)));
        }
    }
}

/// How long the threads of this process have run so far, all together, in milliseconds, where `/proc` says so.
fn processor_time() -> Option<f64> {
    let tasks = std::fs::read_dir("/proc/self/task").ok()?;
    let run = |task: std::fs::DirEntry| std::fs::read_to_string(task.path().join("schedstat")).ok();
    let nanoseconds = |text: String| text.split_whitespace().next()?.parse::<f64>().ok();
    tasks.flatten().map(|task| run(task).and_then(nanoseconds)).sum::<Option<f64>>().map(|sum| sum * 1e-6)
}

fn structure(mesh: &Mesh) -> Result<Polycube> {
    let first = |mut all: Vec<polycube::structure::Violation>| Error::from(all.swap_remove(0));
    Polycube::new(mesh, None, &Tolerance::default()).map_err(first)
}

/// The stages between reading a mesh and morphing it.
fn stages(mesh: &Mesh) -> Result<Value> {
    let (polycube, found) = best(|| structure(mesh))?;
    let (clear, checked) = best(|| Ok(polycube.overlaps(mesh.points()).is_empty()))?;
    if !clear {
        return Err(Error::new(ErrorKind::Polycube, "the polycube touches or crosses itself"));
    }
    let arrange = || Arrangement::new(&polycube.structure, &polycube.placement);
    let (_, counted) = best(|| Ok(count(&arrange())))?;
    let options = AlignOptions { strategy: Strategy::Paper, ..AlignOptions::default() };
    let run = || align(&polycube.structure, &polycube.placement, &options, &Context::default());
    let (result, aligned) = best(run)?;
    Ok(json!({
        "corners": polycube.structure.corners.len(), "levels": polycube.structure.levels.len(),
        "faces": polycube.surface.faces().len(), "rounds": result.rounds.len(),
        "structure": found, "check": checked, "count": counted, "align": aligned,
        "total": found + checked + aligned, "before": result.before, "after": result.after,
    }))
}

fn model(file: &str) -> Result<Value> {
    let mut line = stages(&read(Path::new(file))?)?;
    line["file"] = json!(file);
    Ok(line)
}

fn corners(count: &str) -> Result<Value> {
    let voxels = random_with_corners(1, number(count)?)?;
    let mut line = stages(&voxels.mesh(CellKind::Quads, 1e9)?)?;
    line["peak_mb"] = json!(memory());
    Ok(line)
}

fn tetrahedra(count: &str) -> Result<Value> {
    let voxels = Example::CubeSpikes.voxels(1)?;
    // There are five in every cell.
    let step = (5.0 * voxels.volume() / number(count)? as f64).cbrt();
    let mesh = voxels.mesh(CellKind::Tetrahedra, step)?;
    let input = Input { polycube: &mesh, shape: None, labels: None };
    let options = polycube::SimplifyOptions { strategy: Strategy::Paper, ..Default::default() };
    let (_, time) = best(|| simplify(&input, &options, &Context::default()))?;
    Ok(json!({ "tetrahedra": mesh.cells().len(), "simplify": time, "peak_mb": memory() }))
}

/// Corners of a polycube, the same with a large step, random points, and all points of a grid.
fn crowd(count: &str) -> Result<Value> {
    let count = number(count)?;
    let polycube = structure(&random_with_corners(1, count)?.mesh(CellKind::Quads, 1e9)?)?;
    let corner = |c: u32| polycube.structure.position(c, &polycube.placement).map(|x| x as i64);
    let corners: Vec<[i64; 3]> = (0..polycube.structure.corners.len() as u32).map(corner).collect();
    let large = corners.iter().map(|p| p.map(|x| (x << 18) + 1)).chain([[0; 3]]).collect();
    let mut rng = SplitMix64::new(1);
    let random = (0..count).map(|_| [0; 3].map(|_: i32| rng.below(1 << 24) as i64)).collect();
    let side = (count as f64).cbrt() as i64;
    let grid = (0..side.pow(3)).map(|i| [i / side / side, i / side % side, i % side]).collect();
    let mut line = json!({ "corners": count });
    for (name, points) in [("polycube", corners), ("large", large), ("random", random), ("grid", grid)] {
        line[name] = json!(best(|| neighbours(&points, &Context::default()))?.1);
    }
    Ok(line)
}

/// Levels drawn apart unevenly, so that their order stays.
fn stretched(polycube: &Polycube) -> Vec<f64> {
    polycube.placement.iter().map(|x| 1.5 * x + 0.2 * (x % 3.0)).collect()
}

fn morphed(file: &str) -> Result<Value> {
    let mesh = read(Path::new(file))?;
    let (polycube, found) = best(|| structure(&mesh))?;
    let before = memory();
    let fixed = polycube.prescribed(&stretched(&polycube));
    let (_, time) = best(|| morph(&mesh, &fixed, &Context::default()))?;
    Ok(json!({
        "file": file, "cells": mesh.cells().len(), "structure": found, "morph": time,
        "peak_before_mb": before, "peak_mb": memory(),
    }))
}

/// The most memory that the process had so far, in megabytes; 0 where `/proc` does not say.
fn memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    line.and_then(|l| l.split_whitespace().next()?.parse().ok()).map_or(0.0, |kb: f64| kb / 1024.0)
}

/// Each point of the front from where the search ended.
fn front(file: &str, shape: &str) -> Result<()> {
    let (mesh, shape) = (read(Path::new(file))?, read(Path::new(shape))?);
    let input = Input { polycube: &mesh, shape: Some(&shape), labels: None };
    let found = simplify(&input, &polycube::SimplifyOptions::default(), &Context::default())?;
    let last = found.report.front.len().saturating_sub(1);
    for index in 0..=last {
        let simplicity = 1.0 - index as f64 / last.max(1) as f64;
        let (point, time) = best(|| found.at(&input, simplicity, &Context::default()))?;
        println!("{}", json!({ "point": point.report.chosen, "at": time, "flipped": point.report.flipped_elements }));
    }
    Ok(())
}

fn copy(file: &str, folder: &str) -> Result<Value> {
    let from = Path::new(file);
    let to = Path::new(folder).join(from.file_name().unwrap_or_default());
    let (mesh, reading) = best(|| read(from))?;
    let (_, writing) = best(|| write(&to, &mesh, &[]))?;
    Ok(json!({ "file": file, "read": reading, "write": writing }))
}

fn number(text: &str) -> Result<usize> {
    text.parse().map_err(|_| Error::new(ErrorKind::Option, format!("{text} is no number")))
}

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (mode, rest) = arguments.split_first().map_or(("", &[][..]), |(m, r)| (m.as_str(), r));
    let measure: fn(&str) -> Result<Value> = match (mode, rest) {
        ("models", _) => model,
        ("corners", _) => corners,
        ("tetrahedra", _) => tetrahedra,
        ("neighbours", _) => crowd,
        ("morph", _) => morphed,
        ("front", [file, shape]) => return front(file, shape),
        ("copy", [file, folder]) => {
            println!("{}", copy(file, folder)?);
            return Ok(());
        }
        _ => return Err(Error::new(ErrorKind::Option, "see the head of examples/timings.rs for what to ask")),
    };
    rest.iter().try_for_each(|argument| {
        println!("{}", measure(argument)?);
        Ok(())
    })
}
