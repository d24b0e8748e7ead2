//! Integer placements that keep an order of levels.
//!
//! Minimise Σ corners · (x − target)² with equal levels equal and others at least one step apart. The order is total,
//! so taking off one step per plane leaves an isotonic regression on a chain: adjacent planes that would pass each
//! other are pooled at their common mean. Its integer optimum is the rounded real one, and bounds on the chain's ends
//! only clip it.

use super::problem::Problem;

/// A plane with the targets of its levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Plane {
    /// The number of corners, at least 1.
    pub weight: i64,
    /// Σ corners · target in units of `2^−FRACTION_BITS`.
    pub moment: i128,
    /// Where it must lie.
    pub fixed: Option<i64>,
}

impl Plane {
    /// This plane and the image of `other` under `x ↦ doubled − x` in one.
    pub(super) fn folded(&self, other: &Self, doubled: i64) -> Self {
        let reach = i128::from(other.weight) * (i128::from(doubled) << Problem::FRACTION_BITS);
        Self {
            weight: self.weight + other.weight,
            moment: self.moment + reach - other.moment,
            fixed: self.fixed.or(other.fixed.map(|x| doubled - x)),
        }
    }
}

/// Coordinates of planes in a row, each at least one step above the one before, the last at most at `most`; nothing if
/// fixed planes and bound leave no room.
pub(super) fn chain(planes: &[Plane], most: Option<i64>) -> Option<Vec<i64>> {
    let mut placed = Vec::with_capacity(planes.len());
    let mut low = i64::MIN;
    while placed.len() < planes.len() {
        let start = placed.len();
        let free = planes[start..].iter().take_while(|p| p.fixed.is_none()).count();
        let end = planes.get(start + free).and_then(|p| p.fixed.map(|x| x - (start + free) as i64));
        let high = end.or(most.map(|m| m - (planes.len() - 1) as i64)).unwrap_or(i64::MAX);
        if low > high {
            return None;
        }
        let steps = isotonic(&planes[start..start + free], start as i64);
        placed.extend((start as i64..).zip(steps).map(|(i, y)| i + y.clamp(low, high)));
        if let Some(at) = end {
            placed.push(at + placed.len() as i64);
            low = at;
        }
    }
    let in_bounds = most.is_none_or(|m| placed.last().is_none_or(|&x| x <= m));
    in_bounds.then_some(placed)
}

/// The integers `y`, never falling, with `y + index` nearest to the targets, `index` counted from `first`.
fn isotonic(planes: &[Plane], first: i64) -> Vec<i64> {
    let mut pools: Vec<(i64, i128, usize)> = Vec::with_capacity(planes.len());
    for (index, plane) in (first..).zip(planes) {
        let taken = i128::from(plane.weight) * (i128::from(index) << Problem::FRACTION_BITS);
        let mut pool = (plane.weight, plane.moment - taken, 1);
        while let Some(last) = pools.last()
            && last.1 * i128::from(pool.0) >= pool.1 * i128::from(last.0)
        {
            pool = (pool.0 + last.0, pool.1 + last.1, pool.2 + last.2);
            pools.pop();
        }
        pools.push(pool);
    }
    pools.into_iter().flat_map(|(weight, moment, count)| std::iter::repeat_n(rounded(weight, moment), count)).collect()
}

/// The integer nearest to a mean in fixed point, of two equally near the lower.
fn rounded(weight: i64, moment: i128) -> i64 {
    let unit = i128::from(weight) << Problem::FRACTION_BITS;
    let half_down = -((unit - 2 * moment).div_euclid(2 * unit));
    half_down as i64
}
