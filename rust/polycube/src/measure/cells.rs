//! What solvers look at in hexahedra, cell by cell and in total.

use super::BARS;
use super::faces::over_faces;
use super::quality::edges;
use super::soundness::mean_determinant;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::hexahedron::{EDGES, corner_tetrahedra};
use crate::mesh::{CellField, Cells, Mesh, Point};

/// Measures of each hexahedron of a mesh beside its scaled Jacobian, which says nothing of sizes.
#[derive(Clone, Debug, Default, PartialEq, bitcode::Encode, bitcode::Decode)]
pub struct CellMeasures {
    /// The longest of the twelve edges over the shortest, at least 1; infinite where one has no length.
    pub edge_ratio: Vec<f64>,
    /// The least determinant of the edges at a corner over the mean of all corners of the mesh: 1 for cubes of one
    /// size, not positive for inverted cells.
    pub determinant: Vec<f64>,
    /// The largest angle between the normal of a face and the line to the middle of the cell behind it, in degrees from
    /// 0 to 180, as OpenFOAM defines it; faces at the surface do not count.
    pub non_orthogonality: Vec<f64>,
    /// How far from the middle of a face the line to the middle of the next cell meets it, at worst, by the face's own
    /// extent, at least 0, as OpenFOAM defines it; at the surface the line is the normal. More than 4 is bad.
    pub skewness: Vec<f64>,
}

impl CellMeasures {
    /// Measures the cells of a mesh of hexahedra. Linear time.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for other cells.
    pub fn new(mesh: &Mesh) -> Result<Self> {
        let (Cells::Hexahedra(hexes), points) = (mesh.cells(), mesh.points()) else {
            return Err(Error::new(ErrorKind::Unsupported, "only hexahedra have these measures")
                .remedy("give a mesh of hexahedra"));
        };
        let mean = mean_determinant(points, hexes);
        let (non_orthogonality, skewness) = over_faces(points, hexes).into_iter().map(|[a, s]| (a, s)).unzip();
        Ok(Self {
            edge_ratio: hexes.iter().map(|hex| edge_ratio(points, hex)).collect(),
            determinant: hexes.iter().map(|hex| least_determinant(points, hex) / mean).collect(),
            non_orthogonality,
            skewness,
        })
    }

    /// All of them for mesh files.
    pub fn fields(&self) -> Vec<CellField> {
        vec![
            CellField::real("edge_ratio", self.edge_ratio.clone()),
            CellField::real("determinant", self.determinant.clone()),
            CellField::real("non_orthogonality", self.non_orthogonality.clone()),
            CellField::real("skewness", self.skewness.clone()),
        ]
    }

    /// All of them in total.
    pub fn summary(&self) -> MeasureSummary {
        MeasureSummary {
            edge_ratio: Spread::new(&self.edge_ratio, 1.0, 1.0),
            determinant: Spread::new(&self.determinant, 0.0, 0.05),
            non_orthogonality: Spread::new(&self.non_orthogonality, 0.0, 4.5),
            skewness: Spread::new(&self.skewness, 0.0, 0.2),
        }
    }
}

/// [`CellMeasures`] of a whole mesh.
#[derive(Clone, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct MeasureSummary {
    /// Longest over shortest edge.
    pub edge_ratio: Spread,
    /// Least determinant over the mean of the mesh.
    pub determinant: Spread,
    /// Largest non-orthogonality, in degrees.
    pub non_orthogonality: Spread,
    /// Largest skewness.
    pub skewness: Spread,
}

/// How one measure is spread over the cells of a mesh.
#[derive(Clone, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct Spread {
    /// The least; 0 for no cell.
    pub min: f64,
    /// The largest; 0 for no cell.
    pub max: f64,
    /// The mean; 0 for no cell.
    pub mean: f64,
    /// Where the first bar begins.
    pub from: f64,
    /// How wide bars are.
    pub bar: f64,
    /// Cells by bar, each up to the next without it; the first also has what is below it, the last what is above it.
    pub histogram: [u32; BARS],
}

