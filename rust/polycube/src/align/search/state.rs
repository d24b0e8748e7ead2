//! What a search walks over.

use crate::align::ranks::Ranks;

/// An order with what it counts and costs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State {
    /// The order.
    pub ranks: Ranks,
    /// What the objective counts.
    pub count: usize,
    /// The least Σ weight · (x − target)² of each axis for this order, in squared units of the input.
    pub shape: [f64; 3],
}

impl State {
    /// Σ over the axes of `shape`.
    pub(crate) fn shape_cost(&self) -> f64 {
        self.shape.iter().sum()
    }
}
