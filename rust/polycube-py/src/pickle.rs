//! Pickling: a result goes as the meshes and results in it, and the bytes of all else.

use crate::errors;
use bitcode::{DecodeOwned, Encode};
use polycube::{Error, ErrorKind};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};

/// The version that wrote a pickle, which alone can read it.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What `__reduce__` returns: `_native._restore` and its arguments.
pub type Reduced<'py> = (Bound<'py, PyAny>, (&'static str, &'static str, Bound<'py, PyTuple>, Bound<'py, PyBytes>));

/// How an object of `class` is pickled and copied: the meshes and results that it holds, and all else.
pub fn reduce<'py, P>(py: Python<'py>, class: &'static str, parts: P, rest: &impl Encode) -> PyResult<Reduced<'py>>
where
    P: IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>>,
    P::Error: Into<PyErr>,
{
    let restore = py.import("polycube._native")?.getattr("_restore")?;
    let parts = parts.into_pyobject(py).map_err(Into::into)?;
    Ok((restore, (class, VERSION, parts, PyBytes::new(py, &bitcode::encode(rest)))))
}

/// All else again.
///
/// # Errors
/// `ParseError` for bytes that `reduce` did not write.
pub fn decode<T: DecodeOwned>(py: Python<'_>, rest: &[u8]) -> PyResult<T> {
    let broken = |e: bitcode::Error| {
        let error = Error::new(ErrorKind::Parse, format!("the pickle is broken: {e}")).remedy("make the result again");
        errors::raise(py, &error, None)
    };
    bitcode::decode(rest).map_err(broken)
}
