//! Algorithm 1 until a fresh start finds nothing more.

use super::{Round, Settings, Step, run};
use crate::align::judge::Judge;
use crate::align::order::place_in_order;
use crate::align::unit::Unit;
use crate::align::{Alignment, Options, SolverKind, to_integers};
use crate::context::Context;
use crate::error::Result;
use crate::layout::Counts;
use crate::structure::{Placement, Structure};
use rayon::prelude::*;

/// Algorithm 1 from λ = 1 again and again until it finds nothing more, so that a second call changes nothing.
pub fn simplify(
    structure: &Structure,
    input: &[f64],
    targets: &[f64],
    before: Counts,
    options: &Options,
    context: &Context,
) -> Result<Alignment> {
    let solver = options.solver.solver();
    let oblique_planes = options.solver == SolverKind::Linear;
    let settings = Settings { lambda_min: options.lambda_min, solver: &*solver, oblique_planes };
    let mut best = place_in_order(structure, input, targets, &*solver, context)?;
    let mut after = before;
    let mut rounds = Vec::new();
    let mut judge = Judge::new(structure);
    let mut from = input.to_vec();
    loop {
        let (found, steps) = improve(structure, &from, input, &settings, context)?;
        let counts = judge.counts_of(&found);
        let improved = counts.blocks_padded < after.blocks_padded;
        if rounds.is_empty() || improved {
            rounds.extend(counted(structure, steps));
        }
        if !improved {
            break;
        }
        best = place_in_order(structure, &found, targets, &*solver, context)?;
        from.clone_from(&best);
        after = counts;
    }
    let levels = to_integers(&best);
    Ok(Alignment { levels, before, after: Some(after), rounds, broken: Vec::new(), front: Vec::new(), bound: None })
}

/// One run of Algorithm 1 on `from`, settled near `input` or, if only that is as coarse, near `from`.
fn improve(
    structure: &Structure,
    from: &[f64],
    input: &[f64],
    settings: &Settings,
    context: &Context,
) -> Result<(Placement, Vec<Step>)> {
    let own = Unit::of(structure, from).apply(structure, from);
    let outcome = run(structure, &own, settings, context)?;
    let near = outcome.settle(&own, settings.solver, context)?;
    if from == input {
        return Ok((near, outcome.steps));
    }
    let original = Unit::of(structure, input).apply(structure, input);
    let faithful = outcome.settle(&original, settings.solver, context)?;
    let mut judge = Judge::new(structure);
    let coarser = judge.counts_of(&faithful).blocks_padded <= judge.counts_of(&near).blocks_padded;
    Ok((if coarser { faithful } else { near }, outcome.steps))
}

/// The steps with what their results count.
fn counted(structure: &Structure, steps: Vec<Step>) -> Vec<Round> {
    let round = |judge: &mut Judge, step: Step| {
        let Step { lambda, pairs, alignments, levels } = step;
        let placement: Placement = levels.iter().map(|&x| x as f64).collect();
        Round { lambda, pairs, alignments, counts: judge.counts_of(&placement), levels }
    };
    steps.into_par_iter().with_min_len(4).map_init(|| Judge::new(structure), round).collect()
}
