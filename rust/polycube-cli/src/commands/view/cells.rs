//! The pieces of a layout: blocks, their faces on the surface, and patches, by the planes between them.

use polycube::layout::{Block, Complex, Lattice, Patch, Separatrices};
use polycube::structure::Arrangement;
use std::collections::BTreeMap;

/// A rectangle of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tile {
    /// The facet it lies in.
    pub facet: u32,
    /// The block behind it, or the number of the patch.
    pub id: u32,
    /// The lower corner, by the numbers of its planes from 0.
    pub low: [usize; 3],
    /// The upper corner.
    pub high: [usize; 3],
}

/// Blocks, their faces and the patches of one placement.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    /// The coordinates of the planes along each axis.
    pub planes: [Vec<f64>; 3],
    /// The blocks: lower and upper corner, by the numbers of their planes from 0.
    pub blocks: Vec<[[usize; 3]; 2]>,
    /// The faces of the blocks on the surface.
    pub faces: Vec<Tile>,
    /// The patches.
    pub patches: Vec<Tile>,
}

impl Pieces {
    /// Cuts a placement without conflicts.
    pub fn new(arrangement: &Arrangement) -> Self {
        let lattice = Lattice::new(arrangement);
        let complex = Complex::new(&lattice, arrangement);
        let (blocks, facets) = (complex.blocks(), Facets::new(&lattice, arrangement));
        let owners = owners(&lattice, &blocks);
        let patches = Separatrices::new(&lattice, arrangement).patches();
        let faces = complex.surface_faces();
        Self {
            faces: faces.iter().map(|p| facets.tile(p, owners[behind(&lattice, p)])).collect(),
            patches: (0..).zip(&patches).map(|(id, p)| facets.tile(p, id)).collect(),
            blocks: blocks.iter().map(|b| [b.low, b.high].map(|corner| corner.map(|r| r - 1))).collect(),
            planes: lattice.planes,
        }
    }
}

/// The block of every lattice cell.
fn owners(lattice: &Lattice, blocks: &[Block]) -> Vec<u32> {
    let mut owners = vec![0; lattice.len()];
    for (id, block) in (0..).zip(blocks) {
        for k in block.low[2]..block.high[2] {
            for j in block.low[1]..block.high[1] {
                let row = lattice.index([block.low[0], j, k]);
                owners[row..row + block.high[0] - block.low[0]].fill(id);
            }
        }
    }
    owners
}

/// The solid cell at the lower corner of a patch.
fn behind(lattice: &Lattice, patch: &Patch) -> usize {
    let cell = lattice.index(patch.low);
    if patch.label.sign() > 0 { cell - lattice.stride(patch.label.axis()) } else { cell }
}

/// Rectangles of a facet by the ranks of their corners, with the number of the facet.
type Covers = Vec<([usize; 3], [usize; 3], u32)>;

/// Finds the facet that a rectangle lies in.
struct Facets(BTreeMap<(usize, usize), Covers>);

impl Facets {
    fn new(lattice: &Lattice, arrangement: &Arrangement) -> Self {
        let mut covers: BTreeMap<_, Covers> = BTreeMap::new();
        let rank = |at: [f64; 3]| -> [usize; 3] { std::array::from_fn(|a| lattice.rank(a, at[a])) };
        for (facet, low, high) in arrangement.tiles() {
            let label = arrangement.structure().facets[facet as usize].label;
            let (low, high) = (rank(low), rank(high));
            covers.entry((label.index(), low[label.axis()])).or_default().push((low, high, facet));
        }
        Self(covers)
    }

    fn tile(&self, patch: &Patch, id: u32) -> Tile {
        let key = (patch.label.index(), patch.low[patch.label.axis()]);
        let holds = |low: &[usize; 3], high: &[usize; 3]| {
            (0..3).all(|a| low[a] <= patch.low[a] && (patch.low[a] < high[a] || low[a] == high[a]))
        };
        let mut around = self.0.get(&key).into_iter().flatten();
        let facet = around.find(|(low, high, _)| holds(low, high)).map_or(0, |c| c.2);
        Tile { facet, id, low: patch.low.map(|r| r - 1), high: patch.high.map(|r| r - 1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use polycube::generate::Example;
    use polycube::mesh::CellKind;
    use polycube::structure::{Polycube, Tolerance};

    #[test]
    fn pieces_are_as_many_as_counted_and_lie_in_their_facets() {
        for example in Example::ALL {
            let mesh = example.voxels(1).unwrap().mesh(CellKind::Quads, 6.0).unwrap();
            let polycube = Polycube::new(&mesh, None, &Tolerance::default()).unwrap();
            let arrangement = Arrangement::new(&polycube.structure, &polycube.placement);
            let (pieces, counts) = (Pieces::new(&arrangement), polycube::layout::count(&arrangement));
            assert_eq!(pieces.blocks.len(), counts.blocks);
            assert_eq!(pieces.patches.len(), counts.surface_patches);
            assert_eq!(pieces.blocks.len() + pieces.faces.len(), counts.blocks_padded);
            let area = |tiles: &[Tile], facet: u32| -> f64 {
                let side = |t: &Tile, a: usize| pieces.planes[a][t.high[a]] - pieces.planes[a][t.low[a]];
                let size = |t: &Tile| (0..3).map(|a| side(t, a)).filter(|s| *s > 0.0).product::<f64>();
                tiles.iter().filter(|t| t.facet == facet).map(size).sum()
            };
            for facet in 0..polycube.structure.facets.len() as u32 {
                let (a, b) = (area(&pieces.faces, facet), area(&pieces.patches, facet));
                assert!(a > 0.0 && (a - b).abs() < 1e-9 * a, "{example} {facet}: {a} {b}");
            }
            assert!(pieces.faces.iter().all(|t| (t.id as usize) < pieces.blocks.len()));
        }
    }
}
