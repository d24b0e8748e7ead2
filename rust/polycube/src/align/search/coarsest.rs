//! The strategy `best`, from the input to the chosen trade-off.

use super::anneal::State;
use super::{is_searchable, search};
use crate::align::guides::Guided;
use crate::align::judge::Judge;
use crate::align::paper::{Outcome, descend, simplify};
use crate::align::place::place_in_order;
use crate::align::prove::Proof;
use crate::align::ranks::Ranks;
use crate::align::unit::Unit;
use crate::align::{Alignment, LowerBound, Task, TradeOff};
use crate::context::Context;
use crate::error::Result;
use crate::structure::placement_of;

/// Algorithm 1, then the search.
pub fn coarsest(task: &Task, context: &Context) -> Result<Alignment> {
    let aligning = context.stage("align", 0.0, 0.2);
    if !is_searchable(task.structure) {
        return simplify(task, &aligning);
    }
    let structure = task.structure;
    // On its own lattice Algorithm 1 gives the search the same start at every scale.
    let own = Unit::of(structure, task.input).apply(structure, task.input);
    let paper = descend(task, &own, &Guided::free(structure), &aligning)?;
    let start = placement_of(&paper.levels);
    let found = search(task, &start, &context.stage("search", 0.2, 1.0))?;
    // Fewer patches can mean more blocks; the promise is never more of them than there were.
    let mut judge = Judge::new(structure);
    let most = task.before.blocks_padded;
    let keeps_promise = |s: &&State| judge.counts(&s.ranks).is_some_and(|c| c.blocks_padded <= most);
    let front: Vec<TradeOff> = found.front.states().filter(keeps_promise).map(|s| trade_off(task, s)).collect();
    if front.is_empty() {
        return simplify(task, context);
    }
    let (chosen, levels) = choose(task, &front, context)?;
    let placement = placement_of(&levels);
    let after = Some(judge.counts_of(&placement));
    let Proof { bound, proven, nodes, .. } = found.proof;
    let bound = Some(LowerBound { count: bound, proven: proven && front[0].count == bound, nodes });
    let (before, rounds) = (task.before, paper.rounds);
    Ok(Alignment { levels, before, after, rounds, broken: Vec::new(), front, chosen: Some(chosen), bound })
}

fn trade_off(task: &Task, state: &State) -> TradeOff {
    let corners = task.structure.corners.len() as f64;
    TradeOff {
        count: state.count,
        displacement: (state.shape_cost() / corners).sqrt(),
        order: state.ranks.of_level.clone(),
    }
}

/// The trade-off that the options ask for, and its levels: the coarsest within the displacement allowed or, where none is,
/// the one with the least displacement.
fn choose(task: &Task, front: &[TradeOff], context: &Context) -> Result<(usize, Vec<i64>)> {
    let options = task.options;
    let mut index = TradeOff::index(options.simplicity, front.len());
    loop {
        let levels = place_trade_off(task, &front[index], context)?;
        let placement = placement_of(&levels);
        let moved = task.structure.max_displacement(&task.targets, &placement) / options.scale;
        if options.max_displacement.is_none_or(|limit| moved <= limit) || index + 1 == front.len() {
            return Ok((index, levels));
        }
        index += 1;
    }
}

/// The levels of a trade-off: its alignments as near to the input as they can be, on the lattice that is asked for.
pub fn place_trade_off(task: &Task, point: &TradeOff, context: &Context) -> Result<Vec<i64>> {
    let structure = task.structure;
    let order = relaxed(task, &point.ranks(structure), context)?;
    place_in_order(structure, &order, &task.targets, &task.guided)
}

/// The order with the alignments of `found` nearest to the input, if it counts no more and the guides allow it; else `found`.
fn relaxed(task: &Task, found: &Ranks, context: &Context) -> Result<Ranks> {
    let Task { structure, options, .. } = *task;
    let fine = Unit::of(structure, task.input).apply(structure, task.input);
    let start = place_in_order(structure, found, &fine, &Guided::free(structure))?;
    let start = placement_of(&start);
    let outcome = Outcome::of(structure, &start);
    let near = outcome.settle(&fine, &*options.solver.solver(), context)?;
    let order = Ranks::new(structure, &near);
    let mut judge = Judge::new(structure);
    let (now, then) = (judge.counts_of(&near), judge.counts_of(&start));
    let no_worse =
        now.of(options.objective) <= then.of(options.objective) && now.blocks_padded <= task.before.blocks_padded;
    Ok(if no_worse && task.guided.allows(&order) { order } else { found.clone() })
}
