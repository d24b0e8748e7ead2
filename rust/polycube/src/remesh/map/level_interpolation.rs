//! From one lattice to another with the same order of levels.

use crate::mesh::Point;
use crate::simplify::Simplified;

/// The same map onto a lattice with other levels in the same order.
pub(crate) fn on_levels(map: &Simplified, levels: Vec<i64>) -> Simplified {
    let mut moved = map.clone();
    if let Some(mesh) = &mut moved.polycube {
        mesh.points = moved_points(map, &levels, &mesh.points);
    }
    moved.levels = levels;
    moved
}

/// Points on the lattice of `map` moved onto one with other levels.
fn moved_points(map: &Simplified, levels: &[i64], points: &[Point]) -> Vec<Point> {
    let between = LevelInterpolation::new(map, &map.levels, levels);
    points.iter().map(|p| Point::from(between.apply(p.coords.into()))).collect()
}

/// From one lattice to another with the same order of levels: linear between levels.
pub(crate) struct LevelInterpolation {
    /// Levels of each axis from one lattice, ascending, with those of the other.
    planes: [Vec<[f64; 2]>; 3],
}

impl LevelInterpolation {
    pub(crate) fn new(map: &Simplified, from: &[i64], to: &[i64]) -> Self {
        let mut planes = [const { Vec::new() }; 3];
        for (level, (&from, &to)) in map.input.structure.levels.iter().zip(from.iter().zip(to)) {
            planes[level.axis].push([from as f64, to as f64]);
        }
        for own in &mut planes {
            own.sort_by(|a, b| a[0].total_cmp(&b[0]));
            own.dedup();
        }
        Self { planes }
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
