//! A mesh read as a polycube: its structure, and what of the structure each face and vertex belongs to.

use super::charts::Charts;
use super::extract::Skeleton;
use super::label::{Label, area_vector};
use super::{Overlaps, Placement, Structure, Surface, Violation};
use crate::mesh::{Mesh, Point};
use crate::range::Range;

/// How far a mesh may be from a polycube and still be read as one.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Tolerance {
    /// Largest angle between a face and the nearest axis, in degrees; 0 to 45.
    pub degrees: f64,
    /// Largest distance of a vertex from the plane of its chart, as a fraction of the bounding box's diagonal; 0 to 1.
    pub distance: f64,
    /// Levels closer than this fraction of the bounding box's diagonal are taken to be equal; 0 to 1.
    pub merge: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { degrees: 30.0, distance: 0.05, merge: 1e-6 }
    }
}

impl Tolerance {
    /// Refuses what is out of its range.
    ///
    /// # Errors
    /// [`ErrorKind::Option`](crate::ErrorKind::Option), which names the field.
    pub fn check(&self) -> crate::Result<()> {
        Range::Within(0.0, 45.0).check("tolerance.degrees", self.degrees)?;
        Range::Within(0.0, 1.0).check("tolerance.distance", self.distance)?;
        Range::Within(0.0, 1.0).check("tolerance.merge", self.merge)
    }
}

/// How far the mesh is from a polycube.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Deviation {
    /// Largest angle between a face and the axis of its label, in degrees.
    pub degrees: f64,
    /// Largest distance of a vertex from the plane of its chart, in the units of the mesh.
    pub distance: f64,
}

/// A [`Structure`] found on a mesh, with the way back to the mesh.
#[derive(Clone, Debug)]
pub struct Polycube {
    /// Facets, edges, corners, levels.
    pub structure: Structure,
    /// The levels as the mesh has them, in its units.
    pub placement: Placement,
    /// The boundary of the mesh.
    pub surface: Surface,
    /// The facet of every boundary face.
    pub facet_of_face: Vec<u32>,
    /// The mesh vertices along every edge, from its lower to its higher corner.
    pub chains: Vec<Vec<u32>>,
    /// For every mesh vertex and axis, the level that it must lie on: three at corners, two on edges, one on facets.
    pub vertex_levels: Vec<[Option<u32>; 3]>,
    /// How far the mesh is from exact.
    pub deviation: Deviation,
}

impl Polycube {
    /// Reads `mesh` as a polycube, or lists every violation of the first rule that does not hold ([`Violation`]).
    ///
    /// `labels` has one number per boundary face (see [`Cells::boundary`](crate::mesh::Cells::boundary)), −1 where
    /// the face's normal shall decide, as it does for faces beyond the last label. Whether the surface touches itself is not checked here but by
    /// [`overlaps`](Self::overlaps). O(n log n) for n faces.
    pub fn new(mesh: &Mesh, labels: Option<&[i8]>, tolerance: &Tolerance) -> Result<Self, Vec<Violation>> {
        check_points(&mesh.points)?;
        let faces = mesh.cells.boundary().map_err(|e| match e.place {
            Some(crate::Place::Edge(a, b)) => vec![Violation::NonManifoldEdge { edge: [a, b] }],
            Some(crate::Place::Cell(cell)) => vec![Violation::CrowdedCell { cell }],
            _ => vec![Violation::Empty],
        })?;
        let surface = Surface::new(faces, mesh.points.len())?;
        let (labels, degrees) = label_faces(&mesh.points, &surface, labels, tolerance)?;
        let charts = Charts::new(&surface, labels)?;
        let skeleton = Skeleton::new(&surface, &charts)?;
        skeleton.into_polycube(&mesh.points, surface, charts, degrees, tolerance)
    }

    /// Where the surface touches or crosses itself, or looks inward, as the mesh comes: one place for each pair of facets that meet.
    pub fn overlaps(&self, points: &[Point]) -> Vec<Violation> {
        Overlaps::of(self).all(points)
    }

    /// The label of every boundary face.
    pub fn labels(&self) -> impl Iterator<Item = Label> + '_ {
        self.facet_of_face.iter().map(|&f| self.structure.facets[f as usize].label)
    }

    /// The prescribed coordinates of every mesh vertex when the levels lie at `placement`.
    pub fn prescribed(&self, placement: &[f64]) -> Vec<[Option<f64>; 3]> {
        let at = |level: Option<u32>| level.map(|l| placement[l as usize]);
        self.vertex_levels.iter().map(|levels| levels.map(at)).collect()
    }
}

fn check_points(points: &[Point]) -> Result<(), Vec<Violation>> {
    let bad = (0..).zip(points).filter(|(_, p)| !p.iter().all(|x| x.is_finite()));
    let violations: Vec<_> = bad.map(|(vertex, _)| Violation::NotFinite { vertex }).collect();
    if violations.is_empty() { Ok(()) } else { Err(violations) }
}

/// The label of every face and the largest angle to its axis, or the faces that have none.
fn label_faces(
    points: &[Point],
    surface: &Surface,
    given: Option<&[i8]>,
    tolerance: &Tolerance,
) -> Result<(Vec<Label>, f64), Vec<Violation>> {
    let degrees = |cosine: f64| libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees();
    // Faces well within the tolerance need no arc cosine.
    let least = libm::cos(tolerance.degrees.to_radians()) + 1e-6;
    let mut labels = Vec::with_capacity(surface.faces().len());
    let mut violations = Vec::new();
    let mut worst = 1.0_f64;
    for (face, f) in (0..).zip(surface.faces()) {
        let normal = area_vector(points, f);
        let own = given.and_then(|g| g.get(face as usize)).and_then(|&l| Label::new(l));
        let (nearest, cosine) = Label::nearest(&normal);
        labels.push(own.unwrap_or(nearest));
        if !cosine.is_finite() {
            if own.is_none() {
                violations.push(Violation::FlatFace { face });
            }
            continue;
        }
        let along = |label: Label| f64::from(label.sign()) * normal[label.axis()] / normal.norm();
        let cosine = own.map_or(cosine, along);
        worst = worst.min(cosine);
        if own.is_none() && cosine < least && degrees(cosine) > tolerance.degrees {
            violations.push(Violation::SkewFace { face, degrees: degrees(cosine), limit: tolerance.degrees });
        }
    }
    if violations.is_empty() { Ok((labels, degrees(worst))) } else { Err(violations) }
}
