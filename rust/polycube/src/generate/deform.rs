//! Smooth injective maps of space that make a sculpted shape of a polycube.
//!
//! They use nothing but `+ - * /` and square roots, which give the same bits on every machine;
//! sines and powers do not. A turn is written with the tangent of its half angle instead.

use crate::mesh::Point;

/// A smooth injective map of space; every one preserves orientation. Lengths are those of the
/// mesh, angles are radians, axes are 0 = X, 1 = Y, 2 = Z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Deformation {
    /// Turns squares around an axis, or cubes around a point, towards circles and balls.
    Round {
        /// Stays where it is.
        center: [f64; 3],
        /// The axes that take part: two for a tube, three for a ball.
        axes: [bool; 3],
        /// How far, from 0 (not at all) to 1 (all the way).
        strength: f64,
        /// Radius around the centre that hardly changes; positive.
        core: f64,
    },
    /// Turns each plane across `axis`, at distance `d` from the centre, by `2 atan(rate d / 2)`.
    Twist {
        /// A point on the line that stays where it is.
        center: [f64; 3],
        /// The axis turned about.
        axis: usize,
        /// Angle per length near the centre; any.
        rate: f64,
    },
    /// Turns each plane across `along`, at distance `d` from the centre, by `2 atan(curvature d / 2)`
    /// about a line parallel to the third axis, which lies at distance `1 / curvature` from the
    /// centre towards positive `towards`.
    Bend {
        /// Stays where it is.
        center: [f64; 3],
        /// The axis that gets an arc.
        along: usize,
        /// The axis the arc opens to.
        towards: usize,
        /// One over the arc's radius, not 0. The map is injective where
        /// `curvature * distance towards < 1`: on the near side of the line turned about.
        curvature: f64,
    },
}

/// How often the norm whose spheres count as cubes in [`Deformation::Round`] squares: its power
/// is `2^4`. The ball's norm squares once.
const SQUARINGS: [u32; 2] = [4, 1];

impl Deformation {
    /// Where the point goes.
    ///
    /// # Panics
    /// When an axis is above 2.
    pub fn apply(&self, point: Point) -> Point {
        match *self {
            Self::Round { center, axes, .. } => {
                let factor = self.factor(point);
                Point::from([0, 1, 2].map(|a| {
                    let by = if axes[a] { factor } else { 1.0 };
                    center[a] + (point[a] - center[a]) * by
                }))
            }
            Self::Twist { center, axis, rate } => twist(point, center, axis, rate),
            Self::Bend { center, along, towards, curvature } => {
                let mut moved = point;
                let radius = 1.0 / curvature - (point[towards] - center[towards]);
                let (sin, cos) = turn((point[along] - center[along]) * curvature);
                moved[along] = center[along] + radius * sin;
                moved[towards] = center[towards] + 1.0 / curvature - radius * cos;
                moved
            }
        }
    }

    /// The determinant of the map's derivative at the point; positive where the map is injective.
    ///
    /// # Panics
    /// When an axis is above 2.
    pub fn determinant(&self, point: Point) -> f64 {
        match *self {
            Self::Round { axes, strength, .. } => {
                // A map x s(x) in d dimensions has determinant s^(d-1) (s + x grad s).
                let ((cube, ball), ratio) = (self.slopes(point), self.ratio(point));
                let along = 1.0 - strength + strength * ratio * (1.0 + cube - ball);
                let across = axes.iter().filter(|a| **a).skip(1);
                across.fold(along, |product, _| product * self.factor(point))
            }
            Self::Twist { .. } => 1.0,
            Self::Bend { center, along, towards, curvature } => {
                let half = 0.5 * curvature * (point[along] - center[along]);
                (1.0 - curvature * (point[towards] - center[towards])) / (1.0 + half * half)
            }
        }
    }

    /// The sums of powers of the offset from the centre (in cores) for the cube and the ball.
    fn sums(&self, point: Point) -> [f64; 2] {
        let Self::Round { center, axes, core, .. } = *self else {
            return [0.0; 2];
        };
        SQUARINGS.map(|squarings| {
            let used = (0..3).filter(|a| axes[*a]);
            let power = |a: usize| (0..squarings).fold((point[a] - center[a]) / core, |x, _| x * x);
            used.map(power).sum()
        })
    }

    /// The cube's norm over the ball's, both kept off zero by the core.
    fn ratio(&self, point: Point) -> f64 {
        let sums = self.sums(point);
        let norm = |i: usize| (0..SQUARINGS[i]).fold(1.0 + sums[i], |x, _| x.sqrt());
        norm(0) / norm(1)
    }

    fn factor(&self, point: Point) -> f64 {
        match *self {
            Self::Round { strength, .. } => 1.0 - strength + strength * self.ratio(point),
            _ => 1.0,
        }
    }

    /// Logarithmic growth of both norms along the ray from the centre, each in `0..1`.
    fn slopes(&self, point: Point) -> (f64, f64) {
        let [cube, ball] = self.sums(point).map(|sum| sum / (1.0 + sum));
        (cube, ball)
    }
}

/// Sine and cosine of `2 atan(angle / 2)`.
fn turn(angle: f64) -> (f64, f64) {
    let half = 0.5 * angle;
    let square = half * half;
    (angle / (1.0 + square), (1.0 - square) / (1.0 + square))
}

fn twist(point: Point, center: [f64; 3], axis: usize, rate: f64) -> Point {
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    let (sin, cos) = turn((point[axis] - center[axis]) * rate);
    let [x, y] = [point[u] - center[u], point[v] - center[v]];
    let mut moved = point;
    moved[u] = center[u] + cos * x - sin * y;
    moved[v] = center[v] + sin * x + cos * y;
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::SplitMix64;
    use nalgebra::{Matrix3, Vector3};

    /// By central differences.
    fn numeric(map: &Deformation, p: Point) -> f64 {
        let h = 1e-5;
        let column = |axis: usize| {
            let mut step = Vector3::zeros();
            step[axis] = h;
            (map.apply(p + step) - map.apply(p - step)) / (2.0 * h)
        };
        Matrix3::from_columns(&[column(0), column(1), column(2)]).determinant()
    }

    #[test]
    fn determinants_are_those_of_the_map_and_positive() {
        let center = [1.0, 2.0, 3.0];
        let round = |axes, strength| Deformation::Round { center, axes, strength, core: 2.0 };
        let maps = [
            round([true; 3], 0.9),
            round([true, true, false], 1.0),
            Deformation::Twist { center, axis: 1, rate: 0.05 },
            Deformation::Bend { center, along: 2, towards: 0, curvature: -0.03 },
        ];
        let mut rng = SplitMix64::new(1);
        for map in maps {
            for _ in 0..1000 {
                let p = Point::from([0; 3].map(|_: i32| 40.0 * rng.unit() - 20.0));
                let exact = map.determinant(p);
                assert!(exact > 0.0);
                assert!((exact - numeric(&map, p)).abs() < 1e-6, "{map:?} at {p}");
            }
            let p = Point::from(center);
            assert!((map.apply(p) - p).norm() < 1e-12);
        }
    }
}