impl Spread {
    fn new(all: &[f64], from: f64, bar: f64) -> Self {
        let mut histogram = [0; BARS];
        for x in all {
            histogram[((x - from) / bar).clamp(0.0, BARS as f64 - 1.0) as usize] += 1;
        }
        let or_none = |x: f64| if all.is_empty() { 0.0 } else { x };
        Self {
            min: or_none(all.iter().copied().fold(f64::INFINITY, f64::min)),
            max: or_none(all.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
            mean: all.iter().sum::<f64>() / all.len().max(1) as f64,
            from,
            bar,
            histogram,
        }
    }
}

fn edge_ratio(points: &[Point], hex: &[u32; 8]) -> f64 {
    let length = |[a, b]: &[usize; 2]| (points[hex[*a] as usize] - points[hex[*b] as usize]).norm();
    let lengths = EDGES.as_flattened().iter().map(length);
    lengths.clone().fold(0.0, f64::max) / lengths.fold(f64::INFINITY, f64::min)
}

fn least_determinant(points: &[Point], hex: &[u32; 8]) -> f64 {
    corner_tetrahedra(hex).into_iter().map(|c| edges(points, c).determinant()).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two unit cubes side by side along x, the upper end of the second one moved.
    fn two(end: f64, shear: f64) -> Mesh {
        let at = |x: usize, y: usize, z: usize| (x + 3 * (y + 2 * z)) as u32;
        let cell = |x| {
            [
                at(x, 0, 0),
                at(x + 1, 0, 0),
                at(x + 1, 1, 0),
                at(x, 1, 0),
                at(x, 0, 1),
                at(x + 1, 0, 1),
                at(x + 1, 1, 1),
                at(x, 1, 1),
            ]
        };
        let place = |i: usize| {
            let [x, y, z] = [i % 3, i / 3 % 2, i / 6].map(|k| k as f64);
            if x == 2.0 { Point::new(1.0 + end, y + shear, z) } else { Point::new(x, y, z) }
        };
        Mesh::new((0..12).map(place).collect(), Cells::Hexahedra(vec![cell(0), cell(1)])).unwrap()
    }

    #[test]
    fn cubes_are_perfect() {
        let found = CellMeasures::new(&two(1.0, 0.0)).unwrap();
        assert_eq!((found.edge_ratio, found.determinant), (vec![1.0; 2], vec![1.0; 2]));
        assert!(found.non_orthogonality.iter().chain(&found.skewness).all(|x| *x < 1e-6));
    }

    #[test]
    fn flat_cells_show_in_edges_and_determinants_alone() {
        let found = CellMeasures::new(&two(0.1, 0.0)).unwrap();
        assert!((found.edge_ratio[1] - 10.0).abs() < 1e-9 && found.edge_ratio[0] == 1.0);
        assert!((found.determinant[1] - 0.1 / 0.55).abs() < 1e-9);
        assert!(found.non_orthogonality.iter().chain(&found.skewness).all(|x| *x < 1e-6));
        assert_eq!(found.summary().edge_ratio.histogram[0], 1);
    }

    #[test]
    fn sheared_cells_are_askew() {
        // The line between the middles rises by a half on its way of one, and meets the face a quarter above its
        // middle; half the face is a half high.
        let found = CellMeasures::new(&two(1.0, 1.0)).unwrap();
        let angle = 0.5_f64.atan().to_degrees();
        assert!((found.non_orthogonality[0] - angle).abs() < 1e-9, "{:?}", found.non_orthogonality);
        assert!((found.skewness[0] - 0.5).abs() < 1e-9, "{:?}", found.skewness);
    }

    #[test]
    fn other_cells_are_refused() {
        let mesh = Mesh::new(Vec::new(), Cells::Triangles(Vec::new())).unwrap();
        assert_eq!(CellMeasures::new(&mesh).unwrap_err().kind, ErrorKind::Unsupported);
    }
}
