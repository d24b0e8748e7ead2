//! Algorithm 1 until a fresh start finds nothing more.

use super::Round;
use super::{Settings, run};
use crate::align::order::place_in_order;
use crate::align::unit::Unit;
use crate::align::{Alignment, Options, SolverKind, to_integers};
use crate::context::Context;
use crate::error::Result;
use crate::layout::{Counts, count};
use crate::structure::{Arrangement, Structure};

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
    let mut from = input.to_vec();
    loop {
        let (found, steps) = improve(structure, &from, input, &settings, context)?;
        let counts = count(&found);
        let improved = counts.blocks_padded < after.blocks_padded;
        if rounds.is_empty() || improved {
            rounds.extend(steps);
        }
        if !improved {
            break;
        }
        best = place_in_order(structure, found.placement(), targets, &*solver, context)?;
        from.clone_from(&best);
        after = counts;
    }
    let levels = to_integers(&best);
    Ok(Alignment { levels, before, after: Some(after), rounds, broken: Vec::new(), front: Vec::new(), bound: None })
}

/// One run of Algorithm 1 on `from`, settled near `input` or, if only that is as coarse, near `from`.
fn improve<'a>(
    structure: &'a Structure,
    from: &[f64],
    input: &[f64],
    settings: &Settings,
    context: &Context,
) -> Result<(Arrangement<'a>, Vec<Round>)> {
    let own = Unit::of(structure, from).apply(structure, from);
    let outcome = run(structure, &own, settings, context)?;
    let near = outcome.settle(&own, settings.solver, context)?;
    if from == input {
        return Ok((near, outcome.rounds));
    }
    let original = Unit::of(structure, input).apply(structure, input);
    let faithful = outcome.settle(&original, settings.solver, context)?;
    let coarser = count(&faithful).blocks_padded <= count(&near).blocks_padded;
    Ok((if coarser { faithful } else { near }, outcome.rounds))
}
