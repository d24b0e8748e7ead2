//! Polycubes far from the origin, as in map coordinates: they are brought near it for as long as they are aligned.

use super::problem::Problem;
use crate::structure::{Placement, Structure};

/// The lattice steps between the origin and a polycube that lies too far from it for the lattice.
pub(super) struct Origin {
    steps: [i64; 3],
    scale: f64,
}

/// The farthest from the origin that a level may lie on the lattice.
pub(super) const BOUND: f64 = Problem::MAX_LEVEL as f64 / 2.0;

impl Origin {
    /// For levels at `input` on a lattice with `scale` steps per unit: nothing to move along an axis where all is near
    /// enough.
    pub(super) fn of(structure: &Structure, input: &[f64], scale: f64) -> Self {
        let steps = |axis: usize| {
            let along = structure.levels.iter().zip(input).filter(|(l, _)| l.axis == axis).map(|(_, x)| x * scale);
            let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
            let far = low.min(-high) < -BOUND && high - low <= BOUND && f64::midpoint(low, high).abs() < FARTHEST;
            if far { f64::midpoint(low, high).round() as i64 } else { 0 }
        };
        Self { steps: std::array::from_fn(steps), scale }
    }

    /// The levels near the origin.
    pub(super) fn leave(&self, structure: &Structure, input: &[f64]) -> Placement {
        let near = |(level, x): (&crate::structure::Level, &f64)| match self.steps[level.axis] {
            0 => *x,
            steps => x - steps as f64 / self.scale,
        };
        structure.levels.iter().zip(input).map(near).collect()
    }

    /// Lattice coordinates near the origin, put back.
    pub(super) fn put_back(&self, structure: &Structure, mut levels: Vec<i64>) -> Vec<i64> {
        levels.iter_mut().zip(&structure.levels).for_each(|(x, level)| *x += self.steps[level.axis]);
        levels
    }
}

/// Beyond this many steps from the origin, numbers do not tell single steps apart any more.
const FARTHEST: f64 = (1_u64 << 45) as f64;
