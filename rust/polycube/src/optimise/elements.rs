//! The corner tetrahedra whose shapes are optimised, each with the shape it should have.

use super::sizes::{fair, sizes};
use super::springs::{Spring, Springs};
use crate::error::{Error, ErrorKind, Place, Result};
use crate::measure::{AIM, Fair, corner_soundness, edges, mean_determinant, or_worst};
use crate::mesh::Point;
use crate::mesh::hexahedron::{CORNERS, EDGES, corner_tetrahedra};
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// How the quality of an element is measured; always in −1..1, positive where it is not inverted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Scaled Jacobian of the three edges, 1 where they are perpendicular; but less where one is more than five times
    /// as long as another or their determinant is under a twentieth of the mean, so that cells do not collapse.
    ScaledJacobian,
    /// Mean ratio `3 det(J)^(2/3) / tr(Jᵀ J)` of the map from the reference, with the sign of `det J`: 1 for
    /// similarities.
    MeanRatio,
}

/// The shape an element should have: what the energy needs of the inverse `R` of its edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reference<T> {
    /// `R Rᵀ`: the entries xx, yy, zz, yz, xz, xy.
    pub(super) metric: [T; 6],
    /// `det R`.
    pub(super) det: T,
}

impl Reference<f64> {
    /// For the edges as columns; those of the unit cube where they are flat.
    pub(super) fn new(edges: &Matrix3<f64>) -> Self {
        let inverse = edges.try_inverse().unwrap_or_else(Matrix3::identity);
        let square = inverse * inverse.transpose();
        let metric = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)].map(|at| square[at]);
        Self { metric, det: inverse.determinant() }
    }

    /// The reference `factor` times as large.
    fn enlarged(&self, factor: f64) -> Self {
        let square = factor * factor;
        Self { metric: self.metric.map(|m| m / square), det: self.det / (square * factor) }
    }

    /// `tr(Jᵀ J)`.
    fn trace(&self, edges: &Matrix3<f64>) -> f64 {
        let dot = |a: usize, b: usize| edges.column(a).dot(&edges.column(b));
        let [xx, yy, zz, yz, xz, xy] = self.metric;
        xx * dot(0, 0) + yy * dot(1, 1) + zz * dot(2, 2) + 2.0 * (yz * dot(1, 2) + xz * dot(0, 2) + xy * dot(0, 1))
    }
}

/// Corner tetrahedra, each given by a vertex and the ends of three edges that leave it.
///
/// `J = [x1 − x0, x2 − x0, x3 − x0] R` maps the reference of an element, whose edges are `R⁻¹`, onto its present shape.
/// About 80 bytes an element.
#[derive(Clone, Debug)]
pub struct Elements {
    pub(super) corners: Vec<[u32; 4]>,
    pub(super) references: Vec<Reference<f64>>,
    pub(super) weights: Vec<f64>,
    pub(super) per_cell: usize,
    pub(super) measure: Measure,
    /// What is added to the third edge of each element: those of a surface, whose third edge has no other end, have
    /// their normals there, as long as their sides. None for elements of a volume.
    pub(super) offsets: Vec<Vector3<f64>>,
    /// The mean determinant of the edges; 0 as long as it is not known.
    pub(super) mean: f64,
    /// What pulls at their vertices.
    pub(super) springs: Springs,
}

/// Elements that a thread takes at least.
const LEAST_SHARE: usize = 4096;

/// A rest shape with a lower mean ratio than this is no example to follow.
const WORST_REST: f64 = 0.02;

