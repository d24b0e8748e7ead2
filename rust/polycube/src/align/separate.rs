//! What to forbid when a placement makes the surface touch itself.

use super::problem::Difference;
use crate::structure::{Conflict, LevelBox, Structure};

/// Differences that `valid` satisfies and `broken` does not, and that keep the parts in `conflict` apart.
///
/// Whether two parts touch depends on the order of their levels alone, so some order between them must have changed.
/// Of the axes along which their boxes were separate the one with the largest distance is kept; where
/// no single axis tells them apart, every change of order among the levels of the two facets is undone.
pub(super) fn separations(
    structure: &Structure,
    conflict: &Conflict,
    valid: &[f64],
    broken: &[f64],
) -> Vec<Difference> {
    let kept = |a: u32, b: u32| required(a, b, valid).filter(|d| !holds(d, broken));
    if let Some([a, b]) = &conflict.boxes {
        let apart = |axis: usize| [(a.high[axis], b.low[axis]), (b.high[axis], a.low[axis])];
        let found = (0..3).flat_map(apart).filter_map(|(low, high)| kept(low, high));
        let distance = |d: &Difference| valid[d.high as usize] - valid[d.low as usize];
        if let Some(widest) = found.max_by(|a, b| distance(a).total_cmp(&distance(b))) {
            return vec![widest];
        }
    }
    let levels = levels_around(structure, conflict);
    let same_axis = |a: u32, b: u32| structure.levels[a as usize].axis == structure.levels[b as usize].axis;
    let pairs = levels.iter().flat_map(|&a| levels.iter().map(move |&b| (a, b)));
    pairs.filter(|&(a, b)| a != b && same_axis(a, b)).filter_map(|(a, b)| kept(a, b)).collect()
}

/// The difference that keeps `low` below `high` as `valid` has it: one step apart if they are apart there.
fn required(low: u32, high: u32, valid: &[f64]) -> Option<Difference> {
    let distance = valid[high as usize] - valid[low as usize];
    (distance >= 0.0).then_some(Difference { low, high, gap: i64::from(distance > 0.0) })
}

/// Whether `placement` satisfies `difference`.
pub(super) fn holds(difference: &Difference, placement: &[f64]) -> bool {
    placement[difference.high as usize] - placement[difference.low as usize] >= difference.gap as f64
}

/// The levels of the two boxes and of all sides of the two facets, ascending.
fn levels_around(structure: &Structure, conflict: &Conflict) -> Vec<u32> {
    let of_box = |b: &LevelBox| b.low.into_iter().chain(b.high).collect::<Vec<_>>();
    let mut levels: Vec<u32> = conflict.boxes.iter().flatten().flat_map(of_box).collect();
    for facet in conflict.facets.map(|f| &structure.facets[f as usize]) {
        let corners = facet.sides().flat_map(|s| structure.edges[s.edge as usize].corners);
        levels.extend(corners.flat_map(|c| structure.corners[c as usize].levels));
    }
    levels.sort_unstable();
    levels.dedup();
    levels
}
