//! `make` and what it gives.

use crate::failure::{Result, guard};
use crate::ffi::*;
use crate::input::mesh;
use crate::results::json;
use crate::run::run;
use polycube::make::{self as core, Axes, Made, MakeOptions};

/// See `polycube::make::make`.
pub fn make(shape: &MeshView, data: &MakeOptionsData, observer: &Observer) -> Result<MadeData> {
    let shape = guard(|| mesh(shape))?;
    let result = run(observer, |context| core::make(&shape, &make_options(data), context))?;
    guard(|| made(&result))
}

/// The core's options.
pub fn make_options(data: &MakeOptionsData) -> MakeOptions {
    // More corners than a usize holds are as many as there can be.
    let corners = data.has_corners.then(|| usize::try_from(data.corners).unwrap_or(usize::MAX));
    let axes = if data.best_axes { Axes::Best } else { Axes::Keep };
    let labels = data.has_labels.then(|| data.labels.clone());
    MakeOptions { detail: data.detail, corners, axes, labels, no_repair: data.no_repair }
}

/// What was made, as C++ sees it.
///
/// # Errors
/// [`polycube::ErrorKind::Internal`] if its report cannot be written.
pub fn made(Made { shape, polycube, labels, report }: &Made) -> polycube::Result<MadeData> {
    Ok(MadeData {
        polycube: polycube.into(),
        shape: shape.into(),
        labels: labels.clone(),
        repairs: report.repairs.iter().map(ToString::to_string).collect(),
        corners: report.corners as u64,
        edges: report.edges as u64,
        facets: report.facets as u64,
        genus: report.genus as u64,
        added: report.added as u64,
        misfit: report.misfit,
        squashed: report.squashed,
        distortion: report.distortion.iter().map(DistortionData::from).collect(),
        folded: report.folded.iter().map(|&face| face as u32).collect(),
        seconds: report.seconds.total,
        report_json: json(report)?,
    })
}

/// The defaults of the core, for C++ to compare its own with.
pub fn default_make_options() -> MakeOptionsData {
    let MakeOptions { detail, corners, axes, labels, no_repair } = MakeOptions::default();
    MakeOptionsData {
        detail,
        has_corners: corners.is_some(),
        corners: corners.unwrap_or_default() as u64,
        best_axes: axes == Axes::Best,
        has_labels: labels.is_some(),
        labels: labels.unwrap_or_default(),
        no_repair,
    }
}
