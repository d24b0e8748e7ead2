//! The energy of one element and its derivative.
//!
//! Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov: "Foldover-free maps in 50 lines of code", ACM TOG 2021.

use super::elements::Measure;
use super::quality::cofactors;
use nalgebra::{Matrix3, Vector3};

/// What is minimised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Law {
    /// `(1−θ) f + θ g` with `f = tr(Jᵀ J) / χ^(2/3)`, `g = (det² + 1) / χ` and `χ = (det + √(ε² + det²)) / 2`:
    /// finite for inverted elements.
    Regularised { theta: f64, epsilon: f64 },
    /// The same with `χ = det`, infinite unless `det` is positive, and `average / quality` added, which weighs on all elements, and
    /// `strength · (floor / quality)^(2^squarings)`, which weighs on those near the worst quality `floor`. All less its least
    /// value, so that gains can be compared with what is left.
    Barrier { theta: f64, average: f64, strength: f64, floor: f64, squarings: u32 },
}

impl Law {
    /// The energy of an element with the present `edges` and the `inverse` of its reference, and its
    /// derivative by the edges. Infinite with a derivative of 0 outside the domain.
    pub(super) fn value(&self, measure: Measure, edges: &Matrix3<f64>, inverse: &Matrix3<f64>) -> (f64, Matrix3<f64>) {
        let j = edges * inverse;
        match *self {
            Self::Regularised { theta, epsilon } => {
                let (energy, by_j) = distortion(&j, &cofactors(&j), theta, epsilon);
                (energy, by_j * inverse.transpose())
            }
            Self::Barrier { theta, average, strength, floor, squarings } => {
                let cofactors = cofactors(&j);
                if j.column(0).dot(&cofactors.column(0)) <= f64::MIN_POSITIVE {
                    return (f64::INFINITY, Matrix3::zeros());
                }
                let (energy, by_j) = distortion(&j, &cofactors, theta, 0.0);
                let energy = energy - (3.0 - theta);
                let (bad, slope) = match measure {
                    Measure::ScaledJacobian => skewness(edges),
                    Measure::MeanRatio => stretch(&j, inverse),
                };
                let (power, growth) = raise(floor * bad, squarings);
                let least = raise(floor, squarings).0;
                let badness = average * (bad - 1.0) + strength * (power - least);
                (energy + badness, by_j * inverse.transpose() + slope * (average + strength * growth * floor))
            }
        }
    }
}

/// `x^(2^n)` and its derivative, by squaring: the same on every machine.
fn raise(x: f64, squarings: u32) -> (f64, f64) {
    let power = (0..squarings).fold(x, |p, _| p * p);
    (power, if x > 0.0 { f64::from(1_u32 << squarings) * power / x } else { 0.0 })
}

/// `(1−θ) f + θ g` and its derivative by `J`.
fn distortion(j: &Matrix3<f64>, cofactors: &Matrix3<f64>, theta: f64, epsilon: f64) -> (f64, Matrix3<f64>) {
    let det = j.column(0).dot(&cofactors.column(0));
    let root = (epsilon * epsilon + det * det).sqrt();
    // Written so that nothing cancels on either side.
    let chi = if det > 0.0 { 0.5 * (det + root) } else { 0.5 * epsilon * epsilon / (root - det) };
    let cube = libm::cbrt(chi);
    let square = cube * cube;
    let f = j.norm_squared() / square;
    let g = (det * det + 1.0) / chi;
    // χ' = χ / √(ε² + det²).
    let by_det = theta * (2.0 * det / chi - g / root) - (1.0 - theta) * f / (1.5 * root);
    ((1.0 - theta) * f + theta * g, j * (2.0 * (1.0 - theta) / square) + cofactors * by_det)
}

/// One over the scaled Jacobian, and its derivative by the edges.
fn skewness(edges: &Matrix3<f64>) -> (f64, Matrix3<f64>) {
    let cofactors = cofactors(edges);
    let det = edges.column(0).dot(&cofactors.column(0));
    let squares = [0, 1, 2].map(|i| edges.column(i).norm_squared());
    let bad = squares.iter().map(|s| s.sqrt()).product::<f64>() / det;
    let slope = |i: usize| -> Vector3<f64> { (edges.column(i) / squares[i] - cofactors.column(i) / det) * bad };
    (bad, Matrix3::from_columns(&[slope(0), slope(1), slope(2)]))
}

/// One over the mean ratio, and its derivative by the edges.
fn stretch(j: &Matrix3<f64>, inverse: &Matrix3<f64>) -> (f64, Matrix3<f64>) {
    let (f, by_j) = distortion(j, &cofactors(j), 0.0, 0.0);
    (f / 3.0, by_j * inverse.transpose() / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const LAWS: [Law; 4] = [
        Law::Regularised { theta: 0.3, epsilon: 0.5 },
        Law::Regularised { theta: 0.0, epsilon: 1.0 },
        Law::Barrier { theta: 0.1, average: 0.7, strength: 2.0, floor: 0.3, squarings: 3 },
        Law::Barrier { theta: 0.5, average: 0.0, strength: 0.0, floor: 0.9, squarings: 0 },
    ];

    proptest! {
        #[test]
        fn derivatives_are_those_of_the_energy(at in prop::array::uniform9(-1.0..1.0_f64), r in prop::array::uniform3(0.5..2.0_f64)) {
            let (edges, inverse) = (Matrix3::from_row_slice(&at) + Matrix3::identity(), Matrix3::from_diagonal(&r.into()));
            let h = 1e-6;
            for (law, measure) in LAWS.into_iter().flat_map(|l| [(l, Measure::ScaledJacobian), (l, Measure::MeanRatio)]) {
                // Within reach of the barrier differences say nothing.
                prop_assume!(matches!(law, Law::Regularised { .. }) || edges.determinant() > 0.1);
                let (_, slope) = law.value(measure, &edges, &inverse);
                for i in 0..9 {
                    let moved = |by: f64| { let mut e = edges; e[i] += by; law.value(measure, &e, &inverse).0 };
                    let difference = (moved(h) - moved(-h)) / (2.0 * h);
                    let tolerance = 1e-5 * (1.0 + slope.norm() + moved(0.0));
                    prop_assert!((difference - slope[i]).abs() < tolerance, "{law:?} {measure:?} {difference} {}", slope[i]);
                }
            }
        }
    }

    #[test]
    fn right_boxes_and_similar_maps_are_at_rest() {
        let law = Law::Barrier { theta: 0.5, average: 1.0, strength: 1.0, floor: 1.0, squarings: 2 };
        for measure in [Measure::ScaledJacobian, Measure::MeanRatio] {
            let (energy, slope) = law.value(measure, &Matrix3::identity(), &Matrix3::identity());
            assert!(energy.abs() < 1e-12 && slope.norm() < 1e-12);
            assert_eq!(law.value(measure, &-Matrix3::identity(), &Matrix3::identity()).0, f64::INFINITY);
        }
    }
}
