//! Direct solution of a sparse symmetric system, where the iterative one gets nowhere.
//!
//! Own code for the reason that `krylov` is: the same bytes on every machine. Its sums have one order, whatever the
//! processor.

use super::cotangent::CHUNK;
use super::dissection::nested_dissection;
use super::sparse::{SparseRows, Values};
use crate::context::Context;
use crate::error::Result;

/// More entries than this (16 bytes each) are not asked for.
const MOST_ENTRIES: usize = 1 << 27;

/// No row.
const NONE: u32 = u32::MAX;

/// `P A Pᵀ = L D Lᵀ` for a symmetric positive definite `A`, row by row along the elimination tree (Liu 1986).
pub(super) struct Ldl {
    /// The row of `A` that is eliminated as each.
    order: Vec<u32>,
    /// Where each column of `L` begins in `rows` and `values`.
    start: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<f64>,
    /// One over each pivot.
    inverse: Vec<f64>,
}

impl Ldl {
    /// Factorises `a`. Nothing if a pivot is not positive, or if the factor would be larger than 2 GB.
    pub(super) fn new(a: &SparseRows, context: &Context) -> Result<Option<Self>> {
        let order = nested_dissection(a);
        let mut place = vec![NONE; a.len()];
        for (i, &row) in order.iter().enumerate() {
            place[row as usize] = i as u32;
        }
        let tree = Tree::new(a, &order, &place);
        let mut start = vec![0];
        start.extend(tree.counts.iter().scan(0, |sum: &mut usize, &count| {
            *sum += count;
            Some(*sum)
        }));
        let entries = start[order.len()];
        if entries > MOST_ENTRIES {
            return Ok(None);
        }
        let (rows, values) = (vec![0; entries], vec![0.0; entries]);
        let inverse = Vec::with_capacity(order.len());
        let mut ldl = Self { order, start, rows, values, inverse };
        Ok(ldl.eliminate(a, &place, &tree, context)?.then_some(ldl))
    }

    /// Computes all rows; false at a pivot that is not positive.
    fn eliminate(&mut self, a: &SparseRows, place: &[u32], tree: &Tree, context: &Context) -> Result<bool> {
        let mut end = self.start.clone();
        let mut work = vec![0.0; a.len()];
        let mut reach = Reach::new(a.len());
        for k in 0..a.len() {
            if k % CHUNK == 0 {
                context.check()?;
            }
            let mut pivot = 0.0;
            for (column, value) in a.row(self.order[k] as usize) {
                let i = place[column] as usize;
                match i.cmp(&k) {
                    std::cmp::Ordering::Less => work[i] = value,
                    std::cmp::Ordering::Equal => pivot = value,
                    std::cmp::Ordering::Greater => {}
                }
            }
            for &i in reach.of(k, a.row(self.order[k] as usize).map(|(column, _)| place[column]), tree) {
                pivot -= self.row_entry(k as u32, i as usize, &mut work, &mut end);
            }
            // Written so that a NaN is no pivot, either.
            let usable = pivot > 0.0 && pivot.is_finite();
            if !usable {
                return Ok(false);
            }
            self.inverse.push(1.0 / pivot);
        }
        Ok(true)
    }

    /// Computes and appends entry (k, i); returns what it takes off pivot k.
    fn row_entry(&mut self, k: u32, i: usize, work: &mut [f64], end: &mut [usize]) -> f64 {
        let value = std::mem::take(&mut work[i]);
        let range = self.start[i]..end[i];
        for (&row, factor) in self.rows[range.clone()].iter().zip(&self.values[range]) {
            work[row as usize] -= factor * value;
        }
        let factor = value * self.inverse[i];
        self.rows[end[i]] = k;
        self.values[end[i]] = factor;
        end[i] += 1;
        factor * value
    }

    /// `A⁻¹ b`.
    pub(super) fn solve<const N: usize>(&self, b: &[Values<N>]) -> Vec<Values<N>> {
        let mut y: Vec<Values<N>> = self.order.iter().map(|&row| b[row as usize]).collect();
        for i in 0..y.len() {
            let value = y[i];
            for (row, factor) in self.column(i) {
                for k in 0..N {
                    y[row][k] -= factor * value[k];
                }
            }
        }
        for i in (0..y.len()).rev() {
            let mut value = y[i].map(|v| v * self.inverse[i]);
            for (row, factor) in self.column(i) {
                for k in 0..N {
                    value[k] -= factor * y[row][k];
                }
            }
            y[i] = value;
        }
        let mut x = vec![[0.0; N]; y.len()];
        for (&row, y) in self.order.iter().zip(y) {
            x[row as usize] = y;
        }
        x
    }

