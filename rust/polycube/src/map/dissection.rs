//! Nested dissection: an order of elimination with little fill for the matrices of meshes.

use super::sparse::SparseRows;

/// A set of so few rows is not cut further.
const LEAF: usize = 16;

/// The rows of `a`, whose pattern is symmetric, in an order of elimination with little fill (George 1973; George and
/// Liu 1978): what a level of a breadth-first search cuts apart comes before that level.
///
/// Time: n log n for n rows of a mesh. The fill of a surface is of that size, too.
pub(super) fn nested_dissection(a: &SparseRows) -> Vec<u32> {
    let mut search = Search { a, set: vec![0; a.len()], seen: vec![0; a.len()], searches: 0 };
    let mut backwards = Vec::with_capacity(a.len());
    let mut sets = vec![(0..a.len() as u32).collect::<Vec<_>>()];
    let mut number = 0;
    while let Some(rows) = sets.pop() {
        if rows.len() <= LEAF {
            backwards.extend(rows);
            continue;
        }
        number += 1;
        for &row in &rows {
            search.set[row as usize] = number;
        }
        for component in search.components(&rows, number) {
            let Some([before, separator, after]) = search.cut(&component, number) else {
                backwards.extend(component);
                continue;
            };
            backwards.extend(separator);
            sets.extend([before, after]);
        }
    }
    backwards.reverse();
    backwards
}

/// Breadth-first searches within sets of rows.
struct Search<'a> {
    a: &'a SparseRows,
    /// The number of the set of each row.
    set: Vec<u32>,
    /// The last search that came to each row.
    seen: Vec<u32>,
    searches: u32,
}

impl Search<'_> {
    /// The connected parts of the set `number`, which holds `rows`.
    fn components(&mut self, rows: &[u32], number: u32) -> Vec<Vec<u32>> {
        self.searches += 1;
        let mut found = Vec::new();
        for &row in rows {
            if self.seen[row as usize] != self.searches {
                found.push(self.levels(row, number).concat());
            }
        }
        found
    }

    /// What comes before a short level in the middle of a connected part of the set, that level, and what comes after
    /// it; nothing where there are too few levels.
    fn cut(&mut self, component: &[u32], number: u32) -> Option<[Vec<u32>; 3]> {
        self.searches += 1;
        // The row that is reached last lies at an end.
        let levels = self.levels(*component.last()?, number);
        let (mut passed, mut best) = (0, None);
        for (i, level) in levels.iter().enumerate() {
            let middle = passed + level.len() / 2;
            passed += level.len();
            let within = (component.len() / 3..=component.len() * 2 / 3).contains(&middle);
            let shorter = best.is_none_or(|b: usize| level.len() < levels[b].len());
            best = if within && shorter { Some(i) } else { best };
        }
        let at = best.filter(|&at| at > 0 && at + 1 < levels.len())?;
        Some([levels[..at].concat(), levels[at].clone(), levels[at + 1..].concat()])
    }

    /// The rows of the set `number` that this search has not seen, by their distance from `first`.
    fn levels(&mut self, first: u32, number: u32) -> Vec<Vec<u32>> {
        self.seen[first as usize] = self.searches;
        let mut levels = vec![vec![first]];
        loop {
            let mut next = Vec::new();
            for &row in &levels[levels.len() - 1] {
                for (column, _) in self.a.row(row as usize) {
                    if self.set[column] == number && self.seen[column] != self.searches {
                        self.seen[column] = self.searches;
                        next.push(column as u32);
                    }
                }
            }
            if next.is_empty() {
                return levels;
            }
            levels.push(next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of `n` by `n` and, apart from it, a path of `n` rows.
    fn grid_and_path(n: u32) -> SparseRows {
        let mut a = SparseRows::new();
        for i in 0..n * n + n {
            let mut row = vec![(i, 4.0)];
            let (x, in_grid) = (i % n, i < n * n);
            row.extend((x > 0).then(|| (i - 1, -1.0)));
            row.extend((x + 1 < n).then(|| (i + 1, -1.0)));
            row.extend((in_grid && i >= n).then(|| (i - n, -1.0)));
            row.extend((in_grid && i + n < n * n).then(|| (i + n, -1.0)));
            a.push(&mut row);
        }
        a
    }

    /// Entries of the factor by eliminating the graph, without any theory.
    fn fill(a: &SparseRows, order: &[u32]) -> usize {
        let mut left: Vec<std::collections::BTreeSet<usize>> =
            (0..a.len()).map(|i| a.row(i).map(|(j, _)| j).filter(|&j| j != i).collect()).collect();
        let mut count = 0;
        for &v in order {
            let around = std::mem::take(&mut left[v as usize]);
            count += around.len();
            for &i in &around {
                left[i].extend(around.iter().filter(|&&j| j != i));
                left[i].remove(&(v as usize));
            }
        }
        count
    }

    #[test]
    fn every_row_comes_once_and_the_fill_is_far_below_that_of_a_band() {
        let n = 40;
        let a = grid_and_path(n);
        let order = nested_dissection(&a);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().copied().eq(0..n * n + n));
        let as_numbered: Vec<u32> = (0..n * n + n).collect();
        assert!(2 * fill(&a, &order) < fill(&a, &as_numbered));
    }
}
