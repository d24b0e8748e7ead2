//! Which of the simplified polycubes is meshed: the coarsest one that a quick coarse mesh finds good, or one with more
//! blocks if the fine mesh of that is not.

use super::bisection::Bisection;
use super::candidate::Candidate;
use super::tried::{Failure, Tried, TriedPoint};
use crate::context::Context;
use crate::error::Result;
use crate::layout::Counts;
use crate::measure::GOOD;
use crate::remesh::options::RemeshOptions;
use crate::simplify::{Input, Note, Simplified};

/// A mesh with more blocks must be better by this, worst and average in sum, to be taken instead of another poor one.
pub(crate) const WORTH: f64 = 0.05;
/// Corners move at most this part as far in the next point of the front that is tried.
const CLOSER: f64 = 0.71;
/// So many tries in a row that are no better end the trying.
const MISSES: usize = 2;
/// Points of the front of which coarse meshes are made, the last of the front not counted.
const TRIES: usize = 6;
/// Points of the front that are meshed finely as long as the best of them is not inverted.
const MESHED: usize = 5;

/// Where meshes are farther from the shape than this many times what was asked for,
const HOPELESS: f64 = 2.0;
/// more blocks must bring them nearer by this factor, or still more are no help.
const NEARER: f64 = 0.8;

/// How a mesh turned out.
pub(crate) struct Verdict {
    /// The point of the front.
    pub(crate) at: usize,
    /// What is wrong with it.
    pub(crate) failed: Option<Failure>,
    /// How far it is from the shape, in multiples of what was asked for; 0 if it is near enough.
    pub(crate) far: f64,
    /// Whether even the best mesh so far has inverted hexahedra.
    pub(crate) inverted: bool,
}

/// Candidates to be meshed, the one that promises most first.
pub(crate) struct Candidates<'a> {
    input: &'a Input<'a>,
    options: &'a RemeshOptions,
    /// What was found at first; the others are points of its front.
    first: Simplified,
    /// Those with a coarse mesh, from the fewest blocks on.
    coarse: Vec<Candidate>,
    /// Points of the front that were not tried, from the fewest blocks on.
    left: Vec<usize>,
    /// How many were handed out.
    taken: usize,
    /// Where the one with the fewest blocks whose fine mesh is right may lie.
    bisection: Bisection,
    /// How far the last mesh was from the shape, in multiples of what was asked for.
    far: Option<f64>,
    /// What is known of all of them.
    tried: Tried,
}

impl<'a> Candidates<'a> {
    /// Untangles the surface of the polycube `found` and, if that is wanted, makes coarse meshes of its inside. If it
    /// stays folded or they are poor, others from the same front with more blocks are tried, until one is good or none
    /// gets better. The choice is left to the options where they say which point of the front, how far corners may
    /// move, or what must hold.
    ///
    /// # Errors
    /// Those of [`Candidate::new`] and [`Simplified::at`].
    pub(crate) fn new(
        input: &'a Input<'a>,
        found: Simplified,
        options: &'a RemeshOptions,
        context: &Context,
    ) -> Result<Self> {
        let left = others(&found, options);
        let share = 1.0 / (left.len() + 1) as f64;
        let chosen = found.report.chosen.unwrap_or(0);
        let bisection = Bisection::new(chosen, if left.is_empty() { chosen } else { found.report.front.len() });
        let candidate =
            Candidate::new(input, found.clone(), options, !left.is_empty(), &context.stage("map", 0.0, share))?;
        let mut tried = Tried::default();
        tried.coarse(&candidate, options.surface_only);
        let mut candidates =
            Self { input, options, first: found, coarse: vec![candidate], left, taken: 0, bisection, far: None, tried };
        while candidates.is_worth_trying() {
            let k = candidates.coarse.len() as f64;
            let index = candidates.left.remove(0);
            let next = candidates.candidate(
                index,
                !candidates.left.is_empty(),
                &context.stage("map", k * share, (k + 1.0) * share),
            )?;
            candidates.coarse.push(next);
        }
        Ok(candidates)
    }

    /// Whether there is a coarse mesh and it is poor, and it or one shortly before was better than all others.
    fn is_worth_trying(&self) -> bool {
        let Some(worst) = self.coarse.last().and_then(Candidate::worst) else { return false };
        let (before, lately) = self.coarse.split_at(self.coarse.len().saturating_sub(MISSES));
        let best = |candidates: &[Candidate]| candidates.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
        !self.left.is_empty() && worst < GOOD && (worst <= 0.0 || best(lately) > best(before) + WORTH)
    }

    /// What a mesh of the given point of the front is made from, if it is one of `several` with no coarse mesh where
    /// that is in vain.
    fn candidate(&mut self, index: usize, several: bool, context: &Context) -> Result<Candidate> {
        let found = self.first.at_index(self.input, index, context)?;
        let candidate = Candidate::new(self.input, found, self.options, several, context)?;
        self.tried.coarse(&candidate, self.options.surface_only);
        Ok(candidate)
    }

