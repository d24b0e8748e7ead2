//! From one lattice to another with the same order of levels.

use crate::mesh::Point;
use crate::structure::Structure;

/// From one lattice to another with the same order of levels: linear between levels.
pub(crate) struct LevelInterpolation {
    /// Levels of each axis from one lattice, ascending, with those of the other.
    planes: [Vec<[f64; 2]>; 3],
}

impl LevelInterpolation {
    pub(crate) fn new(structure: &Structure, from: &[i64], to: &[i64]) -> Self {
        let mut planes = [const { Vec::new() }; 3];
        for (level, (&from, &to)) in structure.levels.iter().zip(from.iter().zip(to)) {
            planes[level.axis].push([from as f64, to as f64]);
        }
        for own in &mut planes {
            own.sort_by(|a, b| a[0].total_cmp(&b[0]));
            own.dedup();
        }
        Self { planes }
    }

    /// Moves points from one lattice onto the other.
    pub(crate) fn move_all(&self, points: &mut [Point]) {
        points.iter_mut().for_each(|p| *p = Point::from(self.apply(p.coords.into())));
    }

    pub(crate) fn apply(&self, at: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| {
            let planes = &self.planes[a];
            let above = planes.partition_point(|p| p[0] <= at[a]).clamp(1, planes.len() - 1);
            let [low, high] = [planes[above - 1], planes[above]];
            let part = (at[a] - low[0]) / (high[0] - low[0]);
            low[1] + (high[1] - low[1]) * part
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_levels_and_beyond_them_coordinates_are_in_proportion() {
        let planes = || vec![[0.0, 0.0], [2.0, 1.0], [3.0, 5.0]];
        let between = LevelInterpolation { planes: [planes(), planes(), planes()] };
        assert_eq!(between.apply([1.0, 2.5, 2.0]), [0.5, 3.0, 1.0]);
        assert_eq!(between.apply([0.0, 3.0, 4.0]), [0.0, 5.0, 9.0]);
    }
}
