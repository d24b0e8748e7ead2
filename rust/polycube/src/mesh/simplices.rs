//! Any mesh seen as simplices over the same vertices, and the faces that bound it.
//!
//! A quadrilateral is cut along the diagonal through its smallest vertex index, so the two cells
//! that share it cut it alike (Dompierre, Labbé, Vallet, Camarero: "How to subdivide pyramids,
//! prisms and hexahedra into tetrahedra", 1999).

use super::{Cells, Point, Stars, hexahedron};
use crate::error::{Error, ErrorKind, Place, Result};
use std::borrow::Cow;

/// Local faces of a tetrahedron in VTK's order, counter-clockwise seen from outside.
const TETRAHEDRON_FACES: [[usize; 3]; 4] = [[0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 2, 1]];

/// The simplices of a mesh: borrowed where its cells are simplices already, made where they are not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Simplices<'a> {
    /// The triangles of a surface, oriented as its cells.
    Triangles(Cow<'a, [[u32; 3]]>),
    /// The tetrahedra of a volume, oriented as its cells.
    Tetrahedra(Cow<'a, [[u32; 4]]>),
}

/// A face of the boundary, counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// Of a triangle or tetrahedral mesh.
    Triangle([u32; 3]),
    /// Of a quadrilateral or hexahedral mesh.
    Quad([u32; 4]),
}

impl Face {
    /// Its three or four vertices.
    pub fn vertices(&self) -> &[u32] {
        match self {
            Self::Triangle(v) => v,
            Self::Quad(v) => v,
        }
    }

    /// The mean of its vertices.
    pub(crate) fn middle(&self, points: &[Point]) -> Point {
        let corners = self.vertices();
        let sum: nalgebra::Vector3<f64> = corners.iter().map(|&v| points[v as usize].coords).sum();
        Point::from(sum / corners.len() as f64)
    }

    /// Its one or two triangles, cut as in [`Cells::simplices`].
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + use<> {
        let (first, second) = match *self {
            Self::Triangle(t) => (t, None),
            Self::Quad(q) => {
                let [first, second] = split_quad(q);
                (first, Some(second))
            }
        };
        std::iter::once(first).chain(second)
    }
}

