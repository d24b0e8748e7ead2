//! The quadrilaterals of a meshed shape.

use crate::arrays::{self, flat, matrix, vector};
use crate::errors;
use crate::mesh::PyMesh;
use crate::pickle::{self, Reduced};
use crate::report;
use polycube::mesh::{CellField, Point, write_atomically, write_textured_bytes};
use polycube::remesh::Quads;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::path::PathBuf;
use std::sync::Arc;

/// A quadrilateral mesh of the shape's surface. Arrays are read-only.
#[pyclass(frozen, from_py_object, module = "polycube", name = "Quads")]
#[derive(Clone)]
pub struct PyQuads(Arc<QuadParts>);

struct QuadParts {
    mesh: PyMesh,
    polycube: Vec<Point>,
    fields: Vec<CellField>,
    label: Vec<i8>,
    patch_id: Vec<u32>,
    block_id: Vec<u32>,
    scaled_jacobian: Vec<f64>,
    feature_edges: Vec<u32>,
    uv: Vec<[[f64; 2]; 4]>,
}

impl From<Quads> for PyQuads {
    fn from(quads: Quads) -> Self {
        let feature_edges = quads.feature_edges().into_flattened();
        let fields = quads.fields();
        let (scaled_jacobian, uv) = (quads.quality().of_cell, quads.uv());
        let Quads { mesh, polycube, label, patch_id, block_id, .. } = quads;
        Self(Arc::new(QuadParts {
            mesh: mesh.into(),
            polycube,
            fields,
            label,
            patch_id,
            block_id,
            scaled_jacobian,
            feature_edges,
            uv,
        }))
    }
}

impl PyQuads {
    /// What was pickled; what follows from it is computed again.
    pub fn restore(parts: &Bound<'_, PyTuple>, rest: &[u8]) -> PyResult<Self> {
        let (mesh,): (PyMesh,) = parts.extract()?;
        let (points, label, patch_id, block_id) = pickle::decode::<(_, _, _, _)>(parts.py(), rest)?;
        let (mesh, polycube) = (mesh.into_inner(), arrays::points(points));
        Ok(Quads { mesh, polycube, carriers: Vec::new(), label, patch_id, block_id, guessed: 0 }.into())
    }
}

#[pymethods]
impl PyQuads {
    /// The mesh, in units of the shape, counter-clockwise seen from outside. Its vertices lie on the shape.
    #[getter]
    fn mesh(&self) -> PyMesh {
        self.0.mesh.clone()
    }

    /// `mesh.points`: (n, 3) float64.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        PyMesh::points(&Bound::new(py, self.mesh())?)
    }

    /// `mesh.cells`: (m, 4) uint32.
    #[getter]
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        PyMesh::cells(&Bound::new(py, self.mesh())?)
    }

    /// The same vertices on the polycube: (n, 3) float64, in lattice units.
    #[getter]
    fn polycube_points<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, 3, |q| flat(&q.0.polycube))
    }

    /// The label of every quadrilateral: (m,) int8, 0 to 5 for +X -X +Y -Y +Z -Z.
    #[getter]
    fn label<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |q| &q.0.label)
    }

    /// The patch of every quadrilateral: (m,) uint32, a row of `Remeshed.layout.patches.cells`.
    #[getter]
    fn patch_id<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |q| &q.0.patch_id)
    }

    /// The padding block below every quadrilateral: (m,) uint32, as in `Hexes.block_id`.
    #[getter]
    fn block_id<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |q| &q.0.block_id)
    }

    /// How near every quadrilateral is to a rectangle: (m,) float64 in -1..1, the sine of its worst corner. 0 or below
    /// where a corner is flat or reflex.
    #[getter]
    fn scaled_jacobian<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |q| &q.0.scaled_jacobian)
    }

    /// The mesh edges that lie on edges of the polycube: (e, 2) uint32, the lower vertex first, in ascending order.
    #[getter]
    fn feature_edges<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, 2, |q| &q.0.feature_edges)
    }

    /// Texture coordinates of the corners of every quadrilateral: (4 m, 2) float64, four rows for each in the order of
    /// `cells`, 0 to 1. Every patch is a rectangle of equal squares, counter-clockwise from outside; none touch.
    #[getter]
    fn uv<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, 2, |q| q.0.uv.as_flattened().as_flattened())
    }

    /// Writes the mesh with `label`, `patch_id` and `block_id`, where the format holds them; see `Mesh.write`.
    ///
    /// Args:
    ///     path: the file.
    ///     uv: with the texture coordinates `uv`; only for OBJ.
    ///
    /// Raises:
    ///     FileError: the file cannot be written.
    ///     Unsupported: the format is unknown.
    ///     InvalidOption: `uv` with another format than OBJ.
    #[pyo3(signature = (path, uv=false))]
    fn write(&self, py: Python<'_>, path: PathBuf, uv: bool) -> PyResult<()> {
        let QuadParts { mesh, fields, uv: all, .. } = &*self.0;
        if !uv {
            return mesh.save(py, &path, fields);
        }
        if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("obj")) {
            return Err(errors::option(py, "uv goes to OBJ files alone", "name the file .obj"));
        }
        let write = || write_atomically(&path, &write_textured_bytes(&mesh.0, all)?);
        py.detach(write).map_err(|e| errors::about(py, &e, Some(&mesh.0)))
    }

    /// The number of quadrilaterals.
    fn __len__(&self) -> usize {
        self.0.label.len()
    }

    /// A picture for notebooks.
    fn _repr_png_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        report::picture(slf)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let QuadParts { mesh, polycube, label, patch_id, block_id, .. } = &*self.0;
        let rest: (Vec<[f64; 3]>, _, _, _) =
            (arrays::rows(polycube), label.clone(), patch_id.clone(), block_id.clone());
        pickle::reduce(py, "Quads", (mesh.clone(),), &rest)
    }

    fn __repr__(&self) -> String {
        format!("Quads({} quads)", self.0.label.len())
    }
}
