//! Exact signs of the two determinants the triangulation asks for.
//!
//! Points are whole numbers held as `f64`. A sign is read off the floating-point determinant where its
//! error bound allows, else off the same determinant in 128-bit integers: lattice points are
//! cospherical all the time, so zero is a common answer and has to be exact.

use std::ops::{Add, Mul, Sub};

/// A site: whole numbers in `0..=2^31`.
pub(super) type Point = [f64; 3];

/// Up to this difference of coordinates no intermediate of [`in_sphere`] exceeds 2^53: `72 · 650^5 < 2^53`.
const EXACT_SPHERE: f64 = 650.0;
/// The same for [`orient`]: `6 · 100_000^3 < 2^53`.
const EXACT_ORIENT: f64 = 100_000.0;
/// Relative to the fifth power of the largest difference: at most 12 roundings of terms that sum to 72.
const ERROR_SPHERE: f64 = 1024.0 * HALF_ULP;
/// Relative to the third power of the largest difference: at most 5 roundings of terms that sum to 6.
const ERROR_ORIENT: f64 = 32.0 * HALF_ULP;
const HALF_ULP: f64 = f64::EPSILON / 2.0;

/// Bits per limb of a squared length: a limb times a minor stays below 2^120.
const LIMB: u32 = 22;

trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {}
impl Number for f64 {}
impl Number for i128 {}

/// The sign of the volume of `abcd`: +1, 0 where they are coplanar, or −1. No two coordinates are further apart than
/// `extent`.
pub(super) fn orient([a, b, c, d]: [Point; 4], extent: f64) -> i32 {
    let rows = [a, b, c].map(|q| minus(q, d));
    let det = det3(rows);
    if extent <= EXACT_ORIENT {
        return sign(det);
    }
    let size = largest(&rows);
    if size <= EXACT_ORIENT || det.abs() > ERROR_ORIENT * size * size * size {
        return sign(det);
    }
    det3(rows.map(|row| row.map(whole))).signum() as i32
}

/// Where `e` lies for the positively oriented `abcd`: +1 inside the circumsphere, 0 on it, −1 outside. No two
/// coordinates are further apart than `extent`.
pub(super) fn in_sphere(cell: [Point; 4], e: Point, extent: f64) -> i32 {
    let rows = cell.map(|q| minus(q, e));
    let m = minors(&rows);
    let [a, b, c, d] = std::array::from_fn(|i| m[i] * dot(rows[i]));
    let det = (b + a) + (d + c);
    if extent <= EXACT_SPHERE {
        return sign(det);
    }
    let size = largest(&rows);
    if size <= EXACT_SPHERE || det.abs() > ERROR_SPHERE * (size * size) * (size * size) * size {
        return sign(det);
    }
    in_sphere_exact(rows.map(|row| row.map(whole)))
}

/// The sphere determinant needs up to 162 bits, so the squared lengths go in limb by limb.
fn in_sphere_exact(rows: [[i128; 3]; 4]) -> i32 {
    let m = minors(&rows);
    let lengths = rows.map(dot);
    let limb = |k: u32| -> i128 {
        let mask = (1 << LIMB) - 1;
        (0..4).map(|i| m[i] * (lengths[i] >> (k * LIMB) & mask)).sum()
    };
    // Shifts round down, so what is left behind is never negative and only breaks a tie at zero.
    let low = limb(0);
    let middle = limb(1) + (low >> LIMB);
    let high = limb(2) + (middle >> LIMB);
    let rest = (low | middle) & ((1 << LIMB) - 1);
    if high == 0 { rest.signum() as i32 } else { high.signum() as i32 }
}

/// The cofactors of the column of squared lengths.
fn minors<T: Number>([a, b, c, d]: &[[T; 3]; 4]) -> [T; 4] {
    let (ab, bc, cd) = (cross(a, b), cross(b, c), cross(c, d));
    let (ad, ac, bd) = (cross(a, d), cross(a, c), cross(b, d));
    [
        c[2] * bd - b[2] * cd - d[2] * bc,
        a[2] * cd - c[2] * ad + d[2] * ac,
        b[2] * ad - a[2] * bd - d[2] * ab,
        a[2] * bc - b[2] * ac + c[2] * ab,
    ]
}

