//! The trade-off between few blocks and little displacement.

use super::state::State;
use std::collections::BTreeMap;

/// Of all states seen, for each count the one with the least displacement, and only those that no other beats in both.
#[derive(Clone, Debug, Default)]
pub(crate) struct Front {
    by_count: BTreeMap<usize, State>,
}

impl Front {
    /// Takes `state` in unless another is as good in both.
    pub(crate) fn offer(&mut self, state: &State) {
        let cost = state.shape_cost();
        let beaten = self.by_count.range(..=state.count).next_back().is_some_and(|(_, s)| s.shape_cost() <= cost);
        if beaten {
            return;
        }
        while let Some((&count, other)) = self.by_count.range(state.count..).next()
            && other.shape_cost() >= cost
        {
            self.by_count.remove(&count);
        }
        self.by_count.insert(state.count, state.clone());
    }

    /// Takes in another front.
    pub(crate) fn join(&mut self, other: Self) {
        other.by_count.values().for_each(|s| self.offer(s));
    }

    /// The states from the fewest blocks to the least displacement.
    pub(crate) fn states(&self) -> impl DoubleEndedIterator<Item = &State> {
        self.by_count.values()
    }
}
