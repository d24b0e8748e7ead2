//! Numbers side by side, so that one instruction works on several elements: plain arrays, which the compiler turns into
//! vector instructions. Every lane has the bits it would have alone.

use std::ops::{Add, Mul, Sub};

/// Elements side by side.
pub(super) const LANES: usize = 4;

/// One number of each element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lanes(pub(super) [f64; LANES]);

/// One vector of each element.
pub(super) type Vectors = [Lanes; 3];

impl Lanes {
    #[inline(always)]
    pub(super) fn each(f: impl Fn(usize) -> f64) -> Self {
        let mut all = [0.0; LANES];
        (0..LANES).for_each(|i| all[i] = f(i));
        Self(all)
    }

    #[inline(always)]
    pub(super) fn all(x: f64) -> Self {
        Self([x; LANES])
    }

    #[inline(always)]
    pub(super) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self::each(|i| f(self.0[i]))
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    #[inline(always)]
    pub(super) fn inverse(self) -> Self {
        self.map(|x| 1.0 / x)
    }

    /// Whether every lane is above `x`; NaN is not.
    #[inline(always)]
    pub(super) fn above(self, x: f64) -> bool {
        self.0.iter().fold(true, |all, l| all & (*l > x))
    }

    /// One over the cubic root of positive normal numbers, to a few units in the last place: a guess from the exponent
    /// and four steps of Newton's method, which have no division.
    #[inline(always)]
    pub(super) fn inverse_cbrt(self) -> Self {
        let third = self * (1.0 / 3.0);
        let mut root = self.map(|x| f64::from_bits(0x553e_f0ff_289d_d794 - x.to_bits() / 3));
        for _ in 0..4 {
            root = root * (Self::all(4.0 / 3.0) - third * (root * root * root));
        }
        root
    }
}

impl Add for Lanes {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::each(|i| self.0[i] + other.0[i])
    }
}

impl Sub for Lanes {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::each(|i| self.0[i] - other.0[i])
    }
}

impl Mul for Lanes {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::each(|i| self.0[i] * other.0[i])
    }
}

impl Mul<f64> for Lanes {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.map(|x| x * factor)
    }
}

#[inline(always)]
pub(super) fn dot(a: Vectors, b: Vectors) -> Lanes {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn cross(a: Vectors, b: Vectors) -> Vectors {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Three things at once; unlike `map` of arrays always unrolled.
#[inline(always)]
pub(super) fn three<T>(f: impl Fn(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}

/// The sum of three vectors, each times its factor.
#[inline(always)]
pub(super) fn combine(vectors: &[Vectors; 3], by: [Lanes; 3]) -> Vectors {
    three(|k| vectors[0][k] * by[0] + vectors[1][k] * by[1] + vectors[2][k] * by[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubic_roots_are_exact_but_for_rounding() {
        for i in -600..600 {
            let x = libm::exp(f64::from(i)) * 1.7;
            let Lanes(roots) = Lanes::each(|k| x * (1.0 + k as f64)).inverse_cbrt();
            for (k, root) in roots.into_iter().enumerate() {
                let right = 1.0 / libm::cbrt(x * (1.0 + k as f64));
                assert!((root / right - 1.0).abs() < 1e-14, "{x} {root} {right}");
            }
        }
        let least = Lanes::all(f64::MIN_POSITIVE).inverse_cbrt();
        assert!((least.0[0] * libm::cbrt(f64::MIN_POSITIVE) - 1.0).abs() < 1e-14);
    }
}
