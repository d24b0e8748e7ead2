//! Where on a front the point with the fewest blocks whose mesh is right may lie.

use crate::align::TradeOff;

/// Points between one that is wrong and one that is right are looked at as long as they may save this part of the
/// blocks.
const SAVED: f64 = 0.25;

/// The part of a front between the last point whose mesh was wrong and the first whose mesh was right.
pub(crate) struct Bisection {
    /// The last that is wrong.
    low: usize,
    /// The first that is right, or the end of the front.
    high: usize,
    /// Whether one was right.
    found: bool,
}

impl Bisection {
    /// All of a front of `len` points after the point `low`.
    pub(crate) fn new(low: usize, len: usize) -> Self {
        Self { low, high: len, found: false }
    }

    /// Notes that the mesh of a point was wrong, and so are those of points with fewer blocks, which move corners
    /// farther.
    pub(crate) fn wrong(&mut self, at: usize) {
        self.low = self.low.max(at);
    }

    /// Notes that the mesh of a point was right.
    pub(crate) fn right(&mut self, at: usize) {
        (self.high, self.found) = (self.high.min(at), true);
    }

    /// Whether the mesh of any point was right.
    pub(crate) fn found(&self) -> bool {
        self.found
    }

    /// The point in the middle, if there is one and it may be worth a mesh.
    pub(crate) fn middle(&self, front: &[TradeOff]) -> Option<usize> {
        let middle = (self.low + self.high) / 2;
        let blocks = |at: usize| front[at].count as f64;
        let worth = || !self.found || blocks(self.low) < (1.0 - SAVED) * blocks(self.high);
        (middle > self.low && worth()).then_some(middle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn front() -> Vec<TradeOff> {
        let point = |i: usize| TradeOff { count: 100 + 10 * i, displacement: (9 - i) as f64, order: Vec::new() };
        (0..10).map(point).collect()
    }

    #[test]
    fn the_middle_is_tried_until_little_can_be_saved() {
        let mut bisection = Bisection::new(0, 10);
        assert_eq!(bisection.middle(&front()), Some(5));
        bisection.wrong(5);
        assert_eq!(bisection.middle(&front()), Some(7));
        bisection.right(7);
        assert_eq!(bisection.middle(&front()), None);
        let mut steep = front();
        steep[7].count = 250;
        assert_eq!(bisection.middle(&steep), Some(6));
        bisection.right(6);
        assert_eq!(bisection.middle(&steep), None);
    }

    #[test]
    fn at_last_the_input_is_tried_and_nothing_after_it() {
        let mut bisection = Bisection::new(8, 10);
        assert_eq!(bisection.middle(&front()), Some(9));
        bisection.wrong(9);
        assert_eq!(bisection.middle(&front()), None);
    }

    #[test]
    fn without_a_front_there_is_no_middle() {
        let mut bisection = Bisection::new(0, 0);
        bisection.right(0);
        assert_eq!(bisection.middle(&[]), None);
    }

    #[test]
    fn a_step_that_saves_little_is_not_looked_into() {
        let mut bisection = Bisection::new(3, 10);
        bisection.right(5);
        bisection.wrong(3);
        let mut dense = front();
        dense[3].count = 140;
        assert_eq!(bisection.middle(&dense), None);
    }
}
