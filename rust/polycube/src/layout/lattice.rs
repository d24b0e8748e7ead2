//! The coarsest lattice that a placed structure lies on: one plane per distinct level.

use crate::structure::{Arrangement, Structure};

/// Cells, faces and edges of the lattice spanned by the distinct levels, and what of them is solid.
///
/// Everything is indexed by the lattice vertex at its lower corner; the lattice has one unused layer of
/// empty cells at every side, so that neighbours always exist.
pub struct Lattice {
    /// The distinct coordinates along each axis, ascending.
    pub planes: [Vec<f64>; 3],
    /// Number of cells along each axis, the empty layers included.
    pub size: [usize; 3],
    solid: Vec<bool>,
}

impl Lattice {
    /// Spans the lattice and fills the inside of the polycube.
    ///
    /// `arrangement` must be free of conflicts. O(c) for c lattice cells.
    pub fn new(arrangement: &Arrangement) -> Self {
        let structure = arrangement.structure();
        let planes: [Vec<f64>; 3] = std::array::from_fn(|axis| planes(structure, arrangement.placement(), axis));
        let size = std::array::from_fn(|a| planes[a].len() + 1);
        let mut lattice = Self { planes, size, solid: Vec::new() };
        lattice.fill(arrangement);
        lattice
    }

    /// Index of the lattice vertex `(i, j, k)` and of the cell above it.
    pub fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.size[1] + j) * self.size[0] + i
    }

    /// The inverse of [`index`](Self::index).
    pub fn coordinates(&self, index: usize) -> [usize; 3] {
        let row = index / self.size[0];
        [index % self.size[0], row % self.size[1], row / self.size[1]]
    }

    /// Index distance of neighbours along `axis`.
    pub fn stride(&self, axis: usize) -> usize {
        [1, self.size[0], self.size[0] * self.size[1]][axis]
    }

    /// Number of cells, the empty layers included.
    pub fn len(&self) -> usize {
        self.solid.len()
    }

    /// Whether there is no cell; false, as the empty layers are always there.
    pub fn is_empty(&self) -> bool {
        self.solid.is_empty()
    }

    /// Whether cell `cell` lies inside the polycube.
    pub fn is_solid(&self, cell: usize) -> bool {
        self.solid[cell]
    }

    /// Whether the lattice face at the lower side of `cell` along `axis` lies inside the polycube.
    pub fn is_inner(&self, cell: usize, axis: usize) -> bool {
        self.solid[cell] && self.solid[cell - self.stride(axis)]
    }

    /// The lattice coordinate of a level's plane: the vertex `r` has the cell `r - 1` below it and `r` above.
    pub fn rank(&self, axis: usize, coordinate: f64) -> usize {
        self.planes[axis].partition_point(|&p| p < coordinate) + 1
    }

    /// Where the lattice vertex of the ranks `at` lies; every rank from 1 to the number of planes.
    pub fn position(&self, at: [usize; 3]) -> [f64; 3] {
        std::array::from_fn(|a| self.planes[a][at[a] - 1])
    }

    /// Puts +1 where the surface is entered along X and −1 where it is left, and sums along X.
    fn fill(&mut self, arrangement: &Arrangement) {
        let mut change = vec![0_i8; self.size.iter().product()];
        for (facet, low, high) in arrangement.tiles() {
            let label = arrangement.structure().facets[facet as usize].label;
            if label.axis() != 0 {
                continue;
            }
            let [i, j0, k0] = std::array::from_fn(|a| self.rank(a, low[a]));
            let [_, j1, k1] = std::array::from_fn(|a| self.rank(a, high[a]));
            for k in k0..k1 {
                for j in j0..j1 {
                    change[self.index([i, j, k])] -= label.sign();
                }
            }
        }
        let mut winding = 0;
        let inside = |change: i8| {
            winding += change;
            winding > 0
        };
        self.solid = change.into_iter().map(inside).collect();
    }
}

fn planes(structure: &Structure, placement: &[f64], axis: usize) -> Vec<f64> {
    let own = structure.levels.iter().zip(placement).filter(|(l, _)| l.axis == axis);
    let mut planes: Vec<f64> = own.map(|(_, &x)| x).collect();
    planes.sort_by(f64::total_cmp);
    planes.dedup();
    planes
}
