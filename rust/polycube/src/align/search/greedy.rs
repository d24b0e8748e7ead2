//! Greedy merging: align the two levels that save most, recount, repeat.

use super::anneal::{Chain, Landscape, State};
use crate::context::Context;
use crate::error::Result;

/// Aligns one level with another, the pair that saves most first, until no pair saves anything or the work gets too much.
///
/// Savings are looked up again only for the pairs that promise most: those whose saving was largest when last counted.
/// O(n²) counts for n levels, and a few for every merge; of so many levels that these are too many, only the nearest pairs.
pub fn merge(landscape: &Landscape, chain: &mut Chain, start: State, context: &Context) -> Result<State> {
    let mut now = start;
    let mut counts = landscape.affordable(u32::MAX);
    let mut promises: Vec<(i64, (u32, u32))> =
        pairs(landscape, counts / 2).into_iter().map(|p| (i64::MAX, p)).collect();
    loop {
        let mut best: Option<(i64, State)> = None;
        promises.sort_by_key(|p| std::cmp::Reverse(p.0));
        for (saved, (level, onto)) in &mut promises {
            if best.as_ref().is_some_and(|b| b.0 >= *saved) || counts == 0 {
                break;
            }
            context.tick(0.0)?;
            let next = landscape.moves.align(&now.ranks, *level, *onto).and_then(|ranks| {
                counts -= 1;
                chain.state(ranks)
            });
            *saved = next.as_ref().map_or(i64::MIN, |s| now.count as i64 - s.count as i64);
            if let Some(state) = next
                && *saved > best.as_ref().map_or(0, |b| b.0)
            {
                best = Some((*saved, state));
            }
        }
        let Some((_, state)) = best else { return Ok(now) };
        now = state;
        // A merge may make possible what was not: ask those again that were impossible or useless.
        promises.iter_mut().filter(|p| p.0 <= 0).for_each(|p| p.0 = 1);
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
