//! Greedy merging: align the two levels that save most, recount, repeat.

use super::anneal::{Chain, State};
use super::moves::Moves;
use crate::context::Context;
use crate::error::Result;
use crate::structure::Structure;
use num_traits::PrimInt;

/// Aligns one level with another, the pair that saves most first, until no pair saves anything.
///
/// Savings are looked up again only for the pairs that promise most: those whose saving was largest when last counted.
/// O(n²) counts for n levels, and a few for every merge.
pub fn merge<R: PrimInt>(
    structure: &Structure,
    moves: &Moves,
    chain: &mut Chain<R>,
    start: State,
    context: &Context,
) -> Result<State> {
    let mut now = start;
    let levels = 0..structure.levels.len() as u32;
    let same = |a: u32, b: u32| a != b && structure.levels[a as usize].axis == structure.levels[b as usize].axis;
    let pairs = levels.clone().flat_map(|a| levels.clone().map(move |b| (a, b))).filter(|&(a, b)| same(a, b));
    let mut promises: Vec<(i64, (u32, u32))> = pairs.map(|p| (i64::MAX, p)).collect();
    loop {
        let mut best: Option<(i64, State)> = None;
        promises.sort_by_key(|p| std::cmp::Reverse(p.0));
        for (saved, (level, onto)) in &mut promises {
            if best.as_ref().is_some_and(|b| b.0 >= *saved) {
                break;
            }
            context.tick(0.0)?;
            let next = moves.align(&now.ranks, *level, *onto).and_then(|ranks| chain.state(ranks));
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
