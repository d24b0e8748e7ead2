//! The hexahedra of a meshed shape.

use crate::arrays::{self, flat, matrix, vector};
use crate::errors;
use crate::mesh::PyMesh;
use crate::pickle::{self, Reduced};
use crate::report;
use polycube::measure::CellMeasures;
use polycube::mesh::{CellField, Point, SolverFormat, read_grouped_surface, write_solver};
use polycube::remesh::{BoundaryFace, Hexes, carry_groups, grouped, grouped_by};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::path::PathBuf;
use std::sync::Arc;

/// A hexahedral mesh of the shape. Arrays are read-only.
#[pyclass(frozen, from_py_object, module = "polycube", name = "Hexes")]
#[derive(Clone)]
pub struct PyHexes(Arc<HexParts>);

struct HexParts {
    mesh: PyMesh,
    polycube: Vec<Point>,
    fields: Vec<CellField>,
    label: Vec<i8>,
    block_id: Vec<u32>,
    boundary: Vec<BoundaryFace>,
    scaled_jacobian: Vec<f64>,
    measures: CellMeasures,
}

impl From<Hexes> for PyHexes {
    fn from(hexes: Hexes) -> Self {
        let (fields, scaled_jacobian, measures) = (hexes.fields(), hexes.quality().of_cell, hexes.measures());
        let Hexes { mesh, polycube, block_id, label, boundary, .. } = hexes;
        let mesh = mesh.into();
        let parts = HexParts { mesh, polycube, fields, label, block_id, boundary, scaled_jacobian, measures };
        Self(Arc::new(parts))
    }
}

impl PyHexes {
    /// What was pickled; what follows from it is computed again.
    pub fn restore(parts: &Bound<'_, PyTuple>, rest: &[u8]) -> PyResult<Self> {
        let (mesh,): (PyMesh,) = parts.extract()?;
        let (points, label, block_id, boundary) = pickle::decode::<(_, _, _, _)>(parts.py(), rest)?;
        let (mesh, polycube) = (mesh.into_inner(), arrays::points(points));
        Ok(Hexes { mesh, polycube, carriers: Vec::new(), block_id, label, boundary, guessed: 0 }.into())
    }
}

#[pymethods]
impl PyHexes {
    /// The mesh, in units of the shape; nodes in VTK's order.
    #[getter]
    fn mesh(&self) -> PyMesh {
        self.0.mesh.clone()
    }

    /// `mesh.points`: (n, 3) float64.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        PyMesh::points(&Bound::new(py, self.mesh())?)
    }

    /// `mesh.cells`: (m, 8) uint32.
    #[getter]
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        PyMesh::cells(&Bound::new(py, self.mesh())?)
    }

    /// The same vertices in the polycube: (n, 3) float64, in lattice units.
    #[getter]
    fn polycube_points<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, 3, |h| flat(&h.0.polycube))
    }

    /// The label of every hexahedron's facet at the surface: (m,) int8, 0 to 5; -1 inside.
    #[getter]
    fn label<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |h| &h.0.label)
    }

    /// The block of every hexahedron: (m,) uint32, a row of `Remeshed.layout.blocks.cells`.
    #[getter]
    fn block_id<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |h| &h.0.block_id)
    }

    /// The scaled Jacobian of every hexahedron: (m,) float64, 1 for a cube, 0 or less for an inverted one.
    #[getter]
    fn scaled_jacobian<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |h| &h.0.scaled_jacobian)
    }

    /// The longest edge of every hexahedron over its shortest: (m,) float64, 1 for a cube.
    #[getter]
    fn edge_ratio<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |h| &h.0.measures.edge_ratio)
    }

    /// The least corner determinant of every hexahedron over the mean of all: (m,) float64.
    #[getter]
    fn determinant<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |h| &h.0.measures.determinant)
    }

    /// The largest non-orthogonality of every hexahedron's faces, as OpenFOAM defines it: (m,) float64, in degrees.
    #[getter]
    fn non_orthogonality<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |h| &h.0.measures.non_orthogonality)
    }

    /// The largest skewness of every hexahedron's faces, as OpenFOAM defines it: (m,) float64.
    #[getter]
    fn skewness<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |h| &h.0.measures.skewness)
    }

    /// Writes the mesh whole or not at all. The extension tells the format: one of `Mesh.write`, which gets `block_id`,
    /// `label`, `scaled_jacobian` and the other arrays where it holds them, or one for solvers, which gets blocks and
    /// boundary by name (block_0 ...; facet_0 ..., and minus_x to plus_z for all facets that look one way on the
    /// polycube): msh of Gmsh 4.1, inp of Abaqus and CalculiX, su2 of SU2, foam for the folder of an OpenFOAM case;
    /// or the block structure itself: json, xyz of Plot3D (no names), blockmesh for the folder of a case with a
    /// blockMeshDict of OpenFOAM.
    ///
    /// Args:
    ///     path: the file.
    ///     points: (n, 3) float64. Where the vertices lie instead of `points`, as after a rigid motion; what is written
    ///         of the hexahedra stays as it is.
    ///     groups: a mesh file that lies on the shape (on `points` as they are, whatever the argument says), most often
    ///         the shape's own. The boundary in msh, inp, su2 and foam is named by the groups of its faces: materials,
    ///         groups or objects of OBJ, references of MEDIT, physical groups of Gmsh, element sets of Abaqus, arrays
    ///         of the cells of VTK.
    ///
    /// Raises:
    ///     FileError: a file cannot be read or written.
    ///     Unsupported: the format is unknown.
    ///     InvalidMesh: `points` is no array of that shape, or not finite.
    ///     InvalidOption: `groups` with a format that is not for solvers.
    ///     Mismatch: `groups` with json, xyz or blockmesh, where a face of a block is in more than one.
    ///     ParseError: no face in the file of `groups` is in any.
    #[pyo3(signature = (path, points=None, groups=None))]
    fn write(
        &self,
        py: Python<'_>,
        path: PathBuf,
        points: Option<&Bound<'_, PyAny>>,
        groups: Option<PathBuf>,
    ) -> PyResult<()> {
        let HexParts { mesh: own, block_id, boundary, fields, .. } = &*self.0;
        let mesh = &points.map_or_else(|| Ok(own.clone()), |points| own.with_points(points))?;
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        if extension.parse::<SolverFormat>().is_err() {
            if groups.is_some() {
                return Err(errors::option(py, "this format has no groups", "write msh, inp, su2 or foam"));
            }
            return mesh.save(py, &path, fields);
        }
        let write = || match &groups {
            None => write_solver(&path, &grouped(&mesh.0, block_id, boundary)?),
            Some(file) => {
                let patches = carry_groups(&read_grouped_surface(file)?, &own.0, boundary)?;
                write_solver(&path, &grouped_by(&mesh.0, block_id, boundary, patches)?)
            }
        };
        py.detach(write).map_err(|e| errors::about(py, &e, Some(&mesh.0)))
    }

    /// The number of hexahedra.
    fn __len__(&self) -> usize {
        self.0.label.len()
    }

    /// A picture for notebooks.
    fn _repr_png_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        report::picture(slf)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let HexParts { mesh, polycube, label, block_id, boundary, .. } = &*self.0;
        let rest = (arrays::rows(polycube), label.clone(), block_id.clone(), boundary.clone());
        pickle::reduce(py, "Hexes", (mesh.clone(),), &rest)
    }

    fn __repr__(&self) -> String {
        format!("Hexes({} hexes)", self.0.label.len())
    }
}
