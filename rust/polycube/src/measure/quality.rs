//! How good hexahedra, tetrahedra and quadrilaterals are: scaled Jacobians, volumes and their statistics.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::hexahedron::{FACES, corner_tetrahedra};
use crate::mesh::{Cells, Mesh, Point};
use nalgebra::Matrix3;

/// The edges from the first vertex of `corner` to the others, as columns.
pub(crate) fn edges(points: &[Point], corner: [u32; 4]) -> Matrix3<f64> {
    let [o, a, b, c] = corner.map(|v| points[v as usize]);
    Matrix3::from_columns(&[a - o, b - o, c - o])
}

/// `det(a, b, c) / (|a| |b| |c|)` of three edges, in −1..1; 0 where an edge has no length.
pub(crate) fn corner_jacobian(edges: &Matrix3<f64>) -> f64 {
    let lengths = edges.column(0).norm() * edges.column(1).norm() * edges.column(2).norm();
    let determinant = edges.determinant();
    match lengths.is_finite() && determinant.is_finite() {
        true if lengths > 0.0 => determinant / lengths,
        true => 0.0,
        false => directions(edges).determinant(),
    }
}

/// Edges as unit vectors, however long they are.
fn directions(edges: &Matrix3<f64>) -> Matrix3<f64> {
    let direction = |i: usize| {
        let short = edges.column(i) / edges.column(i).amax();
        short / short.norm()
    };
    Matrix3::from_columns(&[direction(0), direction(1), direction(2)])
}

/// A quality that is not a number is as bad as can be.
pub(crate) fn or_worst(quality: f64) -> f64 {
    if quality.is_nan() { -1.0 } else { quality }
}

/// The scaled Jacobian of a hexahedron in VTK's order, in −1..1: the minimum over its eight corners
/// of `det(a, b, c) / (|a| |b| |c|)` for the edges `a`, `b`, `c` that leave the corner.
///
/// 1 for boxes, 0 or below where a corner is flat or inside out. This is Verdict's measure without its ninth
/// sample in the middle, as the literature on hexahedral meshes reports it.
///
/// # Panics
/// When a vertex is not among `points`.
pub fn scaled_jacobian(points: &[Point], hex: &[u32; 8]) -> f64 {
    let quality = |corner: [u32; 4]| or_worst(corner_jacobian(&edges(points, corner)));
    corner_tetrahedra(hex).into_iter().map(quality).fold(1.0, f64::min)
}

/// Verdict's scaled Jacobian of a tetrahedron, in −1..1: `√2 det / λ`, where `λ` is the largest product
/// of the three edge lengths at a vertex. 1 for regular tetrahedra, 0 for flat ones.
///
/// # Panics
/// When a vertex is not among `points`.
pub(super) fn tetrahedron_scaled_jacobian(points: &[Point], tet: &[u32; 4]) -> f64 {
    let at = tet.map(|v| points[v as usize]);
    let product = |i: usize| -> f64 { (0..4).filter(|j| *j != i).map(|j| (at[i] - at[j]).norm()).product() };
    let largest = (0..4).map(product).fold(0.0, f64::max);
    let det = edges(points, *tet).determinant();
    let quality = std::f64::consts::SQRT_2 * det / largest;
    if largest == 0.0 && det == 0.0 { 0.0 } else { or_worst(quality.clamp(-1.0, 1.0)) }
}

/// Verdict's scaled Jacobian of a quadrilateral, in −1..1: the minimum over its corners of the sine of their angle,
/// seen along the normal of its middle. 1 for rectangles, 0 or below where a corner is straight or reflex.
///
/// # Panics
/// When a vertex is not among `points`.
pub(crate) fn quadrilateral_scaled_jacobian(points: &[Point], quad: &[u32; 4]) -> f64 {
    let at = quad.map(|v| points[v as usize]);
    let normal = ((at[1] - at[0]) + (at[2] - at[3])).cross(&((at[2] - at[1]) + (at[3] - at[0])));
    let corner = |i: usize| -> f64 {
        let (next, last) = (at[(i + 1) % 4] - at[i], at[(i + 3) % 4] - at[i]);
        let lengths = next.norm() * last.norm() * normal.norm();
        if lengths == 0.0 { 0.0 } else { or_worst(next.cross(&last).dot(&normal) / lengths) }
    };
    (0..4).map(corner).fold(1.0, f64::min)
}

/// The volume of a hexahedron with bilinear faces (cubed unit of the points), negative if inside out.
///
/// # Panics
/// When a vertex is not among `points`.
pub(super) fn hexahedron_volume(points: &[Point], hex: &[u32; 8]) -> f64 {
    let origin = points[hex[0] as usize];
    let at = hex.map(|v| points[v as usize] - origin);
    let cone = |a: usize, b: usize, c: usize| -> f64 { at[a].dot(&at[b].cross(&at[c])) };
    // The volume under a bilinear face is the mean of those under its two triangulations.
    let face = |[a, b, c, d]: [usize; 4]| -> f64 { cone(a, b, c) + cone(a, c, d) + cone(a, b, d) + cone(b, c, d) };
    FACES.into_iter().map(face).sum::<f64>() / 12.0
}

