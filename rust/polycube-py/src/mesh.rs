//! Meshes as numpy arrays, and their files.

use crate::arrays::{self, flat, matrix};
use crate::errors;
use crate::report;
use polycube::generate::{self, Example};
use polycube::mesh::{self, CellField, CellKind, Cells, Point};
use polycube::{Error, ErrorKind, Place};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::path::PathBuf;
use std::sync::Arc;

/// A mesh of triangles, quadrilaterals, tetrahedra or hexahedra. It does not change.
///
/// Args:
///     points: (n, 3) float64. Vertex positions. Other numbers are converted.
///     cells: (m, k) integers from 0 to n - 1, also as floats without a fraction. Vertices of each cell; surfaces
///         counter-clockwise seen from outside, volumes in VTK's order.
///     kind: "triangles", "quads", "tetrahedra" or "hexahedra". Needed for k = 4 only.
///
/// Raises:
///     InvalidMesh: the arrays do not have these shapes, a coordinate is not finite, or a cell names a vertex that is
///         not there.
///     TypeError: the arrays do not hold numbers.
///
/// >>> import polycube
/// >>> polycube.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]], "tetrahedra")
/// Mesh(4 points, 1 tetrahedra)
#[pyclass(frozen, from_py_object, module = "polycube", name = "Mesh")]
#[derive(Clone)]
pub struct PyMesh(pub Arc<mesh::Mesh>);

impl From<mesh::Mesh> for PyMesh {
    fn from(mesh: mesh::Mesh) -> Self {
        Self(Arc::new(mesh))
    }
}

#[pymethods]
impl PyMesh {
    #[new]
    #[pyo3(signature = (points, cells, kind=None))]
    fn new(points: &Bound<'_, PyAny>, cells: &Bound<'_, PyAny>, kind: Option<&str>) -> PyResult<Self> {
        let py = points.py();
        let (points, shape) = arrays::real("points").read::<f64>(points)?;
        let (cells, corners) = arrays::whole("cells").read::<i64>(cells)?;
        let build = || {
            let points = to_points(&points, &shape)?;
            let cells = to_cells(&cells, &corners, kind)?;
            mesh::Mesh::new(points, cells)
        };
        build().map(Self::from).map_err(|e| errors::raise(py, &e, None))
    }

    /// Vertex positions: (n, 3) float64, read-only, not a copy.
    #[getter]
    pub fn points<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, 3, |m| flat(m.0.points()))
    }

    /// Vertices of each cell: (m, k) uint32, read-only, not a copy.
    #[getter]
    pub fn cells<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        matrix(slf, width(slf.get().0.cells()), |m| match m.0.cells() {
            Cells::Triangles(c) => c.as_flattened(),
            Cells::Quads(c) | Cells::Tetrahedra(c) => c.as_flattened(),
            Cells::Hexahedra(c) => c.as_flattened(),
        })
    }

    /// "triangles", "quads", "tetrahedra" or "hexahedra".
    #[getter]
    fn kind(&self) -> &'static str {
        kind_name(self.0.cells().kind())
    }

    /// Whether the cells fill a volume.
    #[getter]
    fn is_volume(&self) -> bool {
        self.0.cells().is_volume()
    }

    /// The number of cells.
    fn __len__(&self) -> usize {
        self.0.cells().len()
    }

    /// The boundary faces, outward: (f, 3 or 4) uint32. Labels, facets and locks are numbered like them. The boundary
    /// of a surface is its cells.
    ///
    /// Raises:
    ///     InvalidMesh: more than two cells share a face.
    fn boundary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let faces = self.0.cells().boundary().map_err(|e| errors::about(py, &e, Some(&self.0)))?;
        let flat: Vec<u32> = faces.iter().flat_map(|f| f.vertices()).copied().collect();
        let columns = if matches!(self.0.cells().kind(), CellKind::Triangles | CellKind::Tetrahedra) { 3 } else { 4 };
        numpy::PyArray1::from_vec(py, flat).call_method1("reshape", (-1, columns))
    }

    /// Writes the mesh whole or not at all. The extension tells the format: obj, off, ply, stl, vtp (surfaces),
    /// mesh, meshb, vtk, vtu, msh, inp.
    ///
    /// Args:
    ///     path: the file.
    ///     fields: numbers per cell by name, (m,) integers or floats; held by ply, vtk, vtu and vtp; mesh holds `label`
    ///         or else `block_id`.
    ///
    /// Raises:
    ///     FileError: the file cannot be written.
    ///     Unsupported: the format is unknown or cannot hold the cells.
    ///     InvalidOption: a field has another number of values, or a name that files cannot hold.
    #[pyo3(signature = (path, fields=None))]
    fn write(&self, py: Python<'_>, path: PathBuf, fields: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        let fields =
            fields.map_or(Ok(Vec::new()), |f| f.iter().map(|(name, values)| field(&name, &values)).collect())?;
        self.save(py, &path, &fields)
    }

    /// A picture for notebooks.
    fn _repr_png_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        report::picture(slf)
    }

    /// A mesh is pickled and copied by its arrays, which every version reads.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let arguments = (Self::points(slf)?, Self::cells(slf)?, slf.get().kind()).into_pyobject(slf.py())?;
        Ok((slf.get_type().into_any(), arguments))
    }

    fn __repr__(&self) -> String {
        format!("Mesh({} points, {} {})", self.0.points().len(), self.0.cells().len(), self.kind())
    }
}

