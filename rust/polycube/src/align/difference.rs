//! How far two levels must be apart.

use serde::{Deserialize, Serialize};

/// The constraint `x[high] − x[low] ≥ gap`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Difference {
    /// The variable that stays below.
    pub low: u32,
    /// The variable that stays above.
    pub high: u32,
    /// The least distance; zero and negative distances are allowed.
    pub gap: i64,
}

impl Difference {
    /// Ascends with the lower variable, the higher one, and the gap: one number to sort by, which is faster than three.
    pub(crate) fn rank(&self) -> u128 {
        let gap = (self.gap as u64) ^ (1 << 63);
        u128::from(self.low) << 96 | u128::from(self.high) << 64 | u128::from(gap)
    }
}
