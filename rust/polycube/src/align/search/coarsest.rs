//! The strategy `best`, from the input to the chosen trade-off.

use super::anneal::Landscape;
use super::front::Front;
use super::state::State;
use super::{Prepared, greedy, is_searchable, search};
use crate::align::guides::Guided;
use crate::align::judge::Judge;
use crate::align::paper::{Outcome, descend, simplify};
use crate::align::place::place_in_order;
use crate::align::prove::Proof;
use crate::align::ranks::Ranks;
use crate::align::unit::Unit;
use crate::align::{Alignment, LowerBound, Task, TradeOff, keeps};
use crate::context::Context;
use crate::error::Result;
use crate::layout::Counts;
use crate::structure::placement_of;

/// Algorithm 1, then the search.
pub(crate) fn coarsest(task: &Task, context: &Context) -> Result<Alignment> {
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
    let mut judge = Judge::new(structure);
    let mut keeps = |s: &&State| judge.counts(&s.ranks).is_some_and(|c| keeps_promise(task, &c));
    let mut front: Vec<TradeOff> = found.front.states().filter(&mut keeps).map(|s| trade_off(task, s)).collect();
    if front.is_empty() {
        return simplify(task, context);
    }
    go_on_to_input(task, &mut judge, &mut front, context)?;
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

/// Goes on with the front to the input's own order where, on the lattice that is asked for, that moves corners less
/// than the end that the search found. The search keeps planes half the shortest edge apart, so that planes nearer to
/// each other are better together; on a finer lattice they can stay as they are. What lies between is what merging
/// meets on the way. The first point stays.
fn go_on_to_input(task: &Task, judge: &mut Judge, front: &mut Vec<TradeOff>, context: &Context) -> Result<()> {
    let ranks = Ranks::new(task.structure, task.input);
    let Some(last) = front.last() else { return Ok(()) };
    if last.is_input(&ranks) || !task.guided.allows(&ranks) {
        return Ok(());
    }
    let Ok(own) = place_in_order(task.structure, &ranks, &task.targets, &task.guided) else { return Ok(()) };
    let found = place_trade_off(task, last, context)?;
    if displacement(task, &own) >= displacement(task, &found) {
        return Ok(());
    }
    let finer = merged(task, &ranks, context)?;
    let most = finer.states().next_back().map_or(0, |s| s.count);
    while front.len() > 1 && front.last().is_some_and(|last| last.count >= most) {
        front.pop();
    }
    for state in finer.states().filter(|s| judge.counts(&s.ranks).is_some_and(|c| keeps_promise(task, &c))) {
        let mut point = trade_off(task, state);
        if point.order == ranks.of_level {
            point.displacement = 0.0;
        }
        if front.last().is_none_or(|last| last.count < point.count && last.displacement > point.displacement) {
            front.push(point);
        }
    }
    Ok(())
}

/// The front that merging meets from the order `input` on, when planes may be as near to each other as on the lattice
/// that is asked for.
fn merged(task: &Task, input: &Ranks, context: &Context) -> Result<Front> {
    let prepared = Prepared::new(task);
    let landscape = prepared.landscape(task);
    let landscape = Landscape { gap: landscape.gap.min(1.0 / task.options.scale), ..landscape };
    let mut chain = landscape.chain()?;
    let mut front = Front::default();
    if let Some(start) = chain.state(input.clone()) {
        front.offer(&start);
        greedy::merge(&landscape, &mut chain, start, greedy::saved_per_cost, &mut front, context)?;
    }
    Ok(front)
}

/// Fewer patches can mean more blocks; the promise is never more of them than there were.
fn keeps_promise(task: &Task, counts: &Counts) -> bool {
    counts.blocks_padded <= task.before.blocks_padded
}

/// The farthest that a corner moves, in steps of the lattice that is asked for.
fn displacement(task: &Task, levels: &[i64]) -> f64 {
    let placement = placement_of(levels);
    task.structure.max_displacement(&task.targets, &placement)
}

/// The trade-off that the options ask for, and its levels: the coarsest within the displacement allowed or, where none
/// is, the one with the least displacement.
fn choose(task: &Task, front: &[TradeOff], context: &Context) -> Result<(usize, Vec<i64>)> {
    let options = task.options;
    let mut index = TradeOff::index(options.simplicity, front.len());
    loop {
        let levels = place_trade_off(task, &front[index], context)?;
        let moved = displacement(task, &levels) / options.scale;
        if options.max_displacement.is_none_or(|limit| keeps(moved, limit, options.scale)) || index + 1 == front.len() {
            return Ok((index, levels));
        }
        index += 1;
    }
}

/// The levels of a trade-off: its alignments as near to the input as they can be, on the lattice that is asked for.
pub(crate) fn place_trade_off(task: &Task, point: &TradeOff, context: &Context) -> Result<Vec<i64>> {
    let structure = task.structure;
    let ranks = point.ranks(structure);
    let place = |order: &Ranks| place_in_order(structure, order, &task.targets, &task.guided);
    let order = relaxed(task, &ranks, context)?;
    let near = place(&order)?;
    let less = || Judge::new(structure).cost(task.options.objective, &order).is_some_and(|count| count < point.count);
    if !point.is_input(&Ranks::new(structure, task.input)) && (order == ranks || !less()) {
        return Ok(near);
    }
    // On a lattice finer than that of the search, what relaxing merged is another point of the front.
    let own = place(&ranks)?;
    Ok(if displacement(task, &own) < displacement(task, &near) { own } else { near })
}

/// The order with the alignments of `found` nearest to the input, if it counts no more and the guides allow it; else
/// `found`.
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
    let no_worse = now.of(options.objective) <= then.of(options.objective) && keeps_promise(task, &now);
    Ok(if no_worse && task.guided.allows(&order) { order } else { found.clone() })
}
