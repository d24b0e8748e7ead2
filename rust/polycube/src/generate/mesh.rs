//! Meshes of the solid cells.

use super::voxels::Voxels;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::hexahedron::OCTANTS;
use crate::mesh::{CellKind, Cells, Mesh, Point};

/// The octants at the corners of each face (−X +X −Y +Y −Z +Z), counter-clockwise from outside.
const FACES: [[usize; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Five tetrahedra of a cell whose octant 0 is even; its diagonals join even octants (0, 3, 5, 6).
/// An odd cell is its mirror image along X.
pub(super) const TETRAHEDRA: [[usize; 4]; 5] = [[0, 3, 6, 5], [1, 3, 0, 5], [2, 0, 3, 6], [4, 0, 6, 5], [7, 3, 5, 6]];

/// Cells by the lattice vertices they join: `x + nx (y + ny z)` for planes `x`, `y`, `z`.
pub(super) struct VertexLattice<'a> {
    voxels: &'a Voxels,
    counts: [usize; 3],
}

impl<'a> VertexLattice<'a> {
    /// # Errors
    /// [`ErrorKind::Option`] when vertex indices do not fit 32 bits.
    pub(super) fn new(voxels: &'a Voxels) -> Result<Self> {
        let counts = voxels.size().map(|n| n + 1);
        if counts.iter().product::<usize>() > u32::MAX as usize {
            let message = "the lattice has more than 2^32 vertices";
            return Err(Error::new(ErrorKind::Option, message).remedy("use a larger step"));
        }
        Ok(Self { voxels, counts })
    }

    pub(super) fn len(&self) -> usize {
        self.counts.iter().product()
    }

    pub(super) fn point(&self, vertex: usize) -> Point {
        let [nx, ny, _] = self.counts;
        let at = [vertex % nx, vertex / nx % ny, vertex / nx / ny];
        Point::from([0, 1, 2].map(|axis| self.voxels.planes(axis)[at[axis]]))
    }

    pub(super) fn octants(&self, cell: [usize; 3]) -> [u32; 8] {
        let [nx, ny, _] = self.counts;
        std::array::from_fn(|o| {
            let [x, y, z] = [0, 1, 2].map(|axis| cell[axis] + (o >> axis & 1));
            (x + nx * (y + ny * z)) as u32
        })
    }

    pub(super) fn cells(&self, kind: CellKind) -> Cells {
        match kind {
            CellKind::Triangles => Cells::Triangles(self.triangles()),
            CellKind::Quads => Cells::Quads(self.quads()),
            CellKind::Tetrahedra => Cells::Tetrahedra(self.tetrahedra()),
            CellKind::Hexahedra => Cells::Hexahedra(self.hexahedra()),
        }
    }

    pub(super) fn hexahedra(&self) -> Vec<[u32; 8]> {
        let cells = self.voxels.cells().map(|cell| self.octants(cell));
        cells.map(|o| OCTANTS.map(|i| o[i])).collect()
    }

    pub(super) fn tetrahedra(&self) -> Vec<[u32; 4]> {
        let split = |cell: [usize; 3]| {
            let octants = self.octants(cell);
            let odd = cell.iter().sum::<usize>() % 2;
            // The mirrored cell's octants change sides, and two vertices the order.
            TETRAHEDRA.map(|t| {
                let [a, b, c, d] = t.map(|o| octants[o ^ odd]);
                if odd == 1 { [a, c, b, d] } else { [a, b, c, d] }
            })
        };
        self.voxels.cells().flat_map(split).collect()
    }

    pub(super) fn quads(&self) -> Vec<[u32; 4]> {
        let faces = |cell: [usize; 3]| {
            let octants = self.octants(cell);
            let open = (0..6).filter(move |face| !self.has_neighbour(cell, *face));
            open.map(move |face| FACES[face].map(|o| octants[o]))
        };
        self.voxels.cells().flat_map(faces).collect()
    }

    fn triangles(&self) -> Vec<[u32; 3]> {
        let split = |[a, b, c, d]: [u32; 4]| {
            if self.is_even(a) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
        };
        self.quads().into_iter().flat_map(split).collect()
    }

    fn has_neighbour(&self, cell: [usize; 3], face: usize) -> bool {
        let mut next = cell.map(|c| c as i64);
        next[face / 2] += if face % 2 == 1 { 1 } else { -1 };
        self.voxels.is_solid(next)
    }

    fn is_even(&self, vertex: u32) -> bool {
        let [nx, ny, _] = self.counts;
        let v = vertex as usize;
        (v % nx + v / nx % ny + v / nx / ny).is_multiple_of(2)
    }
}

impl Voxels {
    /// The mesh of the solid cells, each cut evenly into parts no longer than `step` on any axis.
    /// Coordinates stay integers where `step` divides the distances between the planes.
    ///
    /// Triangles are half quadrilaterals with diagonals in turn, and are the boundary of the tetrahedra, five to a
    /// cell. Vertices are shared and in the order of the lattice, X fastest; surfaces have no inner vertex. The
    /// surface is manifold where the voxels are.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] when `step` is not positive and finite or makes too many cells for
    /// 32-bit indices; [`ErrorKind::Mesh`] when no cell is solid.
    pub fn mesh(&self, kind: CellKind, step: f64) -> Result<Mesh> {
        let fine = self.refined(step)?;
        let lattice = VertexLattice::new(&fine)?;
        let cells = lattice.cells(kind);
        if cells.is_empty() {
            return Err(Error::new(ErrorKind::Mesh, "no cell of the polycube is solid"));
        }
        let points: Vec<Point> = (0..lattice.len()).map(|v| lattice.point(v)).collect();
        Ok(Mesh::of_used(&points, cells)?.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::super::voxels::Cuboid;
    use super::*;

    fn bracket() -> Voxels {
        let boxes = [Cuboid::new([-2, 0, 0], [6, 4, 2]), Cuboid::new([-2, 0, 2], [0, 4, 7])];
        let hole = Cuboid::new([2, 1, -1], [4, 3, 3]);
        Voxels::from_difference(&boxes, &[hole]).unwrap()
    }

    #[test]
    fn every_kind_has_the_volume_of_the_boxes() {
        let voxels = bracket();
        for kind in CellKind::ALL {
            for step in [0.75, 1.0, 100.0] {
                let mesh = voxels.mesh(kind, step).unwrap();
                let volume = check::volume(&mesh);
                assert!((volume - voxels.volume()).abs() < 1e-9, "{kind} {step}: {volume}");
            }
        }
    }

    #[test]
    fn surfaces_are_closed_and_manifold_with_one_tunnel() {
        for kind in [CellKind::Triangles, CellKind::Quads] {
            let mesh = bracket().mesh(kind, 1.0).unwrap();
            check::assert_manifold(&mesh);
            assert_eq!(check::euler(&mesh), 0);
        }
    }

    #[test]
    fn volume_cells_are_positive_and_conforming() {
        let voxels = bracket();
        for (volume, surface) in [(CellKind::Tetrahedra, CellKind::Triangles), (CellKind::Hexahedra, CellKind::Quads)] {
            let mesh = voxels.mesh(volume, 1.0).unwrap();
            assert!(check::smallest_determinant(&mesh) > 0.5);
            let boundary = check::boundary(&mesh);
            let expected = voxels.mesh(surface, 1.0).unwrap();
            assert_eq!(boundary.cells().len(), expected.cells().len());
            assert_eq!(check::sorted_faces(&boundary), check::sorted_faces(&expected));
        }
    }

    #[test]
    fn no_edge_is_longer_than_the_step() {
        let mesh = bracket().mesh(CellKind::Hexahedra, 0.75).unwrap();
        for i in 0..mesh.cells().len() {
            let cell = mesh.cells().cell(i);
            let width = mesh.points()[cell[6] as usize] - mesh.points()[cell[0] as usize];
            assert!(width.min() > 0.0 && width.max() <= 0.75);
        }
    }

    #[test]
    fn nothing_is_no_mesh() {
        for kind in CellKind::ALL {
            let none = Voxels::from_boxes(&[]).unwrap().mesh(kind, 1.0);
            assert_eq!(none.unwrap_err().kind, ErrorKind::Mesh);
        }
    }
}
