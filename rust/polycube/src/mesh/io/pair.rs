//! A polycube and the shape it was deformed from.

use super::formats::{self, stl};
use super::{Format, about, file, format_of};
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Mesh;
use std::path::Path;

/// Reads a polycube and its shape, two meshes with the same connectivity: **the polycube first**, in the arguments and
/// in the pair that is returned. (Python's `read_pair` has the shape first.)
///
/// Both are read as [`read`](super::read) does. Of two STL files, which have no connectivity of their own,
/// two corners become one vertex where both files agree that they coincide.
///
/// # Errors
/// As [`read`](super::read), and [`ErrorKind::Mismatch`] naming the first difference when the meshes do not
/// have the same kind of cells, as many vertices, and the same cells in the same order.
pub fn read_pair(polycube: &Path, shape: &Path) -> Result<(Mesh, Mesh)> {
    let formats = (format_of(polycube)?, format_of(shape)?);
    let (a, b) = (file::read_file(polycube)?, file::read_file(shape)?);
    let in_both = |error: Error| error.in_file(format_args!("{} and {}", polycube.display(), shape.display()));
    if formats == (Format::Stl, Format::Stl) {
        let a = stl::corners(&a).map_err(about(Format::Stl, polycube, &a))?;
        let b = stl::corners(&b).map_err(about(Format::Stl, shape, &b))?;
        return stl::pair(&a, &b).map_err(in_both);
    }
    let (about_a, about_b) = (about(formats.0, polycube, &a), about(formats.1, shape, &b));
    let [held, held_b] =
        [formats::read(formats.0, &a).map_err(&about_a)?, formats::read(formats.1, &b).map_err(&about_b)?];
    let a = held.mesh().map_err(&about_a)?;
    let b = held_b.finish_like(&held, &a).map_err(&about_b)?;
    compare(&a, &b).map_err(in_both)?;
    Ok((a, b))
}

fn compare(polycube: &Mesh, shape: &Mesh) -> Result<()> {
    let (a, b) = (polycube.cells(), shape.cells());
    if a.kind() != b.kind() {
        let (a, b) = (a.kind(), b.kind());
        return Err(mismatch(format!("the polycube has {a}, the shape {b}")));
    }
    let (n, m) = (polycube.points().len(), shape.points().len());
    if n != m {
        return Err(mismatch(format!("the polycube has {n} vertices, the shape {m}")));
    }
    if let Some(i) = (0..a.len().min(b.len())).find(|&i| a.cell(i) != b.cell(i)) {
        let (a, b) = (a.cell(i), b.cell(i));
        let message = format!("vertices {a:?} in the polycube, {b:?} in the shape");
        return Err(mismatch(message).at(Place::Cell(u32::try_from(i).unwrap_or(u32::MAX))));
    }
    if a.len() != b.len() {
        let (n, m, kind) = (a.len(), b.len(), a.kind());
        return Err(mismatch(format!("the polycube has {n} {kind}, the shape {m}")));
    }
    Ok(())
}

fn mismatch(message: String) -> Error {
    Error::new(ErrorKind::Mismatch, message)
        .remedy("export both in one format from one mesh, without reordering or merging vertices")
}