    /// Row and value of the entries below the diagonal of column `i` of `L`.
    fn column(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.start[i]..self.start[i + 1];
        let rows = self.rows[range.clone()].iter().map(|&row| row as usize);
        rows.zip(self.values[range].iter().copied())
    }
}

/// The elimination tree: the parent of a column is the first row below its diagonal.
struct Tree {
    parent: Vec<u32>,
    /// The number of entries below the diagonal of each column.
    counts: Vec<usize>,
}

impl Tree {
    fn new(a: &SparseRows, order: &[u32], place: &[u32]) -> Self {
        let (mut parent, mut counts) = (vec![NONE; order.len()], vec![0; order.len()]);
        let mut mark = vec![NONE; order.len()];
        for (k, &row) in order.iter().enumerate() {
            mark[k] = k as u32;
            for (column, _) in a.row(row as usize).filter(|&(column, _)| (place[column] as usize) < k) {
                let mut i = place[column] as usize;
                while mark[i] != k as u32 {
                    mark[i] = k as u32;
                    counts[i] += 1;
                    if parent[i] == NONE {
                        parent[i] = k as u32;
                    }
                    i = parent[i] as usize;
                }
            }
        }
        Self { parent, counts }
    }
}

/// Finds which columns have an entry in a row.
struct Reach {
    mark: Vec<u32>,
    columns: Vec<u32>,
    path: Vec<u32>,
}

impl Reach {
    fn new(size: usize) -> Self {
        Self { mark: vec![NONE; size], columns: Vec::new(), path: Vec::new() }
    }

    /// The columns with an entry in row `k`, each before those that need it: what lies in the tree between the entries
    /// of the matrix and `k`.
    fn of(&mut self, k: usize, entries: impl Iterator<Item = u32>, tree: &Tree) -> &[u32] {
        let k = k as u32;
        self.columns.clear();
        self.mark[k as usize] = k;
        for first in entries.filter(|&i| i < k) {
            let mut i = first;
            while self.mark[i as usize] != k {
                self.mark[i as usize] = k;
                self.path.push(i);
                i = tree.parent[i as usize];
            }
            // Found from the leaves up, and each path ends on one before: turned round, later paths come first.
            self.columns.extend(self.path.drain(..).rev());
        }
        self.columns.reverse();
        &self.columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::SplitMix64;
    use nalgebra::{DMatrix, DVector};

    /// A symmetric matrix on a ring with random chords, positive definite as its diagonal dominates.
    fn matrix(n: u32, seed: u64) -> SparseRows {
        let mut random = SplitMix64::new(seed);
        let mut rows = vec![Vec::new(); n as usize];
        for i in 0..n {
            for j in [(i + 1) % n, (random.unit() * f64::from(n)) as u32] {
                let weight = random.unit();
                for (i, j) in [(i, j), (j, i)] {
                    rows[i as usize].extend([(j, -weight), (i, 1.01 * weight)]);
                }
            }
        }
        let mut a = SparseRows::new();
        rows.iter_mut().for_each(|row| a.push(row));
        a
    }

    #[test]
    fn agrees_with_a_dense_solver() {
        for seed in 0..20 {
            let n = 3 + 7 * seed as usize;
            let a = matrix(n as u32, seed);
            let mut dense = DMatrix::zeros(n, n);
            for i in 0..n {
                a.row(i).for_each(|(j, value)| dense[(i, j)] = value);
            }
            let side = DVector::from_fn(n, |i, _| (i % 5) as f64 - 1.0);
            let expected = dense.cholesky().unwrap().solve(&side);
            let b: Vec<_> = side.iter().map(|&b| [b, -2.0 * b]).collect();
            let x = Ldl::new(&a, &Context::default()).unwrap().unwrap().solve(&b);
            for (x, e) in x.iter().zip(&expected) {
                let scale = 1e-10 * expected.amax();
                assert!((x[0] - e).abs() <= scale && (x[1] + 2.0 * e).abs() <= 2.0 * scale);
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_definite_is_not_factorised() {
        let mut a = SparseRows::new();
        a.push(&mut vec![(0, 1.0), (1, 2.0)]);
        a.push(&mut vec![(0, 2.0), (1, 1.0)]);
        assert!(Ldl::new(&a, &Context::default()).unwrap().is_none());
    }
}
