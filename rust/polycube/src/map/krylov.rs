//! Iterative solution of a sparse linear system for several right-hand sides at once.
//!
//! An own solver of a hundred lines, because results must be the same bytes on every machine and
//! with any number of threads: libraries that choose their vector instructions at run time round
//! differently from one processor to the next. It runs on one thread; what is saved instead is
//! memory traffic, by taking all right-hand sides through the matrix together.

use super::ilu::Ilu;
use super::sparse::{SparseRows, Values};
use crate::context::Context;
use crate::error::Result;

/// Relative residual one run aims for, by the recursion.
const GOAL: f64 = 1e-11;
/// Relative residual that is enough, computed afresh after a run.
pub(super) const ENOUGH: f64 = 1e-10;
/// Relative residual after a run from which no further one comes back.
const DIVERGED: f64 = 1e3;
/// Below this cosine between shadow and residual, rounding alone says where the next direction leads: a run ends there,
/// and the next one casts a new shadow. Symmetric polycubes come to it.
const ORTHOGONAL: f64 = 1e-12;
/// Most iterations in one run.
const ITERATIONS: usize = 2000;

/// The solution of `A x = b` as far as at most `iterations` come, by the stabilised bi-conjugate gradients of van der
/// Vorst (1992), preconditioned from the right by [`Ilu`].
///
/// # Errors
/// [`ErrorKind::Cancelled`](crate::error::ErrorKind::Cancelled).
pub(super) fn solve<const N: usize>(
    a: &SparseRows,
    b: &[Values<N>],
    iterations: usize,
    context: &Context,
) -> Result<Vec<Values<N>>> {
    let ilu = Ilu::new(a, context)?;
    let size = norms(b);
    let mut x = vec![[0.0; N]; b.len()];
    let mut used = 0;
    while used < iterations {
        let residual = residual(a, b, &x);
        let left = worst(&norms(&residual), &size);
        if left <= ENOUGH || left > DIVERGED || left.is_nan() {
            break;
        }
        used += Run::new(a, &ilu, residual, size).iterate(&mut x, (iterations - used).min(ITERATIONS), context)?;
    }
    Ok(x)
}

/// The largest residual of a column, relative to its right-hand side.
pub(super) fn relative_residual<const N: usize>(a: &SparseRows, b: &[Values<N>], x: &[Values<N>]) -> f64 {
    worst(&norms(&residual(a, b, x)), &norms(b))
}

/// One run of the method, with a fresh shadow residual.
struct Run<'a, const N: usize> {
    a: &'a SparseRows,
    ilu: &'a Ilu,
    /// Norms of the right-hand sides.
    size: Values<N>,
    /// Columns still to be improved. A column stops when it is good or when the method breaks down on it.
    open: [bool; N],
    residual: Vec<Values<N>>,
    shadow: Vec<Values<N>>,
    /// Norms of the columns of the shadow.
    cast: Values<N>,
    direction: Vec<Values<N>>,
    /// A times the preconditioned direction.
    image: Vec<Values<N>>,
    /// Preconditioned direction or residual.
    smooth: Vec<Values<N>>,
    /// A times the preconditioned residual.
    second: Vec<Values<N>>,
    rho: Values<N>,
}

impl<'a, const N: usize> Run<'a, N> {
    fn new(a: &'a SparseRows, ilu: &'a Ilu, residual: Vec<Values<N>>, size: Values<N>) -> Self {
        let zero = vec![[0.0; N]; residual.len()];
        let found = norms(&residual);
        Self {
            a,
            ilu,
            size,
            open: std::array::from_fn(|k| found[k] > GOAL * size[k]),
            shadow: residual.clone(),
            cast: found,
            direction: residual.clone(),
            rho: dots(&residual, &residual),
            residual,
            image: zero.clone(),
            smooth: zero.clone(),
            second: zero,
        }
    }

    /// Improves `x` until every column is good or broken down, or for so many iterations; returns how many, at least
    /// one.
    fn iterate(mut self, x: &mut [Values<N>], iterations: usize, context: &Context) -> Result<usize> {
        for used in 0..iterations {
            if self.open == [false; N] {
                return Ok(used.max(1));
            }
            self.step(x, context)?;
        }
        Ok(iterations)
    }

    fn step(&mut self, x: &mut [Values<N>], context: &Context) -> Result<()> {
        self.ilu.apply(&self.direction, &mut self.smooth);
        self.a.multiply(&self.smooth, &mut self.image);
        let alpha = self.ratio(&self.rho, &dots(&self.shadow, &self.image));
        add(x, &alpha, &self.smooth);
        add(&mut self.residual, &alpha.map(|a| -a), &self.image);
        context.tick(self.progress())?;
        self.ilu.apply(&self.residual, &mut self.smooth);
        self.a.multiply(&self.smooth, &mut self.second);
        let omega = self.ratio(&dots(&self.second, &self.residual), &dots(&self.second, &self.second));
        add(x, &omega, &self.smooth);
        add(&mut self.residual, &omega.map(|o| -o), &self.second);
        self.turn(&alpha, &omega);
        context.tick(self.progress())
    }

