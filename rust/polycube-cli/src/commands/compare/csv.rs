//! The comparison as comma-separated values (RFC 4180).

use super::row::Row;
use polycube::align::Strategy;
use polycube::compare::{Gain, Meshing};
use polycube::{Error, ErrorKind, Result};
use serde::Serialize;

/// A line. Empty where there is nothing to say.
#[derive(Default, Serialize)]
struct Line<'a> {
    model: &'a str,
    shape: &'a str,
    polycube: &'a str,
    simplification: &'a str,
    strategy: Option<Strategy>,
    hexes: Option<usize>,
    quads: Option<usize>,
    inverted: Option<usize>,
    min_sj: Option<f64>,
    avg_sj: Option<f64>,
    max_edge_ratio: Option<f64>,
    min_determinant: Option<f64>,
    max_non_orthogonality: Option<f64>,
    max_skewness: Option<f64>,
    singular_vertices: Option<usize>,
    surface_patches: Option<usize>,
    blocks: Option<usize>,
    blocks_padded: Option<usize>,
    gain_surface_patches: Option<f64>,
    gain_blocks: Option<f64>,
    gain_blocks_padded: Option<f64>,
    hausdorff: Option<f64>,
    hausdorff_percent: Option<f64>,
    seconds_simplify: Option<f64>,
    seconds_map: Option<f64>,
    seconds_mesh: Option<f64>,
    seconds_optimise: Option<f64>,
    seconds_measure: Option<f64>,
    seconds_total: Option<f64>,
    notes: String,
    error: String,
}

/// A header, then two lines for every model that could be compared and one for every other.
///
/// # Errors
/// [`ErrorKind::Internal`] if the values cannot be written.
pub fn text(rows: &[Row]) -> Result<String> {
    let internal = |e: String| Error::new(ErrorKind::Internal, format!("no CSV for this: {e}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    for line in rows.iter().flat_map(lines) {
        writer.serialize(line).map_err(|e| internal(e.to_string()))?;
    }
    let bytes = writer.into_inner().map_err(|e| internal(e.to_string()))?;
    String::from_utf8(bytes).map_err(|e| internal(e.to_string()))
}

fn lines(row: &Row) -> Vec<Line<'_>> {
    let names = || Line { model: &row.model, shape: &row.shape, polycube: &row.polycube, ..Line::default() };
    let Some(found) = &row.comparison else {
        return vec![Line { error: row.error.as_ref().map_or_else(String::new, Error::to_string), ..names() }];
    };
    vec![line(names(), "without", &found.without, None), line(names(), "with", &found.with, Some(found.gain))]
}

fn line<'a>(names: Line<'a>, simplification: &'a str, mesh: &Meshing, gain: Option<Gain>) -> Line<'a> {
    Line {
        simplification,
        strategy: Some(mesh.strategy),
        hexes: Some(mesh.hexes),
        quads: Some(mesh.quads),
        inverted: Some(mesh.inverted),
        min_sj: mesh.min_sj,
        avg_sj: mesh.avg_sj,
        max_edge_ratio: mesh.max_edge_ratio,
        min_determinant: mesh.min_determinant,
        max_non_orthogonality: mesh.max_non_orthogonality,
        max_skewness: mesh.max_skewness,
        singular_vertices: Some(mesh.singular_vertices),
        surface_patches: Some(mesh.counts.surface_patches),
        blocks: Some(mesh.counts.blocks),
        blocks_padded: Some(mesh.counts.blocks_padded),
        gain_surface_patches: gain.map(|g| g.surface_patches),
        gain_blocks: gain.map(|g| g.blocks),
        gain_blocks_padded: gain.map(|g| g.blocks_padded),
        hausdorff: Some(mesh.hausdorff),
        hausdorff_percent: Some(mesh.hausdorff_percent),
        seconds_simplify: Some(mesh.seconds.simplify),
        seconds_map: Some(mesh.seconds.map),
        seconds_mesh: Some(mesh.seconds.mesh),
        seconds_optimise: Some(mesh.seconds.optimise),
        seconds_measure: Some(mesh.seconds.measure),
        seconds_total: Some(mesh.seconds.total),
        notes: mesh.notes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "),
        ..names
    }
}
