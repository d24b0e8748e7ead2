//! Reads a mesh as a polycube, or says what is wrong with it.

use super::charts::Charts;
use super::extract::Skeleton;
use super::label::{Label, area_vector};
use super::polycube::{Polycube, Tolerance};
use super::{Surface, Violation};
use crate::mesh::{Cells, Mesh, Point};

impl Polycube {
    /// Reads `mesh` as a polycube, or lists every violation of the first rule that does not hold ([`Violation`]).
    ///
    /// `labels` has one number per boundary face (see [`Cells::boundary`](crate::mesh::Cells::boundary)), −1 where the
    /// face's normal shall decide, as it does for faces beyond the last label. Whether the surface touches itself is
    /// not checked here but by [`overlaps`](Self::overlaps). O(n log n) for n faces.
    pub fn new(mesh: &Mesh, labels: Option<&[i8]>, tolerance: &Tolerance) -> Result<Self, Vec<Violation>> {
        check_cells(mesh.cells())?;
        let faces = mesh.cells().boundary().map_err(|e| match e.place {
            Some(crate::Place::Edge(a, b)) => vec![Violation::NonManifoldEdge { edge: [a, b] }],
            Some(crate::Place::Cell(cell)) => vec![Violation::CrowdedCell { cell }],
            _ => vec![Violation::Empty],
        })?;
        let surface = Surface::new(faces, mesh.points().len())?;
        let (labels, degrees) = label_faces(mesh.points(), &surface, labels, tolerance)?;
        let charts = Charts::new(&surface, labels)?;
        let skeleton = Skeleton::new(&surface, &charts)?;
        skeleton.into_polycube(mesh.points(), surface, charts, degrees, tolerance)
    }
}

/// Refuses cells of a volume that use a vertex twice.
fn check_cells(cells: &Cells) -> Result<(), Vec<Violation>> {
    if !cells.is_volume() {
        return Ok(());
    }
    let collapsed = |cell: usize| {
        let all = cells.cell(cell);
        let corners = (0..all.len()).filter(|&i| !all[..i].contains(&all[i])).count();
        (corners < all.len()).then_some(Violation::CollapsedCell { cell: cell as u32, corners })
    };
    let found: Vec<Violation> = (0..cells.len()).filter_map(collapsed).collect();
    if found.is_empty() { Ok(()) } else { Err(found) }
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