impl Cells {
    /// Splits every cell into simplices over its own vertices, conforming across neighbours.
    ///
    /// A quadrilateral gives 2 triangles, a hexahedron 6 tetrahedra (the cones from its smallest
    /// vertex over the halves of the three faces opposite to it), in the order of the cells; so the
    /// simplex `i` belongs to the cell `i`, `i / 2` or `i / 6`. Linear time.
    pub fn simplices(&self) -> Simplices<'_> {
        match self {
            Self::Triangles(c) => Simplices::Triangles(Cow::Borrowed(c)),
            Self::Quads(c) => Simplices::Triangles(c.iter().copied().flat_map(split_quad).collect()),
            Self::Tetrahedra(c) => Simplices::Tetrahedra(Cow::Borrowed(c)),
            Self::Hexahedra(c) => Simplices::Tetrahedra(c.iter().flat_map(split_hex).collect()),
        }
    }

    /// The faces that belong to one cell only, outward, in the order of the cells and then of
    /// VTK's local faces. The boundary of a surface is its cells.
    ///
    /// O(n log n) time, linear but for fans of many cells around a vertex; about 50 bytes a tetrahedron of passing
    /// memory.
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`] naming a cell when more than two cells share one face, or when the
    /// faces of all cells are more than 32 bits can count.
    pub fn boundary(&self) -> Result<Vec<Face>> {
        Ok(match self {
            Self::Triangles(c) => c.iter().copied().map(Face::Triangle).collect(),
            Self::Quads(c) => c.iter().copied().map(Face::Quad).collect(),
            Self::Tetrahedra(c) => outer(c, &TETRAHEDRON_FACES, Face::Triangle)?,
            Self::Hexahedra(c) => outer(c, &hexahedron::FACES, Face::Quad)?,
        })
    }
}

/// The two triangles of a quadrilateral, cut through its smallest vertex index.
fn split_quad(quad: [u32; 4]) -> [[u32; 3]; 2] {
    let m = smallest(&quad);
    let at = |k: usize| quad[(m + k) % 4];
    [[at(0), at(1), at(2)], [at(0), at(2), at(3)]]
}

/// The six tetrahedra of a hexahedron: cones from its smallest vertex index, which so lies on the
/// diagonals of its own three faces, as the rule of [`split_quad`] wants.
fn split_hex(hex: &[u32; 8]) -> impl Iterator<Item = [u32; 4]> {
    let m = smallest(hex);
    hexahedron::FACES
        .iter()
        .filter(move |face| !face.contains(&m))
        .flat_map(|face| split_quad(face.map(|k| hex[k])))
        .map(move |[a, b, c]| [hex[m], a, b, c])
}

/// The position of the smallest number; the first of equals.
fn smallest(numbers: &[u32]) -> usize {
    (1..numbers.len()).fold(0, |m, k| if numbers[k] < numbers[m] { k } else { m })
}

/// The faces of `cells` that no other cell has.
fn outer<const C: usize, const K: usize, const F: usize>(
    cells: &[[u32; C]],
    table: &[[usize; K]; F],
    make: fn([u32; K]) -> Face,
) -> Result<Vec<Face>> {
    if u32::try_from(cells.len() * F).is_err() {
        return Err(Error::new(ErrorKind::Mesh, "the mesh has too many cells"));
    }
    let face = |i: u32| table[i as usize % F].map(|k| cells[i as usize / F][k]);
    // Cells that share a face are in one drawer; there are as many drawers as cells, whatever numbers vertices have.
    let drawer = |i: u32| face(i).into_iter().min().map(|v| v % cells.len() as u32);
    let drawers = Stars::new(cells.len(), (0..(cells.len() * F) as u32).map(drawer));
    let (mut single, mut worst) = (Vec::new(), None);
    let mut keys: Vec<(u128, u32)> = Vec::new();
    for faces in (0..cells.len()).map(|d| drawers.of(d)) {
        keys.clear();
        keys.extend(faces.iter().map(|&i| (key(face(i)), i)));
        keys.sort_unstable();
        for group in keys.chunk_by(|a, b| a.0 == b.0) {
            match group {
                [one] => single.push(one.1),
                [first, _, third, ..] => {
                    worst = worst.into_iter().chain([(first.0, third.1, group.len())]).min();
                }
                _ => {}
            }
        }
    }
    if let Some((_, third, count)) = worst {
        return Err(crowded(&face(third), third / F as u32, count));
    }
    single.sort_unstable();
    Ok(single.into_iter().map(|i| make(face(i))).collect())
}

/// A number that faces over the same three or four vertices share, and no others.
fn key<const K: usize>(mut face: [u32; K]) -> u128 {
    face.sort_unstable();
    face.iter().fold(0, |key, &v| key << 32 | u128::from(v))
}

fn crowded(face: &[u32], cell: u32, count: usize) -> Error {
    let message = format!("its face {face:?} belongs to {count} cells");
    Error::new(ErrorKind::Mesh, message)
        .at(Place::Cell(cell))
        .remedy("at most two cells may share a face: remove duplicate or overlapping cells")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::testing::{hex_box, quad_box, shuffled, tet_box};
    use crate::mesh::Mesh;
    use nalgebra::Vector3;
    use proptest::prelude::*;

    fn tetrahedra(cells: &Cells) -> Vec<[u32; 4]> {
        match cells.simplices() {
            Simplices::Tetrahedra(t) => t.into_owned(),
            Simplices::Triangles(_) => panic!("not a volume"),
        }
    }

    fn area_vector(mesh: &Mesh, face: &Face) -> Vector3<f64> {
        let p: Vec<_> = face.vertices().iter().map(|&v| mesh.points()[v as usize].coords).collect();
        let next = |i: usize| p[(i + 1) % p.len()];
        (0..p.len()).map(|i| p[i].cross(&next(i)) / 2.0).sum()
    }

    /// Six times the volume of a closed surface through the divergence theorem, about the origin.
    fn enclosed(mesh: &Mesh, boundary: &[Face]) -> f64 {
        boundary.iter().map(|f| area_vector(mesh, f).dot(&mesh.points()[f.vertices()[0] as usize].coords) / 3.0).sum()
    }

    #[test]
    fn a_box_has_its_own_boundary_outward() {
        for (mesh, count) in [(hex_box([3, 2, 4]), 52), (tet_box([3, 2, 4]), 104)] {
            let boundary = mesh.cells().boundary().unwrap();
            assert_eq!(boundary.len(), count);
            assert!((enclosed(&mesh, &boundary) - 24.0).abs() < 1e-12);
        }
        let quads = quad_box([3, 2, 4]);
        assert_eq!(quads.cells().boundary().unwrap().len(), 52);
        assert!((enclosed(&quads, &quads.cells().boundary().unwrap()) - 24.0).abs() < 1e-12);
    }

    #[test]
    fn boundary_follows_the_cells() {
        let cells = Cells::Tetrahedra(vec![[0, 1, 2, 3], [1, 2, 3, 4]]);
        let faces = [[0, 1, 3], [2, 0, 3], [0, 2, 1], [1, 2, 4], [2, 3, 4], [3, 1, 4]];
        assert_eq!(cells.boundary().unwrap(), faces.map(Face::Triangle));
    }

    #[test]
    fn a_face_of_three_cells_is_named() {
        let cells = Cells::Tetrahedra(vec![[0, 1, 2, 3], [0, 2, 1, 4], [0, 1, 2, 5]]);
        let error = cells.boundary().unwrap_err();
        assert_eq!((error.kind, error.place), (ErrorKind::Mesh, Some(Place::Cell(2))));
    }

    #[test]
    fn triangles_and_tetrahedra_are_borrowed() {
        let mesh = tet_box([1, 1, 1]);
        let Simplices::Tetrahedra(t) = mesh.cells().simplices() else { panic!("not a volume") };
        assert!(matches!(t, Cow::Borrowed(_)));
    }

    proptest! {
        /// Whatever the numbering, neighbours agree on the diagonals: no face is left single inside.
        #[test]
        fn split_hexahedra_conform(seed in any::<u64>()) {
            let mesh = shuffled(&hex_box([3, 2, 2]), seed);
            let split = tetrahedra(mesh.cells());
            prop_assert_eq!(split.len(), 72);
            for t in &split {
                let [a, b, c, d] = t.map(|v| mesh.points()[v as usize]);
                let volume = (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0;
                prop_assert!((volume - 1.0 / 6.0).abs() < 1e-12);
            }
            let cells = Cells::Tetrahedra(split);
            let mut split: Vec<_> = cells.boundary().unwrap().iter()
                .map(|f| key([f.vertices()[0], f.vertices()[1], f.vertices()[2]])).collect();
            let quads = mesh.cells().boundary().unwrap();
            let mut quads: Vec<_> = quads.iter().flat_map(Face::triangles).map(key).collect();
            split.sort_unstable();
            quads.sort_unstable();
            prop_assert_eq!(split, quads);
        }
    }
}
