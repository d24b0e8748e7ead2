//! Simplifying a polycube, and what comes of it.

use crate::arrays::vector;
use crate::errors;
use crate::mesh::PyMesh;
use crate::options::Keywords;
use crate::pickle::{self, Reduced};
use crate::report::{self, to_dict};
use crate::structure::{PyCounts, PyStructure};
use crate::work::{Failure, Listener};
use bitcode::{Decode, Encode};
use polycube::Context;
use polycube::mesh::Mesh;
use polycube::simplify::{Input, Simplified, SimplifyOptions, simplify as run};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::{Arc, OnceLock};

/// What a simplification starts from.
#[derive(Clone)]
pub struct Source {
    /// The polycube.
    pub polycube: Arc<Mesh>,
    /// The shape that it was deformed from.
    pub shape: Option<Arc<Mesh>>,
    /// Labels of its boundary faces.
    pub labels: Option<Vec<i8>>,
}

impl Source {
    /// The arguments that say what is simplified.
    pub fn new(polycube: &PyMesh, shape: Option<&PyMesh>, keywords: &Keywords<'_>) -> PyResult<Self> {
        keywords.number_faces(&polycube.0)?;
        Ok(Self {
            polycube: Arc::clone(&polycube.0),
            shape: shape.map(|shape| Arc::clone(&shape.0)),
            labels: keywords.labels()?,
        })
    }

    /// What the library takes.
    pub fn input(&self) -> Input<'_> {
        Input { polycube: &self.polycube, shape: self.shape.as_deref(), labels: self.labels.as_deref() }
    }

    /// The error with its place on the polycube.
    pub fn failure(&self, error: polycube::Error) -> Failure {
        Failure::new(error, &self.polycube)
    }

    fn simplify(self, options: SimplifyOptions, context: &Context) -> Result<PySimplified, Failure> {
        let result = run(&self.input(), &options, context).map_err(|e| self.failure(e))?;
        Ok(PySimplified::new(result, self))
    }
}

/// A trade-off between few blocks and little displacement, met by the search.
#[pyclass(frozen, module = "polycube", name = "TradeOff", get_all)]
#[derive(Encode, Decode)]
pub struct PyTradeOff {
    /// What the objective counts.
    count: usize,
    /// Root mean square of the corners' displacement, in units of the polycube.
    displacement: f64,
}

impl PyTradeOff {
    /// What was pickled.
    pub fn restore(py: Python<'_>, rest: &[u8]) -> PyResult<Self> {
        pickle::decode(py, rest)
    }
}

#[pymethods]
impl PyTradeOff {
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        pickle::reduce(py, "TradeOff", PyTuple::empty(py), self)
    }

    fn __repr__(&self) -> String {
        format!("TradeOff(count={}, displacement={})", self.count, self.displacement)
    }
}

/// A simplified polycube.
#[pyclass(frozen, from_py_object, module = "polycube", name = "Simplified")]
#[derive(Clone)]
pub struct PySimplified(Arc<Parts>);

struct Parts {
    source: Source,
    result: Simplified,
    polycube: Option<PyMesh>,
    labels: Vec<i8>,
    structure: OnceLock<PyStructure>,
}

impl PySimplified {
    /// Takes the result of simplifying `source`.
    pub fn new(mut result: Simplified, source: Source) -> Self {
        let labels = result.input.labels().map(|l| l.index() as i8).collect();
        let polycube = result.polycube.take().map(PyMesh::from);
        Self(Arc::new(Parts { source, result, polycube, labels, structure: OnceLock::new() }))
    }

    /// What was pickled. The structure of the input is read again, in linear time.
    pub fn restore(parts: &Bound<'_, PyTuple>, rest: &[u8]) -> PyResult<Self> {
        let py = parts.py();
        let (input, shape, mesh): (PyMesh, Option<PyMesh>, Option<PyMesh>) = parts.extract()?;
        let (labels, state) = pickle::decode::<(Option<Vec<i8>>, Vec<u8>)>(py, rest)?;
        let source = Source { polycube: input.0, shape: shape.map(|shape| shape.0), labels };
        let again = || Simplified::from_state(&source.input(), mesh.map(PyMesh::into_inner), &state);
        let result = py.detach(again).map_err(|e| errors::raise(py, &e, None))?;
        Ok(Self::new(result, source))
    }

    /// Another result from the same source, made while `listener` listens.
    fn again(
        &self,
        py: Python<'_>,
        listener: &Listener,
        make: impl FnOnce(&Simplified, &Input, &Context) -> polycube::Result<Simplified> + Send + 'static,
    ) -> PyResult<Self> {
        let parts = Arc::clone(&self.0);
        let task = move |context: &Context| {
            let Parts { source, result, .. } = &*parts;
            let made = make(result, &source.input(), context).map_err(|e| source.failure(e))?;
            Ok(Self::new(made, source.clone()))
        };
        listener.run(py, task)
    }
}

