//! The symmetries of the cube, and moving and scaling.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Cells, Mesh};
use nalgebra::{Matrix3, Vector3};

/// The 48 symmetries of the cube: every signed permutation of the axes, the identity first. The
/// 24 with determinant 1 are rotations, the others contain a reflection.
pub fn symmetries() -> [Matrix3<f64>; 48] {
    const AXES: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]];
    std::array::from_fn(|i| {
        let (axes, signs) = (AXES[i / 8], i % 8);
        let mut matrix = Matrix3::zeros();
        for (row, axis) in axes.into_iter().enumerate() {
            matrix[(row, axis)] = if signs >> row & 1 == 1 { -1.0 } else { 1.0 };
        }
        matrix
    })
}

/// The mesh with `matrix` applied to its points. Where the matrix reflects, cells are reordered
/// so that surfaces still look outwards and volumes stay positive.
///
/// # Errors
/// [`ErrorKind::Mesh`] when a point is not finite then.
pub fn transform(mesh: &Mesh, matrix: &Matrix3<f64>) -> Result<Mesh> {
    let points = mesh.points().iter().map(|p| matrix * p).collect();
    let cells = if matrix.determinant() < 0.0 { flipped(mesh.cells()) } else { mesh.cells().clone() };
    Mesh::new(points, cells)
}

/// The cells seen in a mirror; their first vertices stay first.
fn flipped(cells: &Cells) -> Cells {
    match cells {
        Cells::Triangles(c) => Cells::Triangles(c.iter().map(|[a, b, c]| [*a, *c, *b]).collect()),
        Cells::Quads(c) => Cells::Quads(c.iter().map(|[a, b, c, d]| [*a, *d, *c, *b]).collect()),
        Cells::Tetrahedra(c) => Cells::Tetrahedra(c.iter().map(|[a, b, c, d]| [*a, *c, *b, *d]).collect()),
        Cells::Hexahedra(c) => {
            let order = [0, 3, 2, 1, 4, 7, 6, 5];
            Cells::Hexahedra(c.iter().map(|c| order.map(|i: usize| c[i])).collect())
        }
    }
}

/// The mesh moved by a vector.
///
/// # Errors
/// [`ErrorKind::Mesh`] when a point is not finite then.
pub fn translate(mesh: &Mesh, by: Vector3<f64>) -> Result<Mesh> {
    mesh.moved(|p| p + by)
}

/// The mesh scaled evenly about the origin.
///
/// # Errors
/// [`ErrorKind::Option`] when `factor` is not positive and finite; [`ErrorKind::Mesh`] when a point is not then.
pub fn scale(mesh: &Mesh, factor: f64) -> Result<Mesh> {
    if !(factor.is_finite() && factor > 0.0) {
        let message = format!("the scale {factor} is not a positive number");
        return Err(Error::new(ErrorKind::Option, message));
    }
    mesh.moved(|p| p * factor)
}

#[cfg(test)]
mod tests {
    use super::super::{check, random_polycube};
    use super::*;
    use crate::mesh::CellKind;

    #[test]
    fn the_symmetries_form_a_group() {
        let all = symmetries();
        assert_eq!(all[0], Matrix3::identity());
        for (i, a) in all.iter().enumerate() {
            assert_eq!(a.determinant().abs(), 1.0);
            assert!(all.contains(&a.transpose()));
            assert!(!all[..i].contains(a));
            assert!(all.iter().all(|b| all.contains(&(a * b))));
        }
        let rotations = all.iter().filter(|m| m.determinant() > 0.0);
        assert_eq!(rotations.count(), 24);
    }

    #[test]
    fn outside_stays_outside() {
        let voxels = random_polycube(5, 4, 8).unwrap();
        for kind in CellKind::ALL {
            let mesh = voxels.mesh(kind, 2.0).unwrap();
            for matrix in symmetries() {
                let turned = transform(&mesh, &matrix).unwrap();
                assert!((check::volume(&turned) - voxels.volume()).abs() < 1e-9);
                if kind == CellKind::Tetrahedra || kind == CellKind::Hexahedra {
                    assert!(check::smallest_determinant(&turned) > 0.0);
                } else {
                    check::assert_manifold(&turned);
                }
            }
        }
    }

    #[test]
    fn moving_and_scaling_change_the_volume_as_they_should() {
        let voxels = random_polycube(6, 3, 8).unwrap();
        let mesh = voxels.mesh(CellKind::Triangles, 2.0).unwrap();
        let moved = translate(&mesh, Vector3::new(1.0, -2.0, 3.0)).unwrap();
        assert!((check::volume(&moved) - voxels.volume()).abs() < 1e-9);
        let big = scale(&mesh, 2.0).unwrap();
        assert!((check::volume(&big) - 8.0 * voxels.volume()).abs() < 1e-9);
        for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(scale(&mesh, factor).unwrap_err().kind, ErrorKind::Option);
        }
    }
}
