//! The strategy `best`, from the input to the chosen trade-off.

use super::anneal::State;
use super::{Found, is_searchable, search};
use crate::align::judge::Judge;
use crate::align::order::place_in_order;
use crate::align::paper::{Outcome, simplify};
use crate::align::solve::Solver;
use crate::align::unit::Unit;
use crate::align::{Alignment, LowerBound, Options, TradeOff, to_integers};
use crate::context::Context;
use crate::error::Result;
use crate::layout::{Counts, Objective};
use crate::structure::{Placement, Structure};

/// Algorithm 1, then the search.
pub fn coarsest(
    structure: &Structure,
    input: &[f64],
    targets: &[f64],
    before: Counts,
    options: &Options,
    context: &Context,
) -> Result<Alignment> {
    let aligning = context.stage("align", 0.0, 0.2);
    if !is_searchable(structure) {
        return simplify(structure, input, targets, before, options, &aligning);
    }
    // On its own lattice Algorithm 1 gives the search the same start at every scale.
    let own = Unit::of(structure, input).apply(structure, input);
    let paper = simplify(structure, input, &own, before, options, &aligning)?;
    let start: Placement = paper.levels.iter().map(|&x| x as f64).collect();
    let searching = context.stage("search", 0.2, 1.0);
    let found = search(structure, input, &start, options.objective, &options.effort, &searching)?;
    let solver = options.solver.solver();
    let chosen = choose(structure, &found, targets, options, &*solver, context)?;
    let order = relaxed(structure, input, &chosen, options.objective, &*solver, context)?;
    let levels = place_in_order(structure, &order, targets, &*solver, context)?;
    let after = Judge::new(structure).counts_of(&levels);
    if after.blocks_padded > before.blocks_padded {
        // Fewer patches can mean more blocks; the promise is never more of them than there were.
        return simplify(structure, input, targets, before, options, context);
    }
    let front = found.front.states().map(|s| trade_off(structure, s)).collect();
    let bound = Some(LowerBound { count: found.proof.bound, proven: found.proof.proven, nodes: found.proof.nodes });
    Ok(Alignment { levels: to_integers(&levels), after: Some(after), front, bound, ..paper })
}

fn trade_off(structure: &Structure, state: &State) -> TradeOff {
    let corners = structure.corners.len() as f64;
    TradeOff {
        count: state.count,
        displacement: (state.shape_cost() / corners).sqrt(),
        order: state.ranks.of_level.clone(),
    }
}

/// The order on the front that the options ask for: the coarsest within the displacement allowed, or, where none is, the
/// one with the least displacement.
fn choose(
    structure: &Structure,
    found: &Found,
    targets: &[f64],
    options: &Options,
    solver: &dyn Solver,
    context: &Context,
) -> Result<Placement> {
    let states: Vec<&State> = found.front.states().collect();
    let skipped = ((1.0 - options.simplicity.clamp(0.0, 1.0)) * (states.len() as f64 - 1.0)).round() as usize;
    for state in &states[skipped..] {
        let placement = state.ranks.placement();
        let levels = place_in_order(structure, &placement, targets, solver, context)?;
        let moved = structure.max_displacement(targets, &levels) / options.scale;
        if options.max_displacement.is_none_or(|limit| moved <= limit) {
            return Ok(placement);
        }
    }
    Ok(states.last().map_or_else(|| found.placement.clone(), |s| s.ranks.placement()))
}

/// The placement with the alignments of `found` nearest to the input, if it counts no more; else `found`.
fn relaxed(
    structure: &Structure,
    input: &[f64],
    found: &[f64],
    objective: Objective,
    solver: &dyn Solver,
    context: &Context,
) -> Result<Placement> {
    let fine = Unit::of(structure, input).apply(structure, input);
    let start = place_in_order(structure, found, &fine, solver, context)?;
    let outcome = Outcome::of(structure, &start);
    let near = outcome.settle(&fine, solver, context)?;
    let mut judge = Judge::new(structure);
    let no_worse = judge.counts_of(&near).of(objective) <= judge.counts_of(&start).of(objective);
    Ok(if no_worse { near } else { start })
}