/// The volume of a tetrahedron (cubed unit of the points), negative if inside out.
///
/// # Panics
/// When a vertex is not among `points`.
pub(crate) fn tetrahedron_volume(points: &[Point], tet: &[u32; 4]) -> f64 {
    edges(points, *tet).determinant() / 6.0
}

/// The scaled Jacobian of every cell, in −1..1. Linear time.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for triangles.
pub fn scaled_jacobians(mesh: &Mesh) -> Result<Vec<f64>> {
    let p = mesh.points();
    match mesh.cells() {
        Cells::Quads(c) => Ok(c.iter().map(|c| quadrilateral_scaled_jacobian(p, c)).collect()),
        Cells::Triangles(_) => Err(Error::new(ErrorKind::Unsupported, "triangles have no scaled Jacobian")
            .remedy("give a mesh of quadrilaterals, tetrahedra or hexahedra")),
        _ => Ok(cell_qualities(mesh)?.into_iter().map(|q| q.0).collect()),
    }
}

/// The scaled Jacobian and the volume of every cell. Linear time.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a surface.
pub fn cell_qualities(mesh: &Mesh) -> Result<Vec<(f64, f64)>> {
    let p = mesh.points();
    match mesh.cells() {
        Cells::Hexahedra(c) => Ok(c.iter().map(|c| (scaled_jacobian(p, c), hexahedron_volume(p, c))).collect()),
        Cells::Tetrahedra(c) => {
            let each = |c| (tetrahedron_scaled_jacobian(p, c), tetrahedron_volume(p, c));
            Ok(c.iter().map(each).collect())
        }
        _ => Err(Error::new(ErrorKind::Unsupported, "a surface has no scaled Jacobian of volumes")
            .remedy("give a mesh of tetrahedra or hexahedra")),
    }
}

/// How good the cells of a mesh are by one measure that is not positive for cells that are inverted or flat.
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// That of each cell.
    pub of_cell: Vec<f64>,
    /// How many cells are inverted or flat: those whose quality is not positive.
    pub inverted: usize,
    /// The worst, at most 1; 1 for no cell.
    pub worst: f64,
    /// The mean; 1 for no cell.
    pub mean: f64,
}

impl Quality {
    /// Sums up the qualities of all cells. Linear time.
    pub fn new(of_cell: Vec<f64>) -> Self {
        let mean = if of_cell.is_empty() { 1.0 } else { of_cell.iter().sum::<f64>() / of_cell.len() as f64 };
        Self {
            inverted: of_cell.iter().filter(|q| Self::is_inverted(**q)).count(),
            worst: of_cell.iter().copied().fold(1.0, f64::min),
            mean,
            of_cell,
        }
    }

    /// The numbers of the cells that are inverted or flat, ascending.
    pub fn inverted_cells(&self) -> impl Iterator<Item = usize> {
        self.of_cell.iter().enumerate().filter(|(_, q)| Self::is_inverted(**q)).map(|(cell, _)| cell)
    }

    fn is_inverted(quality: f64) -> bool {
        quality.is_nan() || quality <= 0.0
    }
}

/// Number of bars of [`Statistics::histogram`].
pub(crate) const BARS: usize = 20;

/// The quality of a whole mesh.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Statistics {
    /// Number of cells.
    pub cells: usize,
    /// Cells whose scaled Jacobian is not positive.
    pub inverted: usize,
    /// Smallest scaled Jacobian, in −1..1; 1 for no cell.
    pub min: f64,
    /// Mean scaled Jacobian, in −1..1; 1 for no cell.
    pub average: f64,
    /// Cells by scaled Jacobian: bar `i` counts those from `i / 20` up to `(i + 1) / 20`. The first one also has
    /// everything below 0, the last one has 1.
    pub histogram: [u32; BARS],
    /// Smallest volume of a cell; infinite for no cell.
    pub min_volume: f64,
    /// Sum of the volumes.
    pub volume: f64,
}

