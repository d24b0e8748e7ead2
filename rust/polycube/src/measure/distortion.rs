//! How far the map from one mesh to another is from a similarity.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Mesh, Point, Simplices};
use nalgebra::Matrix3;

/// A simplex whose measure is below this part of its longest edge to the same power is degenerate.
const FLAT: f64 = 1e-12;

/// Distortion of a piecewise linear map, over the simplices that are neither degenerate nor inverted.
///
/// With `J` the Jacobian of the map in one simplex, `s` its singular values, and both meshes scaled
/// to the same total area or volume:
/// - angle: `(s1/s2 + s2/s1) / 2` for triangles, `‖J‖² / (3 det(J)^⅔)` for tetrahedra; whatever the
///   scale, 1 for a similarity and more for anything else;
/// - size: `(det J + 1 / det J) / 2`, which is 1 where the measure is kept and more elsewhere.
///
/// These are the two parts of the energies of Degener, Meseth and Klein ("An adaptable surface
/// parameterization method", 2003) and of Fu, Liu and Guo ("Computing locally injective mappings by
/// advanced MIPS", 2015). Means are weighted by area or volume in the first mesh.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct Distortion {
    /// Mean of the angle part, at least 1.
    pub angle: f64,
    /// Mean of the size part, at least 1.
    pub size: f64,
    /// Largest angle part.
    pub worst_angle: f64,
    /// Largest size part.
    pub worst_size: f64,
    /// The first cell with the largest angle part.
    pub worst_cell: u32,
    /// Number of simplices, those left out included.
    pub simplices: usize,
    /// Simplices flat in one of the meshes, or inverted in the first alone, left out.
    pub degenerate: usize,
    /// Tetrahedra inverted in the second mesh, left out. Always 0 for surfaces, where no
    /// side is known: see [`flipped`](super::flipped()).
    pub inverted: usize,
}

/// A simplex that counts.
struct Stretch {
    /// Area or volume before.
    measure: f64,
    /// Area or volume after over that before.
    determinant: f64,
    /// The angle part.
    angle: f64,
}

/// What the map does to one simplex.
enum Image {
    Good(Stretch),
    Degenerate,
    Inverted,
}

/// Measures the map that takes each simplex of `from` to that of `to`.
///
/// Quadrilaterals and hexahedra count as their [simplices](crate::mesh::Cells::simplices). Linear time, 32 bytes
/// of passing memory a simplex.
///
/// # Errors
/// [`ErrorKind::Mismatch`] unless both have the same cells and number of vertices;
/// [`ErrorKind::Mesh`] when no simplex is left to measure.
pub fn distortion(from: &Mesh, to: &Mesh) -> Result<Distortion> {
    if from.cells() != to.cells() || from.points().len() != to.points().len() {
        return Err(Error::new(ErrorKind::Mismatch, "the two meshes do not have the same cells"));
    }
    let images = match from.cells().simplices() {
        Simplices::Triangles(t) => images(&t, from, to, triangle),
        Simplices::Tetrahedra(t) => images(&t, from, to, tetrahedron),
    };
    summary(&images, from.cells().len())
}

/// Means, maxima and counts over the images of all simplices, which come from `cells` cells.
fn summary(images: &[Image], cells: usize) -> Result<Distortion> {
    let good = images.iter().enumerate().filter_map(|(i, image)| match image {
        Image::Good(stretch) => Some((i, stretch)),
        Image::Degenerate | Image::Inverted => None,
    });
    let before: f64 = good.clone().map(|(_, s)| s.measure).sum();
    let after: f64 = good.clone().map(|(_, s)| s.measure * s.determinant).sum();
    let mut found = counted(images);
    if found.degenerate + found.inverted == images.len() {
        let message = "every cell is flat or inverted: there is no distortion to measure";
        return Err(Error::new(ErrorKind::Mesh, message));
    }
    for (i, s) in good {
        let determinant = s.determinant * before / after;
        let size = 0.5 * (determinant + 1.0 / determinant);
        found.angle += s.angle * s.measure / before;
        found.size += size * s.measure / before;
        found.worst_size = found.worst_size.max(size);
        if s.angle > found.worst_angle {
            found.worst_angle = s.angle;
            found.worst_cell = (i * cells / images.len()) as u32;
        }
    }
    Ok(found)
}

