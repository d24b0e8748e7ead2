//! Meshing a shape, and what comes of it.

use crate::hexes::PyHexes;
use crate::layout::PyLayout;
use crate::made::PyMade;
use crate::mesh::PyMesh;
use crate::options::Keywords;
use crate::pickle::{self, Reduced};
use crate::quads::PyQuads;
use crate::report::{self, to_dict};
use crate::simplified::{PySimplified, Source};
use crate::work::{Failure, Listener};
use polycube::Context;
use polycube::make::{self, MakeOptions};
use polycube::mesh::Mesh;
use polycube::remesh::{RemeshOptions, RemeshReport, Remeshed, remesh as run};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::Arc;

/// Meshes of a shape and the block structure that they have.
#[pyclass(frozen, module = "polycube", name = "Remeshed")]
#[derive(Clone)]
pub struct PyRemeshed(Arc<Parts>);

struct Parts {
    simplified: PySimplified,
    quads: PyQuads,
    hexes: Option<PyHexes>,
    layout: PyLayout,
    made: Option<PyMade>,
    report: RemeshReport,
}

impl PyRemeshed {
    /// What was pickled.
    pub fn restore(parts: &Bound<'_, PyTuple>, rest: &[u8]) -> PyResult<Self> {
        let (simplified, quads, hexes, layout, made) = parts.extract()?;
        let report = pickle::decode(parts.py(), rest)?;
        Ok(Self(Arc::new(Parts { simplified, quads, hexes, layout, made, report })))
    }

    fn new(result: Remeshed, source: Source, made: Option<PyMade>) -> Self {
        let Remeshed { simplified, layout, quads, hexes, report } = result;
        Self(Arc::new(Parts {
            made,
            simplified: PySimplified::new(simplified, source),
            quads: quads.into(),
            layout: layout.into(),
            hexes: hexes.map(PyHexes::from),
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

    /// The polycube that was made of the shape, with the shape as it was cut for it; None where a polycube was given.
    #[getter]
    fn made(&self) -> Option<PyMade> {
        self.0.made.clone()
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

    /// A picture for notebooks.
    fn _repr_png_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        report::picture(slf)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let Parts { simplified, quads, hexes, layout, made, report } = &*self.0;
        let parts = (simplified.clone(), quads.clone(), hexes.clone(), layout.clone(), made.clone());
        pickle::reduce(py, "Remeshed", parts, report)
    }

    fn __repr__(&self) -> String {
        let report = &self.0.report;
        format!("Remeshed({} quads, {} hexes)", report.quads, report.hexes)
    }
}

/// What is meshed.
enum Start {
    /// A shape and its polycube.
    Pair(Source),
    /// A shape of which a polycube is to be made.
    Shape(Arc<Mesh>, MakeOptions),
}

impl Start {
    fn new(shape: &PyMesh, polycube: Option<&PyMesh>, keywords: &Keywords<'_>) -> PyResult<Self> {
        if let Some(polycube) = polycube {
            keywords.refuse(&["detail", "corners", "axes"], "a polycube is given", "leave it out, or the polycube")?;
            return Ok(Self::Pair(Source::new(polycube, Some(shape), keywords)?));
        }
        Ok(Self::Shape(Arc::clone(&shape.0), keywords.make()?))
    }

    fn remesh(self, options: &RemeshOptions, context: &Context) -> Result<PyRemeshed, Failure> {
        match self {
            Self::Pair(source) => {
                let result = run(&source.input(), options, context).map_err(|e| source.failure(e))?;
                Ok(PyRemeshed::new(result, source, None))
            }
            Self::Shape(shape, making) => {
                let making = MakeOptions { no_repair: options.simplify.no_repair, ..making };
                let (made, result) =
                    make::remesh(&shape, &making, options, context).map_err(|e| Failure::new(e, &shape))?;
                let made = PyMade::from(made);
                Ok(PyRemeshed::new(result, made.source(), Some(made)))
            }
        }
    }
}

/// Meshes a shape: makes a polycube of it or takes one that is given, simplifies that, and takes its blocks for coarse
/// layout, quadrilaterals and hexahedra.
///
/// The hexahedra are untangled and optimised with the surface sliding on the shape. Where some stay inverted, or the
/// surface is farther from the shape than asked for, the result is given all the same and `good` is False. The same
/// input gives the same result, bit by bit. Other Python threads run meanwhile; Ctrl-C cancels.
///
/// The order is SHAPE FIRST, then polycube (`simplify` takes the polycube first).
///
/// Args:
///     shape: without a polycube, a closed surface; with one, the mesh that the polycube was deformed from, with the
///         same cells: a surface or a volume.
///     polycube: the mesh whose boundary faces look along the axes. One is made, as `make` does, if none is given.
///     detail, corners, axes: only where a polycube is made, as in `make`.
///     labels: (f,) 0 to 5 for each boundary face of the polycube, -1 for "by the normal". By the normals if not given.
///         Without a polycube, those of the shape, whose charts become the facets, as in `make`.
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
///         angle_tolerance, level_tolerance, no_repair, progress, cancel: as in `simplify`. "naive" meshes the polycube
///         as it is.
///
/// Raises:
///     InvalidMesh, InvalidPolycube, Mismatch, InvalidOption, Infeasible, Cancelled: as in `simplify`.
///
/// >>> import polycube
/// >>> shape, cube = polycube.example("stepped-l")
/// >>> meshes = polycube.remesh(shape, cube, hexes=1500)
/// >>> meshes.report["inverted"], meshes.report["min_sj"] > 0
/// (0, True)
/// >>> shape, _ = polycube.example("stepped-l", kind="triangles")
/// >>> polycube.remesh(shape, hexes=1500).made.report["folded"]
/// []
#[pyfunction]
#[pyo3(
    signature = (shape, polycube=None, *, progress=None, cancel=None, **options),
    text_signature = "(shape, polycube=None, *, detail=None, corners=None, axes=None, labels=None, hexes=None, \
        edge_length=None, scale=None, padding=1, surface_only=False, max_hausdorff=0.5, strategy='best', \
        objective=None, simplicity=None, max_displacement=None, max_distortion=None, locked_faces=None, \
        guides=None, steps=400, \
        proof_nodes=200, time_limit=None, lambda_min=0.0, solver='exact', angle_tolerance=30.0, \
        level_tolerance=0.05, no_repair=False, progress=None, cancel=None)"
)]
pub fn remesh<'py>(
    py: Python<'py>,
    shape: &PyMesh,
    polycube: Option<&PyMesh>,
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
    polycube: Option<&PyMesh>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<impl FnOnce(&Context) -> Result<PyRemeshed, Failure> + Send + 'static> {
    let keywords = Keywords::new(py, "remesh", options)?;
    let start = Start::new(shape, polycube, &keywords)?;
    let options = keywords.remesh()?;
    keywords.finish()?;
    Ok(move |context: &Context| start.remesh(&options, context))
}
