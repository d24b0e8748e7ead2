//! Making a polycube of a shape, and what comes of it.

use crate::arrays::vector;
use crate::mesh::PyMesh;
use crate::options::Keywords;
use crate::pickle::{self, Reduced};
use crate::report::{self, to_dict};
use crate::simplified::Source;
use crate::work::{Failure, Listener};
use polycube::Context;
use polycube::make::{Made, MakeOptions, MakeReport, make as run};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::Arc;

/// A polycube that was made of a shape. Arrays are read-only.
#[pyclass(frozen, from_py_object, module = "polycube", name = "Made")]
#[derive(Clone)]
pub struct PyMade(Arc<Parts>);

struct Parts {
    shape: PyMesh,
    polycube: PyMesh,
    labels: Vec<i8>,
    report: MakeReport,
}

impl From<Made> for PyMade {
    fn from(made: Made) -> Self {
        let Made { shape, polycube, labels, report } = made;
        Self(Arc::new(Parts { shape: shape.into(), polycube: polycube.into(), labels, report }))
    }
}

impl PyMade {
    /// What was pickled.
    pub fn restore(parts: &Bound<'_, PyTuple>, rest: &[u8]) -> PyResult<Self> {
        let (shape, polycube) = parts.extract()?;
        let (labels, report) = pickle::decode(parts.py(), rest)?;
        Ok(Self(Arc::new(Parts { shape, polycube, labels, report })))
    }

    /// The polycube, its shape and its labels, to be simplified.
    pub fn source(&self) -> Source {
        let Parts { shape, polycube, labels, .. } = &*self.0;
        Source { polycube: Arc::clone(&polycube.0), shape: Some(Arc::clone(&shape.0)), labels: Some(labels.clone()) }
    }
}

#[pymethods]
impl PyMade {
    /// The shape as triangles, cut finer where the map needs room; the vertices of the input come first and keep their
    /// numbers.
    #[getter]
    fn shape(&self) -> PyMesh {
        self.0.shape.clone()
    }

    /// The polycube on the integer lattice, vertex by vertex and triangle by triangle that of `shape`.
    #[getter]
    fn polycube(&self) -> PyMesh {
        self.0.polycube.clone()
    }

    /// The label of every triangle: (f,) int8, 0 to 5 for +X -X +Y -Y +Z -Z.
    #[getter]
    fn labels<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |m| &m.0.labels)
    }

    /// Whether the map from shape to polycube is one to one; where it is not, `report["folded"]` lists the triangles
    /// that are turned over.
    #[getter]
    fn good(&self) -> bool {
        self.0.report.folded.is_empty()
    }

    /// What was made and how good it is, as in the command's report.json: corners, edges, facets, genus, misfit,
    /// squashed, distortion, added vertices, folded triangles, seconds.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_dict(py, &self.0.report)
    }

    /// A picture for notebooks.
    fn _repr_png_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        report::picture(slf)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let Parts { shape, polycube, labels, report } = &*self.0;
        pickle::reduce(py, "Made", (shape.clone(), polycube.clone()), &(labels.clone(), report.clone()))
    }

    fn __repr__(&self) -> String {
        let report = &self.0.report;
        format!("Made({} corners, {} facets)", report.corners, report.facets)
    }
}

/// Makes a polycube of a shape: a closed surface of triangles or quadrilaterals, of any genus and any number of parts.
///
/// The polycube is valid and does not touch itself, or an error says at which face and why not. Where its map is folded
/// in places, the result is given all the same and `good` is False. The same input gives the same result, bit by bit.
/// Other Python threads run meanwhile; Ctrl-C cancels.
///
/// Args:
///     shape: the surface.
///     detail: how closely the polycube follows the shape, from 0, as few corners as can be, to 1. 0.5 if not given.
///     corners: take corners away until no more than these are left, as far as the shape allows, whatever detail says.
///     axes: which directions of the shape become the axes of the polycube: "keep" for those of the coordinates, as if
///         not given; "best" for those that the surface looks along best, for a shape that lies askew.
///     labels: (f,) 0 to 5 for each face of the shape, as programs that label shapes leave them. Its charts become the
///         facets as they are, and detail, corners and axes have no effect.
///     no_repair: take the shape as it is. Else what has one right answer is repaired, as in `simplify`, and
///         `report["repairs"]` tells it.
///     progress, cancel: as in `simplify`.
///
/// Raises:
///     InvalidMesh: the surface is not closed, oriented and manifold.
///     InvalidPolycube: no structure was found, the labels are not those of a polycube, or parts of the polycube could
///         not be kept apart.
///     Mismatch: the labels do not fit the faces.
///     Unsupported: the mesh is a volume.
///     InvalidOption: an option is out of its range.
///     Cancelled: `cancel` was set.
///
/// >>> import polycube
/// >>> shape, _ = polycube.example("ring", kind="triangles")
/// >>> made = polycube.make(shape)
/// >>> made.report["genus"], polycube.check(made.polycube, made.labels, shape=made.shape)
/// (1, [])
/// >>> simple = polycube.simplify(made.polycube, made.shape, labels=made.labels)
#[pyfunction]
#[pyo3(
    signature = (shape, *, progress=None, cancel=None, **options),
    text_signature = "(shape, *, detail=None, corners=None, axes=None, labels=None, no_repair=False, \
         progress=None, cancel=None)"
)]
pub fn make<'py>(
    py: Python<'py>,
    shape: &PyMesh,
    progress: Option<Bound<'py, PyAny>>,
    cancel: Option<Bound<'py, PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<PyMade> {
    let task = task(py, shape, options)?;
    Listener { progress, cancel }.run(py, task)
}

/// The work that `make` and `Job.make` do.
pub fn task(
    py: Python<'_>,
    shape: &PyMesh,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<impl FnOnce(&Context) -> Result<PyMade, Failure> + Send + 'static> {
    let keywords = Keywords::new(py, "make", options)?;
    let options = MakeOptions { no_repair: keywords.no_repair()?, ..keywords.make()? };
    keywords.finish()?;
    let shape = Arc::clone(&shape.0);
    Ok(move |context: &Context| run(&shape, &options, context).map(PyMade::from).map_err(|e| Failure::new(e, &shape)))
}
