//! Greedy merging: align the two levels that save most, recount, repeat.

use super::anneal::{Chain, Landscape};
use super::front::Front;
use super::state::State;
use crate::context::Context;
use crate::error::Result;

/// What a merge is worth: from one state to another, positive if it shall be done at all.
pub(super) type Worth = fn(&State, &State) -> f64;

/// How much less is counted.
pub(super) fn saved(from: &State, to: &State) -> f64 {
    from.count as f64 - to.count as f64
}

/// How much less is counted for what it costs in displacement.
pub(super) fn saved_per_cost(from: &State, to: &State) -> f64 {
    let cost = (to.shape_cost() - from.shape_cost()).max(0.0);
    saved(from, to) / cost.max(f64::MIN_POSITIVE)
}

/// Aligns one level with another, the pair that is worth most first, until no pair saves anything or the work gets too
/// much. All states on the way are offered to the front.
///
/// Savings are looked up again only for the pairs that promise most: those that were worth most when last counted.
/// O(n²) counts for n levels, and a few for every merge; of so many levels that these are too many, only the nearest
/// pairs.
pub(super) fn merge(
    landscape: &Landscape,
    chain: &mut Chain,
    start: State,
    worth: Worth,
    front: &mut Front,
    context: &Context,
) -> Result<State> {
    let mut now = start;
    let mut counts = landscape.affordable(u32::MAX);
    let mut promises: Vec<(f64, (u32, u32))> =
        pairs(landscape, counts / 2).into_iter().map(|p| (f64::INFINITY, p)).collect();
    loop {
        let mut best: Option<(f64, State)> = None;
        promises.sort_by(|p, q| q.0.total_cmp(&p.0));
        for (promise, (level, onto)) in &mut promises {
            if best.as_ref().is_some_and(|b| b.0 >= *promise) || counts == 0 || landscape.is_late() {
                break;
            }
            context.check()?;
            let next = landscape.moves.align(&now.ranks, *level, *onto).and_then(|ranks| {
                counts -= 1;
                chain.state(ranks)
            });
            *promise = next.as_ref().map_or(f64::NEG_INFINITY, |s| worth(&now, s));
            if let Some(state) = next
                && *promise > best.as_ref().map_or(0.0, |b| b.0)
            {
                best = Some((*promise, state));
            }
        }
        let Some((_, state)) = best else { return Ok(now) };
        front.offer(&state);
        now = state;
        // A merge may make possible what was not: ask those again that were impossible or useless.
        promises.iter_mut().filter(|p| p.0 <= 0.0).for_each(|p| p.0 = f64::MIN_POSITIVE);
    }
}

/// Ordered pairs of levels of one axis, at most `most`: of more the nearest to each other, in their own order.
fn pairs(landscape: &Landscape, most: u32) -> Vec<(u32, u32)> {
    let (structure, at) = (landscape.structure, landscape.targets);
    let levels = 0..structure.levels.len() as u32;
    let same = |a: u32, b: u32| a != b && structure.levels[a as usize].axis == structure.levels[b as usize].axis;
    let all = levels.clone().flat_map(|a| levels.clone().map(move |b| (a, b)));
    let mut pairs: Vec<(u32, u32)> = all.filter(|&(a, b)| same(a, b)).collect();
    if pairs.len() > most as usize {
        let distance = |&(a, b): &(u32, u32)| (at[a as usize] - at[b as usize]).abs();
        pairs.sort_by(|p, q| distance(p).total_cmp(&distance(q)).then(p.cmp(q)));
        pairs.truncate(most as usize);
        pairs.sort_unstable();
    }
    pairs
}
