//! What was done, for people and programs.

use super::{Cause, Input, Note, SimplifyOptions};
use crate::align::{Alignment, LowerBound, Round, Strategy, TradeOff, keeps};
use crate::context::Context;
use crate::error::Result;
use crate::layout::Counts;
use crate::measure::{Distortion, Flipped, distortion, flipped};
use crate::mesh::Mesh;
use crate::repair::Repair;
use crate::structure::{Deviation, Polycube};

/// What was done, for people and programs.
#[derive(Clone, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct SimplifyReport {
    /// How the levels found their places.
    pub strategy: Strategy,
    /// Lattice steps per unit of the input.
    pub scale: f64,
    /// Whether the result is a valid polycube. Only `naive` can give one that is not.
    pub valid: bool,
    /// Counts of the input.
    pub before: Counts,
    /// Counts of the result, if it is valid.
    pub after: Option<Counts>,
    /// The rounds of Algorithm 1.
    pub rounds: Vec<Round>,
    /// The trade-off between the count and displacement that the strategy `best` met, from the fewest blocks on.
    pub front: Vec<TradeOff>,
    /// Which point of the front the result is, from 0; nothing if it is none.
    pub chosen: Option<usize>,
    /// How far the count can go down at most, as far as the strategy `best` could prove it.
    pub bound: Option<LowerBound>,
    /// Time spent, in seconds.
    pub seconds: Seconds,
    /// The farthest that a corner moved, in units of the input polycube.
    pub max_displacement: f64,
    /// Elements of the morphed mesh that are turned over or flat: cells of a volume and boundary faces.
    pub flipped_elements: usize,
    /// Which they are.
    pub flipped: Flipped,
    /// How far the input was from an exact polycube.
    pub deviation: Deviation,
    /// Distortion of the map from the shape to the polycube, before and after. Without a shape the polycube as it came
    /// stands for it.
    pub distortion: Option<[Distortion; 2]>,
    /// What was not possible or not as asked.
    pub notes: Vec<Note>,
}

impl SimplifyReport {
    /// What is known before the mesh is morphed.
    pub(super) fn new(polycube: &Polycube, alignment: &Alignment, strategy: Strategy, scale: f64) -> Self {
        let noted = |count: usize, note: fn(usize) -> Note| (count > 0).then(|| note(count));
        let disorder = noted(polycube.deviation.out_of_order, Note::OutOfOrder);
        let broken = noted(alignment.broken.len(), Note::Broken);
        Self {
            strategy,
            scale,
            valid: alignment.after.is_some(),
            before: alignment.before,
            after: alignment.after,
            rounds: alignment.rounds.clone(),
            front: alignment.front.clone(),
            chosen: alignment.chosen,
            bound: alignment.bound,
            seconds: Seconds::default(),
            max_displacement: max_displacement(polycube, &alignment.levels, scale),
            flipped_elements: 0,
            flipped: Flipped::default(),
            deviation: polycube.deviation,
            distortion: None,
            notes: disorder.into_iter().chain(broken).collect(),
        }
    }

    /// Says what was repaired before all else.
    pub(crate) fn note_repairs(&mut self, repairs: &[Repair]) {
        self.notes.splice(0..0, repairs.iter().map(|repair| Note::Repaired(*repair)));
    }

    /// Says so if corners move farther than the options allow, because of `cause`.
    pub(super) fn note_displacement(&mut self, options: &SimplifyOptions, cause: Cause) {
        let moved = self.max_displacement;
        if let Some(limit) = options.max_displacement.filter(|&limit| !keeps(moved, limit, self.scale)) {
            self.notes.push(Note::Displacement { moved, limit, cause });
        }
    }

    /// Says so if the map of a valid result is distorted more than the options allow, because of `cause`.
    pub(super) fn note_distortion(&mut self, options: &SimplifyOptions, cause: Cause) {
        let angle = self.distortion.map_or(f64::INFINITY, |[_, after]| after.angle);
        if let Some(limit) = options.max_distortion.filter(|&l| self.valid && l < angle) {
            self.notes.push(Note::Distortion { angle, limit, cause });
        }
    }