/// Sums up what [`cell_qualities`] gives.
pub fn statistics(qualities: &[(f64, f64)]) -> Statistics {
    let mut histogram = [0; BARS];
    for (q, _) in qualities {
        let bar = (q * BARS as f64).clamp(0.0, BARS as f64 - 1.0);
        histogram[bar as usize] += 1;
    }
    let Quality { of_cell, inverted, worst, mean } = Quality::new(qualities.iter().map(|q| q.0).collect());
    Statistics {
        cells: of_cell.len(),
        inverted,
        min: worst,
        average: mean,
        histogram,
        min_volume: qualities.iter().map(|q| q.1).fold(f64::INFINITY, f64::min),
        volume: qualities.iter().map(|q| q.1).sum(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    fn cube() -> Mesh {
        let at = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
        let points = at.iter().map(|p| Point::from(p.map(f64::from))).collect();
        Mesh::new(points, Cells::Hexahedra(vec![[0, 1, 2, 3, 4, 5, 6, 7]])).unwrap()
    }

    #[test]
    fn a_quality_does_not_depend_on_the_size_and_no_number_is_the_worst() {
        let hex = [0, 1, 2, 3, 4, 5, 6, 7];
        let mut mesh = cube();
        mesh.points_mut()[6] = Point::new(1.3, 0.9, 1.2);
        mesh.points_mut().iter_mut().for_each(|p| p.x = -p.x);
        let own = scaled_jacobian(mesh.points(), &hex);
        for size in [1e30, 1e105, 1e200] {
            let large: Vec<Point> = mesh.points().iter().map(|p| p * size).collect();
            let found = scaled_jacobian(&large, &hex);
            assert!((found - own).abs() < 1e-12, "{size}: {found}, not {own}");
        }
        mesh.points_mut()[6].y = f64::NAN;
        assert_eq!(scaled_jacobian(mesh.points(), &hex), -1.0);
        assert_eq!(tetrahedron_scaled_jacobian(mesh.points(), &[0, 1, 2, 6]), -1.0);
        assert_eq!(quadrilateral_scaled_jacobian(mesh.points(), &[4, 5, 6, 7]), -1.0);
    }

    #[test]
    fn boxes_are_perfect_and_mirrored_ones_inverted() {
        let mut mesh = cube();
        assert_eq!(cell_qualities(&mesh).unwrap(), [(1.0, 1.0)]);
        mesh.points_mut().iter_mut().for_each(|p| p.x *= -2.0);
        let stats = statistics(&cell_qualities(&mesh).unwrap());
        assert_eq!((stats.min, stats.volume, stats.inverted, stats.histogram[0]), (-1.0, -2.0, 1, 1));
    }

    #[test]
    fn a_sheared_corner_has_the_sine_of_its_angle() {
        let mut mesh = cube();
        for v in [2, 3, 6, 7] {
            mesh.points_mut()[v].x += 1.0;
        }
        let [(quality, volume)] = cell_qualities(&mesh).unwrap()[..] else { panic!() };
        assert!((quality - 0.5_f64.sqrt()).abs() < 1e-15 && (volume - 1.0).abs() < 1e-15);
    }

    #[test]
    fn quadrilaterals_have_the_least_sine_of_their_corners() {
        let flat = |corners: [[f64; 2]; 4]| {
            let points = corners.iter().map(|p| Point::new(p[0], p[1], 3.0)).collect();
            Mesh::new(points, Cells::Quads(vec![[0, 1, 2, 3]])).unwrap()
        };
        let quality = |corners| scaled_jacobians(&flat(corners)).unwrap()[0];
        assert_eq!(quality([[0., 0.], [4., 0.], [4., 2.], [0., 2.]]), 1.0);
        // A rhombus with 60 degrees, a dart, a triangle with a vertex on its side.
        let rhombus = quality([[0., 0.], [2., 0.], [3., 3_f64.sqrt()], [1., 3_f64.sqrt()]]);
        assert!((rhombus - 0.75_f64.sqrt()).abs() < 1e-15, "{rhombus}");
        assert!(quality([[0., 0.], [4., 0.], [1., 1.], [0., 4.]]) < -0.5);
        assert_eq!(quality([[0., 0.], [1., 0.], [2., 0.], [1., 2.]]), 0.0);
        let triangles = Mesh::new(vec![Point::origin(); 3], Cells::Triangles(vec![[0, 1, 2]])).unwrap();
        assert_eq!(scaled_jacobians(&triangles).unwrap_err().kind, ErrorKind::Unsupported);
        assert_eq!(scaled_jacobians(&cube()).unwrap(), [1.0]);
    }

    #[test]
    fn regular_tetrahedra_are_perfect() {
        let points: Vec<Point> =
            [[1., 1., 1.], [-1., 1., -1.], [1., -1., -1.], [-1., -1., 1.]].map(Point::from).to_vec();
        assert!((tetrahedron_scaled_jacobian(&points, &[0, 1, 2, 3]) - 1.0).abs() < 1e-14);
        assert!(tetrahedron_volume(&points, &[0, 2, 1, 3]) < 0.0);
        let flat = [points[0]; 4];
        assert_eq!(tetrahedron_scaled_jacobian(&flat, &[0, 1, 2, 3]), 0.0);
    }

    #[test]
    fn twisted_faces_have_the_volume_of_the_trilinear_map() {
        let mut mesh = cube();
        mesh.points_mut()[6] = Point::new(1.5, 1.25, 1.75);
        let Cells::Hexahedra(hexes) = mesh.cells() else { panic!() };
        // By the midpoint rule on a fine grid of the trilinear map.
        let (n, mut sum) = (24, 0.0);
        for i in 0..n * n * n {
            let u = [i % n, i / n % n, i / n / n].map(|k| (f64::from(k) + 0.5) / f64::from(n));
            let bulge = Vector3::new(0.5, 0.25, 0.75);
            let slope = Vector3::new(u[1] * u[2], u[0] * u[2], u[0] * u[1]);
            sum += (Matrix3::identity() + bulge * slope.transpose()).determinant();
        }
        let volume = hexahedron_volume(mesh.points(), &hexes[0]);
        assert!((volume - sum / f64::from(n * n * n)).abs() < 1e-3, "{volume}");
    }
}
