//! Blocks and patches of a meshed shape as single cells.

use crate::arrays::{self, matrix, vector};
use crate::mesh::PyMesh;
use crate::pickle::{self, Reduced};
use bitcode::{Decode, Encode};
use polycube::remesh::{Layout, SingularEdge};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::Arc;

/// A line of edges at which an irregular number of blocks meet.
#[pyclass(frozen, module = "polycube", name = "SingularEdge")]
#[derive(Clone, Encode, Decode)]
pub struct PySingularEdge {
    points: Vec<[f64; 3]>,
    valence: u32,
}

impl PySingularEdge {
    /// What was pickled.
    pub fn restore(py: Python<'_>, rest: &[u8]) -> PyResult<Self> {
        pickle::decode(py, rest)
    }
}

#[pymethods]
impl PySingularEdge {
    /// Its vertices in order: (k, 3) float64 with k of at least 2, in units of the shape; read-only.
    #[getter]
    fn points<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, 3, |e| e.points.as_flattened())
    }

    /// How many blocks meet at it: without padding, on the surface, 1 or 3; with padding, inside, 3, 5 or more.
    #[getter]
    fn valence(&self) -> u32 {
        self.valence
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        pickle::reduce(py, "SingularEdge", PyTuple::empty(py), self)
    }

    fn __repr__(&self) -> String {
        format!("SingularEdge({} points, valence {})", self.points.len(), self.valence)
    }
}

impl From<&SingularEdge> for PySingularEdge {
    fn from(edge: &SingularEdge) -> Self {
        Self { points: arrays::rows(&edge.points), valence: edge.valence }
    }
}

/// Blocks and patches as single cells on the shape.
#[pyclass(frozen, from_py_object, module = "polycube", name = "Layout")]
#[derive(Clone)]
pub struct PyLayout(Arc<LayoutParts>);

struct LayoutParts {
    patches: PyMesh,
    patch_label: Vec<i8>,
    blocks: Option<PyMesh>,
    singular: Vec<PySingularEdge>,
}

impl From<Layout> for PyLayout {
    fn from(layout: Layout) -> Self {
        let Layout { blocks, patches, patch_label, singular } = layout;
        Self(Arc::new(LayoutParts {
            patches: patches.into(),
            patch_label,
            blocks: blocks.map(PyMesh::from),
            singular: singular.iter().map(PySingularEdge::from).collect(),
        }))
    }
}

impl PyLayout {
    /// What was pickled.
    pub fn restore(parts: &Bound<'_, PyTuple>, rest: &[u8]) -> PyResult<Self> {
        let (patches, blocks) = parts.extract()?;
        let (patch_label, singular) = pickle::decode(parts.py(), rest)?;
        Ok(Self(Arc::new(LayoutParts { patches, patch_label, blocks, singular })))
    }
}

#[pymethods]
impl PyLayout {
    /// One quadrilateral for each patch, counter-clockwise seen from outside.
    #[getter]
    fn patches(&self) -> PyMesh {
        self.0.patches.clone()
    }

    /// The label of every patch: (p,) int8, 0 to 5 for +X -X +Y -Y +Z -Z.
    #[getter]
    fn patch_label<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |l| &l.0.patch_label)
    }

    /// One hexahedron for each block; None for a surface alone.
    #[getter]
    fn blocks(&self) -> Option<PyMesh> {
        self.0.blocks.clone()
    }

    /// The edges of the polycube and, with padding, those from its corners to the surface.
    #[getter]
    fn singular_edges(&self) -> Vec<PySingularEdge> {
        self.0.singular.clone()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let LayoutParts { patches, patch_label, blocks, singular } = &*self.0;
        pickle::reduce(py, "Layout", (patches.clone(), blocks.clone()), &(patch_label.clone(), singular.clone()))
    }

    fn __repr__(&self) -> String {
        let blocks = self.0.blocks.as_ref().map(|b| format!(", {} blocks", b.0.cells().len())).unwrap_or_default();
        format!("Layout({} patches{blocks})", self.0.patch_label.len())
    }
}