fn det3<T: Number>([a, b, c]: [[T; 3]; 3]) -> T {
    a[2] * cross(&b, &c) - b[2] * cross(&a, &c) + c[2] * cross(&a, &b)
}

/// The z component of the cross product.
fn cross<T: Number>(p: &[T; 3], q: &[T; 3]) -> T {
    p[0] * q[1] - q[0] * p[1]
}

fn dot<T: Number>(a: [T; 3]) -> T {
    a[0] * a[0] + a[1] * a[1] + a[2] * a[2]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn largest(rows: &[Point]) -> f64 {
    let max = |a: f64, b: f64| if a > b { a } else { b };
    let axis = |k: usize| rows.iter().fold(0.0, |m, row| max(m, row[k].abs()));
    max(max(axis(0), axis(1)), axis(2))
}

fn whole(x: f64) -> i128 {
    i128::from(x as i64)
}

fn sign(x: f64) -> i32 {
    i32::from(x > 0.0) - i32::from(x < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::{BigInt, Sign};
    use proptest::prelude::*;

    /// Laplace expansion along the first row.
    fn det(rows: &[Vec<BigInt>]) -> BigInt {
        let minor = |k: usize| {
            let without = |row: &Vec<BigInt>| [&row[..k], &row[k + 1..]].concat();
            det(&rows[1..].iter().map(without).collect::<Vec<_>>())
        };
        let terms = (0..rows.len()).map(|k| match k % 2 {
            _ if rows.len() == 1 => rows[0][0].clone(),
            0 => &rows[0][k] * minor(k),
            _ => -&rows[0][k] * minor(k),
        });
        terms.sum()
    }

    fn expected(points: &[Point], lifted: bool) -> i32 {
        let row = |p: &Point| {
            let p = p.map(|x| BigInt::from(x as i64));
            let length: BigInt = p.iter().map(|x| x * x).sum();
            let mut row = p.to_vec();
            row.extend(lifted.then_some(length));
            row.push(1.into());
            row
        };
        match det(&points.iter().map(row).collect::<Vec<_>>()).sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        }
    }

    fn assert_signs(p: [Point; 5]) {
        let [a, b, c, d, e] = p;
        let extent = p.iter().flatten().fold(0.0_f64, |m, &x| m.max(x));
        assert_eq!(orient([a, b, c, d], extent), expected(&p[..4], false));
        assert_eq!(in_sphere([a, b, c, d], e, extent), expected(&p, true));
    }

    fn points(limit: i64) -> impl Strategy<Value = [Point; 5]> {
        let point = || prop::array::uniform3(0..=limit).prop_map(|p| p.map(|x| x as f64));
        prop::array::uniform5(point())
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn small_signs_are_exact(p in points(3)) {
            assert_signs(p);
        }

        #[test]
        fn large_signs_are_exact(p in points(1 << 31)) {
            assert_signs(p);
        }

        /// Corners of one box and a last point at most a step off: the hardest signs.
        #[test]
        fn signs_near_zero_are_exact(
            sides in prop::array::uniform3(1_i64..1 << 31),
            corners in prop::array::uniform5(0_u8..8),
            step in prop::array::uniform3(-1_i64..2),
            shrink in 0_u32..31,
        ) {
            let sides = sides.map(|x| (x >> shrink) + 1);
            let corner = |i: u8| [0, 1, 2].map(|k| if i >> k & 1 == 1 { sides[k] as f64 } else { 1.0 });
            let mut p = corners.map(corner);
            assert_signs(p);
            for k in 0..3 {
                p[4][k] += step[k] as f64;
            }
            assert_signs(p);
        }
    }
}