    /// Why corners move farther than they may, if that was said.
    pub(super) fn cause_of_displacement(&self) -> Option<Cause> {
        self.notes.iter().find_map(|n| if let Note::Displacement { cause, .. } = n { Some(*cause) } else { None })
    }

    /// Why the map is distorted more than it may be, if that was said.
    pub(super) fn cause_of_distortion(&self) -> Option<Cause> {
        self.notes.iter().find_map(|n| if let Note::Distortion { cause, .. } = n { Some(*cause) } else { None })
    }

    /// Counts what the morph turned over and measures the map before and after.
    pub(super) fn judge(&mut self, input: &Input, polycube: &Polycube, mesh: &Mesh, context: &Context) -> Result<()> {
        let from = input.shape.unwrap_or(input.polycube);
        let before = distortion(from, input.polycube);
        context.tick(0.3)?;
        self.measured(before.and_then(|before| Ok([before, distortion(from, mesh)?])));
        context.tick(0.6)?;
        self.list_flipped(input, polycube, mesh)?;
        context.tick(1.0)
    }

    /// Lists the flipped elements and measures the distortion anew, after `mesh` was changed.
    pub(crate) fn rejudge(&mut self, input: &Input, polycube: &Polycube, mesh: &Mesh) -> Result<()> {
        self.notes.retain(|note| !matches!(note, Note::Flipped { .. } | Note::Tangled { .. }));
        if let Some([before, _]) = self.distortion {
            let after = distortion(input.shape.unwrap_or(input.polycube), mesh);
            self.measured(after.map(|after| [before, after]));
        }
        self.list_flipped(input, polycube, mesh)
    }

    /// Takes the distortion in. A result is worth having without it.
    fn measured(&mut self, distortion: Result<[Distortion; 2]>) {
        match distortion {
            Ok(both) => self.distortion = Some(both),
            Err(error) => {
                self.distortion = None;
                self.notes.push(Note::Unmeasured(error.message));
            }
        }
    }

    fn list_flipped(&mut self, input: &Input, polycube: &Polycube, mesh: &Mesh) -> Result<()> {
        let labels: Vec<i8> = polycube.labels().map(|l| l.index() as i8).collect();
        self.flipped = flipped(mesh, &labels)?;
        self.flipped_elements = self.flipped.cells.len() + self.flipped.faces.len();
        let came = flipped(input.polycube, &[])?.cells.len();
        if came > 0 {
            self.notes.push(Note::Tangled { came, left: self.flipped.cells.len() });
        }
        if self.flipped_elements > 0 {
            let has_front = self.strategy == Strategy::Best;
            self.notes.push(Note::Flipped { count: self.flipped_elements, has_front });
        }
        Ok(())
    }
}

/// Time spent in each stage, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct Seconds {
    /// Reading the files.
    pub read: f64,
    /// Finding and checking the structure.
    pub structure: f64,
    /// Pairing, aligning, counting.
    pub align: f64,
    /// Morphing the mesh and judging it; for a remeshing, making its map one to one, too.
    pub morph: f64,
    /// Making the meshes of a remeshing.
    #[serde(skip_serializing_if = "is_zero")]
    pub mesh: f64,
    /// Optimising its hexahedra.
    #[serde(skip_serializing_if = "is_zero")]
    pub optimise: f64,
    /// Measuring them.
    #[serde(skip_serializing_if = "is_zero")]
    pub measure: f64,
    /// Writing the files.
    pub write: f64,
    /// All of it.
    pub total: f64,
}

/// Whether no time was spent.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(seconds: &f64) -> bool {
    *seconds == 0.0
}

/// The farthest that a corner moves to `levels`, in units of the input.
pub(super) fn max_displacement(polycube: &Polycube, levels: &[i64], scale: f64) -> f64 {
    let after: Vec<f64> = levels.iter().map(|&x| x as f64 / scale).collect();
    polycube.structure.max_displacement(&polycube.placement, &after)
}
