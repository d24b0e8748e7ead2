//! The surface of a set of cells around each lattice vertex: corners, manifoldness, components.
//!
//! The eight cells around a vertex are its octants. Which of them are solid is its pattern: bit
//! `x + 2y + 4z` stands for the octant on the positive side (1) or negative side (0) of each axis.

use super::voxels::Voxels;
use std::collections::VecDeque;

/// For each axis, the octants on its negative side.
const NEGATIVE: [u8; 3] = [0b0101_0101, 0b0011_0011, 0b0000_1111];

/// Whether octants in the set are connected through their faces.
const fn connected(set: u8) -> bool {
    if set == 0 {
        return true;
    }
    let mut reached = set & set.wrapping_neg();
    let mut round = 0;
    while round < 8 {
        let mut axis = 0;
        while axis < 3 {
            let (negative, shift) = (NEGATIVE[axis], 1 << axis);
            reached |= (((reached & negative) << shift) | ((reached & !negative) >> shift)) & set;
            axis += 1;
        }
        round += 1;
    }
    reached == set
}

/// Whether the surface around the vertex is a disc (or absent): solid and empty octants are
/// connected. Two octants that meet along an edge or at the vertex alone break one of the two.
const fn is_disc(pattern: u8) -> bool {
    connected(pattern) && connected(!pattern)
}

const DISC: [bool; 256] = {
    let mut table = [false; 256];
    let mut pattern = 0;
    while pattern < 256 {
        table[pattern] = is_disc(pattern as u8);
        pattern += 1;
    }
    table
};

/// Whether the surface is neither absent nor flat nor a straight edge: it differs along every axis.
fn is_corner(pattern: u8) -> bool {
    (0..3).all(|axis| (pattern >> (1 << axis)) & NEGATIVE[axis] != pattern & NEGATIVE[axis])
}

/// The smallest set of octants to fill, out of `free` ones, that makes `pattern` a disc.
fn repair(pattern: u8, free: u8) -> u8 {
    (0..=u8::MAX)
        .filter(|fill| fill & !free == 0 && DISC[usize::from(pattern | fill)])
        .min_by_key(|fill| (fill.count_ones(), *fill))
        .unwrap_or(free)
}

impl Voxels {
    /// Number of lattice vertices along each axis.
    fn vertices(&self) -> [usize; 3] {
        self.size().map(|n| n + 1)
    }

    fn vertex(&self, index: usize) -> [usize; 3] {
        let n = self.vertices();
        [index % n[0], index / n[0] % n[1], index / n[0] / n[1]]
    }

    /// The octant's cell around a vertex, where it lies inside the grid.
    fn octant(&self, vertex: [usize; 3], octant: usize) -> Option<usize> {
        let size = self.size();
        let mut cell = [0; 3];
        for axis in 0..3 {
            cell[axis] = (vertex[axis] + (octant >> axis & 1)).checked_sub(1)?;
            if cell[axis] >= size[axis] {
                return None;
            }
        }
        Some(self.index(cell))
    }

    /// The pattern of solid octants around a vertex, and the octants that lie inside the grid.
    fn pattern(&self, vertex: [usize; 3]) -> (u8, u8) {
        (0..8).fold((0, 0), |(solid, inside), o| {
            let Some(cell) = self.octant(vertex, o) else {
                return (solid, inside);
            };
            (solid | u8::from(self.solid[cell]) << o, inside | 1 << o)
        })
    }

