//! Reports as dictionaries, and pictures.

use crate::errors;
use polycube::{Error, ErrorKind};
use pyo3::PyClass;
use pyo3::prelude::*;
use serde::Serialize;

/// What the command writes as JSON, as Python objects.
pub fn to_dict<'py>(py: Python<'py>, report: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(report)
        .map_err(|e| errors::raise(py, &Error::new(ErrorKind::Internal, e.to_string()), None))?;
    py.import("json")?.call_method1("loads", (text,))
}

/// A small picture of a mesh or result as a PNG file; None where there is nothing to see.
pub fn picture<'py>(value: &Bound<'py, impl PyClass>) -> PyResult<Bound<'py, PyAny>> {
    value.py().import("polycube.picture")?.call_method1("of", (value,))
}
