//! Moving along the front between few blocks and little displacement, without searching again.

use super::report::max_displacement;
use super::{Cause, Input, Seconds, Simplified, SimplifyReport, finish};
use crate::align::{self, Alignment, Strategy, TradeOff};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::layout::{Counts, count};
use crate::range::Range;
use crate::repair::Repaired;
use crate::structure::{Arrangement, placement_of};
use std::time::Instant;

/// A point of the front on the lattice, before any mesh is moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Located {
    /// Its number on the front, from 0 for the fewest blocks.
    pub index: usize,
    /// The lattice coordinate of every level.
    pub levels: Vec<i64>,
    /// Its counts.
    pub counts: Counts,
    /// The farthest that a corner moves, in units of the input.
    pub max_displacement: f64,
}

impl Simplified {
    /// Another point of the same front, from 1, the fewest blocks, to 0, the least displacement: for a slider. Nothing
    /// is searched; it takes the time of placing the levels and of the morph. `input` must be what was simplified.
    ///
    /// It is what [`simplify`](super::simplify) would give with this simplicity and no limits on displacement and
    /// distortion; its notes name those that it does not keep.
    ///
    /// ```
    /// use polycube::generate::{Example, example};
    /// use polycube::mesh::CellKind;
    /// use polycube::simplify::simplify;
    /// use polycube::{Context, Input, SimplifyOptions};
    ///
    /// let (cube, shape) = example(Example::CubeSpikes, 1, CellKind::Quads)?;
    /// let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
    /// let coarse = simplify(&input, &SimplifyOptions::default(), &Context::default())?;
    /// let near = coarse.at(&input, 0.0, &Context::default())?;
    ///
    /// assert_eq!((coarse.report.chosen, near.report.chosen), (Some(0), Some(near.report.front.len() - 1)));
    /// assert!(near.report.after.unwrap().surface_patches > coarse.report.after.unwrap().surface_patches);
    /// # Ok::<(), polycube::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for a simplicity out of range, or if there is no front (only [`Strategy::Best`] finds
    /// one); [`ErrorKind::Mismatch`] if `input` has other cells; those of `align::place`; [`ErrorKind::Cancelled`].
    pub fn at(&self, input: &Input, simplicity: f64, context: &Context) -> Result<Self> {
        let start = Instant::now();
        let located = self.locate(simplicity, context)?;
        let repaired = self.options.repaired(input);
        let input = &repaired.as_ref().map_or(*input, Repaired::input);
        self.check_input(input)?;
        let mut moved = self.chosen(input, located, context)?;
        let total = start.elapsed().as_secs_f64();
        moved.report.seconds = Seconds { morph: total, total, ..Seconds::default() };
        Ok(moved)
    }

    /// Levels and counts of the point that [`at`](Self::at) would give, without moving the mesh: milliseconds.
    ///
    /// # Errors
    /// Those of [`at`](Self::at).
    pub fn locate(&self, simplicity: f64, context: &Context) -> Result<Located> {
        Range::Within(0.0, 1.0).check("simplicity", simplicity)?;
        if self.report.front.is_empty() {
            return Err(Error::new(ErrorKind::Option, "there is no front to move along")
                .remedy("simplify with the strategy `best` first"));
        }
        self.locate_index(TradeOff::index(simplicity, self.report.front.len()), context)
    }

    /// All points of the front as results of their own, from the fewest blocks on, each with its mesh and distortion.
    /// `input` must be what was simplified. Takes one morph for each.
    ///
    /// # Errors
    /// Those of [`at`](Self::at), except that an empty front gives no points.
    pub fn pareto(&self, input: &Input, context: &Context) -> Result<Vec<Self>> {
        let count = self.report.front.len();
        let repaired = self.options.repaired(input);
        let input = &repaired.as_ref().map_or(*input, Repaired::input);
        if count > 0 {
            self.check_input(input)?;
        }
        let point = |index: usize| {
            let own = context.stage("front", index as f64 / count as f64, (index + 1) as f64 / count as f64);
            self.chosen(input, self.locate_index(index, &own)?, &own)
        };
        (0..count).map(point).collect()
    }

    /// The first point from this one on whose map is distorted no more than the options allow; if there is none, the
    /// least distorted one, with a note.
    pub(super) fn within_distortion(self, input: &Input, context: &Context) -> Result<Self> {
        let Some(limit) = self.options.max_distortion else { return Ok(self) };
        let first = self.report.chosen.map_or(usize::MAX, |c| c + 1);
        let count = self.report.front.len();
        let mut best = self.clone();
        for index in first..count {
            if best.angle() <= limit {
                break;
            }
            context.tick(index as f64 / count as f64)?;
            let next = self.moved(input, self.locate_index(index, context)?, context)?;
            if next.angle() < best.angle() {
                best = next;
            }
        }
        let options = &best.options;
        best.report.note_distortion(options, Cause::Search);
        Ok(best)
    }

    /// The mean angle distortion of the map to the result.
    fn angle(&self) -> f64 {
        self.report.distortion.map_or(f64::INFINITY, |[_, after]| after.angle)
    }

    /// Point `index` of the front.
    pub(crate) fn at_index(&self, input: &Input, index: usize, context: &Context) -> Result<Self> {
        self.moved(input, self.locate_index(index, context)?, context)
    }

    fn locate_index(&self, index: usize, context: &Context) -> Result<Located> {
        let Self { input: polycube, report, .. } = self;
        let (structure, placement) = (&polycube.structure, &polycube.placement);
        let settings = self.options.alignment(report.scale);
        let levels = align::place(structure, placement, report.before, &report.front[index], &settings, context)?;
        let at = placement_of(&levels);
        let counts = count(&Arrangement::new(structure, &at));
        let max_displacement = max_displacement(polycube, &levels, report.scale);
        Ok(Located { index, levels, counts, max_displacement })
    }

    fn moved(&self, input: &Input, located: Located, context: &Context) -> Result<Self> {
        let Self { input: polycube, report: old, options, .. } = self;
        let alignment = Alignment {
            levels: located.levels,
            before: old.before,
            after: Some(located.counts),
            rounds: old.rounds.clone(),
            broken: Vec::new(),
            front: old.front.clone(),
            chosen: Some(located.index),
            bound: old.bound,
        };
        let mut report = SimplifyReport::new(polycube, &alignment, Strategy::Best, old.scale);
        report.notes.splice(0..0, old.notes.iter().filter(|n| n.is_of_input()).cloned());
        report.note_displacement(options, old.cause_of_displacement().unwrap_or(Cause::Choice));
        finish(input, polycube.clone(), alignment.levels, report, options, context)
    }

    /// The point of the front that was asked for, with notes on the limits that it does not keep.
    fn chosen(&self, input: &Input, located: Located, context: &Context) -> Result<Self> {
        let mut result = self.moved(input, located, context)?;
        result.report.note_distortion(&self.options, self.report.cause_of_distortion().unwrap_or(Cause::Choice));
        Ok(result)
    }
}
