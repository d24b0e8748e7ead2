//! The Python module `polycube._native`.
use pyo3::prelude::*;

/// A test.
#[pyclass(frozen)]
pub struct A {}

#[pymodule]
mod polycube_native {}
