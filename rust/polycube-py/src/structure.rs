//! The structure of a polycube as arrays.

use crate::arrays::{matrix, vector};
use crate::errors;
use crate::mesh::{PyMesh, labels};
use crate::options::Keywords;
use crate::pickle::{self, Reduced};
use bitcode::{Decode, Encode};
use polycube::layout::{Counts, Pieces, count};
use polycube::mesh::Mesh;
use polycube::simplify::{Input, read_structure};
use polycube::structure::{Arrangement, Deviation, Polycube};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::Arc;

/// How coarse a block structure is.
#[pyclass(frozen, eq, module = "polycube", name = "Counts")]
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct PyCounts(pub Counts);

impl PyCounts {
    /// What was pickled.
    pub fn restore(py: Python<'_>, rest: &[u8]) -> PyResult<Self> {
        pickle::decode(py, rest).map(Self)
    }
}

#[pymethods]
impl PyCounts {
    /// Quadrilateral patches on the surface, cut by the lines that run straight on from every corner.
    #[getter]
    fn surface_patches(&self) -> usize {
        self.0.surface_patches
    }

    /// Blocks of the solid, cut by the sheets that run on from every reflex edge: the base complex.
    #[getter]
    fn blocks(&self) -> usize {
        self.0.blocks
    }

    /// Blocks once a layer of hexahedra is laid around the solid.
    #[getter]
    fn blocks_padded(&self) -> usize {
        self.0.blocks_padded
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        pickle::reduce(py, "Counts", PyTuple::empty(py), &self.0)
    }

    fn __repr__(&self) -> String {
        let Counts { surface_patches, blocks, blocks_padded } = self.0;
        format!("Counts(surface_patches={surface_patches}, blocks={blocks}, blocks_padded={blocks_padded})")
    }
}

/// Facets, edges, corners and levels of a polycube. Numbers count from 0; arrays are read-only.
#[pyclass(frozen, module = "polycube", name = "Structure")]
#[derive(Clone)]
pub struct PyStructure(Arc<Parts>);

#[derive(Encode, Decode)]
struct Parts {
    counts: Counts,
    components: usize,
    genus: usize,
    deviation: Deviation,
    faces: Vec<u32>,
    columns: usize,
    labels: Vec<i8>,
    facet_of_face: Vec<u32>,
    patch_of_face: Vec<u32>,
    block_of_face: Vec<u32>,
    chains: Vec<Vec<u32>>,
    levels: Vec<f64>,
    rows: FlatRows,
}

/// The columns of the structure's tables.
#[derive(Encode, Decode)]
struct FlatRows {
    corners: Vec<u32>,
    corner_valence: Vec<u32>,
    corner_levels: Vec<u32>,
    edge_facets: Vec<u32>,
    facet_label: Vec<i8>,
    facet_level: Vec<u32>,
    level_axis: Vec<u8>,
}

impl FlatRows {
    fn new(polycube: &Polycube) -> Self {
        let structure = &polycube.structure;
        let (corners, facets) = (&structure.corners, &structure.facets);
        Self {
            corners: corners.iter().map(|c| c.vertex).collect(),
            corner_valence: corners.iter().map(|c| c.valence).collect(),
            corner_levels: corners.iter().flat_map(|c| c.levels).collect(),
            edge_facets: structure.edges.iter().flat_map(|e| e.facets).collect(),
            facet_label: facets.iter().map(|f| f.label.index() as i8).collect(),
            facet_level: facets.iter().map(|f| f.level).collect(),
            level_axis: structure.levels.iter().map(|l| l.axis as u8).collect(),
        }
    }
}

impl PyStructure {
    /// The structure that was found on `mesh`.
    pub fn new(polycube: Polycube, mesh: &Mesh) -> Self {
        let arrangement = Arrangement::new(&polycube.structure, &polycube.placement);
        let faces: Vec<u32> = polycube.surface.faces().iter().flat_map(|f| f.vertices()).copied().collect();
        let pieces = Pieces::of_faces(&polycube, mesh.points(), &polycube.placement);
        let parts = Parts {
            counts: count(&arrangement),
            components: polycube.structure.components().into_iter().max().map_or(0, |c| c as usize + 1),
            genus: polycube.structure.genus(),
            deviation: polycube.deviation,
            columns: faces.len() / polycube.surface.faces().len().max(1),
            faces,
            labels: polycube.labels().map(|l| l.index() as i8).collect(),
            patch_of_face: pieces.patch_of_face,
            block_of_face: pieces.block_of_face,
            rows: FlatRows::new(&polycube),
            facet_of_face: polycube.facet_of_face,
            chains: polycube.chains,
            levels: polycube.placement,
        };
        Self(Arc::new(parts))
    }

    /// What was pickled.
    pub fn restore(py: Python<'_>, rest: &[u8]) -> PyResult<Self> {
        pickle::decode(py, rest).map(|parts| Self(Arc::new(parts)))
    }
}

