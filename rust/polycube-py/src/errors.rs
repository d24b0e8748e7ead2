//! The library's errors as Python exceptions, one class for each kind.

use polycube::mesh::Mesh;
use polycube::{Error, ErrorKind, Place};
use pyo3::prelude::*;

/// The exception for an error. `at` is the middle of the element concerned, where that is known.
pub fn raise(py: Python<'_>, error: &Error, at: Option<[f64; 3]>) -> PyErr {
    build(py, error, at).unwrap_or_else(|failure| failure)
}

/// The exception for an error about a mesh, or about a file (without one).
pub fn about(py: Python<'_>, error: &Error, mesh: Option<&Mesh>) -> PyErr {
    raise(py, error, mesh.zip(error.place).and_then(|(mesh, place)| mesh.middle(place)))
}

/// The exception for an option that is out of its range.
pub fn option(py: Python<'_>, message: impl Into<String>, remedy: &str) -> PyErr {
    raise(py, &Error::new(ErrorKind::Option, message).remedy(remedy), None)
}

fn build(py: Python<'_>, error: &Error, at: Option<[f64; 3]>) -> PyResult<PyErr> {
    let (class, kind) = class(error.kind);
    let (element, elements) = error.place.map_or((None, Vec::new()), |place| {
        let (name, numbers) = element(place);
        (Some(name), numbers)
    });
    let elements = pyo3::types::PyTuple::new(py, elements)?;
    let at = at.map(|[x, y, z]| (x, y, z));
    let text = error.to_string();
    let arguments = (text, kind, &error.message, element, elements, at, &error.remedy);
    let exception = py.import("polycube.errors")?.getattr(class)?.call1(arguments)?;
    Ok(PyErr::from_value(exception))
}

/// The class of a kind, and the kind's name.
fn class(kind: ErrorKind) -> (&'static str, &'static str) {
    match kind {
        ErrorKind::Io => ("FileError", "io"),
        ErrorKind::Parse => ("ParseError", "parse"),
        ErrorKind::Unsupported => ("Unsupported", "unsupported"),
        ErrorKind::Mesh => ("InvalidMesh", "mesh"),
        ErrorKind::Polycube => ("InvalidPolycube", "polycube"),
        ErrorKind::Mismatch => ("Mismatch", "mismatch"),
        ErrorKind::Option => ("InvalidOption", "option"),
        ErrorKind::Infeasible => ("Infeasible", "infeasible"),
        ErrorKind::Cancelled => ("Cancelled", "cancelled"),
        ErrorKind::Internal => ("InternalError", "internal"),
    }
}

/// The name of an element's kind, and its number or the vertices of an edge.
pub fn element(place: Place) -> (&'static str, Vec<usize>) {
    match place {
        Place::Vertex(i) => ("vertex", vec![i as usize]),
        Place::Edge(a, b) => ("edge", vec![a as usize, b as usize]),
        Place::Face(i) => ("face", vec![i as usize]),
        Place::Cell(i) => ("cell", vec![i as usize]),
        Place::PolycubeEdge(i) => ("polycube_edge", vec![i as usize]),
        Place::Facet(i) => ("facet", vec![i as usize]),
        Place::Line(i) => ("line", vec![i]),
    }
}
