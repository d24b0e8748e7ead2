//! The energy of elements and its derivative.
//!
//! All of it depends on the edges `E` of an element through `tr(Jᵀ J)`, `det J` and the lengths of the edges, where `J
//! = E R` for the inverse `R` of the edges it should have. So the derivative is a sum of three fields: `E R Rᵀ`, the
//! cofactors of `E`, and the edges.
//!
//! Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov: "Foldover-free maps in 50 lines of code", ACM TOG 2021.

use super::elements::{Measure, Reference};
use super::lanes::{Lanes, Vectors, combine, cross, dot, three};
use crate::measure::AIM;
use std::ops::Add;

/// What is minimised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Law {
    /// `(1−θ) f + θ g` with `f = tr(Jᵀ J) / χ^(2/3)`, `g = (det² + 1) / χ` and `χ = (det + √(ε² + det²)) / 2`:
    /// finite for inverted elements.
    Regularised { theta: f64, epsilon: f64 },
    /// The same with `χ = det`, infinite unless `det` is positive, and `average / quality` added, which weighs on all
    /// elements, and `strength · (floor / quality)^(2^squarings)`, which weighs on those near the worst quality
    /// `floor`. For scaled Jacobians the same power also weighs on determinants near or below `small` and on edges of
    /// unlike lengths. All but these less its least value, so that gains can be compared with what is left.
    Barrier { theta: f64, average: f64, strength: f64, floor: f64, squarings: u32, small: f64 },
}

/// One over twice the square of the ratio of edges that counts as bad as a scaled Jacobian of 1: what three edges'
/// squares and the inverses of these come to where one is much longer or shorter than the others.
const UNLIKE: f64 = 0.5 / (AIM.ratio * AIM.ratio);

/// An energy and its derivatives by `tr(Jᵀ J)`, by `det J`, and by half the square of each edge's length.
struct Parts {
    energy: Lanes,
    by_trace: Lanes,
    by_det: Lanes,
    by_squares: Vectors,
}

impl Add for Parts {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            energy: self.energy + other.energy,
            by_trace: self.by_trace + other.by_trace,
            by_det: self.by_det + other.by_det,
            by_squares: three(|k| self.by_squares[k] + other.by_squares[k]),
        }
    }
}

impl Law {
    /// The energies of elements with these `edges`, and their derivatives by the edges; nothing when one of them is
    /// infinite.
    #[inline(always)]
    pub(super) fn value(
        &self,
        measure: Measure,
        edges: &[Vectors; 3],
        reference: &Reference<Lanes>,
    ) -> Option<(Lanes, [Vectors; 3])> {
        let [xx, yy, zz, yz, xz, xy] = reference.metric;
        let metric = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let pulls = three(|k| combine(edges, metric[k]));
        let cofactors = three(|k| cross(edges[(k + 1) % 3], edges[(k + 2) % 3]));
        let det = dot(edges[0], cofactors[0]) * reference.det;
        let trace = dot(pulls[0], edges[0]) + dot(pulls[1], edges[1]) + dot(pulls[2], edges[2]);
        let parts = match *self {
            Self::Regularised { theta, epsilon } => regularised(trace, det, theta, epsilon),
            Self::Barrier { theta, average, strength, floor, squarings, small } => {
                if !det.above(f64::MIN_POSITIVE) {
                    return None;
                }
                let raised = Raised { trace, inverse: det.inverse(), shrink: shrink(det) };
                let penalty = Penalty { average, strength, floor, squarings };
                raised.distortion(det, theta)
                    + match measure {
                        Measure::ScaledJacobian => {
                            raised.unsoundness(edges, reference.det * small, reference.det, &penalty)
                        }
                        Measure::MeanRatio => raised.stretch(&penalty),
                    }
            }
        };
        let by_cofactors = parts.by_det * reference.det;
        let slopes = three(|k| {
            combine(&[pulls[k], cofactors[k], edges[k]], [parts.by_trace * 2.0, by_cofactors, parts.by_squares[k]])
        });
        Some((parts.energy, slopes))
    }
}

/// `χ^(−2/3)`.
#[inline(always)]
fn shrink(chi: Lanes) -> Lanes {
    let root = chi.inverse_cbrt();
    root * root
}

