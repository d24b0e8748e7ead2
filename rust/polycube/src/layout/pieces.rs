//! Which patch and which block every boundary face of a mesh belongs to.

use super::complex::Complex;
use super::lattice::Lattice;
use super::separatrices::Separatrices;
use crate::mesh::Point;
use crate::structure::{Arrangement, Label, Polycube};

/// The pieces of the layout that boundary faces belong to by their middles.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pieces {
    /// The surface patch of every boundary face, numbered as [`Separatrices::patches`].
    pub patch_of_face: Vec<u32>,
    /// The block below every boundary face, numbered as [`Complex::blocks`].
    pub block_of_face: Vec<u32>,
}

impl Pieces {
    /// Finds the pieces of all boundary faces of `polycube`, whose vertices lie at `points` and whose levels at
    /// `placement`.
    ///
    /// Faces need not follow the lines of the layout, nor lie exactly in their facets: the point of the facet nearest
    /// to the middle of the face decides. `placement` must be free of conflicts. O(c + f t) for c lattice cells, f
    /// faces and t tiles of a facet.
    pub fn of_faces(polycube: &Polycube, points: &[Point], placement: &[f64]) -> Self {
        let arrangement = Arrangement::new(&polycube.structure, placement);
        let table = Table::new(&arrangement);
        let mut pieces = Self::default();
        for (face, &facet) in polycube.surface.faces().iter().zip(&polycube.facet_of_face) {
            let vertices = face.vertices();
            let sum: nalgebra::Vector3<f64> = vertices.iter().map(|&v| points[v as usize].coords).sum();
            let (patch, block) = table.at(facet, (sum / vertices.len() as f64).into());
            pieces.patch_of_face.push(patch);
            pieces.block_of_face.push(block);
        }
        pieces
    }
}

/// A rectangle of a facet.
struct Tile {
    low: [f64; 3],
    high: [f64; 3],
}

/// The numbers of patches and blocks at every lattice face and cell.
struct Table {
    lattice: Lattice,
    labels: Vec<Label>,
    tiles: Vec<Vec<Tile>>,
    /// By axis and lattice vertex at the lowest corner.
    patch: [Vec<u32>; 3],
    block: Vec<u32>,
}

impl Table {
    fn new(arrangement: &Arrangement) -> Self {
        let lattice = Lattice::new(arrangement);
        let patch = patches(&lattice, arrangement);
        let block = blocks(&lattice, arrangement);
        let facets = &arrangement.structure().facets;
        let mut tiles: Vec<Vec<Tile>> = facets.iter().map(|_| Vec::new()).collect();
        for (facet, low, high) in arrangement.tiles() {
            tiles[facet as usize].push(Tile { low, high });
        }
        Self { lattice, labels: facets.iter().map(|f| f.label).collect(), tiles, patch, block }
    }

    /// Patch and block at the point of `facet` nearest to `point`.
    fn at(&self, facet: u32, point: [f64; 3]) -> (u32, u32) {
        let label = self.labels[facet as usize];
        let own = &self.tiles[facet as usize];
        let Some(tile) = own.iter().min_by(|a, b| a.distance(point).total_cmp(&b.distance(point))) else {
            return (0, 0);
        };
        let at: [usize; 3] = std::array::from_fn(|axis| self.cell(tile, axis, label.axis(), point[axis]));
        let face = self.lattice.index(at);
        let below = if label.sign() > 0 { face - self.lattice.stride(label.axis()) } else { face };
        (self.patch[label.axis()][face], self.block[below])
    }

    /// The lattice coordinate of the cell of `tile` that holds `x` along `axis`, of its plane along `normal`.
    fn cell(&self, tile: &Tile, axis: usize, normal: usize, x: f64) -> usize {
        let low = self.lattice.rank(axis, tile.low[axis]);
        if axis == normal {
            return low;
        }
        let high = self.lattice.rank(axis, tile.high[axis]);
        self.lattice.planes[axis].partition_point(|&plane| plane <= x).clamp(low, high - 1)
    }
}

impl Tile {
    /// Squared distance to a point.
    fn distance(&self, point: [f64; 3]) -> f64 {
        (0..3).map(|a| (point[a].clamp(self.low[a], self.high[a]) - point[a]).powi(2)).sum()
    }
}

