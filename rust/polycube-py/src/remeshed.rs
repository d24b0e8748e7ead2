//! Meshing a shape, and what comes of it.

use crate::arrays::{flat, matrix, vector};
use crate::mesh::PyMesh;
use crate::options::Keywords;
use crate::report::to_dict;
use crate::simplified::{PySimplified, Source};
use crate::work::{Failure, Listener};
use polycube::Context;
use polycube::measure::CellMeasures;
use polycube::mesh::{CellField, Point};
use polycube::remesh::{Hexes, Layout, Quads, RemeshReport, Remeshed, remesh as run};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// A quadrilateral mesh of the shape's surface. Arrays are read-only.
#[pyclass(frozen, module = "polycube", name = "Quads")]
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
}

impl From<Quads> for PyQuads {
    fn from(quads: Quads) -> Self {
        let feature_edges = quads.feature_edges().into_flattened();
        let fields = quads.fields();
        let scaled_jacobian = quads.quality().of_cell;
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
        }))
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

    /// Writes the mesh with `label`, `patch_id` and `block_id`, where the format holds them; see `Mesh.write`.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.0.mesh.save(py, &path, &self.0.fields)
    }

    fn __repr__(&self) -> String {
        format!("Quads({} quads)", self.0.label.len())
    }
}

/// A hexahedral mesh of the shape. Arrays are read-only.
#[pyclass(frozen, module = "polycube", name = "Hexes")]
#[derive(Clone)]
pub struct PyHexes(Arc<HexParts>);

struct HexParts {
    mesh: PyMesh,
    polycube: Vec<Point>,
    fields: Vec<CellField>,
    label: Vec<i8>,
    block_id: Vec<u32>,
    scaled_jacobian: Vec<f64>,
    measures: CellMeasures,
}

impl PyHexes {
    fn new(hexes: Hexes) -> Self {
        let (fields, scaled_jacobian, measures) = (hexes.fields(), hexes.quality().of_cell, hexes.measures());
        let Hexes { mesh, polycube, block_id, label, .. } = hexes;
        Self(Arc::new(HexParts { mesh: mesh.into(), polycube, fields, label, block_id, scaled_jacobian, measures }))
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

    /// Writes the mesh with `block_id`, `label` and `scaled_jacobian`, where the format holds them; see `Mesh.write`.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.0.mesh.save(py, &path, &self.0.fields)
    }

    fn __repr__(&self) -> String {
        format!("Hexes({} hexes)", self.0.label.len())
    }
}

/// A line of edges at which an irregular number of blocks meet.
#[pyclass(frozen, module = "polycube", name = "SingularEdge")]
pub struct PySingularEdge {
    points: Vec<Point>,
    valence: u32,
}

#[pymethods]
impl PySingularEdge {
    /// Its vertices in order: (k, 3) float64 with k of at least 2, in units of the shape; read-only.
    #[getter]
    fn points<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, 3, |e| flat(&e.points))
    }

    /// How many blocks meet at it: without padding, on the surface, 1 or 3; with padding, inside, 3, 5 or more.
    #[getter]
    fn valence(&self) -> u32 {
        self.valence
    }

    fn __repr__(&self) -> String {
        format!("SingularEdge({} points, valence {})", self.points.len(), self.valence)
    }
}

/// Blocks and patches as single cells on the shape.
#[pyclass(frozen, module = "polycube", name = "Layout")]
#[derive(Clone)]
pub struct PyLayout(Arc<LayoutParts>);

struct LayoutParts {
    patches: PyMesh,
    patch_label: Vec<i8>,
    blocks: Option<PyMesh>,
    singular: Vec<(Vec<Point>, u32)>,
}

impl PyLayout {
    fn new(layout: Layout) -> Self {
        let Layout { blocks, patches, patch_label, singular } = layout;
        Self(Arc::new(LayoutParts {
            patches: patches.into(),
            patch_label,
            blocks: blocks.map(PyMesh::from),
            singular: singular.into_iter().map(|e| (e.points, e.valence)).collect(),
        }))
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
        let edges = self.0.singular.iter();
        edges.map(|(points, valence)| PySingularEdge { points: points.clone(), valence: *valence }).collect()
    }

    fn __repr__(&self) -> String {
        let blocks = self.0.blocks.as_ref().map(|b| format!(", {} blocks", b.0.cells().len())).unwrap_or_default();
        format!("Layout({} patches{blocks})", self.0.patch_label.len())
    }
}

/// Meshes of a shape and the block structure that they have.
#[pyclass(frozen, module = "polycube", name = "Remeshed")]
#[derive(Clone)]
pub struct PyRemeshed(Arc<Parts>);

struct Parts {
    simplified: PySimplified,
    quads: PyQuads,
    hexes: Option<PyHexes>,
    layout: PyLayout,
    report: RemeshReport,
}

impl PyRemeshed {
    fn new(result: Remeshed, source: Source) -> Self {
        let Remeshed { simplified, layout, quads, hexes, report } = result;
        Self(Arc::new(Parts {
            simplified: PySimplified::new(simplified, source),
            quads: quads.into(),
            layout: PyLayout::new(layout),
            hexes: hexes.map(PyHexes::new),
            report,
        }))
    }
}

