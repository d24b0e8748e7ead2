//! Which elements of a polycube are turned over.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::hexahedron::corner_tetrahedra;
use crate::mesh::{Cells, Face, Mesh, Point};
use nalgebra::Vector3;

/// The elements turned over or flat, ascending.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct Flipped {
    /// Cells of a volume; none for a surface.
    pub cells: Vec<u32>,
    /// Boundary faces, by their index in [`Cells::boundary`].
    pub faces: Vec<u32>,
}

impl Flipped {
    /// Whether nothing is flipped.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty() && self.faces.is_empty()
    }
}

/// Lists the flipped elements of a polycube.
///
/// - A tetrahedron, if its volume is not positive; a hexahedron, if at one of its corners the
///   determinant of the three edges is not.
/// - A boundary face, if the normal at one of its corners does not point to the side of its label
///   (scalar product not positive). `labels` holds one label 0..=5 = +X −X +Y −Y +Z −Z for each face of
///   [`Cells::boundary`], −1 where there is none, and such a face is not judged; an empty slice
///   judges the cells alone.
///
/// In plain floating point: an element flat to rounding may count either way. O(n log n).
///
/// # Errors
/// [`ErrorKind::Mismatch`] if the number of labels is not that of the boundary faces,
/// [`ErrorKind::Option`] for a label out of range, [`ErrorKind::Mesh`] for a face of three cells.
pub fn flipped(mesh: &Mesh, labels: &[i8]) -> Result<Flipped> {
    let faces = if labels.is_empty() { Vec::new() } else { mesh.cells().boundary()? };
    check_labels(labels, faces.len())?;
    let at = |v: u32| mesh.points()[v as usize];
    let turned = |i: &u32| face_flipped(&faces[*i as usize], labels[*i as usize], at);
    Ok(Flipped {
        cells: (0..mesh.cells().len() as u32).filter(|&i| cell_flipped(mesh, i as usize)).collect(),
        faces: (0..faces.len() as u32).filter(turned).collect(),
    })
}

fn check_labels(labels: &[i8], faces: usize) -> Result<()> {
    if labels.len() != faces {
        let message = format!("{} labels for {faces} boundary faces", labels.len());
        return Err(Error::new(ErrorKind::Mismatch, message).remedy("give one label for each face"));
    }
    match labels.iter().position(|l| !(-1..=5).contains(l)) {
        None => Ok(()),
        Some(i) => Err(Error::new(ErrorKind::Option, format!("{} is no label", labels[i]))
            .at(Place::Face(i as u32))
            .remedy("labels are 0 to 5, or -1 for none")),
    }
}

fn cell_flipped(mesh: &Mesh, i: usize) -> bool {
    let is_bad = |tet: &[u32; 4]| {
        let [a, b, c, d] = tet.map(|v| mesh.points()[v as usize]);
        (b - a).cross(&(c - a)).dot(&(d - a)) <= 0.0
    };
    match mesh.cells() {
        Cells::Triangles(_) | Cells::Quads(_) => false,
        Cells::Tetrahedra(c) => is_bad(&c[i]),
        Cells::Hexahedra(c) => corner_tetrahedra(&c[i]).iter().any(is_bad),
    }
}

fn face_flipped(face: &Face, label: i8, at: impl Fn(u32) -> Point) -> bool {
    if label < 0 {
        return false;
    }
    let mut outward = Vector3::zeros();
    outward[label as usize / 2] = if label % 2 == 0 { 1.0 } else { -1.0 };
    let v = face.vertices();
    let corner = |i: usize| {
        let (here, next, last) = (at(v[i]), at(v[(i + 1) % v.len()]), at(v[(i + v.len() - 1) % v.len()]));
        (next - here).cross(&(last - here)).dot(&outward)
    };
    // All corners of a triangle have one normal.
    let corners = if v.len() == 3 { 1 } else { v.len() };
    (0..corners).any(|i| corner(i) <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::testing::{hex_box, labels, quad_box, tet_box, tri_box};

    #[test]
    fn a_good_box_has_none() {
        for mesh in [tri_box([2, 2, 2]), quad_box([2, 2, 2]), tet_box([2, 2, 2]), hex_box([2, 2, 2])] {
            assert!(flipped(&mesh, &labels(&mesh)).unwrap().is_empty());
            assert!(flipped(&mesh, &[]).unwrap().is_empty());
        }
    }

    #[test]
    fn a_pushed_out_centre_flips_cells_only() {
        for (mut mesh, all) in [(tet_box([2, 2, 2]), 48), (hex_box([2, 2, 2]), 8)] {
            mesh.points_mut()[13].x = 3.0;
            let found = flipped(&mesh, &labels(&mesh)).unwrap();
            assert!(found.faces.is_empty() && !found.cells.is_empty() && found.cells.len() < all);
        }
    }

    #[test]
    fn a_vertex_pushed_over_its_neighbour_flips_faces() {
        for mut mesh in [tri_box([3, 2, 2]), quad_box([3, 2, 2]), hex_box([3, 2, 2]), tet_box([3, 2, 2])] {
            let labels = labels(&mesh);
            // Vertex (1, 1, 0) in the facet −Z beyond (2, 1, 0).
            mesh.points_mut()[5].x = 2.5;
            let found = flipped(&mesh, &labels).unwrap();
            assert!(!found.faces.is_empty());
            assert!(found.faces.iter().all(|&i| labels[i as usize] == 5));
        }
    }

    #[test]
    fn flat_elements_count_and_unset_labels_do_not() {
        let mut mesh = quad_box([1, 1, 1]);
        let mut labels = labels(&mesh);
        for p in mesh.points_mut() {
            p.z = 0.0;
        }
        assert_eq!(flipped(&mesh, &labels).unwrap().faces.len(), 4);
        labels.fill(-1);
        assert!(flipped(&mesh, &labels).unwrap().is_empty());
        let mut mesh = tet_box([1, 1, 1]);
        mesh.points_mut().fill(Point::origin());
        assert_eq!(flipped(&mesh, &[]).unwrap().cells, [0, 1, 2, 3, 4, 5]);
    }

    #[test]
    fn labels_are_checked() {
        let mesh = quad_box([1, 1, 1]);
        assert_eq!(flipped(&mesh, &[0; 5]).unwrap_err().kind, ErrorKind::Mismatch);
        let error = flipped(&mesh, &[0, 1, 6, 0, 0, 0]).unwrap_err();
        assert_eq!((error.kind, error.place), (ErrorKind::Option, Some(Place::Face(2))));
    }
}