/// `(1−θ) f + θ g`.
#[inline(always)]
fn regularised(trace: Lanes, det: Lanes, theta: f64, epsilon: f64) -> Parts {
    let root = (det * det + Lanes::all(epsilon * epsilon)).sqrt();
    // Written so that nothing cancels on either side.
    let large = (root + det.map(f64::abs)) * 0.5;
    let small = large.inverse() * (0.25 * epsilon * epsilon);
    let chi = Lanes::each(|i| if det.0[i] > 0.0 { large.0[i] } else { small.0[i] });
    let (shrink, inverse) = (shrink(chi), chi.inverse());
    let f = trace * shrink;
    let g = (det * det + Lanes::all(1.0)) * inverse;
    // χ' = χ / √(ε² + det²).
    let falling = (g * theta + f * ((1.0 - theta) / 1.5)) * root.inverse();
    Parts {
        energy: f * (1.0 - theta) + g * theta,
        by_trace: shrink * (1.0 - theta),
        by_det: det * inverse * (2.0 * theta) - falling,
        by_squares: [Lanes::all(0.0); 3],
    }
}

/// What the parts of the barrier share.
struct Raised {
    trace: Lanes,
    /// `1 / det`.
    inverse: Lanes,
    /// `det^(−2/3)`.
    shrink: Lanes,
}

impl Raised {
    /// `(1−θ) f + θ g` for `χ = det`, less its least value.
    #[inline(always)]
    fn distortion(&self, det: Lanes, theta: f64) -> Parts {
        let (f, g) = (self.trace * self.shrink, det + self.inverse);
        Parts {
            energy: f * (1.0 - theta) + g * theta - Lanes::all(3.0 - theta),
            by_trace: self.shrink * (1.0 - theta),
            by_det: Lanes::all(2.0 * theta) - (g * theta + f * ((1.0 - theta) / 1.5)) * self.inverse,
            by_squares: [Lanes::all(0.0); 3],
        }
    }

    /// The penalties on one over the scaled Jacobian, on determinants below `small`, and on edges of unlike lengths;
    /// `scale` is `det R`.
    #[inline(always)]
    fn unsoundness(&self, edges: &[Vectors; 3], small: Lanes, scale: Lanes, penalty: &Penalty) -> Parts {
        let squares = three(|k| dot(edges[k], edges[k]));
        let others = three(|k| squares[(k + 1) % 3] * squares[(k + 2) % 3]);
        let product = squares[0] * others[0];
        let inverse = product.inverse();
        let bad = product.sqrt() * self.inverse * scale;
        let (skewed, slope) = penalty.value(bad);
        let skewness = slope * bad;
        let (tiny, slope) = penalty.worst(small * self.inverse);
        let tininess = slope * small * self.inverse;
        // Their sum times the sum of their inverses.
        let (sum, sum_of_inverses) =
            (squares[0] + squares[1] + squares[2], (others[0] + others[1] + others[2]) * inverse);
        let (slender, slope) = penalty.worst_square(sum * sum_of_inverses * UNLIKE, 9.0 * UNLIKE);
        let slope = slope * (2.0 * UNLIKE);
        let by_squares = three(|k| {
            let inverse = others[k] * inverse;
            inverse * skewness + slope * (sum_of_inverses - sum * inverse * inverse)
        });
        let by_det = (skewness + tininess) * self.inverse * -1.0;
        Parts { energy: skewed + tiny + slender, by_trace: Lanes::all(0.0), by_det, by_squares }
    }

    /// The penalty on one over the mean ratio.
    #[inline(always)]
    fn stretch(&self, penalty: &Penalty) -> Parts {
        let bad = self.trace * self.shrink * (1.0 / 3.0);
        let (energy, slope) = penalty.value(bad);
        Parts {
            energy,
            by_trace: slope * self.shrink * (1.0 / 3.0),
            by_det: slope * bad * self.inverse * (-1.0 / 1.5),
            by_squares: [Lanes::all(0.0); 3],
        }
    }
}

/// What one over the quality costs, see [`Law::Barrier`].
struct Penalty {
    average: f64,
    strength: f64,
    floor: f64,
    squarings: u32,
}

impl Penalty {
    /// The penalty less its least value, and its derivative.
    #[inline(always)]
    fn value(&self, bad: Lanes) -> (Lanes, Lanes) {
        let (power, growth) = raise(bad * self.floor, self.squarings);
        let (least, _) = raise(Lanes::all(self.floor), self.squarings);
        let energy = (bad - Lanes::all(1.0)) * self.average + (power - least) * self.strength;
        (energy, growth * (self.strength * self.floor) + Lanes::all(self.average))
    }

    /// The penalty on the worst alone, and its derivative.
    #[inline(always)]
    fn worst(&self, bad: Lanes) -> (Lanes, Lanes) {
        let (power, growth) = raise(bad * self.floor, self.squarings);
        (power * self.strength, growth * (self.strength * self.floor))
    }