fn patches(lattice: &Lattice, arrangement: &Arrangement) -> [Vec<u32>; 3] {
    let mut patch = [0, 1, 2].map(|_| vec![0; lattice.len()]);
    for (number, p) in (0..).zip(Separatrices::new(lattice, arrangement).patches()) {
        let axis = p.label.axis();
        let mut high = p.high;
        high[axis] += 1;
        cells(p.low, high).for_each(|at| patch[axis][lattice.index(at)] = number);
    }
    patch
}

fn blocks(lattice: &Lattice, arrangement: &Arrangement) -> Vec<u32> {
    let mut block = vec![0; lattice.len()];
    for (number, b) in (0..).zip(Complex::new(lattice, arrangement).blocks()) {
        cells(b.low, b.high).for_each(|at| block[lattice.index(at)] = number);
    }
    block
}

/// All lattice points from `low` to below `high`.
fn cells(low: [usize; 3], high: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let [x, y, z] = [0, 1, 2].map(|a| low[a]..high[a]);
    z.flat_map(move |k| {
        y.clone().flat_map({
            let x = x.clone();
            move |j| x.clone().map(move |i| [i, j, k])
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Context;
    use crate::generate::{Example, example};
    use crate::layout::count;
    use crate::mesh::CellKind;
    use crate::remesh::map::LatticeMap;
    use crate::remesh::mesher::Remesher;
    use crate::simplify::{Input, SimplifyOptions, simplify};
    use crate::structure::placement_of;
    use std::collections::BTreeSet;

    /// On a mesh of unit squares every patch has faces, and the numbers are those of the lattice meshes.
    #[test]
    fn unit_squares_are_numbered_as_the_quadrilateral_mesh() {
        for name in Example::ALL {
            let (mesh, _) = example(name, 1, CellKind::Quads).unwrap();
            let input = Input { polycube: &mesh, shape: None, labels: None };
            let options = SimplifyOptions { strategy: crate::align::Strategy::Naive, ..SimplifyOptions::default() };
            let result = simplify(&input, &options, &Context::default()).unwrap();
            let polycube = result.polycube.as_ref().unwrap();
            let levels = placement_of(&result.levels);
            let pieces = Pieces::of_faces(&result.input, polycube.points(), &levels);
            let counts = count(&Arrangement::new(&result.input.structure, &levels));
            let found: BTreeSet<u32> = pieces.patch_of_face.iter().copied().collect();
            assert_eq!(found, (0..counts.surface_patches as u32).collect(), "{name}");
            let map = LatticeMap::new(&result).unwrap();
            let quads = Remesher::new(&map, &mesh, &Context::default()).unwrap().quads(&Context::default()).unwrap();
            let middle = |points: &[Point], v: &[u32]| {
                let sum: nalgebra::Vector3<f64> = v.iter().map(|&v| points[v as usize].coords).sum();
                [0, 1, 2].map(|a| sum[a].round() as i64)
            };
            let numbered = |points: &[Point], cells: &crate::mesh::Cells, ids: &[u32]| -> BTreeSet<([i64; 3], u32)> {
                (0..cells.len()).map(|i| (middle(points, cells.cell(i)), ids[i])).collect()
            };
            let own = numbered(polycube.points(), polycube.cells(), &pieces.patch_of_face);
            assert_eq!(own, numbered(&quads.polycube, quads.mesh.cells(), &quads.patch_id), "{name}");
        }
    }

    /// Every block at the surface lies below some face, and neighbours across no sheet share their block.
    #[test]
    fn a_cube_is_one_block_whatever_its_faces() {
        for kind in [CellKind::Triangles, CellKind::Tetrahedra] {
            let mesh = crate::generate::Voxels::from_boxes(&[crate::generate::Cuboid::new([0; 3], [3; 3])])
                .and_then(|v| v.mesh(kind, 1.0))
                .unwrap();
            let polycube =
                crate::structure::Polycube::new(&mesh, None, &crate::structure::Tolerance::default()).unwrap();
            let pieces = Pieces::of_faces(&polycube, mesh.points(), &polycube.placement);
            assert!(pieces.block_of_face.iter().all(|&b| b == 0));
            let patches: BTreeSet<u32> = pieces.patch_of_face.iter().copied().collect();
            assert_eq!(patches.len(), 6);
        }
    }
}