impl PyMesh {
    /// The same cells with their vertices elsewhere, of which there must be as many.
    pub fn with_points(&self, points: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = points.py();
        let (points, shape) = arrays::real("points").read::<f64>(points)?;
        let build = || {
            let (points, count) = (to_points(&points, &shape)?, self.0.points().len());
            if points.len() != count {
                let message = format!("there are {} points, and the mesh has {count} vertices", points.len());
                return Err(Error::new(ErrorKind::Mesh, message).remedy("give one row x, y, z per vertex"));
            }
            mesh::Mesh::new(points, self.0.cells().clone())
        };
        build().map(Self::from).map_err(|e| errors::raise(py, &e, None))
    }

    /// The library's mesh, copied where another still holds it.
    pub fn into_inner(self) -> mesh::Mesh {
        Arc::unwrap_or_clone(self.0)
    }

    /// Writes the mesh with fields, letting other Python threads run.
    pub fn save(&self, py: Python<'_>, path: &std::path::Path, fields: &[CellField]) -> PyResult<()> {
        py.detach(|| mesh::write(path, &self.0, fields)).map_err(|e| errors::about(py, &e, Some(&self.0)))
    }
}

fn field(name: &Bound<'_, PyAny>, values: &Bound<'_, PyAny>) -> PyResult<CellField> {
    let name: String = name.extract()?;
    if arrays::is_of_kind(values, b"iu")? {
        let (whole, _) = arrays::whole("fields").read::<i64>(values)?;
        let narrow = whole.iter().map(|&x| i32::try_from(x)).collect::<Result<_, _>>();
        if let Ok(narrow) = narrow {
            return Ok(CellField::integer(name, narrow));
        }
    }
    Ok(CellField::real(name, arrays::real("fields").read::<f64>(values)?.0))
}

fn to_points(numbers: &[f64], shape: &[usize]) -> polycube::Result<Vec<Point>> {
    if !matches!(shape, [_, 3] | [0]) {
        let message = format!("points have the shape {shape:?}, not (n, 3)");
        return Err(Error::new(ErrorKind::Mesh, message).remedy("give one row x, y, z per vertex"));
    }
    Ok(numbers.as_chunks().0.iter().map(|&p: &[f64; 3]| Point::from(p)).collect())
}

fn to_cells(numbers: &[i64], shape: &[usize], kind: Option<&str>) -> polycube::Result<Cells> {
    let kind = cell_kind(shape, kind)?;
    Ok(match kind {
        CellKind::Triangles => Cells::Triangles(rows(numbers)?),
        CellKind::Quads => Cells::Quads(rows(numbers)?),
        CellKind::Tetrahedra => Cells::Tetrahedra(rows(numbers)?),
        CellKind::Hexahedra => Cells::Hexahedra(rows(numbers)?),
    })
}

fn cell_kind(shape: &[usize], kind: Option<&str>) -> polycube::Result<CellKind> {
    let asked = kind.map(str::parse::<CellKind>).transpose()?;
    let error = |message: String, remedy: &str| Err(Error::new(ErrorKind::Mesh, message).remedy(remedy));
    let columns = match *shape {
        [_, columns] => columns,
        [0] => asked.map_or(3, columns_of),
        _ => return error(format!("cells have the shape {shape:?}, not (m, k)"), "give one row of vertices per cell"),
    };
    match (columns, asked) {
        (4, None) => error("cells of four vertices may be quads or tetrahedra".into(), "say kind=\"tetrahedra\""),
        (3, None) => Ok(CellKind::Triangles),
        (8, None) => Ok(CellKind::Hexahedra),
        (k, Some(kind)) if k == columns_of(kind) => Ok(kind),
        (k, Some(kind)) => error(format!("{kind} do not have {k} vertices"), "give the cells' own kind"),
        (k, None) => error(format!("there are no cells of {k} vertices"), "give 3, 4 or 8 vertices per cell"),
    }
}

fn columns_of(kind: CellKind) -> usize {
    match kind {
        CellKind::Triangles => 3,
        CellKind::Quads | CellKind::Tetrahedra => 4,
        CellKind::Hexahedra => 8,
    }
}

fn rows<const K: usize>(numbers: &[i64]) -> polycube::Result<Vec<[u32; K]>> {
    if let Some(bad) = numbers.iter().position(|v| u32::try_from(*v).is_err()) {
        let message = format!("the cell names vertex {}", numbers[bad]);
        let cell = Place::Cell((bad / K) as u32);
        return Err(Error::new(ErrorKind::Mesh, message).at(cell).remedy("give vertices from 0 on that are there"));
    }
    let row = |row: &[i64; K]| row.map(|v| v as u32);
    Ok(numbers.as_chunks().0.iter().map(row).collect())
}

fn width(cells: &Cells) -> usize {
    columns_of(cells.kind())
}

