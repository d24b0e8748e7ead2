//! Tables for people.

use comfy_table::presets::{ASCII_MARKDOWN, UTF8_NO_BORDERS};
use comfy_table::{CellAlignment, LineStyle, Table};
use polycube::layout::Counts;
use polycube::remesh::RemeshReport;
use polycube::simplify::SimplifyReport;

/// Where a table is read.
#[derive(Clone, Copy, Debug)]
pub enum Style {
    /// On a terminal.
    Terminal,
    /// In a Markdown document.
    Markdown,
}

/// A table for the terminal under `header`; every column but the first is aligned to the right.
pub fn table<const N: usize>(header: [&str; N], rows: impl IntoIterator<Item = [String; N]>) -> String {
    styled(Style::Terminal, header, rows)
}

/// A table as [`table()`] makes it, in any style.
pub fn styled<const N: usize>(style: Style, header: [&str; N], rows: impl IntoIterator<Item = [String; N]>) -> String {
    let mut table = Table::new();
    let preset = match style {
        Style::Terminal => UTF8_NO_BORDERS,
        Style::Markdown => ASCII_MARKDOWN,
    };
    table.load_style(preset).set_header(header);
    table.style_mut().row_separator = LineStyle::none();
    for row in rows {
        table.add_row(row);
    }
    table.column_iter_mut().skip(1).for_each(|c| {
        c.set_cell_alignment(CellAlignment::Right);
    });
    table.trim_fmt() + "\n"
}