impl Elements {
    /// Tetrahedra that should look as in `rest`, each with its rest volume as weight (Garanzha et al. 2021).
    ///
    /// For a polycube map the cells are those of both meshes, `rest` is the shape, and the optimised points are those
    /// of the polycube. A rest tetrahedron that is inverted or all but flat is replaced by a regular one of the same
    /// mean edge length, so bad input does not spoil the map.
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`] naming the cell that has a vertex outside `rest`.
    pub fn tetrahedra_like(tets: &[[u32; 4]], rest: &[Point]) -> Result<Self> {
        check(tets, rest.len())?;
        let shapes: Vec<_> = tets.iter().map(|t| rest_shape(&edges(rest, *t))).collect();
        let volumes = shapes.iter().map(Matrix3::determinant);
        let mean = volumes.clone().sum::<f64>() / tets.len().max(1) as f64;
        let weights = volumes.map(|v| v / mean).collect();
        Ok(Self::new(tets.to_vec(), shapes, weights, 1, Measure::MeanRatio))
    }

    /// Tetrahedra that should be regular, all of one size and one weight, so that thin ones count as much as others
    /// where a mesh is to be untangled.
    pub fn regular_tetrahedra(tets: &[[u32; 4]]) -> Self {
        let shapes = vec![regular(); tets.len()];
        Self::new(tets.to_vec(), shapes, vec![1.0; tets.len()], 1, Measure::MeanRatio)
    }

    /// Hexahedra in VTK's order that should be cubes, all of one size: eight corner tetrahedra each.
    ///
    /// The optimiser then guarantees that the Jacobian is positive at all eight corners. That is what solvers and
    /// [`scaled_jacobian`](crate::measure::scaled_jacobian()) check; it does not prove it positive everywhere inside.
    #[cfg(test)]
    pub fn cubes(hexes: &[[u32; 8]]) -> Self {
        let shapes = vec![Matrix3::identity(); 8 * hexes.len()];
        Self::new(corners(hexes), shapes, vec![1.0; 8 * hexes.len()], 8, Measure::ScaledJacobian)
    }

    /// Hexahedra that should be boxes with about the edge lengths they have in `points`; eight
    /// corner tetrahedra each.
    ///
    /// The lengths are averaged over parallel edges, `smoothing` times over the neighbours as well (3 is a good
    /// number), so layers that are thin on purpose stay thin, while single odd edges do not count. O(n log n) for
    /// sorting the edges.
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`] naming the cell that has a vertex outside `points`.
    pub fn boxes_like(hexes: &[[u32; 8]], points: &[Point], smoothing: usize) -> Result<Self> {
        check(hexes, points.len())?;
        Ok(Self::boxes(hexes, points, &sizes(hexes, &EDGES, points, smoothing)))
    }

    /// The same, but no box is thinner than 0.3 times the mean edge or a quarter of its own longest side: cells that
    /// have collapsed are no example.
    ///
    /// # Errors
    /// Those of [`boxes_like`](Self::boxes_like).
    pub fn fair_boxes_like(hexes: &[[u32; 8]], points: &[Point], smoothing: usize) -> Result<Self> {
        check(hexes, points.len())?;
        Ok(Self::boxes(hexes, points, &fair(sizes(hexes, &EDGES, points, smoothing))))
    }

    /// Fastens `springs` to their vertices, in place of those there were. Where these have `unit` more energy than at
    /// `points`, that is as bad as a worst quality less by 1.
    pub(crate) fn fasten(&mut self, springs: Vec<Spring>, points: &[Point], unit: f64) {
        self.springs = Springs::new(springs, points, unit);
    }

    fn boxes(hexes: &[[u32; 8]], points: &[Point], sizes: &[[f64; 3]]) -> Self {
        let shapes = sizes.iter().flat_map(corner_shapes).collect();
        let own = Self::new(corners(hexes), shapes, vec![1.0; 8 * hexes.len()], 8, Measure::ScaledJacobian);
        Self { mean: mean_determinant(points, hexes), ..own }
    }

    pub(super) fn new(
        corners: Vec<[u32; 4]>,
        shapes: Vec<Matrix3<f64>>,
        weights: Vec<f64>,
        per_cell: usize,
        measure: Measure,
    ) -> Self {
        let references = shapes.iter().map(Reference::new).collect();
        Self {
            corners,
            references,
            weights,
            per_cell,
            measure,
            offsets: Vec::new(),
            mean: 0.0,
            springs: Springs::default(),
        }
    }

    /// The determinant of the edges below which an element is less sound, see [`corner_soundness`].
    pub(super) fn small(&self) -> f64 {
        AIM.determinant * self.mean
    }

    /// Number of corner tetrahedra.
    pub fn len(&self) -> usize {
        self.corners.len()
    }

    /// Whether there is none.
    #[cfg(test)]
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    /// Cell that element `i` belongs to.
    pub(super) fn cell(&self, i: usize) -> usize {
        i / self.per_cell
    }

    /// Number of cells.
    pub(super) fn cells(&self) -> usize {
        self.len() / self.per_cell
    }

    /// How many cells have so many elements.
    pub(super) fn cells_in(&self, elements: usize) -> usize {
        elements / self.per_cell
    }

    /// The vertices of a cell, each once: those of a tetrahedron, or the one at each corner of a hexahedron.
    pub(super) fn vertices_of(&self, cell: usize) -> impl Iterator<Item = u32> + Clone {
        let own = if self.per_cell == 1 { 4 } else { 1 };
        let corners = &self.corners[cell * self.per_cell..(cell + 1) * self.per_cell];
        corners.iter().flat_map(move |corner| &corner[..own]).copied()
    }

    /// Some of the cells, with vertices numbered by `own`, without springs.
    pub(super) fn some(&self, cells: &[u32], own: impl Fn(u32) -> u32) -> Self {
        let all = || cells.iter().flat_map(|&cell| (0..self.per_cell).map(move |k| cell as usize * self.per_cell + k));
        Self {
            corners: all().map(|e| self.corners[e].map(&own)).collect(),
            references: all().map(|e| self.references[e]).collect(),
            weights: all().map(|e| self.weights[e]).collect(),
            offsets: all().filter_map(|e| self.offsets.get(e).copied()).collect(),
            springs: Springs::default(),
            ..*self
        }
    }

    /// The three edges of an element.
    #[inline]
    pub(super) fn edges(&self, i: usize, points: &[Point]) -> Matrix3<f64> {
        let mut edges = edges(points, self.corners[i]);
        if let Some(offset) = self.offsets.get(i) {
            edges.set_column(2, &(edges.column(2) + offset));
        }
        edges
    }

    /// Scales the references to the mean volume of the elements, or area of those of a surface, which a fixed boundary
    /// keeps.
    pub(super) fn match_size(&mut self, points: &[Point]) {
        if self.mean == 0.0 {
            let all = self.each(|i| self.edges(i, points).determinant().abs());
            self.mean = all.iter().sum::<f64>() / self.len().max(1) as f64;
        }
        let dets = self.each(|i| self.weights[i] * self.det(i, points));
        let weight: f64 = self.weights.iter().sum();
        let (mean, absolute) = (dets.iter().sum::<f64>() / weight, dets.iter().map(|d| d.abs()).sum::<f64>() / weight);
        // Corners of tangled hexahedra may cancel each other out.
        let mean = if mean > 0.05 * absolute { mean } else { absolute };
        let root = if self.offsets.is_empty() { libm::cbrt } else { libm::sqrt };
        let factor = if mean > 0.0 && mean.is_finite() { root(mean) } else { 1.0 };
        self.references.iter_mut().for_each(|r| *r = r.enlarged(factor));
        if !self.offsets.is_empty() {
            self.offsets.iter_mut().for_each(|offset| *offset *= factor);
            self.mean *= factor;
        }
    }

    pub(super) fn quality(&self, i: usize, points: &[Point]) -> f64 {
        let edges = self.edges(i, points);
        match self.measure {
            Measure::ScaledJacobian => corner_soundness(&edges, self.mean, &AIM),
            Measure::MeanRatio => mean_ratio(&edges, &self.references[i]),
        }
    }

    /// How sound a cell is by what is `fair`, in −1..1: as its worst element.
    pub(crate) fn soundness(&self, cell: usize, points: &[Point], fair: &Fair) -> f64 {
        let own = cell * self.per_cell..(cell + 1) * self.per_cell;
        let of = |i: usize| or_worst(corner_soundness(&self.edges(i, points), self.mean, fair));
        own.map(of).fold(1.0, f64::min)
    }

    /// `f` of every element, on all threads.
    pub(super) fn each<T: Send>(&self, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
        (0..self.len()).into_par_iter().with_min_len(LEAST_SHARE).map(f).collect()
    }

    /// `det J`.
    pub(super) fn det(&self, i: usize, points: &[Point]) -> f64 {
        self.edges(i, points).determinant() * self.references[i].det
    }
}