#[pymethods]
impl PySimplified {
    /// The simplified polycube in lattice units, with the vertices and cells of the input; None when it is not valid,
    /// which only the strategy "naive" can bring about.
    #[getter]
    fn polycube(&self) -> Option<PyMesh> {
        self.0.polycube.clone()
    }

    /// Whether the result is a valid polycube.
    #[getter]
    fn valid(&self) -> bool {
        self.0.result.report.valid
    }

    /// Lattice steps per unit of the input.
    #[getter]
    fn scale(&self) -> f64 {
        self.0.result.report.scale
    }

    /// The label of every boundary face: (f,) int8, 0 to 5 for +X -X +Y -Y +Z -Z.
    #[getter]
    fn labels<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.labels)
    }

    /// The lattice coordinate of every level, in the order of `structure.levels`: (l,) int64.
    #[getter]
    fn levels<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.result.levels)
    }

    /// The structure of the input, which the result shares.
    #[getter]
    fn structure(&self) -> PyStructure {
        let Parts { result, source, structure, .. } = &*self.0;
        structure.get_or_init(|| PyStructure::new(result.input.clone(), &source.polycube)).clone()
    }

    /// Counts of the input.
    #[getter]
    fn counts_before(&self) -> PyCounts {
        PyCounts(self.0.result.report.before)
    }

    /// Counts of the result; None when it is not valid.
    #[getter]
    fn counts_after(&self) -> Option<PyCounts> {
        self.0.result.report.after.map(PyCounts)
    }

    /// The trade-offs that the strategy "best" met, from the fewest blocks to the least displacement.
    #[getter]
    fn front(&self) -> Vec<PyTradeOff> {
        let points = self.0.result.report.front.iter();
        points.map(|p| PyTradeOff { count: p.count, displacement: p.displacement }).collect()
    }

    /// What was not possible or not as asked, in plain words.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.result.report.notes.iter().map(ToString::to_string).collect()
    }

    /// What was done, as in the command's report.json: counts, rounds, front, bound, seconds, displacement, distortion,
    /// flipped elements.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_dict(py, &self.0.result.report)
    }

    /// Another point of the same front, from 1, the fewest blocks, to 0, the least displacement: for a slider. Nothing
    /// is searched again; it takes the time of the morph. As in `simplify`, other threads run and `progress` and
    /// `cancel` are heeded.
    ///
    /// Raises:
    ///     InvalidOption: `simplicity` is out of its range, or there is no front: only the strategy "best" makes one.
    ///     Cancelled: `cancel` was set.
    #[pyo3(signature = (simplicity, *, progress=None, cancel=None))]
    fn at<'py>(
        &self,
        py: Python<'py>,
        simplicity: f64,
        progress: Option<Bound<'py, PyAny>>,
        cancel: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Self> {
        let at = move |result: &Simplified, input: &Input, context: &Context| result.at(input, simplicity, context);
        self.again(py, &Listener { progress, cancel }, at)
    }

    /// The same result at another scale, in lattice steps per unit of the input: the same blocks on a finer or coarser
    /// lattice. Nothing is searched again; it takes the time of the morph. As in `simplify`, other threads run and
    /// `progress` and `cancel` are heeded.
    ///
    /// Raises:
    ///     InvalidOption: `scale` is not a positive number, or too large for the lattice.
    ///     Infeasible: on this lattice there is no room between the facets that must not move.
    ///     Cancelled: `cancel` was set.
    #[pyo3(signature = (scale, *, progress=None, cancel=None))]
    fn rescaled<'py>(
        &self,
        py: Python<'py>,
        scale: f64,
        progress: Option<Bound<'py, PyAny>>,
        cancel: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Self> {
        let rescaled =
            move |result: &Simplified, input: &Input, context: &Context| result.rescaled(input, scale, context);
        self.again(py, &Listener { progress, cancel }, rescaled)
    }

    /// A picture for notebooks.
    fn _repr_png_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        report::picture(slf)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let Parts { source, result, polycube, .. } = &*self.0;
        let parts = (PyMesh(source.polycube.clone()), source.shape.clone().map(PyMesh), polycube.clone());
        pickle::reduce(py, "Simplified", parts, &(source.labels.clone(), result.state()))
    }

    fn __repr__(&self) -> String {
        let count = |c: polycube::layout::Counts| c.blocks_padded;
        let report = &self.0.result.report;
        match report.after {
            Some(after) => format!("Simplified({} -> {} padded blocks)", count(report.before), count(after)),
            None => format!("Simplified({} padded blocks -> not valid)", count(report.before)),
        }
    }
}