/// The three counts, by their names for people.
pub fn counts(counts: &Counts) -> [(&'static str, usize); 3] {
    [("surface patches", counts.surface_patches), ("blocks", counts.blocks), ("blocks, padded", counts.blocks_padded)]
}

/// What a run did.
pub fn summary(report: &SimplifyReport) -> String {
    let mut text = match &report.after {
        Some(after) => gains(&report.before, after),
        None => {
            table(["", "before", "after"], counts(&report.before).map(|(n, x)| [n.into(), x.to_string(), "-".into()]))
        }
    };
    text.push('\n');
    for (name, value) in facts(report) {
        text += &format!("{name:21}{value}\n");
    }
    for note in &report.notes {
        text += &format!("note: {note}\n");
    }
    text
}

/// What a remeshing did.
pub fn remesh_summary(report: &RemeshReport) -> String {
    let simplified = &report.simplify;
    let mut text = match &simplified.after {
        Some(after) => gains(&simplified.before, after),
        None => String::new(),
    };
    text.push('\n');
    for (name, value) in remesh_facts(report) {
        text += &format!("{name:21}{value}\n");
    }
    // Faults are told apart, as warnings.
    let faults = report.faults();
    for note in simplified.notes.iter().filter(|note| !faults.contains(note)) {
        text += &format!("note: {note}\n");
    }
    text
}

fn remesh_facts(report: &RemeshReport) -> Vec<(&'static str, String)> {
    let mut facts = vec![("lattice", lattice(report)), ("quadrilaterals", report.quads.to_string())];
    if let (Some(min), Some(average)) = (report.min_sj, report.avg_sj) {
        facts.push(("hexahedra", format!("{} in {} blocks", report.hexes, report.hex_blocks)));
        facts.push(("inverted", report.inverted.to_string()));
        facts.push(("scaled Jacobian", format!("at least {min:.3}, {average:.3} on average")));
    }
    if let Some(m) = &report.measures {
        facts.push(("edge ratio", format!("at most {:.1}, {:.2} on average", m.edge_ratio.max, m.edge_ratio.mean)));
        facts.push(("determinant", format!("at least {:.4} of the mean", m.determinant.min)));
        let (angle, skewness) = (m.non_orthogonality.max, m.skewness.max);
        facts.push(("faces", format!("non-orthogonality at most {angle:.0} degrees, skewness at most {skewness:.2}")));
    }
    facts.push((
        "Hausdorff distance",
        format!("{} ({:.3} % of the diagonal)", short(report.hausdorff), report.hausdorff_percent),
    ));
    let s = &report.seconds;
    let stages =
        [("simplify", s.simplify), ("map", s.map), ("mesh", s.mesh), ("optimise", s.optimise), ("measure", s.measure)];
    let each: Vec<String> = stages.iter().map(|(name, t)| format!("{name} {t:.2}")).collect();
    facts.push(("seconds", format!("{:.2} ({})", s.total, each.join(", "))));
    facts
}

fn lattice(report: &RemeshReport) -> String {
    let spaced = if report.spaced { ", spaced by the shape" } else { "" };
    format!("{} steps per unit of the polycube{spaced}", short(report.simplify.scale))
}

fn gains(before: &Counts, after: &Counts) -> String {
    let row = |((name, b), (_, a)): ((&str, usize), (&str, usize))| {
        let gain = if b == 0 { 0.0 } else { 100.0 * (a as f64 - b as f64) / b as f64 };
        [name.to_owned(), b.to_string(), a.to_string(), format!("{gain:+.0} %")]
    };
    table(["", "before", "after", "change"], counts(before).into_iter().zip(counts(after)).map(row))
}

fn facts(report: &SimplifyReport) -> Vec<(&'static str, String)> {
    let mut facts = vec![
        ("lattice", format!("{} steps per unit of the input", short(report.scale))),
        ("rounds", report.rounds.len().to_string()),
        ("corners moved by", format!("at most {} units of the input", short(report.max_displacement))),
    ];
    if let Some(bound) = &report.bound {
        let known =
            if bound.proven { "this is the optimum, proven".into() } else { format!("at least {}", bound.count) };
        facts.push(("lower bound", known));
    }
    if let Some([before, after]) = &report.distortion {
        facts.push((
            "angle distortion",
            format!("{:.3} before, {:.3} after (mean; 1 is none)", before.angle, after.angle),
        ));
        facts
            .push(("size distortion", format!("{:.3} before, {:.3} after (mean; 1 is none)", before.size, after.size)));
    }
    if report.valid {
        facts.push(("flipped elements", report.flipped_elements.to_string()));
    }
    facts.push(("seconds", seconds(report)));
    facts
}

fn seconds(report: &SimplifyReport) -> String {
    let s = &report.seconds;
    let stages = [("read", s.read), ("structure", s.structure), ("align", s.align), ("morph", s.morph)];
    let each: Vec<String> = stages.iter().map(|(name, t)| format!("{name} {t:.3}")).collect();
    format!("{:.3} ({}, write {:.3})", s.total, each.join(", "), s.write)
}

/// A number with six significant digits, but all digits before the point, and no trailing zeros.
pub fn short(x: f64) -> String {
    let rounded = if x.abs() < 1e6 { format!("{x:.5e}").parse().unwrap_or(x) } else { x.round() };
    match rounded.abs() {
        0.0 => "0".to_owned(),
        size if (1e-5..1e15).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let found = [1.0, 0.37, 100.0, 1.0 / 3.0, 0.0, -0.0, -20.0 / 3.0].map(short);
        assert_eq!(found, ["1", "0.37", "100", "0.333333", "0", "0", "-6.66667"]);
        let found = [1.0 / 7e6, 1e-5 / 3.0, 1e-4 / 3.0, 1234567.4, 1e300, f64::NAN].map(short);
        assert_eq!(found, ["1.42857e-7", "3.33333e-6", "0.0000333333", "1234567", "1e300", "NaN"]);
    }

    #[test]
    fn gains_are_relative() {
        let before = Counts { surface_patches: 168, blocks: 108, blocks_padded: 276 };
        let after = Counts { surface_patches: 78, blocks: 33, blocks_padded: 111 };
        let text = gains(&before, &after);
        assert!(text.contains("-54 %") && text.contains("-69 %") && text.contains("-60 %"), "{text}");
    }
}