    fn patterns(&self) -> impl Iterator<Item = u8> + '_ {
        let count = self.vertices().into_iter().product();
        (0..count).map(|i| self.pattern(self.vertex(i)).0)
    }

    /// Whether the surface is a closed manifold: no two solid cells, and no two empty ones, meet
    /// along an edge or at a vertex alone.
    pub fn is_manifold(&self) -> bool {
        self.patterns().all(|p| DISC[usize::from(p)])
    }

    /// Number of corners of the polycube: lattice vertices whose surface is neither flat nor a
    /// straight edge.
    pub fn corners(&self) -> usize {
        self.patterns().filter(|p| is_corner(*p)).count()
    }

    /// Fills the fewest cells around each offending vertex until the surface is manifold. The same
    /// cells are filled every time; solid cells stay, and connected sets stay connected.
    pub fn make_manifold(&mut self) {
        let count: usize = self.vertices().into_iter().product();
        let (mut all, mut waiting) = (0..count, VecDeque::new());
        while let Some(index) = all.next().or_else(|| waiting.pop_front()) {
            let vertex = self.vertex(index);
            let (pattern, inside) = self.pattern(vertex);
            if DISC[usize::from(pattern)] {
                continue;
            }
            let fill = repair(pattern, inside & !pattern);
            let filled = (0..8).filter(|o| fill >> o & 1 == 1);
            let cells: Vec<usize> = filled.filter_map(|o| self.octant(vertex, o)).collect();
            for cell in cells {
                self.solid[cell] = true;
                waiting.extend(self.vertices_of(cell));
            }
        }
    }

    fn vertices_of(&self, cell: usize) -> [usize; 8] {
        let n = self.vertices();
        let c = self.coordinates(cell);
        std::array::from_fn(|o| {
            let [x, y, z] = [0, 1, 2].map(|axis| c[axis] + (o >> axis & 1));
            x + n[0] * (y + n[1] * z)
        })
    }

    /// Number of components of the solid cells, connected through faces.
    pub fn components(&self) -> usize {
        self.component_sizes().1.len()
    }

    /// Empties every solid cell outside the largest component (by cells; the first among equals).
    pub(super) fn keep_largest(&mut self) {
        let (component, sizes) = self.component_sizes();
        let largest = (0..sizes.len()).max_by_key(|i| (sizes[*i], sizes.len() - i));
        for (solid, component) in self.solid.iter_mut().zip(component) {
            *solid &= Some(component) == largest;
        }
    }

    /// The component of each solid cell (`usize::MAX` for empty ones), and the cells in each.
    fn component_sizes(&self) -> (Vec<usize>, Vec<usize>) {
        let mut component = vec![usize::MAX; self.solid.len()];
        let mut sizes = Vec::new();
        for seed in 0..self.solid.len() {
            if self.solid[seed] && component[seed] == usize::MAX {
                let size = self.flood(seed, sizes.len(), &mut component);
                sizes.push(size);
            }
        }
        (component, sizes)
    }

    /// Marks the component of `seed` with `mark`; returns its number of cells.
    fn flood(&self, seed: usize, mark: usize, component: &mut [usize]) -> usize {
        let size = self.size();
        let strides = [1, size[0], size[0] * size[1]];
        let mut stack = vec![seed];
        component[seed] = mark;
        let mut count = 0;
        while let Some(cell) = stack.pop() {
            count += 1;
            let at = self.coordinates(cell);
            for axis in 0..3 {
                let before = (at[axis] > 0).then(|| cell - strides[axis]);
                let after = (at[axis] + 1 < size[axis]).then(|| cell + strides[axis]);
                for next in before.into_iter().chain(after) {
                    if self.solid[next] && component[next] == usize::MAX {
                        component[next] = mark;
                        stack.push(next);
                    }
                }
            }
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::super::voxels::Cuboid;
    use super::*;

    fn boxes(corners: &[[i64; 3]]) -> Voxels {
        let unit = |c: &[i64; 3]| Cuboid::new(*c, [c[0] + 1, c[1] + 1, c[2] + 1]);
        Voxels::from_boxes(&corners.iter().map(unit).collect::<Vec<_>>()).unwrap()
    }

    /// Counts the closed curves between solid and empty octants on a small sphere, crossing by
    /// crossing: 12 edges of the lattice sphere's dual around 6 half-axes.
    fn is_disc_by_curves(pattern: u8) -> bool {
        let solid = |o: usize| pattern >> o & 1 == 1;
        // Arcs between face-adjacent octants that differ; each ends at two of the six half-axes.
        let mut degree = [0; 6];
        let mut arcs = Vec::new();
        for o in 0..8_usize {
            for axis in (0..3).filter(|a| o >> a & 1 == 0 && solid(o) != solid(o | 1 << a)) {
                let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
                let ends = [u, v].map(|a| 2 * a + (o >> a & 1));
                ends.iter().for_each(|e| degree[*e] += 1);
                arcs.push(ends);
            }
        }
        if degree.iter().any(|d| *d > 2) {
            return false;
        }
        let mut root: Vec<usize> = (0..6).collect();
        for [a, b] in arcs {
            let (from, to) = (root[a], root[b]);
            root.iter_mut().filter(|r| **r == from).for_each(|r| *r = to);
        }
        let mut curves: Vec<usize> = (0..6).filter(|i| degree[*i] > 0).map(|i| root[i]).collect();
        curves.sort_unstable();
        curves.dedup();
        curves.len() <= 1
    }

    #[test]
    fn all_patterns_agree_with_the_curves_on_a_sphere() {
        for pattern in 0..=u8::MAX {
            assert_eq!(is_disc(pattern), is_disc_by_curves(pattern), "{pattern:08b}");
        }
    }

    #[test]
    fn cells_that_meet_in_less_than_a_face_are_found_and_joined() {
        for other in [[1, 1, 0], [1, 1, 1]] {
            let mut voxels = boxes(&[[0, 0, 0], other]);
            assert!(!voxels.is_manifold());
            assert_eq!(voxels.components(), 2);
            voxels.make_manifold();
            assert!(voxels.is_manifold());
            assert_eq!(voxels.components(), 1);
        }
    }

    #[test]
    fn empty_cells_that_meet_at_a_vertex_are_found() {
        let block = Cuboid::new([0; 3], [4; 3]);
        let holes = [[1; 3], [2; 3]].map(|c: [i64; 3]| Cuboid::new(c, c.map(|x| x + 1)));
        let mut voxels = Voxels::from_difference(&[block], &holes).unwrap();
        assert!(!voxels.is_manifold());
        voxels.make_manifold();
        assert!(voxels.is_manifold());
        assert_eq!(voxels.volume(), 63.0);
    }

    #[test]
    fn corners_are_neither_flat_nor_on_straight_edges() {
        assert_eq!(boxes(&[[0; 3]]).refined(0.25).unwrap().corners(), 8);
        // An L of three cubes has 12 corners; a tripod of four has 12 at its tips, 5 between its legs.
        assert_eq!(boxes(&[[0; 3], [1, 0, 0], [0, 1, 0]]).corners(), 12);
        assert_eq!(boxes(&[[0; 3], [1, 0, 0], [0, 1, 0], [0, 0, 1]]).corners(), 17);
        assert_eq!(boxes(&[]).corners(), 0);
    }

    #[test]
    fn the_largest_component_is_kept() {
        let mut voxels = boxes(&[[0; 3], [3, 0, 0], [4, 0, 0], [8, 0, 0]]);
        assert_eq!(voxels.components(), 3);
        voxels = voxels.refined(1.0).unwrap();
        voxels.keep_largest();
        assert_eq!((voxels.components(), voxels.volume()), (1, 2.0));
        assert_eq!(voxels.compressed().planes(0), [3.0, 5.0]);
    }
}
