//! `simplify` and what it gives.

use crate::buffers::flat;
use crate::failure::{Result, guard};
use crate::ffi::*;
use crate::input::Owned;
use crate::options::options;
use crate::run::run;
use polycube::layout::{Counts, Pieces};
use polycube::simplify::{self as core, SimplifyReport};
use polycube::structure::placement_of;
use polycube::{Context, Error, ErrorKind};

/// A simplified polycube, to be asked for other points of its front.
pub struct Simplified(pub core::Simplified);

/// See `polycube::simplify::simplify`.
pub fn simplify(input: &InputView, data: &OptionsData, observer: &Observer) -> Result<Box<Simplified>> {
    let (owned, options) = guard(|| {
        let owned = Owned::new(input)?;
        let options = options(data)?;
        Ok((owned, options))
    })?;
    let result = run(observer, |context| core::simplify(&owned.input(), &options, context))?;
    Ok(Box::new(Simplified(result)))
}

impl Simplified {
    /// Everything there is to know.
    pub fn data(&self) -> Result<SimplifiedData> {
        guard(|| {
            let core::Simplified { input, polycube, levels, report, .. } = &self.0;
            let placement = placement_of(levels);
            let pieces = polycube.as_ref().map(|mesh| Pieces::of_faces(input, mesh.points(), &placement));
            let Pieces { patch_of_face, block_of_face } = pieces.unwrap_or_default();
            Ok(SimplifiedData {
                report: report.into(),
                report_json: json(report)?,
                polycube: polycube.as_ref().map_or_else(MeshData::empty, MeshData::from),
                levels: levels.clone(),
                labels: input.labels().map(|l| l.index() as i8).collect(),
                facet_of_face: input.facet_of_face.clone(),
                patch_of_face,
                block_of_face,
            })
        })
    }

    /// See `Simplified::at` of the core.
    pub fn at(&self, input: &InputView, simplicity: f64, observer: &Observer) -> Result<Box<Self>> {
        let owned = guard(|| Owned::new(input))?;
        let result = run(observer, |context| self.0.at(&owned.input(), simplicity, context))?;
        Ok(Box::new(Self(result)))
    }

    /// See `Simplified::rescaled` of the core.
    pub fn rescaled(&self, input: &InputView, scale: f64, observer: &Observer) -> Result<Box<Self>> {
        let owned = guard(|| Owned::new(input))?;
        let result = run(observer, |context| self.0.rescaled(&owned.input(), scale, context))?;
        Ok(Box::new(Self(result)))
    }
}

/// A report as the command writes it.
///
/// # Errors
/// [`ErrorKind::Internal`] if it cannot be written.
pub fn json(report: &impl serde::Serialize) -> polycube::Result<String> {
    let text = serde_json::to_string_pretty(report);
    text.map_err(|e| Error::new(ErrorKind::Internal, format!("no JSON for this: {e}")))
}

impl From<&Counts> for CountsData {
    fn from(counts: &Counts) -> Self {
        Self {
            surface_patches: counts.surface_patches as u64,
            blocks: counts.blocks as u64,
            blocks_padded: counts.blocks_padded as u64,
        }
    }
}

impl From<&polycube::measure::Distortion> for DistortionData {
    fn from(d: &polycube::measure::Distortion) -> Self {
        let polycube::measure::Distortion { angle, size, worst_angle, worst_size, worst_cell, .. } = *d;
        Self { angle, size, worst_angle, worst_size, worst_cell }
    }
}

impl From<&SimplifyReport> for ReportData {
    fn from(report: &SimplifyReport) -> Self {
        let round = |r: &polycube::align::Round| RoundData {
            lambda: r.lambda,
            pairs: r.pairs as u64,
            alignments: r.alignments as u64,
            counts: (&r.counts).into(),
        };
        let front = report.front.iter().map(|t| TradeOffData { count: t.count as u64, displacement: t.displacement });
        let core::Seconds { structure, align, morph, total, .. } = report.seconds;
        Self {
            scale: report.scale,
            valid: report.valid,
            before: (&report.before).into(),
            after: report.after.as_ref().map(CountsData::from).unwrap_or_default(),
            rounds: report.rounds.iter().map(round).collect(),
            front: front.collect(),
            has_chosen: report.chosen.is_some(),
            chosen: report.chosen.unwrap_or_default() as u64,
            has_bound: report.bound.is_some(),
            bound: report.bound.map_or(0, |b| b.count as u64),
            proven: report.bound.is_some_and(|b| b.proven),
            seconds: SecondsData { structure, align, morph, total },
            max_displacement: report.max_displacement,
            flipped_cells: report.flipped.cells.clone(),
            flipped_faces: report.flipped.faces.clone(),
            deviation_degrees: report.deviation.degrees,
            deviation_distance: report.deviation.distance,
            distortion: report.distortion.iter().flatten().map(DistortionData::from).collect(),
            notes: report.notes.iter().map(ToString::to_string).collect(),
        }
    }
}

/// The pairs that Algorithm 1 makes of corners at these lattice points (x, y, z each): for tests against other
/// triangulations.
pub fn corner_pairs(points: &[i64]) -> Result<Vec<u32>> {
    guard(|| {
        let pairs = polycube::parts::neighbours(points.as_chunks::<3>().0, &Context::default())?;
        Ok(pairs.into_iter().flatten().collect())
    })
}

/// Simplifies, but panics in the middle of the core as soon as it reports the stage `stage`: for tests of what hosts
/// get to see.
pub fn panic_in_core(input: &InputView, stage: &str, observer: &Observer) -> Result<()> {
    let owned = guard(|| Owned::new(input))?;
    let stage = stage.to_owned();
    run(observer, move |_| {
        let context = Context::new(move |now, _| assert!(now != stage, "injected into {now}"));
        core::simplify(&owned.input(), &core::SimplifyOptions::default(), &context).map(|_| ())
    })
}

impl From<&polycube::remesh::SingularEdge> for SingularData {
    fn from(edge: &polycube::remesh::SingularEdge) -> Self {
        Self { points: flat(&edge.points), valence: edge.valence }
    }
}
