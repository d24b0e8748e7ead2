//! Barycentric coordinates in triangles of the plane and in tetrahedra.

use nalgebra::{Vector2, Vector3};

/// Coordinates of a point in a simplex: they add up to 1; nothing for a flat simplex.
pub(crate) struct Barycentric<const N: usize> {
    pub(crate) weights: [f64; N],
    /// Whether the simplex is oriented as it should.
    pub(crate) positive: bool,
}

impl<const N: usize> Barycentric<N> {
    /// 0 on the simplex's border, above inside, below outside.
    pub(crate) fn depth(&self) -> f64 {
        self.weights.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The coordinates of a point of the simplex close to a point outside.
    pub(crate) fn clamped(&self) -> [f64; N] {
        let positive = self.weights.map(|w| w.max(0.0));
        let sum: f64 = positive.iter().sum();
        positive.map(|w| w / sum)
    }
}

/// Coordinates of `p` in a triangle.
pub(crate) fn in_triangle(p: [f64; 2], corners: [[f64; 2]; 3]) -> Option<Barycentric<3>> {
    let p = Vector2::from(p);
    let [a, b, c] = corners.map(|c| Vector2::from(c) - p);
    let parts = [b.perp(&c), c.perp(&a), a.perp(&b)];
    normalise(parts)
}

/// Coordinates of `p` in a tetrahedron.
pub(crate) fn in_tetrahedron(p: [f64; 3], corners: [[f64; 3]; 4]) -> Option<Barycentric<4>> {
    let p = Vector3::from(p);
    let [a, b, c, d] = corners.map(|c| Vector3::from(c) - p);
    let det = |x: &Vector3<f64>, y: &Vector3<f64>, z: &Vector3<f64>| x.cross(y).dot(z);
    // Each part is six times the volume of the tetrahedron with `p` in place of one corner.
    normalise([det(&b, &c, &d), -det(&a, &c, &d), det(&a, &b, &d), -det(&a, &b, &c)])
}

fn normalise<const N: usize>(parts: [f64; N]) -> Option<Barycentric<N>> {
    let sum: f64 = parts.iter().sum();
    let weights = parts.map(|w| w / sum);
    weights.iter().all(|w| w.is_finite()).then_some(Barycentric { weights, positive: sum > 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_and_centres() {
        let triangle = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]];
        let found = in_triangle([0.5, 1.0], triangle).unwrap();
        assert!(found.positive);
        assert_eq!(found.weights, [0.25, 0.25, 0.5]);
        let tetrahedron = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
        let found = in_tetrahedron([1.0; 3], tetrahedron).unwrap();
        assert!(found.positive);
        assert_eq!(found.weights, [0.25; 4]);
        let outside = in_tetrahedron([-1.0, 0.0, 0.0], tetrahedron).unwrap();
        assert!(outside.depth() < 0.0);
        assert_eq!(outside.clamped(), [1.0, 0.0, 0.0, 0.0]);
        assert!(in_triangle([0.0, 0.0], [[1.0, 1.0]; 3]).is_none());
    }
}
