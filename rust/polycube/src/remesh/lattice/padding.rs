//! Layers of hexahedra around the lattice, so that singular edges lie inside (paper, section 7).

use super::grid::Grid;

/// The part of the lattice cells at the surface that padding takes. Below 1/2, so that a part of the polycube one cell
/// wide keeps a cell between its paddings, and below 1/3, so that the cell in a hollow corner is not turned over.
const SHARE: f64 = 0.25;

/// Which way is inward at every surface vertex of a lattice, and how wide layers can be.
pub(crate) struct Padding {
    /// The vertices on the surface, ascending.
    pub(crate) ring: Vec<u32>,
    /// For every vertex of the ring a step inward along every axis: −1, 0 or 1.
    inward: Vec<[f64; 3]>,
    /// For every vertex of the lattice its place in `ring`.
    place: Vec<u32>,
    layers: usize,
}

impl Padding {
    /// Finds the surface and its directions. Linear time.
    pub(crate) fn new(grid: &Grid, layers: usize) -> Self {
        let ring = grid.surface_vertices();
        let mut place = vec![u32::MAX; grid.vertices.len()];
        for (i, &v) in (0..).zip(&ring) {
            place[v as usize] = i;
        }
        let inward = directions(grid, &ring, &place);
        Self { ring, inward, place, layers }
    }

    /// Where vertex `i` of the ring lies under `depth` layers, in lattice units: depth 0 is the surface.
    ///
    /// All layers together take [`SHARE`] of the lattice cells at the surface.
    pub(crate) fn position(&self, grid: &Grid, i: usize, depth: usize) -> [f64; 3] {
        let part = SHARE * depth as f64 / self.layers as f64;
        let at = grid.position(self.ring[i] as usize);
        std::array::from_fn(|a| at[a] + part * self.inward[i][a])
    }

    /// The number in a layer of the vertex over the lattice vertex `v`; layer 0 is the lattice. Of a vertex inside
    /// the lattice only layer 0 makes sense.
    pub(crate) fn number(&self, grid: &Grid, v: u32, layer: usize) -> u32 {
        match layer {
            0 => v,
            _ => (grid.vertices.len() + (layer - 1) * self.ring.len()) as u32 + self.place[v as usize],
        }
    }

    /// The hexahedra of the layers, from the lattice outward, layer by layer for every square of the surface, the
    /// square each belongs to, and whether its layer is the outermost.
    pub(crate) fn hexes<'a>(&'a self, grid: &'a Grid) -> impl Iterator<Item = ([u32; 8], usize, bool)> + 'a {
        let hex = move |square: &[u32; 4], layer: usize| -> [u32; 8] {
            std::array::from_fn(|k| self.number(grid, square[k % 4], layer + k / 4))
        };
        let squares = grid.squares.iter().enumerate();
        squares.flat_map(move |(s, square)| {
            (0..self.layers).map(move |layer| (hex(&square.vertices, layer), s, layer + 1 == self.layers))
        })
    }
}

/// Against the sum of the directions of the facets at each vertex; where they cancel out, to the middle of the cells.
fn directions(grid: &Grid, ring: &[u32], place: &[u32]) -> Vec<[f64; 3]> {
    let mut seen = vec![0_u8; ring.len()];
    for square in &grid.squares {
        let bit = 1 << square.label.index();
        square.vertices.iter().for_each(|&v| seen[place[v as usize] as usize] |= bit);
    }
    let mut middle = vec![[0.0; 3]; ring.len()];
    for cell in 0..grid.hexes.len() {
        for (octant, v) in grid.octants(cell).into_iter().enumerate() {
            if let Some(sum) = middle.get_mut(place[v as usize] as usize) {
                (0..3).for_each(|a| sum[a] += if octant >> a & 1 == 1 { -1.0 } else { 1.0 });
            }
        }
    }
    let step = |seen: u8, a: usize| f64::from(seen >> (2 * a + 1) & 1) - f64::from(seen >> (2 * a) & 1);
    let direction = |(seen, middle): (u8, [f64; 3])| match std::array::from_fn(|a| step(seen, a)) {
        [0.0, 0.0, 0.0] => middle.map(|x: f64| if x == 0.0 { 0.0 } else { x.signum() }),
        inward => inward,
    };
    seen.into_iter().zip(middle).map(direction).collect()
}
