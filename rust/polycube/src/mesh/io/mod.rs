//! Mesh files: OBJ, OFF, PLY, STL, MEDIT, VTK, VTU, VTP, Gmsh and Abaqus, and those of solvers, which are only written.
//!
//! Every reader takes the bytes of a file and returns a [`Mesh`] or an [`Error`] that says where the file
//! is wrong. No input panics, loops, or takes more memory than in proportion to its size.

mod field;
mod file;
mod format;
mod formats;
mod label_order;
mod labels;
mod painted;
mod pair;
mod polygon;
mod scalar;
mod scan;
mod sniff;
mod solver;
mod soup;
mod text;

#[cfg(test)]
mod tests;

pub use field::{CellField, FieldValues};
pub use file::{Staged, write_atomically};
pub use format::Format;
pub use label_order::LabelOrder;
pub use labels::{parse_labels, read_labels, read_labels_of, write_labels};
pub use painted::read_grouped_surface;
pub use pair::read_pair;
pub use solver::{SolverFormat, write_solver, write_solver_bytes};

use super::{CellKind, Mesh};
use crate::error::{Error, ErrorKind, Result};
use std::path::Path;

/// Reads a mesh from a file whose extension tells the format.
///
/// Vertices keep their order, used or not; coordinates keep the file's unit. Where a file holds volume
/// and surface, the volume is taken. A surface of quadrilaterals stays one; any other is split into
/// triangles, face by face: as a fan around the first corner where that goes, which for a concave face or one with
/// straight corners it does not. The corners of STL are welded where they coincide exactly.
///
/// ```
/// use polycube::mesh::{self, CellKind, Cells};
///
/// # let folder = tempfile::tempdir().unwrap();
/// # let file = folder.path().join("square.obj");
/// # std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").unwrap();
/// let square = mesh::read(&file)?;
/// assert_eq!((square.points().len(), square.cells().kind()), (4, CellKind::Quads));
/// assert_eq!(*square.cells(), Cells::Quads(vec![[0, 1, 2, 3]]));
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Io`] when the file cannot be read; [`ErrorKind::Parse`] with the line or cell when it is
/// malformed; [`ErrorKind::Mesh`] when it holds no cells or a coordinate that is not finite;
/// [`ErrorKind::Unsupported`] for other formats and other cells, or tetrahedra mixed with hexahedra.
pub fn read(path: &Path) -> Result<Mesh> {
    let format = format_of(path)?;
    read_as(format, path, &file::read_file(path)?)
}

/// The format of a file to read.
fn format_of(path: &Path) -> Result<Format> {
    if path.is_dir() {
        let message = format!("{} is a folder", path.display());
        return Err(Error::new(ErrorKind::Io, message).remedy("name a mesh file"));
    }
    Format::from_path(path)
}

/// Reads the bytes of the file at `path`.
fn read_as(format: Format, path: &Path, bytes: &[u8]) -> Result<Mesh> {
    read_bytes(format, bytes).map_err(about(format, path, bytes))
}

/// Names the file that is wrong, and tells where its contents are those of another format.
fn about<'a>(format: Format, path: &'a Path, bytes: &'a [u8]) -> impl Fn(Error) -> Error + 'a {
    move |mut error| {
        if let Some(found) = sniff::format(bytes).filter(|&found| found != format) {
            error.remedy =
                format!("is it another format under this name? It begins as a .{found} file does: rename it");
        } else if error.kind == ErrorKind::Parse && error.remedy.is_empty() {
            error.remedy =
                "the file does not follow the format that its extension names; export it again or rename it".into();
        }
        error.in_file(path.display())
    }
}

/// Reads a mesh as [`read`] does, from the bytes of a file.
///
/// # Errors
/// As [`read`], but never [`ErrorKind::Io`].
pub fn read_bytes(format: Format, bytes: &[u8]) -> Result<Mesh> {
    formats::read(format, bytes)?.finish()
}

/// Writes a mesh to a file whose extension tells the format, whole or not at all (see [`write_atomically`]).
///
/// PLY, VTK and VTU hold every field. MEDIT holds one of integers, as reference numbers: `label`, or else
/// `block_id`. The other formats leave fields out. In PLY integers named `red`, `green`, `blue` and `alpha` are the
/// colours of the faces, one byte each (0 to 255).
///
/// ```
/// use polycube::generate::{Example, example};
/// use polycube::mesh::{self, CellField, CellKind, FieldValues};
///
/// # let folder = tempfile::tempdir().unwrap();
/// # let file = folder.path().join("ring.vtu");
/// let (cube, _) = example(Example::Ring, 1, CellKind::Quads)?;
/// let number = FieldValues::Integer((0..).take(cube.cells().len()).collect());
/// mesh::write(&file, &cube, &[CellField { name: "number".into(), values: number }])?;
/// assert_eq!(mesh::read(&file)?, cube);
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// As [`write_bytes`], and [`ErrorKind::Io`] when the file cannot be written.
pub fn write(path: &Path, mesh: &Mesh, fields: &[CellField]) -> Result<()> {
    let bytes = write_bytes(Format::from_path(path)?, mesh, fields)?;
    write_atomically(path, &bytes)
}

/// The bytes of the file that [`write()`] would write. The same mesh always gives the same bytes.
///
/// Coordinates read back as the very same numbers, except from STL, which holds single precision only.
///
/// # Errors
/// [`ErrorKind::Unsupported`] when the format cannot hold the cells; [`ErrorKind::Mesh`] when there are none;
/// [`ErrorKind::Option`] when a field has not one value per cell, or a name that is empty, taken, or has other
/// characters than letters, digits and `_ - . :`.
pub fn write_bytes(format: Format, mesh: &Mesh, fields: &[CellField]) -> Result<Vec<u8>> {
    format.require(mesh.cells().kind())?;
    require_cells(mesh)?;
    field::check_fields(fields, mesh.cells().len())?;
    formats::write(format, mesh, fields)
}

/// The bytes of an OBJ file of quadrilaterals with texture coordinates of the corners of each, in their order.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for other cells; [`ErrorKind::Mesh`] for none; [`ErrorKind::Mismatch`] unless there are
/// coordinates for each.
pub fn write_textured_bytes(mesh: &Mesh, uv: &[[[f64; 2]; 4]]) -> Result<Vec<u8>> {
    if mesh.cells().kind() != CellKind::Quads {
        let message = format!("{} have no texture coordinates here", mesh.cells().kind());
        return Err(Error::new(ErrorKind::Unsupported, message).remedy("give quadrilaterals"));
    }
    require_cells(mesh)?;
    if uv.len() != mesh.cells().len() {
        let message = format!("texture coordinates of {} of {} quadrilaterals", uv.len(), mesh.cells().len());
        return Err(Error::new(ErrorKind::Mismatch, message).remedy("give four for each"));
    }
    Ok(formats::obj::write(mesh, uv))
}

fn require_cells(mesh: &Mesh) -> Result<()> {
    if mesh.cells().is_empty() {
        return Err(Error::new(ErrorKind::Mesh, "a mesh without cells cannot be written"));
    }
    Ok(())
}
