//! The comparison as a table, for the terminal and for documents.

use super::row::Row;
use crate::output::table::{Style, styled};
use polycube::compare::{Comparison, Meshing};
use polycube::simplify::Note;

/// The columns; the first two are texts.
const HEADER: [&str; 18] = [
    "model",
    "simplification",
    "hexes",
    "min SJ",
    "avg SJ",
    "edges",
    "determinant",
    "angle",
    "skewness",
    "inverted",
    "singular",
    "patches",
    "blocks",
    "padded",
    "gain",
    "Hausdorff",
    "simplify",
    "total",
];

/// Two lines for every model, then the mean gain, then what was not as asked and, if `why` is to be told, what went
/// wrong.
pub fn text(rows: &[Row], style: Style, (surface_only, why): (bool, bool)) -> String {
    let lines = rows.iter().flat_map(|row| match &row.comparison {
        Some(found) => lines(&row.model, found, surface_only).to_vec(),
        None => vec![failed(&row.model)],
    });
    let mut text = styled(style, HEADER, lines) + "\n";
    let bullet = if matches!(style, Style::Markdown) { "- " } else { "" };
    let gains: Vec<f64> = rows.iter().filter_map(|r| Some(gain(r.comparison.as_ref()?, surface_only))).collect();
    if !gains.is_empty() {
        let mean = gains.iter().sum::<f64>() / gains.len() as f64;
        let what = if surface_only { "patches" } else { "padded blocks" };
        let over = match gains.len() {
            1 => String::new(),
            n => format!(" on average over {n} models"),
        };
        text += &format!("{bullet}{mean:.0} % fewer {what}{over}\n");
    }
    text += &format!(
        "{bullet}SJ: scaled Jacobian; edges: largest ratio of a cell's edges; determinant: least one over the mean; \
         angle, skewness: largest non-orthogonality in degrees and skewness of faces; singular: irregular vertices of \
         the surface; Hausdorff: in percent of the shape's diagonal; simplify, total: seconds\n"
    );
    for line in rows.iter().flat_map(|row| remarks(row, why)) {
        text += &format!("{bullet}{line}\n");
    }
    text
}

fn lines(model: &str, found: &Comparison, surface_only: bool) -> [[String; 18]; 2] {
    let gain = format!("{:.0} %", gain(found, surface_only));
    [line(model, "without", &found.without, String::new()), line("", "with", &found.with, gain)]
}

fn line(model: &str, simplification: &str, mesh: &Meshing, gain: String) -> [String; 18] {
    let quality = |x: Option<f64>| x.map_or("-".to_owned(), |x| format!("{x:.3}"));
    [
        model.to_owned(),
        simplification.to_owned(),
        mesh.hexes.to_string(),
        quality(mesh.min_sj),
        quality(mesh.avg_sj),
        mesh.max_edge_ratio.map_or("-".to_owned(), |x| format!("{x:.1}")),
        mesh.min_determinant.map_or("-".to_owned(), |x| format!("{x:.4}")),
        mesh.max_non_orthogonality.map_or("-".to_owned(), |x| format!("{x:.0}")),
        mesh.max_skewness.map_or("-".to_owned(), |x| format!("{x:.2}")),
        mesh.inverted.to_string(),
        mesh.singular_vertices.to_string(),
        mesh.counts.surface_patches.to_string(),
        mesh.counts.blocks.to_string(),
        mesh.counts.blocks_padded.to_string(),
        gain,
        format!("{:.3}", mesh.hausdorff_percent),
        format!("{:.1}", mesh.seconds.simplify),
        format!("{:.1}", mesh.seconds.total),
    ]
}

fn failed(model: &str) -> [String; 18] {
    let mut cells = std::array::from_fn(|_| "-".to_owned());
    (cells[0], cells[1]) = (model.to_owned(), "failed".to_owned());
    cells
}

fn gain(found: &Comparison, surface_only: bool) -> f64 {
    if surface_only { found.gain.surface_patches } else { found.gain.blocks_padded }
}

/// Errors and notes of one model.
fn remarks(row: &Row, why: bool) -> Vec<String> {
    let model = &row.model;
    let error = row.error.iter().filter(|_| why).map(|e| format!("{model}: error: {e}"));
    let notes = |name: &'static str, mesh: &Meshing| {
        let line = |note: &Note| format!("{model}, {name}: {note}");
        mesh.notes.iter().map(line).collect::<Vec<_>>()
    };
    let both = row.comparison.iter().flat_map(|c| [notes("without", &c.without), notes("with", &c.with)]);
    error.chain(both.flatten()).collect()
}