#[pymethods]
impl PyRemeshed {
    /// The polycube on the lattice that was meshed.
    #[getter]
    fn simplified(&self) -> PySimplified {
        self.0.simplified.clone()
    }

    /// The surface. With hexahedra it is theirs.
    #[getter]
    fn quads(&self) -> PyQuads {
        self.0.quads.clone()
    }

    /// The volume; None for a surface alone.
    #[getter]
    fn hexes(&self) -> Option<PyHexes> {
        self.0.hexes.clone()
    }

    /// Blocks and patches as single cells, and the singular edges.
    #[getter]
    fn layout(&self) -> PyLayout {
        self.0.layout.clone()
    }

    /// Whether no hexahedron is inverted and the surface is as near to the shape as asked for.
    #[getter]
    fn good(&self) -> bool {
        self.0.report.is_good()
    }

    /// What was not possible or not as asked, in plain words.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.report.simplify.notes.iter().map(ToString::to_string).collect()
    }

    /// What was done and how good it is, as in the command's report.json: that of `Simplified`, and hexes, quads,
    /// inverted, inverted_cells, min_sj, avg_sj, histogram, edge_ratio, determinant, non_orthogonality, skewness,
    /// volume, hausdorff; seconds has all stages.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_dict(py, &self.0.report)
    }

    fn __repr__(&self) -> String {
        let report = &self.0.report;
        format!("Remeshed({} quads, {} hexes)", report.quads, report.hexes)
    }
}

/// Simplifies a polycube and meshes its shape with the blocks found: coarse layout, quadrilaterals, hexahedra.
///
/// The hexahedra are untangled and optimised with the surface sliding on the shape. Where some stay inverted, or the
/// surface is farther from the shape than asked for, the result is given all the same and `good` is False. The same
/// input gives the same result, bit by bit. Other Python threads run meanwhile; Ctrl-C cancels.
///
/// The order is SHAPE FIRST, then polycube (`simplify` takes the polycube first).
///
/// Args:
///     shape: the mesh that the polycube was deformed from, with the same cells: a surface or a volume.
///     polycube: the mesh whose boundary faces look along the axes.
///     labels: (f,) 0 to 5 for each boundary face, -1 for "by the normal". By the normals if not given.
///     hexes: about how many hexahedra there shall be, padding included. This, edge_length or scale.
///     edge_length: mean length of the mesh's edges, in units of the shape.
///     scale: lattice steps per unit of the polycube. 1 if its levels are integers, else one step per mean mesh edge.
///     padding: layers of hexahedra between the polycube and the surface, 0 to 16.
///     surface_only: leave the hexahedra out.
///     max_hausdorff: the largest distance between mesh and shape to accept, in percent of the diagonal (C++ and
///         Rust take a fraction of it).
///     max_displacement: only with "best", the farthest that a corner may move, in units of the polycube.
///     simplicity: only with "best", from 1, the fewest blocks, to 0, the least displacement. If neither this nor a
///         limit is given, the fewest blocks whose hexahedra are good.
///     strategy, objective, max_distortion, locked_faces, guides, steps, proof_nodes, time_limit, lambda_min, solver,
///         angle_tolerance, level_tolerance, progress, cancel: as in `simplify`. "naive" meshes the polycube as it is.
///
/// Raises:
///     InvalidMesh, InvalidPolycube, Mismatch, InvalidOption, Infeasible, Cancelled: as in `simplify`.
///
/// >>> import polycube
/// >>> shape, cube = polycube.example("stepped-l")
/// >>> meshes = polycube.remesh(shape, cube, hexes=1500)
/// >>> meshes.report["inverted"], meshes.report["min_sj"] > 0
/// (0, True)
#[pyfunction]
#[pyo3(
    signature = (shape, polycube, *, progress=None, cancel=None, **options),
    text_signature = "(shape, polycube, *, labels=None, hexes=None, edge_length=None, scale=None, padding=1, \
        surface_only=False, max_hausdorff=0.5, strategy='best', objective=None, simplicity=None, \
        max_displacement=None, max_distortion=None, locked_faces=None, guides=None, steps=400, \
        proof_nodes=200, time_limit=None, lambda_min=0.0, solver='exact', angle_tolerance=30.0, \
        level_tolerance=0.05, progress=None, cancel=None)"
)]
pub fn remesh<'py>(
    py: Python<'py>,
    shape: &PyMesh,
    polycube: &PyMesh,
    progress: Option<Bound<'py, PyAny>>,
    cancel: Option<Bound<'py, PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<PyRemeshed> {
    let task = task(py, shape, polycube, options)?;
    Listener { progress, cancel }.run(py, task)
}

/// The work that `remesh` and `Job.remesh` do.
pub fn task(
    py: Python<'_>,
    shape: &PyMesh,
    polycube: &PyMesh,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<impl FnOnce(&Context) -> Result<PyRemeshed, Failure> + Send + 'static> {
    let keywords = Keywords::new(py, "remesh", options)?;
    let source = Source::new(polycube, Some(shape), &keywords)?;
    let options = keywords.remesh()?;
    keywords.finish()?;
    Ok(move |context: &Context| {
        let result = run(&source.input(), &options, context).map_err(|e| source.failure(e))?;
        Ok(PyRemeshed::new(result, source))
    })
}