/// The counts, with nothing measured yet.
fn counted(images: &[Image]) -> Distortion {
    let number = |wanted: fn(&Image) -> bool| images.iter().filter(|i| wanted(i)).count();
    Distortion {
        angle: 0.0,
        size: 0.0,
        worst_angle: 0.0,
        worst_size: 0.0,
        worst_cell: 0,
        simplices: images.len(),
        degenerate: number(|i| matches!(i, Image::Degenerate)),
        inverted: number(|i| matches!(i, Image::Inverted)),
    }
}

fn images<const K: usize>(
    simplices: &[[u32; K]],
    from: &Mesh,
    to: &Mesh,
    image: fn([Point; K], [Point; K]) -> Image,
) -> Vec<Image> {
    let corners = |mesh: &Mesh, s: &[u32; K]| s.map(|v| mesh.points()[v as usize]);
    simplices.iter().map(|s| image(corners(from, s), corners(to, s))).collect()
}

/// By the metric: `‖J‖² = tr(G' G⁻¹)` for the Gram matrices `G` of two edges before and after.
fn triangle(from: [Point; 3], to: [Point; 3]) -> Image {
    let gram = |p: [Point; 3]| {
        let (u, v) = (p[1] - p[0], p[2] - p[0]);
        let longest = [u, v, u - v].iter().fold(0.0, |m: f64, e| m.max(e.norm_squared()));
        let doubled = u.cross(&v).norm();
        (doubled > FLAT * longest).then(|| ([u.dot(&u), u.dot(&v), v.dot(&v)], doubled))
    };
    let (Some((f, before)), Some((t, after))) = (gram(from), gram(to)) else {
        return Image::Degenerate;
    };
    let trace = t[0] * f[2] - 2.0 * t[1] * f[1] + t[2] * f[0];
    Image::Good(Stretch { measure: before / 2.0, determinant: after / before, angle: trace / (2.0 * before * after) })
}

fn tetrahedron(from: [Point; 4], to: [Point; 4]) -> Image {
    let edges = |p: [Point; 4]| Matrix3::from_columns(&[p[1] - p[0], p[2] - p[0], p[3] - p[0]]);
    let (before, after) = (edges(from), edges(to));
    if !solid(&before) || !solid(&after) {
        return Image::Degenerate;
    }
    let Some(inverse) = before.try_inverse() else {
        return Image::Degenerate;
    };
    let (volume, determinant) = (before.determinant(), after.determinant() / before.determinant());
    if after.determinant() < 0.0 {
        return Image::Inverted;
    }
    if determinant < 0.0 {
        return Image::Degenerate;
    }
    // libm's, because the platform's own differ in the last bit from one system to the next.
    let root = libm::cbrt(determinant);
    let angle = (after * inverse).norm_squared() / (3.0 * root * root);
    Image::Good(Stretch { measure: volume.abs() / 6.0, determinant, angle })
}