    /// The first candidate: the one with the fewest blocks whose coarse mesh is good or nearly as good as the best.
    fn most_promising(&mut self) -> Option<Candidate> {
        let best = self.coarse.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
        let good = |s: &Candidate| s.worst().is_some_and(|worst| worst >= GOOD) || value(s) >= best - WORTH;
        // Those with fewer blocks move corners farther: what is wrong with this one is wrong with them.
        let k = self.coarse.iter().position(good)?;
        let mut passed = self.coarse.drain(..=k);
        let candidate = passed.next_back();
        let before = passed.filter_map(|s| s.simplified.report.chosen).next_back();
        before.into_iter().for_each(|at| self.bisection.wrong(at));
        candidate
    }

    /// The first candidate. Where the coarse meshes of all others were bad and that of the input would be too coarse to
    /// tell, it is not the input but one in the middle between them.
    fn opening(&mut self, context: &Context) -> Result<Option<Candidate>> {
        let others = self.coarse.len() > 1;
        let end = self.first.report.front.len().checked_sub(1);
        let is_input = |s: &Candidate| s.simplified.report.chosen == end;
        match self.most_promising() {
            Some(candidate) if others && candidate.worst().is_none() && is_input(&candidate) => self.middle(context),
            candidate => Ok(candidate),
        }
    }

    /// The one in the middle of those that come into question.
    fn middle(&mut self, context: &Context) -> Result<Option<Candidate>> {
        let middle = self.bisection.middle(&self.first.report.front);
        middle.map(|k| self.candidate(k, false, context)).transpose()
    }

    /// The next candidate, when the mesh of the point `at` of the front turned out as it did: if hexahedra were poor
    /// the next whose coarse mesh is good, else the one in the middle of those that come into question.
    ///
    /// # Errors
    /// Those of [`Candidate::new`] and [`Simplified::at`].
    pub(crate) fn next(&mut self, last: Option<Verdict>, context: &Context) -> Result<Option<Candidate>> {
        self.taken += 1;
        let Some(Verdict { at, failed, far, inverted }) = last else { return self.opening(context) };
        match failed {
            None => self.bisection.right(at),
            Some(_) => self.bisection.wrong(at),
        }
        let before = self.far.replace(far);
        let is_enough = self.taken > MESHED || !self.bisection.found() && is_hopeless(far, before);
        if is_enough && !inverted {
            return Ok(None);
        }
        if failed == Some(Failure::Poor)
            && let Some(candidate) = self.most_promising()
        {
            return Ok(Some(candidate));
        }
        self.middle(context)
    }

    /// Notes what a mesh as fine as asked for was like.
    pub(crate) fn note(&mut self, point: Option<TriedPoint>) {
        point.into_iter().for_each(|point| self.tried.fine(point));
    }

    /// All points of the front that were tried, from the fewest blocks on, that which was `taken` marked.
    pub(crate) fn tried(self, taken: &Simplified) -> Vec<TriedPoint> {
        self.tried.with_taken(taken.report.chosen)
    }

    /// Says so if a `result` is not what was found at first.
    pub(crate) fn explain(&self, result: &mut Simplified) {
        let (report, first) = (&mut result.report, &self.first.report);
        let after = report.after.filter(|_| report.chosen != first.chosen);
        if let (Some(ours), Some(least)) = (after, first.after) {
            let surface = self.options.surface_only;
            let counted = |c: &Counts| if surface { c.surface_patches } else { c.blocks_padded };
            let cells = self.options.cells();
            report.notes.push(Note::MoreBlocks { count: counted(&ours), least: counted(&least), cells });
        }
    }
}

/// Whether a mesh is far too `far` from the shape and hardly nearer than the one `before`, which had fewer blocks and
/// was too far itself; both in multiples of what was asked for.
fn is_hopeless(far: f64, before: Option<f64>) -> bool {
    far > HOPELESS && before.is_some_and(|before| before > 0.0 && far > NEARER * before)
}

/// What the coarse mesh of a candidate promises: worst and average scaled Jacobian in sum, the worst as far as it is
/// not good; nothing without one, and less than nothing if it has inverted hexahedra, which may be given up half made.
fn value(candidate: &Candidate) -> f64 {
    let average = candidate.coarse.as_ref().map_or(0.0, |c| c.quality.mean);
    match candidate.worst() {
        Some(worst) if worst > 0.0 => worst.min(GOOD) + average,
        worst => worst.unwrap_or(0.0),
    }
}

/// The points of the front to try after the one chosen: each the coarsest that moves corners clearly less far than the
/// one before, the last the one that moves them least.
fn others(found: &Simplified, options: &RemeshOptions) -> Vec<usize> {
    let wanted = &options.simplify;
    let told = wanted.simplicity.is_some() || wanted.max_displacement.is_some() || wanted.max_distortion.is_some();
    let Some(chosen) = found.report.chosen.filter(|_| !told) else { return Vec::new() };
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
