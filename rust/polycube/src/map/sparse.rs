//! Sparse matrices by rows.

/// One value per right-hand side.
pub(crate) type Values<const N: usize> = [f64; N];

/// A sparse matrix by rows; the columns of a row ascend.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SparseRows {
    start: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl SparseRows {
    /// A matrix without rows.
    pub(crate) fn new() -> Self {
        Self { start: vec![0], ..Self::default() }
    }

    /// Adds the next row: sorts `entries` by column, sums those of one column in the order given,
    /// and leaves `entries` empty.
    pub(crate) fn push(&mut self, entries: &mut Vec<(u32, f64)>) {
        let first = self.columns.len();
        // Stable, so that rounding depends on the order of the cells alone.
        entries.sort_by_key(|&(column, _)| column);
        for (column, value) in entries.drain(..) {
            if self.columns.len() > first && self.columns.last() == Some(&column) {
                let last = self.values.len() - 1;
                self.values[last] += value;
            } else {
                self.columns.push(column);
                self.values.push(value);
            }
        }
        self.start.push(self.columns.len());
    }

    /// Number of rows.
    pub(super) fn len(&self) -> usize {
        self.start.len() - 1
    }

    /// Where row `i` lies in [`columns`](Self::columns) and [`values`](Self::values).
    pub(super) fn range(&self, i: usize) -> std::ops::Range<usize> {
        self.start[i]..self.start[i + 1]
    }

    /// Columns of all entries, row by row.
    pub(super) fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// Values of all entries, row by row.
    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// Values of all entries, to change.
    pub(super) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Column and value of the entries of row `i`.
    pub(super) fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.range(i);
        let columns = self.columns[range.clone()].iter();
        columns.map(|&c| c as usize).zip(self.values[range].iter().copied())
    }

    /// `y = A x`.
    pub(super) fn multiply<const N: usize>(&self, x: &[Values<N>], y: &mut [Values<N>]) {
        for (i, out) in y.iter_mut().enumerate() {
            let mut sum = [0.0; N];
            for (j, a) in self.row(i) {
                add_scaled(&mut sum, a, &x[j]);
            }
            *out = sum;
        }
    }
}

/// `sum += a x`.
#[inline]
pub(super) fn add_scaled<const N: usize>(sum: &mut Values<N>, a: f64, x: &Values<N>) {
    for k in 0..N {
        sum[k] += a * x[k];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_sort_and_sum_their_entries() {
        let mut rows = SparseRows::new();
        rows.push(&mut vec![(2, 1.0), (0, 2.0), (2, 3.0)]);
        rows.push(&mut vec![]);
        rows.push(&mut vec![(2, 5.0)]);
        assert_eq!(rows.row(0).collect::<Vec<_>>(), [(0, 2.0), (2, 4.0)]);
        let mut y = vec![[0.0; 2]; 3];
        rows.multiply(&[[1.0, 2.0], [9.0, 9.0], [10.0, 1.0]], &mut y);
        assert_eq!(y, [[42.0, 8.0], [0.0, 0.0], [50.0, 5.0]]);
    }
}
