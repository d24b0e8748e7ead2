//! The points of the front that were meshed, and what came of each.

use super::candidate::Candidate;
use crate::align::TradeOff;
use crate::measure::GOOD;
use crate::mesh::CellKind;
use crate::simplify::{Alternative, Note, Simplified};
use std::collections::BTreeMap;

/// What is wrong with a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
#[serde(rename_all = "snake_case")]
pub enum Failure {
    /// The map of its surface is folded.
    Folded,
    /// It has inverted hexahedra.
    Inverted,
    /// It is farther from the shape than asked for.
    Far,
    /// Its worst hexahedron is poor.
    Poor,
}

/// A point of the front that was meshed, and what came of it.
#[derive(Clone, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct TriedPoint {
    /// Its number on the front, from 0 for the fewest blocks.
    pub point: usize,
    /// The simplicity that asks for it, 0 to 1.
    pub simplicity: f64,
    /// Blocks with padding, or patches of a surface alone.
    pub blocks: usize,
    /// Whether it was meshed as finely as asked for; otherwise a coarse mesh was enough to see that others are better.
    pub fine: bool,
    /// What is wrong with that mesh; nothing if nothing is.
    pub failed: Option<Failure>,
    /// The least scaled Jacobian of that mesh; nothing for a surface alone and where a folded map was not meshed.
    pub min_sj: Option<f64>,
    /// The mean of the same.
    pub avg_sj: Option<f64>,
    /// How far it is from the shape, in percent of the diagonal of its bounding box; nothing where that was not
    /// measured or is no more than asked for.
    pub hausdorff_percent: Option<f64>,
    /// Whether it is the one that was taken.
    pub taken: bool,
}

impl TriedPoint {
    /// A point of the front of which nothing is known yet; nothing if there is no front.
    pub(crate) fn new(simplified: &Simplified, surface_only: bool) -> Option<Self> {
        let report = &simplified.report;
        let (point, counts) = (report.chosen?, report.after?);
        Some(Self {
            point,
            simplicity: TradeOff::simplicity(point, report.front.len()),
            blocks: if surface_only { counts.surface_patches } else { counts.blocks_padded },
            fine: false,
            failed: None,
            min_sj: None,
            avg_sj: None,
            hausdorff_percent: None,
            taken: false,
        })
    }

    fn of_coarse(candidate: &Candidate, surface_only: bool) -> Option<Self> {
        let quality = candidate.coarse.as_ref().map(|coarse| &coarse.quality);
        let failed = match quality {
            None => (candidate.folded > 0).then_some(Failure::Folded),
            Some(quality) if quality.inverted > 0 => Some(Failure::Inverted),
            Some(quality) => (quality.worst < GOOD).then_some(Failure::Poor),
        };
        let [min_sj, avg_sj] = [quality.map(|q| q.worst), quality.map(|q| q.mean)];
        Some(Self { failed, min_sj, avg_sj, ..Self::new(&candidate.simplified, surface_only)? })
    }
}

/// All points that were tried, by their number on the front.
#[derive(Default)]
pub(crate) struct Tried(BTreeMap<usize, TriedPoint>);

impl Tried {
    /// Notes what the coarse mesh of a candidate, if there is one, was like.
    pub(super) fn coarse(&mut self, candidate: &Candidate, surface_only: bool) {
        let point = TriedPoint::of_coarse(candidate, surface_only).filter(|p| !self.0.contains_key(&p.point));
        self.0.extend(point.map(|p| (p.point, p)));
    }

    /// Notes what the mesh as fine as asked for was like.
    pub(super) fn fine(&mut self, point: TriedPoint) {
        self.0.insert(point.point, TriedPoint { fine: true, ..point });
    }

    /// All of them, from the fewest blocks on, and that which was taken marked.
    pub(super) fn with_taken(self, taken: Option<usize>) -> Vec<TriedPoint> {
        self.0.into_values().map(|point| TriedPoint { taken: Some(point.point) == taken, ..point }).collect()
    }
}

/// A note of the points that were tried just before and after the one that was taken; nothing if it is the only one.
pub(crate) fn alternatives(tried: &[TriedPoint], cells: CellKind) -> Option<Note> {
    let taken = tried.iter().position(|point| point.taken)?;
    let near = [taken.checked_sub(1), Some(taken + 1)];
    let both: Vec<Alternative> =
        near.into_iter().flatten().filter_map(|k| tried.get(k)).map(|point| alternative(point, cells)).collect();
    (!both.is_empty()).then_some(Note::Alternatives(both))
}

fn alternative(point: &TriedPoint, cells: CellKind) -> Alternative {
    let fault = point.failed.map(|failed| match (failed, point.hausdorff_percent, point.min_sj) {
        (Failure::Folded, ..) => "a folded map".to_owned(),
        (Failure::Inverted, ..) => "inverted hexahedra".to_owned(),
        (Failure::Far, Some(percent), _) => format!("{percent:.2} % of the diagonal from the shape"),
        (Failure::Poor, _, Some(worst)) => format!("a least scaled Jacobian of {worst:.2}"),
        (Failure::Far | Failure::Poor, ..) => "a poor mesh".to_owned(),
    });
    Alternative { count: point.blocks, simplicity: point.simplicity, cells, fault }
}