/// Whether three edges from one vertex span a volume worth the name; false for a NaN.
fn solid(edges: &Matrix3<f64>) -> bool {
    let longest = edges.column_iter().fold(0.0, |m: f64, e| m.max(e.norm()));
    edges.determinant().abs() > FLAT * longest * longest * longest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::testing::{hex_box, jittered, quad_box, tet_box, tri_box};
    use nalgebra::{Matrix2, Rotation3, Vector3};
    use proptest::prelude::*;

    fn moved(mesh: &Mesh, f: impl Fn(&Point) -> Point) -> Mesh {
        mesh.moved(f).unwrap()
    }

    #[test]
    fn a_stretched_box_has_the_known_distortion() {
        let tets = tet_box([2, 2, 2]);
        let found = distortion(&tets, &moved(&tets, |p| Point::new(8.0 * p.x, p.y, p.z))).unwrap();
        assert!((found.angle - 66.0 / 12.0).abs() < 1e-12 && (found.size - 1.0).abs() < 1e-12);
        let quads = quad_box([1, 1, 1]);
        let found = distortion(&quads, &moved(&quads, |p| Point::new(2.0 * p.x, p.y, p.z))).unwrap();
        // Four faces become 2 by 1 with half of the area ratio 6/10 more, two stay.
        assert!((found.angle - (4.0 * 1.25 + 2.0) / 6.0).abs() < 1e-12);
        let size = |d: f64| (d + 1.0 / d) / 2.0;
        assert!((found.size - (4.0 * size(1.2) + 2.0 * size(0.6)) / 6.0).abs() < 1e-12);
    }

    #[test]
    fn degenerate_and_inverted_simplices_are_left_out() {
        let tets = tet_box([2, 2, 2]);
        let mirrored = moved(&tets, |p| Point::new(-p.x, p.y, p.z));
        assert_eq!(distortion(&tets, &mirrored).unwrap_err().kind, ErrorKind::Mesh);
        let mut pushed = tets.clone();
        pushed.points_mut()[13].x = 3.5;
        let found = distortion(&tets, &pushed).unwrap();
        assert!(found.inverted > 0 && found.angle.is_finite());
        let mut flat = tets.clone();
        flat.points_mut()[13] = flat.points()[0];
        assert!(distortion(&tets, &flat).unwrap().degenerate > 0);
    }

    #[test]
    fn different_cells_are_refused() {
        let error = distortion(&tet_box([1, 1, 1]), &hex_box([1, 1, 1])).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Mismatch);
    }

    #[test]
    fn the_worst_cell_is_named() {
        let hexes = hex_box([3, 1, 1]);
        let mut bent = hexes.clone();
        // The corner (3, 1, 1) belongs to the last cell.
        bent.points_mut()[15] = Point::new(4.0, 1.5, 1.5);
        assert_eq!(distortion(&hexes, &bent).unwrap().worst_cell, 2);
    }

    proptest! {
        #[test]
        fn similarities_have_none(turn in prop::array::uniform3(-3.0..3.0_f64), scale in 0.01..100.0_f64) {
            let rotation = Rotation3::new(Vector3::from(turn));
            for mesh in [tri_box([2, 2, 2]), tet_box([2, 2, 2]), quad_box([2, 2, 2]), hex_box([2, 2, 2])] {
                let mesh = jittered(&mesh, 0.2, 7);
                let found = distortion(&mesh, &moved(&mesh, |p| rotation * p * scale)).unwrap();
                prop_assert!((found.worst_angle - 1.0).abs() < 1e-9 && (found.worst_size - 1.0).abs() < 1e-9);
                prop_assert!((found.angle - 1.0).abs() < 1e-9 && (found.size - 1.0).abs() < 1e-9);
            }
        }

        #[test]
        fn triangles_agree_with_singular_values(c in prop::array::uniform4(-2.0..2.0_f64)) {
            let j = Matrix2::new(c[0], c[1], c[2], c[3]);
            prop_assume!(j.determinant().abs() > 1e-3);
            let s = j.singular_values();
            let from = [[0.1, 0.2], [1.3, 0.1], [0.4, 0.9]].map(nalgebra::Vector2::from);
            let lift = |p: nalgebra::Vector2<f64>| Point::new(p.x, p.y, 1.0);
            let image = triangle(from.map(lift), from.map(|p| lift(j * p)));
            let Image::Good(Stretch { determinant: d, angle, .. }) = image else { panic!("degenerate") };
            let expected = (s[0] / s[1] + s[1] / s[0]) / 2.0;
            prop_assert!((angle - expected).abs() < 1e-9 * expected);
            prop_assert!((d - j.determinant().abs()).abs() < 1e-9);
        }
    }
}
