//! The points of the front between few blocks and little displacement, measured one by one.

use super::folder::Output;
use super::table::{short, table};
use polycube::Result;
use polycube::layout::Counts;
use polycube::measure::Distortion;
use polycube::mesh::{self, Format};
use polycube::simplify::Simplified;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Where the meshes of the points lie, within the output folder.
pub const FOLDER: &str = "front";

/// How the names of these meshes begin.
const PREFIX: &str = "point-";

/// A point of the front as the report has it.
#[derive(Debug, Serialize)]
pub struct Point {
    /// Its mesh, within the output folder.
    file: String,
    counts: Counts,
    /// The farthest that a corner moves, in units of the input.
    max_displacement: f64,
    /// Distortion of the map from the shape.
    distortion: Option<Distortion>,
    flipped_elements: usize,
    /// Whether it is the result.
    chosen: bool,
}

/// What the points are like, in a format for their meshes.
pub fn points(results: &[Simplified], chosen: Option<usize>, format: Format) -> Vec<Point> {
    let point = |(index, result): (usize, &Simplified)| Point {
        file: format!("{FOLDER}/{PREFIX}{index:02}.{format}"),
        counts: result.report.after.unwrap_or(result.report.before),
        max_displacement: result.report.max_displacement,
        distortion: result.report.distortion.map(|[_, after]| after),
        flipped_elements: result.report.flipped_elements,
        chosen: chosen == Some(index),
    };
    results.iter().enumerate().map(point).collect()
}

/// Adds the meshes of the points to the output.
pub fn add(output: &mut Output, points: &[Point], results: &[Simplified], format: Format) -> Result<()> {
    for (point, result) in points.iter().zip(results) {
        if let Some(mesh) = &result.polycube {
            output.add(&point.file, &mesh::write_bytes(format, mesh, &[])?)?;
        }
    }
    Ok(())
}

/// Meshes of points that an earlier run left in the output folder.
pub fn stale(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder.join(FOLDER)) else { return Vec::new() };
    let names = entries.filter_map(|e| e.ok().map(|e| e.path()));
    names.filter(|p| p.file_name().is_some_and(|n| n.to_string_lossy().starts_with(PREFIX))).collect()
}

/// The points as a table.
pub fn to_table(points: &[Point]) -> String {
    let header = ["point", "patches", "blocks", "padded", "moved by", "angle", "size", "flipped"];
    let row = |(index, p): (usize, &Point)| {
        let of =
            |value: fn(&Distortion) -> f64| p.distortion.as_ref().map_or("-".into(), |d| format!("{:.3}", value(d)));
        let Counts { surface_patches, blocks, blocks_padded } = p.counts;
        [
            format!("{index}{}", if p.chosen { " (chosen)" } else { "" }),
            surface_patches.to_string(),
            blocks.to_string(),
            blocks_padded.to_string(),
            short(p.max_displacement),
            of(|d| d.angle),
            of(|d| d.size),
            p.flipped_elements.to_string(),
        ]
    };
    table(header, points.iter().enumerate().map(row))
}