/// See [`Measure::MeanRatio`].
fn mean_ratio(edges: &Matrix3<f64>, reference: &Reference<f64>) -> f64 {
    let (det, sum) = (edges.determinant() * reference.det, reference.trace(edges));
    let root = libm::cbrt(det);
    if sum > 0.0 { 3.0 * root * root.abs() / sum } else { 0.0 }
}

pub(super) fn check<const N: usize>(cells: &[[u32; N]], points: usize) -> Result<()> {
    match cells.iter().position(|c| c.iter().any(|v| *v as usize >= points)) {
        None => Ok(()),
        Some(i) => Err(Error::new(ErrorKind::Mesh, format!("a vertex is not among the {points} of the mesh"))
            .at(Place::Cell(i as u32))),
    }
}

/// Edges of the regular tetrahedron with edges of length 1.
fn regular() -> Matrix3<f64> {
    let (third, height) = (3.0_f64.sqrt() / 6.0, (2.0_f64 / 3.0).sqrt());
    Matrix3::new(1.0, 0.5, 0.5, 0.0, 3.0 * third, third, 0.0, 0.0, height)
}

fn rest_shape(edges: &Matrix3<f64>) -> Matrix3<f64> {
    let ideal = regular();
    let good = mean_ratio(edges, &Reference::new(&ideal)) > WORST_REST;
    let length = (0..3).map(|i| edges.column(i).norm()).sum::<f64>() / 3.0;
    if good { *edges } else { ideal * if length > 0.0 { length } else { 1.0 } }
}

fn corners(hexes: &[[u32; 8]]) -> Vec<[u32; 4]> {
    hexes.iter().flat_map(corner_tetrahedra).collect()
}

/// The reference edges of the eight corners of a box: each corner's three edges in its own order.
fn corner_shapes(size: &[f64; 3]) -> [Matrix3<f64>; 8] {
    CORNERS.map(|[from, to @ ..]| {
        let along = |to: usize| {
            let pair = |e: &[usize; 2]| *e == [from, to] || *e == [to, from];
            EDGES.iter().position(|set| set.iter().any(pair)).unwrap_or(0)
        };
        Matrix3::from_diagonal(&Vector3::from(to.map(|to| size[along(to)])))
    })
}
