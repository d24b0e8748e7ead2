//! Work in the background.

use crate::errors;
use crate::made::{self, PyMade};
use crate::mesh::PyMesh;
use crate::remeshed::{self, PyRemeshed};
use crate::simplified::{self, PySimplified};
use crate::work::{self, Work};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use std::time::Duration;

/// Work in the background, for programs that must stay responsive: start it, look at `progress` and `done` from time to
/// time, and take `result()`. A job that nobody holds any more is cancelled.
///
/// >>> import polycube
/// >>> shape, cube = polycube.example("ring", kind="quads")
/// >>> job = polycube.Job.simplify(cube, shape)
/// >>> job.wait(timeout=600)
/// True
/// >>> job.result().valid
/// True
#[pyclass(frozen, module = "polycube", name = "Job")]
pub struct PyJob(Kind);

enum Kind {
    Make(Work<PyMade>),
    Simplify(Work<PySimplified>),
    Remesh(Work<PyRemeshed>),
}

/// Does the same with any kind of work.
macro_rules! any {
    ($job:expr, $work:ident => $do:expr) => {
        match &$job.0 {
            Kind::Make($work) => $do,
            Kind::Simplify($work) => $do,
            Kind::Remesh($work) => $do,
        }
    };
}

#[pymethods]
impl PyJob {
    /// Starts `polycube.make` with these arguments, of which mistakes are raised at once.
    #[staticmethod]
    #[pyo3(
        signature = (shape, **options),
        text_signature = "(shape, *, detail=None, corners=None, axes=None, labels=None, no_repair=False)"
    )]
    fn make(py: Python<'_>, shape: &PyMesh, options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Ok(Self(Kind::Make(work::start(py, made::task(py, shape, options)?)?)))
    }

    /// Starts `polycube.simplify` with these arguments, of which mistakes are raised at once.
    #[staticmethod]
    #[pyo3(
        signature = (polycube, shape=None, **options),
        text_signature = "(polycube, shape=None, *, labels=None, strategy='best', scale=None, edge_length=None, \
            objective=None, simplicity=1.0, max_displacement=None, max_distortion=None, locked_faces=None, \
            guides=None, steps=400, proof_nodes=200, time_limit=None, lambda_min=0.0, solver='exact', \
            angle_tolerance=30.0, level_tolerance=0.05, no_repair=False)"
    )]
    fn simplify(
        py: Python<'_>,
        polycube: &PyMesh,
        shape: Option<&PyMesh>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        Ok(Self(Kind::Simplify(work::start(py, simplified::task(py, polycube, shape, options)?)?)))
    }

    /// Starts `polycube.remesh` with these arguments, of which mistakes are raised at once.
    #[staticmethod]
    #[pyo3(
        signature = (shape, polycube=None, **options),
        text_signature = "(shape, polycube=None, *, detail=None, corners=None, axes=None, labels=None, hexes=None, \
            edge_length=None, scale=None, padding=1, surface_only=False, max_hausdorff=0.5, strategy='best', \
            objective=None, simplicity=None, max_displacement=None, max_distortion=None, locked_faces=None, \
            guides=None, steps=400, \
            proof_nodes=200, time_limit=None, lambda_min=0.0, solver='exact', angle_tolerance=30.0, \
            level_tolerance=0.05, no_repair=False)"
    )]
    fn remesh(
        py: Python<'_>,
        shape: &PyMesh,
        polycube: Option<&PyMesh>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        Ok(Self(Kind::Remesh(work::start(py, remeshed::task(py, shape, polycube, options)?)?)))
    }

    /// The stage that the work is in, and how much of all is done, 0 to 1; it never goes back.
    #[getter]
    fn progress(&self) -> (String, f64) {
        any!(self, work => work.progress())
    }

    /// Whether the work has ended, in whatever way.
    #[getter]
    fn done(&self) -> bool {
        any!(self, work => work.wait(Duration::ZERO))
    }

    /// Asks the work to stop; `result()` then raises `Cancelled`, unless it was done already.
    fn cancel(&self) {
        any!(self, work => work.cancel());
    }

    /// Waits until the work has ended, `timeout` seconds at most, and returns whether it has.
    #[pyo3(signature = (timeout=None))]
    fn wait(&self, py: Python<'_>, timeout: Option<f64>) -> PyResult<bool> {
        let seconds = timeout.map(|seconds| Duration::try_from_secs_f64(seconds.max(0.0))).transpose();
        let limit = seconds.map_err(|e| errors::option(py, format!("timeout: {e}"), "give fewer seconds, or None"))?;
        any!(self, work => work::wait_for(work, py, limit))
    }

    /// Waits until the work has ended and returns what came of it, the same each time; raises what
    /// `make`, `simplify` or `remesh` would have raised.
    fn result(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        any!(self, work => Ok(Py::new(py, work::outcome(work, py)?)?.into_any()))
    }

    /// `Job[Made]`, `Job[Simplified]` and `Job[Remeshed]` are types.
    #[classmethod]
    fn __class_getitem__<'py>(cls: &Bound<'py, PyType>, item: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        cls.py().import("types")?.getattr("GenericAlias")?.call1((cls, item))
    }

    fn __repr__(&self) -> String {
        let (stage, fraction) = self.progress();
        let state = if self.done() { "done".to_owned() } else { format!("{stage}, {:.0} %", 100.0 * fraction) };
        format!("Job({state})")
    }
}
