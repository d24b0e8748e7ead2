//! Solution of a sparse linear system: iterative, and direct where that gets nowhere.

use super::krylov::{self, ENOUGH, relative_residual};
use super::ldl::Ldl;
use super::sparse::{SparseRows, Values, add_scaled};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};

/// Relative residual that is still returned when rounding allows no better.
const ACCEPTABLE: f64 = 1e-6;
/// Iterations before a matrix that can be factorised is. A surface of 180,000 vertices takes 115.
const PATIENCE: usize = 1000;
/// Iterations before giving up on one that cannot.
const ITERATIONS: usize = 40_000;
/// Two entries across the diagonal differ by less than this part of themselves in a symmetric matrix, whose sums may
/// have been added up in another order.
const ASYMMETRY: f64 = 1e-12;

/// Solves `A x = b` to a relative residual of 1e-10 in each column: iteratively, or, where a symmetric matrix has so
/// different entries that this takes too long or ends too early, by its factorisation.
///
/// # Errors
/// [`ErrorKind::Internal`] if the residual stays above 1e-6; [`ErrorKind::Cancelled`].
pub(super) fn solve<const N: usize>(a: &SparseRows, b: &[Values<N>], context: &Context) -> Result<Vec<Values<N>>> {
    let symmetric = is_symmetric(a);
    let x = krylov::solve(a, b, if symmetric { PATIENCE } else { ITERATIONS }, context)?;
    let left = relative_residual(a, b, &x);
    if left <= ENOUGH {
        return Ok(x);
    }
    let (x, left) = if symmetric { directly(a, b, (x, left), context)? } else { (x, left) };
    if left <= ACCEPTABLE {
        return Ok(x);
    }
    let message = format!("the Laplace problem was solved to {left:.0e} only");
    Err(Error::new(ErrorKind::Internal, message)
        .remedy("look for extremely thin triangles or tetrahedra in the polycube"))
}

/// The better of a solution with its residual and that of a factorisation, improved once by its own residual.
fn directly<const N: usize>(
    a: &SparseRows,
    b: &[Values<N>],
    found: (Vec<Values<N>>, f64),
    context: &Context,
) -> Result<(Vec<Values<N>>, f64)> {
    let Some(factors) = Ldl::new(a, context)? else { return Ok(found) };
    let first = factors.solve(b);
    let correction = factors.solve(&krylov::residual(a, b, &first));
    let mut second = first.clone();
    for (x, c) in second.iter_mut().zip(&correction) {
        add_scaled(x, 1.0, c);
    }
    let measured = [first, second].map(|x| {
        let left = relative_residual(a, b, &x);
        (x, left)
    });
    // Written so that a NaN is no improvement.
    Ok(measured.into_iter().fold(found, |best, next| if next.1 < best.1 || best.1.is_nan() { next } else { best }))
}

fn is_symmetric(a: &SparseRows) -> bool {
    let across = |i: usize, j: usize| a.row(j).find(|&(k, _)| k == i).map_or(0.0, |(_, value)| value);
    let alike = |i: usize, (j, value): (usize, f64)| (value - across(i, j)).abs() <= ASYMMETRY * value.abs();
    (0..a.len()).all(|i| a.row(i).all(|entry| alike(i, entry)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::SplitMix64;

    #[test]
    fn a_singular_system_is_an_error() {
        let mut a = SparseRows::new();
        a.push(&mut vec![(0, 1.0), (1, -1.0)]);
        a.push(&mut vec![(0, -1.0), (1, 1.0)]);
        let error = solve(&a, &[[1.0], [1.0]], &Context::default()).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Internal);
    }

    /// A plate whose grid lines lie from 1 down to 1e-5 apart, with a value held around it.
    fn uneven_plate(n: u32) -> (SparseRows, Vec<Values<1>>) {
        let mut random = SplitMix64::new(7);
        let mut gaps = || (0..=n).map(|_| libm::exp(-11.5 * random.unit())).collect::<Vec<_>>();
        let (wide, high) = (gaps(), gaps());
        let (mut a, mut b) = (SparseRows::new(), Vec::new());
        for i in 0..n * n {
            let (x, y) = ((i % n) as usize, (i / n) as usize);
            let width = 0.5 * (wide[x] + wide[x + 1]);
            let height = 0.5 * (high[y] + high[y + 1]);
            let weights = [height / wide[x], height / wide[x + 1], width / high[y], width / high[y + 1]];
            let last = n - 1;
            let inside = [x > 0, x as u32 != last, y > 0, y as u32 != last];
            let ends = [i.wrapping_sub(1), i + 1, i.wrapping_sub(n), i + n];
            let held = weights.iter().zip(inside).filter(|(_, inside)| !inside).map(|(w, _)| w * value_beside(i)).sum();
            let mut row = vec![(i, weights.iter().sum())];
            row.extend((0..4).filter(|&k| inside[k]).map(|k| (ends[k], -weights[k])));
            a.push(&mut row);
            b.push([held]);
        }
        (a, b)
    }

    fn value_beside(i: u32) -> f64 {
        SplitMix64::new(u64::from(i)).unit()
    }

    #[test]
    fn where_iterating_gets_nowhere_the_factorisation_does() {
        let (a, b) = uneven_plate(60);
        let iterated = krylov::solve(&a, &b, PATIENCE, &Context::default()).unwrap();
        assert!(relative_residual(&a, &b, &iterated) > ENOUGH);
        let x = solve(&a, &b, &Context::default()).unwrap();
        let mut square = 0.0;
        for (i, b) in b.iter().enumerate() {
            let left = b[0] - a.row(i).map(|(j, value)| value * x[j][0]).sum::<f64>();
            square += left * left;
        }
        let size: f64 = b.iter().map(|b| b[0] * b[0]).sum();
        assert!(square.sqrt() <= ENOUGH * size.sqrt(), "{:e}", (square / size).sqrt());
        // A mean of what is held around it.
        assert!(x.iter().all(|x| (0.0..=1.0).contains(&x[0])));
    }
}
