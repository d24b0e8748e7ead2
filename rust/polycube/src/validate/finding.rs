//! What is wrong, with its place and remedy.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::{Face, Mesh, Point};
use crate::structure::Violation;

/// Which of the two meshes a finding is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
#[serde(rename_all = "snake_case")]
pub enum Subject {
    /// The polycube.
    Polycube,
    /// The shape.
    Shape,
}

/// Something wrong, with its place and remedy.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Finding {
    /// A short name of the rule broken, in `snake_case`: that of a [`Violation`], `flipped_face`, `mismatch`,
    /// `bad_label`, `label_order`, `left_handed`, `not_welded`, `duplicate_cells`, `too_large`, `mirrored`,
    /// `not_finite`, `malformed`, `inside_out` or `crossing_faces`.
    pub rule: &'static str,
    /// Which mesh is concerned.
    pub mesh: Subject,
    /// The element concerned.
    pub element: Option<Place>,
    /// The middle of the element, in units of its mesh.
    pub at: Option<[f64; 3]>,
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub remedy: String,
}

impl Finding {
    /// What an error of reading `mesh`, or of making it, tells of it; with its middle unknown.
    ///
    /// # Errors
    /// The error itself where it is not about what is in the mesh: the file cannot be opened, say.
    pub fn of(error: Error, mesh: Subject) -> Result<Self> {
        let rule = match (error.kind, error.place) {
            (ErrorKind::Mesh, Some(Place::Vertex(_))) => "not_finite",
            (ErrorKind::Mesh, Some(_)) | (ErrorKind::Parse, _) => "malformed",
            (ErrorKind::Mesh, None) => "empty",
            (ErrorKind::Mismatch, _) => "mismatch",
            _ => return Err(error),
        };
        let remedy = match error.remedy.is_empty() {
            true => "export the mesh again".to_owned(),
            false => error.remedy,
        };
        Ok(Self { rule, mesh, element: error.place, at: None, message: error.message, remedy })
    }
}

/// The middles of a mesh's elements.
pub(super) struct Middles<'a> {
    mesh: &'a Mesh,
    boundary: Vec<Face>,
}

impl<'a> Middles<'a> {
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        Self { mesh, boundary: mesh.cells().boundary().unwrap_or_default() }
    }

    pub(super) fn findings(&self, violations: impl Iterator<Item = Violation>, mesh: Subject) -> Vec<Finding> {
        violations.map(|violation| self.finding(violation.rule(), violation.into(), mesh)).collect()
    }

    /// An error as a finding.
    pub(super) fn finding(&self, rule: &'static str, error: Error, mesh: Subject) -> Finding {
        let Error { place: element, message, remedy, .. } = error;
        let at = element.and_then(|place| self.of(place));
        Finding { rule, mesh, element, at, message, remedy }
    }

    pub(super) fn flipped_face(&self, face: u32) -> Finding {
        let place = Place::Face(face);
        Finding {
            rule: "flipped_face",
            mesh: Subject::Polycube,
            element: Some(place),
            at: self.of(place),
            message: "the face looks away from the side of its label".to_owned(),
            remedy: "untangle the polycube map, or correct the label".to_owned(),
        }
    }

    fn of(&self, place: Place) -> Option<[f64; 3]> {
        match place {
            Place::Face(i) => mean(self.mesh, self.boundary.get(i as usize)?.vertices()),
            place => self.mesh.middle(place),
        }
    }
}

impl Mesh {
    /// The mean of an element's vertices; nothing for elements that are not there and for those of structures and
    /// files.
    pub fn middle(&self, place: Place) -> Option<[f64; 3]> {
        match place {
            Place::Vertex(v) => mean(self, &[v]),
            Place::Edge(a, b) => mean(self, &[a, b]),
            Place::Face(i) => mean(self, self.cells().boundary().ok()?.get(i as usize)?.vertices()),
            Place::Cell(i) if (i as usize) < self.cells().len() => mean(self, self.cells().cell(i as usize)),
            Place::Cell(_) | Place::PolycubeEdge(_) | Place::Facet(_) | Place::Line(_) => None,
        }
    }
}

fn mean(mesh: &Mesh, vertices: &[u32]) -> Option<[f64; 3]> {
    let points: Option<Vec<&Point>> = vertices.iter().map(|&v| mesh.points().get(v as usize)).collect();
    let points = points?;
    Some([0, 1, 2].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64))
}
