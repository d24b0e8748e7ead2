//! A lattice of its own for the alignment.

use super::problem::Problem;
use crate::structure::{Placement, Structure};

/// The lattice that Algorithm 1 works on, whatever the scale of the result: its steps are half the
/// shortest edge, so that rounding alone collapses nothing.
pub(super) struct Unit {
    origin: [f64; 3],
    scale: f64,
}

impl Unit {
    const STEPS_PER_SHORTEST_EDGE: f64 = 2.0;

    /// The lattice for the polycube that lies at `placement`.
    pub(super) fn of(structure: &Structure, placement: &[f64]) -> Self {
        let along = |axis: usize| structure.levels.iter().zip(placement).filter(move |(l, _)| l.axis == axis);
        let origin: [f64; 3] = std::array::from_fn(|a| along(a).map(|(_, &x)| x).fold(f64::INFINITY, f64::min));
        let size = |a: usize| along(a).map(|(_, &x)| x - origin[a]).fold(0.0, f64::max);
        let largest = size(0).max(size(1)).max(size(2));
        let finest = Problem::MAX_LEVEL as f64 / 2.0 / largest;
        Self { origin, scale: (Self::STEPS_PER_SHORTEST_EDGE / structure.shortest_edge(placement)).min(finest) }
    }

    /// The same placement in steps of this lattice.
    pub(super) fn apply(&self, structure: &Structure, placement: &[f64]) -> Placement {
        let own = structure.levels.iter().zip(placement);
        own.map(|(l, x)| (x - self.origin[l.axis]) * self.scale).collect()
    }
}
