//! Which of the simplified polycubes is meshed: the coarsest one that a quick coarse mesh finds good.

use super::pipeline::RemeshOptions;
use super::start::Start;
use crate::context::Context;
use crate::error::Result;
use crate::simplify::{Input, Simplified};

/// A mesh whose worst scaled Jacobian is this is good: the least that Verdict's manual calls acceptable for hexahedra.
const GOOD: f64 = 0.5;
/// A mesh with more blocks must be better by this, worst and average in sum, to be taken instead of another poor one.
const WORTH: f64 = 0.05;
/// Corners move at most this part as far in the next point of the front that is tried.
const CLOSER: f64 = 0.71;
/// A fine mesh whose worst scaled Jacobian is less than this part of what its coarse one promised went wrong.
const KEPT: f64 = 0.8;
/// So many tries in a row that are no better end the trying.
const MISSES: usize = 2;
/// Points of the front of which coarse meshes are made.
const TRIES: usize = 6;
/// Points of the front that are meshed finely as long as the best of them is not inverted.
const MESHED: usize = 4;

/// What is wrong with the best mesh so far.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Wrong {
    /// It has inverted hexahedra.
    Inverted,
    /// It is farther from the shape than asked for.
    Far,
}

/// Candidates to be meshed, the one that promises most first.
pub(super) struct Choice<'a> {
    input: &'a Input<'a>,
    options: &'a RemeshOptions,
    /// What was found at first; the others are points of its front.
    first: Simplified,
    /// Those with a coarse mesh, from the fewest blocks on.
    tried: Vec<Start>,
    /// Points of the front that were not tried, from the fewest blocks on.
    left: Vec<usize>,
    /// How many were handed out.
    taken: usize,
}

impl<'a> Choice<'a> {
    /// Makes coarse meshes of the polycube `found` and, if that is poor, of others from the same front with more blocks, until one is
    /// good or none gets better. The choice is left to the options where they say which point of the front, how far corners may
    /// move, or what must hold.
    ///
    /// # Errors
    /// Those of [`Start::new`] and [`Simplified::at`].
    pub(super) fn new(
        input: &'a Input<'a>,
        found: Simplified,
        options: &'a RemeshOptions,
        context: &Context,
    ) -> Result<Self> {
        let left = others(&found, options);
        let share = 1.0 / (left.len() + 1) as f64;
        let start = Start::new(input, found.clone(), options, &context.stage("map", 0.0, share))?;
        let mut choice = Self { input, options, first: found, tried: vec![start], left, taken: 0 };
        while choice.is_worth_trying() {
            let k = choice.tried.len() as f64;
            let next = choice.start(&context.stage("map", k * share, (k + 1.0) * share))?;
            choice.tried.extend(next);
        }
        Ok(choice)
    }

    /// Whether there is a coarse mesh and it is poor, and it or one shortly before was better than all others.
    fn is_worth_trying(&self) -> bool {
        let Some(worst) = self.tried.last().and_then(Start::worst) else { return false };
        let (before, lately) = self.tried.split_at(self.tried.len().saturating_sub(MISSES));
        let best = |starts: &[Start]| starts.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
        !self.left.is_empty() && worst < GOOD && (worst <= 0.0 || best(lately) > best(before) + WORTH)
    }

    /// The next point of the front; from the third mesh on the middle one of those left, as such a shape has a long way to go.
    fn nearer(&mut self, context: &Context) -> Result<Option<Start>> {
        if self.taken > 2 {
            self.left.drain(..self.left.len().saturating_sub(1) / 2);
        }
        self.start(context)
    }

    /// The next point of the front that was not tried.
    fn start(&mut self, context: &Context) -> Result<Option<Start>> {
        if self.left.is_empty() {
            return Ok(None);
        }
        let found = self.first.at_index(self.input, self.left.remove(0), context)?;
        Start::new(self.input, found, self.options, context).map(Some)
    }

    /// The next candidate: the one with the fewest blocks whose coarse mesh is good or nearly as good as the best; then, if the best mesh
    /// made so far has inverted hexahedra or is too far from the shape, those that were not tried.
    ///
    /// # Errors
    /// Those of [`Start::new`] and [`Simplified::at`].
    pub(super) fn next(&mut self, wrong: Option<Wrong>, context: &Context) -> Result<Option<Start>> {
        if wrong != Some(Wrong::Inverted) && self.taken >= MESHED {
            return Ok(None);
        }
        self.taken += 1;
        let best = self.tried.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
        let good = |s: &Start| s.worst().is_some_and(|worst| worst >= GOOD) || value(s) >= best - WORTH;
        match self.tried.iter().position(good) {
            // Those with fewer blocks move corners farther: what is wrong with this one is wrong with them.
            Some(k) => Ok(self.tried.drain(..=k).next_back()),
            None if wrong == Some(Wrong::Far) => self.nearer(context),
            None if wrong == Some(Wrong::Inverted) => self.start(context),
            None => Ok(None),
        }
    }

    /// Says so if a `result` is not what was found at first.
    pub(super) fn explain(&self, result: &mut Simplified) {
        let (report, first) = (&mut result.report, &self.first.report);
        let after = report.after.filter(|_| report.chosen != first.chosen);
        if let (Some(ours), Some(least)) = (after, first.after) {
            let note = format!(
                "{} blocks instead of {}: fewer made bad hexahedra; a limit on the displacement or a simplicity chooses otherwise",
                ours.blocks_padded, least.blocks_padded
            );
            report.notes.push(note);
        }
    }
}

/// What the coarse mesh of a start promises: worst and average scaled Jacobian in sum, the worst as far as it is not good; nothing without one.
fn value(start: &Start) -> f64 {
    start.rung.as_ref().map_or(0.0, |r| r.worst.min(GOOD) + r.average)
}

/// Whether a mesh whose worst scaled Jacobian is `worst` is as good as the `coarse` one it came from promised.
pub(super) fn keeps_promise(worst: f64, coarse: Option<f64>) -> bool {
    worst > 0.0 && worst >= GOOD.min(KEPT * coarse.unwrap_or(0.0))
}

/// The points of the front to try after the one chosen: each the coarsest that moves corners clearly less far than the one before,
/// the last the one that moves them least.
fn others(found: &Simplified, options: &RemeshOptions) -> Vec<usize> {
    let wanted = &options.simplify;
    let told = wanted.simplicity.is_some() || wanted.max_displacement.is_some() || wanted.max_distortion.is_some();
    let Some(chosen) = found.report.chosen.filter(|_| !told && !options.surface_only) else { return Vec::new() };
    let front = &found.report.front;
    let mut points = vec![chosen];
    while let Some(&now) = points.last()
        && let Some(next) = (now + 1..front.len()).find(|&i| front[i].displacement <= CLOSER * front[now].displacement)
        && points.len() < TRIES
    {
        points.push(next);
    }
    points.push(front.len() - 1);
    points.dedup();
    points.split_off(1)
}