fn kind_name(kind: CellKind) -> &'static str {
    match kind {
        CellKind::Triangles => "triangles",
        CellKind::Quads => "quads",
        CellKind::Tetrahedra => "tetrahedra",
        CellKind::Hexahedra => "hexahedra",
    }
}

/// Labels given per boundary face.
pub fn labels(value: &Bound<'_, PyAny>) -> PyResult<Vec<i8>> {
    let (numbers, shape) = arrays::whole("labels").read::<i64>(value)?;
    let labels: Option<Vec<i8>> =
        numbers.iter().map(|&l| i8::try_from(l).ok().filter(|l| (-1..6).contains(l))).collect();
    match labels {
        Some(labels) if shape.len() == 1 => Ok(labels),
        _ => Err(errors::option(value.py(), "labels are not one number from -1 to 5 per face", "give shape (f,)")),
    }
}

/// Reads a mesh. The extension tells the format: obj, off, ply, stl, vtp (surfaces), mesh, meshb, vtk, vtu, msh or inp.
///
/// Raises:
///     FileError: the file cannot be read.
///     ParseError: it does not follow its format; `elements` has the line.
///     InvalidMesh: it holds no cells, or a coordinate is not finite.
///     Unsupported: another format, or cells that are not read.
#[pyfunction]
pub fn read(py: Python<'_>, path: PathBuf) -> PyResult<PyMesh> {
    py.detach(|| mesh::read(&path)).map(PyMesh::from).map_err(|e| errors::about(py, &e, None))
}

/// Reads a shape and the polycube that it was deformed to. The order is SHAPE FIRST, then polycube, in the arguments
/// and in the tuple that is returned. (`simplify` takes the polycube first; the C++ and Rust `read_pair`, too.)
///
/// Raises:
///     Mismatch: they do not have the same vertices and cells; and what `read` raises.
#[pyfunction]
pub fn read_pair(py: Python<'_>, shape: PathBuf, polycube: PathBuf) -> PyResult<(PyMesh, PyMesh)> {
    let pair = py.detach(|| mesh::read_pair(&polycube, &shape)).map_err(|e| errors::about(py, &e, None))?;
    Ok((pair.1.into(), pair.0.into()))
}

/// Reads the label of each boundary face of `polycube`, one a line of the file: (f,) int8.
///
/// Args:
///     path: the file of labels, or a mesh file that numbers its faces: references in MEDIT's, data of cells in VTK's,
///         physical groups in Gmsh's, names of materials as "label_3" or "plus_x" in OBJ.
///     polycube: the mesh.
///     source: the file that the mesh was read from. With it, labels may also be given one for each of its faces before
///         polygons were cut into triangles, or for each face that it lists beside its cells. Four for each
///         tetrahedron, for the faces opposite to its corners, are read without.
///     order: which number stands for which direction, where not "+X-X+Y-Y+Z-Z"; as in "-X+X-Y+Y-Z+Z", or
///         "1:+X-X+Y-Y+Z-Z" where numbers count from 1.
///
/// Raises:
///     ParseError: a line is no number from -1 to 5; `elements` has the line. Or the faces of a mesh file have none.
///     Mismatch: there are not as many labels as faces.
///     InvalidOption: `order` is none, or does not have a number of the file.
#[pyfunction]
#[pyo3(signature = (path, polycube, source=None, order=None))]
pub fn read_labels<'py>(
    py: Python<'py>,
    path: PathBuf,
    polycube: &PyMesh,
    source: Option<PathBuf>,
    order: Option<&str>,
) -> PyResult<Bound<'py, PyAny>> {
    let read = || {
        let order = order.unwrap_or("+X-X+Y-Y+Z-Z").parse()?;
        mesh::read_labels_of(&polycube.0, source.as_deref(), &path, Some(&order))
    };
    let labels = py.detach(read).map_err(|e| errors::about(py, &e, None))?;
    Ok(numpy::PyArray1::from_vec(py, labels).into_any())
}

/// Makes an example and returns SHAPE FIRST, then polycube, as `read_pair` does.
///
/// Args:
///     name: one of `EXAMPLES`.
///     seed: shifts the parts of the polycube; 0 leaves all of them aligned.
///     kind: "triangles", "quads", "tetrahedra" or "hexahedra".
///
/// >>> import polycube
/// >>> polycube.example("ring", kind="quads")
/// (Mesh(8992 points, 8992 quads), Mesh(8992 points, 8992 quads))
#[pyfunction]
#[pyo3(signature = (name="cube-spikes", *, seed=1, kind="tetrahedra"))]
pub fn example(py: Python<'_>, name: &str, seed: u64, kind: &str) -> PyResult<(PyMesh, PyMesh)> {
    let make = || generate::example(name.parse::<Example>()?, seed, kind.parse()?);
    let (polycube, shape) = py.detach(make).map_err(|e| errors::raise(py, &e, None))?;
    Ok((shape.into(), polycube.into()))
}

/// The names of all examples.
pub fn examples() -> Vec<String> {
    Example::ALL.iter().map(Example::to_string).collect()
}
