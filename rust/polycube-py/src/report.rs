//! Reports as dictionaries.

use crate::errors;
use polycube::{Error, ErrorKind};
use pyo3::prelude::*;
use serde::Serialize;

/// What the command writes as JSON, as Python objects.
pub fn to_dict<'py>(py: Python<'py>, report: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(report)
        .map_err(|e| errors::raise(py, &Error::new(ErrorKind::Internal, e.to_string()), None))?;
    py.import("json")?.call_method1("loads", (text,))
}
