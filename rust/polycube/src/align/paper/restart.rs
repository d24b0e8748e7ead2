//! Algorithm 1 until a fresh start finds nothing more.

use super::{PaperSettings, Round, Step, run};
use crate::align::guides::Guided;
use crate::align::judge::Judge;
use crate::align::judge::is_valid;
use crate::align::place::place_in_order;
use crate::align::ranks::Ranks;
use crate::align::unit::Unit;
use crate::align::{Alignment, SolverKind, Task};
use crate::context::Context;
use crate::error::Result;
use crate::layout::Counts;
use crate::structure::{Arrangement, Placement, Structure, placement_of};
use rayon::prelude::*;

/// Algorithm 1 from λ = 1 again and again until it finds nothing more, so that a second call changes nothing.
///
/// # Errors
/// [`ErrorKind::Infeasible`](crate::ErrorKind::Infeasible) if what the guides ask for has more blocks than the input.
pub(crate) fn simplify(task: &Task, context: &Context) -> Result<Alignment> {
    // On a worker of the pool, so that what is done side by side in each round starts without waking it.
    let descent = rayon::scope(|_| descend(task, &task.targets, &task.guided, context));
    let Descent { levels, after, rounds } = descent?;
    task.check_blocks(&after)?;
    Ok(Alignment {
        levels,
        before: task.before,
        after: Some(after),
        rounds,
        broken: Vec::new(),
        front: Vec::new(),
        chosen: None,
        bound: None,
    })
}

/// Where repeated runs of Algorithm 1 end.
pub(crate) struct Descent {
    /// The lattice coordinate of every level.
    pub levels: Vec<i64>,
    /// The counts there.
    pub after: Counts,
    /// The rounds of the runs that found something.
    pub rounds: Vec<Round>,
}

/// Runs of Algorithm 1, each from where the last ended, placed near `targets` as `placing` has it.
pub(crate) fn descend(task: &Task, targets: &[f64], placing: &Guided, context: &Context) -> Result<Descent> {
    let structure = task.structure;
    let solver = task.options.solver.solver();
    let oblique_planes = task.options.solver == SolverKind::Linear;
    let settings =
        PaperSettings { lambda_min: task.options.lambda_min, solver: &*solver, guided: &task.guided, oblique_planes };
    let place = |order: &[f64]| place_in_order(structure, &Ranks::new(structure, order), targets, placing);
    let mut best = place(&task.start)?;
    let unchanged = task.start == task.input;
    let mut after = if unchanged { task.before } else { Judge::new(structure).counts_of(&task.start) };
    let mut taken = Vec::new();
    let mut from = task.start.clone();
    loop {
        let (found, steps) = improve(task, &from, &settings, context)?;
        let improved = found.filter(|(_, counts)| counts.blocks_padded < after.blocks_padded);
        if taken.is_empty() || improved.is_some() {
            taken.extend(steps);
        }
        let Some((found, counts)) = improved else { break };
        best = place(&found)?;
        from = placement_of(&best);
        after = counts;
    }
    Ok(Descent { levels: best, after, rounds: counted(structure, &taken) })
}

/// A valid placement with what it counts.
type Counted = (Placement, Counts);

/// One run of Algorithm 1 on `from`, settled near the start or, if only that is as coarse, near `from`; nothing if the
/// guides do not allow where it ends.
fn improve(
    task: &Task,
    from: &[f64],
    settings: &PaperSettings,
    context: &Context,
) -> Result<(Option<Counted>, Vec<Step>)> {
    let structure = task.structure;
    let own = Unit::of(structure, from).apply(structure, from);
    let outcome = run(structure, &own, settings, context)?;
    let settle = |targets: &[f64]| -> Result<Option<Counted>> {
        let found = guided(task, outcome.settle(targets, settings.solver, context)?);
        let counts = found.as_ref().map(|placement| Judge::new(structure).counts_of(placement));
        Ok(found.zip(counts))
    };
    if from == task.start {
        return Ok((settle(&own)?, outcome.steps));
    }
    let original = Unit::of(structure, &task.start).apply(structure, &task.start);
    let (near, faithful) = rayon::join(|| settle(&own), || settle(&original));
    let (near, faithful) = (near?, faithful?);
    let blocks = |found: &Option<Counted>| found.as_ref().map_or(usize::MAX, |(_, counts)| counts.blocks_padded);
    let coarser = blocks(&faithful) <= blocks(&near);
    Ok((if coarser { faithful } else { near }, outcome.steps))
}

/// The placement if the guides allow it; else the one with everything half way to its mirror image, if that is valid.
fn guided(task: &Task, found: Placement) -> Option<Placement> {
    let structure = task.structure;
    let allowed = |placement: &[f64]| task.guided.allows(&Ranks::new(structure, placement));
    if allowed(&found) {
        return Some(found);
    }
    let averaged: Placement = task.guided.averaged(structure, &found);
    (allowed(&averaged) && is_valid(&Arrangement::new(structure, &averaged))).then_some(averaged)
}

/// The steps with what their results count. Steps in a row with one result are counted together.
fn counted(structure: &Structure, steps: &[Step]) -> Vec<Round> {
    let rounds = |judge: &mut Judge, steps: &[Step]| {
        let placement = placement_of(&steps[0].levels);
        let counts = judge.counts_of(&placement);
        steps.iter().map(|step| step.counted(counts)).collect::<Vec<Round>>()
    };
    let results: Vec<&[Step]> = steps.chunk_by(|a, b| a.levels == b.levels).collect();
    results.into_par_iter().map_init(|| Judge::new(structure), rounds).flatten().collect()
}
