//! Levels that were aligned and stay so.

/// A partition of the levels: levels of one class have one coordinate, now and in all later rounds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Classes {
    /// The class of each level, named by its lowest member.
    of: Vec<u32>,
}

impl Classes {
    /// Every level on its own.
    pub(super) fn new(levels: usize) -> Self {
        Self { of: (0..levels as u32).collect() }
    }

    /// The class of `level`, named by its lowest member.
    pub(super) fn of(&self, level: u32) -> u32 {
        self.of[level as usize]
    }

    /// Joins the classes of two levels; `false` if they were one already. O(n) for n levels.
    pub(super) fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.of(a), self.of(b));
        let (low, high) = (a.min(b), a.max(b));
        self.of.iter_mut().filter(|c| **c == high).for_each(|c| *c = low);
        a != b
    }
}
