//! What C++ hands in, checked and made the core's.

use crate::ffi::{InputView, MeshView};
use polycube::mesh::{CellKind, Cells, Mesh, Point};
use polycube::simplify::Input;
use polycube::{Error, ErrorKind, Result};

/// Meshes and labels of a call.
pub struct Owned {
    polycube: Mesh,
    shape: Option<Mesh>,
    labels: Option<Vec<i8>>,
}

impl Owned {
    /// Copies the buffers. Whether they fit each other is for the core to say.
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`] for buffers that are no mesh.
    pub fn new(view: &InputView) -> Result<Self> {
        let polycube = mesh(&view.polycube)?;
        let shape = view.has_shape.then(|| mesh(&view.shape)).transpose()?;
        let labels = view.has_labels.then(|| view.labels.to_vec());
        Ok(Self { polycube, shape, labels })
    }

    /// What the core takes.
    pub fn input(&self) -> Input<'_> {
        Input { polycube: &self.polycube, shape: self.shape.as_ref(), labels: self.labels.as_deref() }
    }
}

/// The mesh in the buffers.
///
/// # Errors
/// [`ErrorKind::Mesh`] for numbers that do not come out even, are not finite or name vertices that are not there.
pub fn mesh(view: &MeshView) -> Result<Mesh> {
    let (points, rest) = view.points.as_chunks::<3>();
    if !rest.is_empty() {
        return Err(uneven(format!("{} coordinates are not three a vertex", view.points.len())));
    }
    let points: Vec<Point> = points.iter().map(|&p| Point::from(p)).collect();
    let cells = match kind(view.kind)? {
        CellKind::Triangles => Cells::Triangles(chunks(view.cells)?),
        CellKind::Quads => Cells::Quads(chunks(view.cells)?),
        CellKind::Tetrahedra => Cells::Tetrahedra(chunks(view.cells)?),
        CellKind::Hexahedra => Cells::Hexahedra(chunks(view.cells)?),
    };
    Mesh::new(points, cells)
}

/// The kind numbered `kind`.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for other numbers.
pub fn kind(kind: u8) -> Result<CellKind> {
    let found = CellKind::ALL.get(usize::from(kind)).copied();
    found.ok_or_else(|| Error::new(ErrorKind::Unsupported, format!("there is no cell kind {kind}")))
}

fn chunks<const N: usize>(cells: &[u32]) -> Result<Vec<[u32; N]>> {
    let (whole, rest) = cells.as_chunks::<N>();
    if rest.is_empty() {
        Ok(whole.to_vec())
    } else {
        Err(uneven(format!("{} indices are not {N} a cell", cells.len())))
    }
}

fn uneven(message: String) -> Error {
    Error::new(ErrorKind::Mesh, message).remedy("give whole vertices and cells")
}