    /// The same of its square, less that at its `least` value.
    #[inline(always)]
    fn worst_square(&self, bad: Lanes, least: f64) -> (Lanes, Lanes) {
        let square = self.floor * self.floor;
        let squarings = self.squarings.saturating_sub(1);
        let (power, growth) = raise(bad * square, squarings);
        let (least, _) = raise(Lanes::all(least * square), squarings);
        ((power - least) * self.strength, growth * (self.strength * square))
    }
}

/// `x^(2^n)` and its derivative, by squaring: the same on every machine.
#[inline(always)]
fn raise(x: Lanes, squarings: u32) -> (Lanes, Lanes) {
    let (mut power, mut growth) = (x, Lanes::all(1.0));
    for _ in 0..squarings {
        growth = growth * power * 2.0;
        power = power * power;
    }
    (power, growth)
}

#[cfg(test)]
mod tests {
    use super::super::lanes::LANES;
    use super::*;
    use nalgebra::Matrix3;
    use proptest::array::{uniform3, uniform9};
    use proptest::prelude::*;

    const LAWS: [Law; 4] = [
        Law::Regularised { theta: 0.3, epsilon: 0.5 },
        Law::Regularised { theta: 0.0, epsilon: 1.0 },
        Law::Barrier { theta: 0.1, average: 0.7, strength: 2.0, floor: 0.3, squarings: 3, small: 0.4 },
        Law::Barrier { theta: 0.5, average: 0.0, strength: 0.0, floor: 0.9, squarings: 1, small: 0.1 },
    ];

    /// Energy and derivative of elements that are all alike, in the first lane.
    fn value(law: &Law, measure: Measure, edges: &Matrix3<f64>, rest: &Matrix3<f64>) -> (f64, Matrix3<f64>) {
        let Reference { metric, det } = Reference::new(rest);
        let reference = Reference { metric: metric.map(Lanes::all), det: Lanes::all(det) };
        let columns = [0, 1, 2].map(|k| [0, 1, 2].map(|axis| Lanes::all(edges[(axis, k)])));
        let Some((energy, slope)) = law.value(measure, &columns, &reference) else {
            return (f64::INFINITY, Matrix3::zeros());
        };
        assert_eq!(energy, Lanes([energy.0[0]; LANES]));
        (energy.0[0], Matrix3::from_fn(|axis, k| slope[k][axis].0[0]))
    }

    proptest! {
        #[test]
        fn derivatives_are_those_of_the_energy(
            at in uniform9(-1.0..1.0_f64),
            r in uniform3(0.5..2.0_f64),
            shear in uniform3(-0.5..0.5_f64),
        ) {
            let edges = Matrix3::from_row_slice(&at) + Matrix3::identity();
            let rest = Matrix3::new(r[0], shear[0], shear[1], 0.0, r[1], shear[2], 0.0, 0.0, r[2]);
            let h = 1e-6;
            let measures = [Measure::ScaledJacobian, Measure::MeanRatio];
            for (law, measure) in LAWS.into_iter().flat_map(|l| measures.map(|m| (l, m))) {
                // Within reach of the barrier differences say nothing.
                prop_assume!(matches!(law, Law::Regularised { .. }) || edges.determinant() > 0.1);
                let (_, slope) = value(&law, measure, &edges, &rest);
                for i in 0..9 {
                    let moved = |by: f64| { let mut e = edges; e[i] += by; value(&law, measure, &e, &rest).0 };
                    let difference = (moved(h) - moved(-h)) / (2.0 * h);
                    let tolerance = 1e-5 * (1.0 + slope.norm() + moved(0.0));
                    let error = (difference - slope[i]).abs();
                    prop_assert!(error < tolerance, "{law:?} {measure:?} {difference} {}", slope[i]);
                }
            }
        }
    }

    #[test]
    fn right_boxes_and_similar_maps_are_at_rest() {
        let law = Law::Barrier { theta: 0.5, average: 1.0, strength: 1.0, floor: 1.0, squarings: 2, small: 0.0 };
        for measure in [Measure::ScaledJacobian, Measure::MeanRatio] {
            let (energy, slope) = value(&law, measure, &Matrix3::identity(), &Matrix3::identity());
            assert!(energy.abs() < 1e-12 && slope.norm() < 1e-12);
            assert_eq!(value(&law, measure, &-Matrix3::identity(), &Matrix3::identity()).0, f64::INFINITY);
        }
    }
}