    /// The next direction; closes the columns that are good or have broken down.
    fn turn(&mut self, alpha: &Values<N>, omega: &Values<N>) {
        let rho = dots(&self.shadow, &self.residual);
        let (back, along) = (self.ratio(&rho, &self.rho), self.ratio(alpha, omega));
        for ((p, r), v) in self.direction.iter_mut().zip(&self.residual).zip(&self.image) {
            for k in 0..N {
                p[k] = r[k] + back[k] * along[k] * (p[k] - omega[k] * v[k]);
            }
        }
        self.rho = rho;
        let found = norms(&self.residual);
        for k in 0..N {
            let moving = along[k] != 0.0 && self.rho[k].abs() > ORTHOGONAL * self.cast[k] * found[k];
            self.open[k] &= moving && found[k] > GOAL * self.size[k];
        }
    }

    /// `a / b` where the column is open and the quotient a number, else 0, which leaves a column as it is.
    fn ratio(&self, a: &Values<N>, b: &Values<N>) -> Values<N> {
        std::array::from_fn(|k| {
            let ratio = a[k] / b[k];
            if self.open[k] && ratio.is_finite() { ratio } else { 0.0 }
        })
    }

    /// The number of digits gained over the number wanted.
    fn progress(&self) -> f64 {
        let left = worst(&norms(&self.residual), &self.size);
        // `max` turns the NaN of a failed run into 0.
        (left.ln() / GOAL.ln()).max(0.0)
    }
}

pub(super) fn residual<const N: usize>(a: &SparseRows, b: &[Values<N>], x: &[Values<N>]) -> Vec<Values<N>> {
    let mut r = vec![[0.0; N]; b.len()];
    a.multiply(x, &mut r);
    for (r, b) in r.iter_mut().zip(b) {
        *r = std::array::from_fn(|k| b[k] - r[k]);
    }
    r
}

fn dots<const N: usize>(a: &[Values<N>], b: &[Values<N>]) -> Values<N> {
    let mut sum = [0.0; N];
    for (a, b) in a.iter().zip(b) {
        for k in 0..N {
            sum[k] += a[k] * b[k];
        }
    }
    sum
}

fn norms<const N: usize>(a: &[Values<N>]) -> Values<N> {
    dots(a, a).map(f64::sqrt)
}

/// `y += f x`, each column with its own factor.
fn add<const N: usize>(y: &mut [Values<N>], f: &Values<N>, x: &[Values<N>]) {
    for (y, x) in y.iter_mut().zip(x) {
        for k in 0..N {
            y[k] += f[k] * x[k];
        }
    }
}

/// The largest quotient of the columns; a column of zero size is solved by zero.
fn worst<const N: usize>(found: &Values<N>, size: &Values<N>) -> f64 {
    let columns = found.iter().zip(size).filter(|(_, s)| **s > 0.0);
    // Not `max`, which would overlook a NaN.
    columns.map(|(f, s)| f / s).fold(0.0, |m, q| if q <= m { m } else { q })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::SplitMix64;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    /// An unsymmetric M-matrix on a ring with random chords, grounded at every seventh row.
    fn matrix(n: u32, random: &mut SplitMix64) -> SparseRows {
        let mut a = SparseRows::new();
        for i in 0..n {
            let ends = [(i + 1) % n, (i + n - 1) % n, (random.unit() * f64::from(n)) as u32];
            let mut row: Vec<_> = ends.iter().filter(|&&j| j != i).map(|&j| (j, -random.unit())).collect();
            let sum: f64 = row.iter().map(|e| -e.1).sum();
            row.push((i, sum + if i % 7 == 0 { 0.5 } else { 0.0 }));
            a.push(&mut row);
        }
        a
    }

    proptest! {
        #[test]
        fn agrees_with_a_dense_solver(seed in any::<u64>(), n in 8_u32..60) {
            let mut random = SplitMix64::new(seed);
            let a = matrix(n, &mut random);
            let n = n as usize;
            let b: Vec<_> = (0..n).map(|_| [random.unit(), 0.0, random.unit() - 0.5]).collect();
            let x = solve(&a, &b, 2000, &Context::default()).unwrap();
            let mut dense = DMatrix::zeros(n, n);
            for i in 0..n {
                for (j, v) in a.row(i) {
                    dense[(i, j)] = v;
                }
            }
            let lu = dense.lu();
            for k in 0..3 {
                let expected = lu.solve(&DVector::from_iterator(n, b.iter().map(|b| b[k]))).unwrap();
                let error = expected.iter().zip(&x).fold(0.0_f64, |m, (e, x)| m.max((e - x[k]).abs()));
                prop_assert!(error <= 1e-7 * expected.amax(), "column {k}: {error:e}");
            }
        }
    }
}