#[pymethods]
impl PyStructure {
    /// The boundary faces, outward: (f, 3 or 4) uint32.
    #[getter]
    fn faces<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, slf.get().0.columns, |s| &s.0.faces)
    }

    /// The label of every boundary face: (f,) int8, 0 to 5 for +X -X +Y -Y +Z -Z.
    #[getter]
    fn label<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.labels)
    }

    /// The facet of every boundary face: (f,) uint32.
    #[getter]
    fn facet<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.facet_of_face)
    }

    /// The patch that the middle of every boundary face lies in: (f,) uint32 below `counts.surface_patches`.
    #[getter]
    fn patch_id<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.patch_of_face)
    }

    /// The block behind the middle of every boundary face: (f,) uint32 below `counts.blocks`.
    #[getter]
    fn block_id<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.block_of_face)
    }

    /// The mesh vertex of every corner: (c,) uint32.
    #[getter]
    fn corners<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.rows.corners)
    }

    /// How many edges meet at every corner: (c,) uint32, 3 to 6.
    #[getter]
    fn corner_valence<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.rows.corner_valence)
    }

    /// The level of every corner along X, Y and Z: (c, 3) uint32.
    #[getter]
    fn corner_levels<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, 3, |s| &s.0.rows.corner_levels)
    }

    /// The mesh vertices along every edge, from its lower to its higher corner: a list of uint32 arrays.
    #[getter]
    fn edges<'py>(slf: &Bound<'py, Self>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        (0..slf.get().0.chains.len()).map(|i| vector(slf, |s| &s.0.chains[i])).collect()
    }

    /// The facet on the left and on the right of every edge, seen from outside along it: (e, 2) uint32.
    #[getter]
    fn edge_facets<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, 2, |s| &s.0.rows.edge_facets)
    }

    /// The label of every facet: (n,) int8.
    #[getter]
    fn facet_label<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.rows.facet_label)
    }

    /// The level of every facet: (n,) uint32.
    #[getter]
    fn facet_level<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.rows.facet_level)
    }

    /// The axis of every level: (l,) uint8, 0 to 2 for X, Y and Z.
    #[getter]
    fn level_axis<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.rows.level_axis)
    }

    /// The coordinate of every level: (l,) float64, in units of the mesh.
    #[getter]
    fn levels<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        vector(slf, |s| &s.0.levels)
    }

    /// How many patches and blocks there are.
    #[getter]
    fn counts(&self) -> PyCounts {
        PyCounts(self.0.counts)
    }

    /// How many parts the surface has that are not connected.
    #[getter]
    fn components(&self) -> usize {
        self.0.components
    }

    /// How many handles the surface has, over all its parts.
    #[getter]
    fn genus(&self) -> usize {
        self.0.genus
    }

    /// How far the mesh is from an exact polycube: the largest angle between a face and its axis, in degrees, and the
    /// largest distance of a vertex from the plane of its facet, in units of the mesh.
    #[getter]
    fn deviation(&self) -> (f64, f64) {
        (self.0.deviation.degrees, self.0.deviation.distance)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        pickle::reduce(py, "Structure", PyTuple::empty(py), &*self.0)
    }

    fn __repr__(&self) -> String {
        let Parts { rows, chains, .. } = &*self.0;
        let (corners, edges, facets) = (rows.corners.len(), chains.len(), rows.facet_label.len());
        format!("Structure({corners} corners, {edges} edges, {facets} facets)")
    }
}

/// Finds facets, edges, corners and levels of a polycube, and the patch and block of every boundary face.
///
/// Args:
///     polycube: the mesh whose boundary faces look along the axes.
///     labels: (f,) 0 to 5 for each boundary face, -1 for "by the normal". By the normals if not given.
///     angle_tolerance: largest angle between a face and the nearest axis, in degrees, 0 to 45.
///     level_tolerance: largest distance of a vertex from the plane of its facet, as a part of the diagonal, 0 to 1.
///
/// Raises:
///     InvalidMesh, InvalidPolycube: `check` lists everything that is wrong.
///     Mismatch: there is not one label per boundary face.
///
/// >>> import polycube
/// >>> polycube.structure(polycube.example("cube-spikes")[1])
/// Structure(56 corners, 84 edges, 36 facets)
#[pyfunction]
#[pyo3(
    signature = (polycube, labels=None, **tolerance),
    text_signature = "(polycube, labels=None, *, angle_tolerance=30.0, level_tolerance=0.05)"
)]
pub fn structure(
    py: Python<'_>,
    polycube: &PyMesh,
    #[pyo3(from_py_with = optional_labels)] labels: Option<Vec<i8>>,
    tolerance: Option<&Bound<'_, PyDict>>,
) -> PyResult<PyStructure> {
    let keywords = Keywords::new(py, "structure", tolerance)?;
    let tolerance = keywords.tolerance()?;
    keywords.finish()?;
    let mesh = &*polycube.0;
    let input = Input { polycube: mesh, shape: None, labels: labels.as_deref() };
    let found = py.detach(|| read_structure(&input, &tolerance).map(|found| PyStructure::new(found, mesh)));
    found.map_err(|e| errors::about(py, &e, Some(mesh)))
}

/// Labels, or nothing for None.
pub fn optional_labels(value: &Bound<'_, PyAny>) -> PyResult<Option<Vec<i8>>> {
    if value.is_none() { Ok(None) } else { labels(value).map(Some) }
}
