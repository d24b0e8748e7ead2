//! Springs that keep places on faces near planes.

use crate::mesh::Point;
use nalgebra::Vector3;

/// Keeps the mean of up to four vertices, weighted, near a plane.
#[derive(Clone, Debug)]
pub struct Spring {
    /// The vertices.
    pub vertices: [u32; 4],
    /// Their weights, in sum 1.
    pub weights: [f64; 4],
    /// A point of the plane.
    pub at: Point,
    /// The unit normal of the plane.
    pub normal: Vector3<f64>,
    /// The distance up to which nothing pulls.
    pub slack: f64,
    /// The energy at a distance of one unit beyond that, at least 0.
    pub stiffness: f64,
}

impl Spring {
    /// How much farther than it may the mean is from the plane, negative below it.
    fn excess(&self, points: &[Point]) -> f64 {
        let from = self.vertices.iter().zip(self.weights).map(|(&v, w)| points[v as usize].coords * w);
        let gap = self.normal.dot(&(from.sum::<Vector3<f64>>() - self.at.coords));
        gap - gap.clamp(-self.slack, self.slack)
    }

    fn energy(&self, excess: f64) -> f64 {
        self.stiffness * excess * excess
    }
}

/// The springs on the vertices of a mesh.
#[derive(Clone, Debug, Default)]
pub(super) struct Springs {
    all: Vec<Spring>,
    /// The energy that is as bad as a worst quality less by 1.
    unit: f64,
}

impl Springs {
    /// Where `unit` more energy than they have at `points` is as bad as a worst quality less by 1.
    pub(super) fn new(all: Vec<Spring>, points: &[Point], unit: f64) -> Self {
        let start: f64 = all.iter().map(|spring| spring.energy(spring.excess(points))).sum();
        Self { all, unit: start + unit }
    }

    /// How bad their energy is, against the worst quality.
    pub(super) fn tension(&self, points: &[Point]) -> f64 {
        let energy: f64 = self.all.iter().map(|spring| spring.energy(spring.excess(points))).sum();
        if self.all.is_empty() { 0.0 } else { energy / self.unit }
    }

    /// Their energy, whose slopes are added to `gradient`.
    pub(super) fn pull(&self, points: &[Point], gradient: &mut [Vector3<f64>]) -> f64 {
        let mut energy = 0.0;
        for spring in &self.all {
            let excess = spring.excess(points);
            energy += spring.energy(excess);
            if excess != 0.0 {
                let slope = spring.normal * (2.0 * spring.stiffness * excess);
                spring.vertices.iter().zip(spring.weights).for_each(|(&v, w)| gradient[v as usize] += slope * w);
            }
        }
        energy
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spring() -> Spring {
        Spring {
            vertices: [0, 1, 2, 2],
            weights: [0.2, 0.3, 0.5, 0.0],
            at: Point::new(0.1, 0.2, 0.3),
            normal: Vector3::new(1.0, 2.0, 2.0) / 3.0,
            slack: 0.1,
            stiffness: 3.0,
        }
    }

    #[test]
    fn slopes_are_those_of_the_energy() {
        let points = [Point::new(1.0, 0.0, 0.2), Point::new(0.3, 1.0, 0.0), Point::new(0.0, 0.4, 1.0)];
        let springs = Springs::new(vec![spring()], &points, 1.0);
        let mut slopes = [Vector3::zeros(); 3];
        let energy = springs.pull(&points, &mut slopes);
        assert!(energy > 0.0);
        for (v, axis) in (0..3).flat_map(|v| (0..3).map(move |axis| (v, axis))) {
            let h = 1e-6;
            let moved = |by: f64| {
                let mut points = points;
                points[v][axis] += by;
                springs.pull(&points, &mut [Vector3::zeros(); 3])
            };
            assert!(((moved(h) - moved(-h)) / (2.0 * h) - slopes[v][axis]).abs() < 1e-6);
        }
    }

    #[test]
    fn nothing_pulls_within_the_slack_or_along_the_plane() {
        let spring = Spring { slack: 0.25, ..spring() };
        let across = Vector3::new(2.0, -2.0, 1.0);
        let points = [spring.at + across * 5.0 + spring.normal * 0.2; 3];
        let mut slopes = [Vector3::zeros(); 3];
        assert_eq!(Springs::new(vec![spring], &points, 1.0).pull(&points, &mut slopes), 0.0);
        assert_eq!(slopes, [Vector3::zeros(); 3]);
    }
}
