//! What was pickled, again.

use crate::check::PyViolation;
use crate::errors;
use crate::hexes::PyHexes;
use crate::layout::{PyLayout, PySingularEdge};
use crate::made::PyMade;
use crate::pickle::VERSION;
use crate::quads::PyQuads;
use crate::remeshed::PyRemeshed;
use crate::simplified::{PySimplified, PyTradeOff};
use crate::structure::{PyCounts, PyStructure};
use polycube::{Error, ErrorKind};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// The object of a class that `pickle::reduce` wrote.
#[pyfunction]
pub fn _restore<'py>(
    py: Python<'py>,
    class: &str,
    version: &str,
    parts: &Bound<'py, PyTuple>,
    rest: &[u8],
) -> PyResult<Bound<'py, PyAny>> {
    check_version(py, version)?;
    match class {
        "Counts" => PyCounts::restore(py, rest)?.into_bound_py_any(py),
        "Hexes" => PyHexes::restore(parts, rest)?.into_bound_py_any(py),
        "Layout" => PyLayout::restore(parts, rest)?.into_bound_py_any(py),
        "Made" => PyMade::restore(parts, rest)?.into_bound_py_any(py),
        "Quads" => PyQuads::restore(parts, rest)?.into_bound_py_any(py),
        "Remeshed" => PyRemeshed::restore(parts, rest)?.into_bound_py_any(py),
        "Simplified" => PySimplified::restore(parts, rest)?.into_bound_py_any(py),
        "SingularEdge" => PySingularEdge::restore(py, rest)?.into_bound_py_any(py),
        "Structure" => PyStructure::restore(py, rest)?.into_bound_py_any(py),
        "TradeOff" => PyTradeOff::restore(py, rest)?.into_bound_py_any(py),
        "Violation" => PyViolation::restore(py, rest)?.into_bound_py_any(py),
        _ => Err(refuse(py, ErrorKind::Parse, format!("the pickle is broken: there is no class {class}"))),
    }
}

fn check_version(py: Python<'_>, version: &str) -> PyResult<()> {
    if version == VERSION {
        return Ok(());
    }
    Err(refuse(py, ErrorKind::Unsupported, format!("this was pickled by polycube {version}, and this is {VERSION}")))
}

fn refuse(py: Python<'_>, kind: ErrorKind, message: String) -> PyErr {
    let remedy = "make the result again, or keep its meshes, which every version reads";
    errors::raise(py, &Error::new(kind, message).remedy(remedy), None)
}
