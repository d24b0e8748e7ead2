//! What keeps a mesh from being a polycube.

use crate::errors;
use crate::mesh::PyMesh;
use crate::options::Keywords;
use crate::pickle::{self, Reduced};
use crate::structure::optional_labels;
use bitcode::{Decode, Encode};
use polycube::simplify::Input;
use polycube::validate::{Finding, Subject, validate, validate_shape};
use polycube::{Context, Place};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// One reason why a mesh is not a polycube.
#[pyclass(frozen, module = "polycube", name = "Violation")]
#[derive(Encode, Decode)]
pub struct PyViolation {
    rule: String,
    mesh: Subject,
    element: Option<Place>,
    at: Option<[f64; 3]>,
    message: String,
    remedy: String,
}

impl From<Finding> for PyViolation {
    fn from(finding: Finding) -> Self {
        let Finding { rule, mesh, element, at, message, remedy } = finding;
        Self { rule: rule.to_owned(), mesh, element, at, message, remedy }
    }
}

impl PyViolation {
    /// What was pickled.
    pub fn restore(py: Python<'_>, rest: &[u8]) -> PyResult<Self> {
        pickle::decode(py, rest)
    }
}

#[pymethods]
impl PyViolation {
    /// A short name of the rule broken, for programs: "open_edge", "skew_face", "self_overlap", ...
    #[getter]
    fn kind(&self) -> &str {
        &self.rule
    }

    /// "polycube" or "shape".
    #[getter]
    fn mesh(&self) -> &'static str {
        match self.mesh {
            Subject::Polycube => "polycube",
            Subject::Shape => "shape",
        }
    }

    /// What is wrong.
    #[getter]
    fn message(&self) -> &str {
        &self.message
    }

    /// What `elements` are: "vertex", "edge", "face" (of the boundary) or "cell"; None where no element is concerned.
    #[getter]
    fn element(&self) -> Option<&'static str> {
        self.element.map(|place| errors::element(place).0)
    }

    /// The element concerned: one number, or the two vertices of an edge.
    #[getter]
    fn elements<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.element.map_or_else(Vec::new, |place| errors::element(place).1))
    }

    /// The middle of the element, in the units of its mesh.
    #[getter]
    fn place(&self) -> Option<(f64, f64, f64)> {
        self.at.map(|[x, y, z]| (x, y, z))
    }

    /// How to mend it.
    #[getter]
    fn remedy(&self) -> &str {
        &self.remedy
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        pickle::reduce(py, "Violation", PyTuple::empty(py), self)
    }

    fn __repr__(&self) -> String {
        let place = self.element.map(|place| format!("{place}: ")).unwrap_or_default();
        format!("Violation({}: {place}{})", self.rule, self.message)
    }
}

/// Lists everything that keeps a mesh from being a valid polycube, with place and remedy; empty for a valid one.
///
/// The rules are checked one after the other, each only where those before it hold, so that one fault is reported once
/// and not by all that follows from it.
///
/// Args:
///     polycube: any mesh.
///     labels: (f,) 0 to 5 for each boundary face, -1 for "by the normal". By the normals if not given.
///     shape: the mesh that the polycube was deformed from: the same cells, none inverted.
///     angle_tolerance: largest angle between a face and the nearest axis, in degrees, 0 to 45.
///     level_tolerance: largest distance of a vertex from the plane of its facet, as a part of the diagonal, 0 to 1.
///
/// Raises:
///     InvalidOption: a tolerance or a label is out of its range. Never for a bad mesh.
///
/// >>> import polycube
/// >>> tetrahedron = polycube.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]], "tetrahedra")
/// >>> polycube.check(tetrahedron)
/// [Violation(skew_face: face 1: the face is 54.7 degrees off the nearest axis, more than 30)]
#[pyfunction]
#[pyo3(
    signature = (polycube, labels=None, *, shape=None, **tolerance),
    text_signature = "(polycube, labels=None, *, shape=None, angle_tolerance=30.0, level_tolerance=0.05)"
)]
pub fn check(
    py: Python<'_>,
    polycube: &PyMesh,
    #[pyo3(from_py_with = optional_labels)] labels: Option<Vec<i8>>,
    shape: Option<&PyMesh>,
    tolerance: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<PyViolation>> {
    let keywords = Keywords::new(py, "check", tolerance)?;
    let tolerance = keywords.tolerance()?;
    keywords.finish()?;
    let shape = shape.map(|shape| &*shape.0);
    let input = Input { polycube: &polycube.0, shape, labels: labels.as_deref() };
    let findings = py.detach(|| validate(&input, &tolerance)).map_err(|e| errors::raise(py, &e, None))?;
    Ok(findings.into_iter().map(PyViolation::from).collect())
}

/// Lists everything that keeps a polycube from being made of a shape, or hexahedra from filling it, with place and
/// remedy: edges that are open or have more than two faces, a surface that looks inward, and faces that cross. Empty
/// for a shape that is fit to be meshed.
///
/// Args:
///     shape: any mesh; of a volume its surface is looked at.
///
/// >>> import polycube
/// >>> polycube.check_shape(polycube.example("ring")[0])
/// []
#[pyfunction]
pub fn check_shape(py: Python<'_>, shape: &PyMesh) -> PyResult<Vec<PyViolation>> {
    let findings =
        py.detach(|| validate_shape(&shape.0, &Context::default())).map_err(|e| errors::raise(py, &e, None))?;
    Ok(findings.into_iter().map(PyViolation::from).collect())
}
