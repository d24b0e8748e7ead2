//! The Python module `polycube._native`: the library's façades with numpy arrays and Python exceptions.
//!
//! Every long call works on a thread of its own (`work`), so Python goes on, Ctrl-C is heard, and a panic ends in an
//! exception. `python/polycube/_native.pyi` has the types of all that is here.

mod arrays;
mod check;
mod errors;
mod hexes;
mod job;
mod layout;
mod made;
mod mesh;
mod options;
mod pickle;
mod quads;
mod remeshed;
mod report;
mod restore;
mod simplified;
mod structure;
mod work;

use pyo3::prelude::*;

#[pymodule(name = "_native")]
mod native {
    use super::*;

    #[pymodule_export]
    use crate::check::{PyViolation, check, check_shape};
    #[pymodule_export]
    use crate::hexes::PyHexes;
    #[pymodule_export]
    use crate::job::PyJob;
    #[pymodule_export]
    use crate::layout::{PyLayout, PySingularEdge};
    #[pymodule_export]
    use crate::made::{PyMade, make};
    #[pymodule_export]
    use crate::mesh::{PyMesh, example, read, read_labels, read_pair};
    #[pymodule_export]
    use crate::quads::PyQuads;
    #[pymodule_export]
    use crate::remeshed::{PyRemeshed, remesh};
    #[pymodule_export]
    use crate::restore::_restore;
    #[pymodule_export]
    use crate::simplified::{PySimplified, PyTradeOff, simplify};
    #[pymodule_export]
    use crate::structure::{PyCounts, PyStructure, structure};

    /// Panics where the library would, for the test that Python survives it.
    #[pyfunction]
    fn _panic(py: Python<'_>) -> PyResult<()> {
        let listener = crate::work::Listener { progress: None, cancel: None };
        listener.run(py, |_: &polycube::Context| panic!("as asked"))
    }

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("EXAMPLES", pyo3::types::PyTuple::new(module.py(), crate::mesh::examples())?)
    }
}
