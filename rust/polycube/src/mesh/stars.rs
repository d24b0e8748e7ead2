//! Which cells a vertex has.

/// For every vertex the cells that use it, ascending.
pub(crate) struct Stars {
    /// Of each vertex, where its cells start in `cells`.
    starts: Vec<usize>,
    cells: Vec<u32>,
}

impl Stars {
    /// The stars of so many `vertices` in cells that name each of their vertices once. Linear time.
    pub(crate) fn new<C: IntoIterator<Item = u32>>(vertices: usize, cells: impl Iterator<Item = C> + Clone) -> Self {
        let mut starts = vec![0; vertices + 1];
        cells.clone().flatten().for_each(|v| starts[v as usize + 1] += 1);
        (0..vertices).for_each(|v| starts[v + 1] += starts[v]);
        let mut next = starts.clone();
        let mut around = vec![0; starts[vertices]];
        for (i, cell) in (0..).zip(cells) {
            for v in cell {
                around[next[v as usize]] = i;
                next[v as usize] += 1;
            }
        }
        Self { starts, cells: around }
    }

    /// The cells around a vertex.
    pub(crate) fn of(&self, vertex: usize) -> &[u32] {
        &self.cells[self.starts[vertex]..self.starts[vertex + 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_list_cells_in_order() {
        let stars = Stars::new(5, [[0, 1, 2], [2, 1, 3]].into_iter());
        assert_eq!(stars.of(1), [0, 1]);
        assert_eq!(stars.of(3), [1]);
        assert!(stars.of(4).is_empty());
    }
}