/// Simplifies a polycube: moves its facets so that corners align and few blocks are left.
///
/// Facets, edges and corners stay; the result is a valid polycube on the integer lattice and never has more blocks. The
/// same input gives the same result, bit by bit. Other Python threads run meanwhile; Ctrl-C cancels.
///
/// The order is POLYCUBE FIRST, then shape, which may be left out (`remesh` takes the shape first). Name them to be
/// sure: `simplify(polycube=cube, shape=shape)`. Lengths are in units of the polycube.
///
/// Args:
///     polycube: the mesh whose boundary faces look along the axes.
///     shape: the mesh that it was deformed from, with the same cells; the distortion of the map is measured
///         against it.
///     labels: (f,) 0 to 5 for each boundary face, -1 for "by the normal". By the normals if not given.
///     strategy: "best" searches for the fewest blocks; "paper" is Algorithm 1 of the paper; "naive" rounds to the
///         lattice, which may break the polycube.
///     scale: lattice steps per unit of the polycube. 1 if its levels are integers, else one step per mean mesh edge.
///     edge_length: the same as a length: a lattice step in units of the polycube.
///     objective: only with "best", what it makes small: "blocks_padded" (volumes), "blocks", or "surface_patches"
///         (surfaces).
///     simplicity: only with "best", from 1, the fewest blocks, to 0, the least displacement.
///     max_displacement: only with "best", the farthest that a corner may move, in units of the polycube; 0 where
///         none shall.
///     max_distortion: only with "best", the largest mean angle distortion, 1 or more, of the map from the shape to
///         the result.
///     locked_faces: with every strategy, boundary faces whose facets must not move: their numbers, or a mask, (f,)
///         bool.
///     guides: with every strategy, what else to keep: `{"fixed": facets, "together": [facets], "apart": [[facet,
///         facet]], "symmetry": [{"axis": 0, "at": 0.0}], "fixed_faces": faces, "fixed_labels": labels}`, by the
///         numbers of `structure(polycube)`.
///     steps: how long "best" searches: moves tried per level in each of eight chains.
///     proof_nodes: how long it tries to prove that its result cannot be beaten.
///     time_limit: seconds; the search then stops, and the result may differ from run to run.
///     lambda_min: Algorithm 1 stops before the weight of staying close falls below this; 1 is one round.
///     solver: "exact" minimum cuts, or "linear" programs, which are slow.
///     angle_tolerance: largest angle between a face and the nearest axis, in degrees, 0 to 45.
///     level_tolerance: largest distance of a vertex from the plane of its facet, as a part of the diagonal, 0 to 1.
///     no_repair: take the input as it is. Else what has one right answer is repaired, and a note says so: cells
///         numbered left-handed, surfaces and labels that look inward, vertices at one place, double and inner faces.
///     progress: called on this thread now and then as `progress(stage, fraction)`, fraction from 0 to 1. What it
///         returns is not looked at; what it raises stops the work and is raised by this call.
///     cancel: an object with `is_set()`, such as a `threading.Event`; once it is set, `Cancelled` is raised.
///
/// Raises:
///     InvalidMesh, InvalidPolycube: `check` lists everything that is wrong.
///     Mismatch: shape or labels do not fit the polycube.
///     InvalidOption: an option is out of its range.
///     Infeasible: nothing satisfies the guides.
///     Cancelled: `cancel` was set.
///
/// >>> import polycube
/// >>> shape, cube = polycube.example("ring", kind="quads")
/// >>> polycube.simplify(cube, shape, strategy="paper").counts_after.blocks < 200
/// True
#[pyfunction]
#[pyo3(
    signature = (polycube, shape=None, *, progress=None, cancel=None, **options),
    text_signature = "(polycube, shape=None, *, labels=None, strategy='best', scale=None, edge_length=None, \
        objective=None, simplicity=1.0, max_displacement=None, max_distortion=None, locked_faces=None, \
        guides=None, steps=400, proof_nodes=200, time_limit=None, lambda_min=0.0, solver='exact', \
        angle_tolerance=30.0, level_tolerance=0.05, no_repair=False, progress=None, cancel=None)"
)]
pub fn simplify<'py>(
    py: Python<'py>,
    polycube: &PyMesh,
    shape: Option<&PyMesh>,
    progress: Option<Bound<'py, PyAny>>,
    cancel: Option<Bound<'py, PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<PySimplified> {
    let task = task(py, polycube, shape, options)?;
    Listener { progress, cancel }.run(py, task)
}

/// The work that `simplify` and `Job.simplify` do.
pub fn task(
    py: Python<'_>,
    polycube: &PyMesh,
    shape: Option<&PyMesh>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<impl FnOnce(&Context) -> Result<PySimplified, Failure> + Send + 'static> {
    let keywords = Keywords::new(py, "simplify", options)?;
    let source = Source::new(polycube, shape, &keywords)?;
    let options = keywords.simplify()?;
    keywords.finish()?;
    Ok(move |context: &Context| source.simplify(options, context))
}
