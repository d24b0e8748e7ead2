//! Fields of vectors on all threads, in pieces of fixed size, so that any number of threads gives the same bits.

use nalgebra::Vector3;
use rayon::prelude::*;

/// One vector a vertex.
pub(super) type Field = Vec<Vector3<f64>>;

/// Vectors a piece: some microseconds' work.
const PIECE: usize = 4096;

/// The sum of products.
pub(super) fn dot(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    if a.len() <= PIECE {
        return piece(a, b);
    }
    let pieces: Vec<f64> = a.par_chunks(PIECE).zip(b.par_chunks(PIECE)).map(|(a, b)| piece(a, b)).collect();
    pieces.iter().sum()
}

/// The sum of products on eight lanes.
fn piece(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    let mut lanes = [0.0; 8];
    for (a, b) in a.chunks(8).zip(b.chunks(8)) {
        for (lane, (a, b)) in lanes.iter_mut().zip(a.iter().zip(b)) {
            *lane += a.dot(b);
        }
    }
    lanes.iter().sum()
}

/// Changes every entry of `to` by its partner in `from`.
pub(super) fn update<T: Send, S: Sync>(to: &mut [T], from: &[S], change: impl Fn(&mut T, &S) + Sync) {
    if to.len() <= PIECE {
        return to.iter_mut().zip(from).for_each(|(t, f)| change(t, f));
    }
    to.par_iter_mut().zip(from).with_min_len(PIECE).for_each(|(t, f)| change(t, f));
}

/// Every entry of `from` with its partner in `with`.
pub(super) fn paired<T: Sync, S: Sync, U: Send>(from: &[T], with: &[S], pair: impl Fn(&T, &S) -> U + Sync) -> Vec<U> {
    if from.len() <= PIECE {
        return from.iter().zip(with).map(|(f, w)| pair(f, w)).collect();
    }
    from.par_iter().zip(with).with_min_len(PIECE).map(|(f, w)| pair(f, w)).collect()
}
