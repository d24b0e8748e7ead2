//! One file for each format of meshes.

mod abaqus;
mod gmsh;
mod medit;
mod meshb;
pub(super) mod obj;
mod off;
mod ply;
pub(super) mod stl;
mod vtk;

use self::vtk::{legacy, vtp, vtu};
use super::field::CellField;
use super::format::Format;
use super::soup::Soup;
use crate::error::Result;
use crate::mesh::Mesh;
use std::borrow::Cow;

/// What the bytes of a file hold.
pub(super) fn read(format: Format, bytes: &[u8]) -> Result<Soup> {
    read_as(format, bytes, false)
}

/// What the bytes of a file hold, with numbers of its faces, as far as it has them.
pub(super) fn read_tagged(format: Format, bytes: &[u8]) -> Result<Soup> {
    read_as(format, bytes, true)
}

/// The data of cells in VTK's files are read only where the faces shall be `tagged`; the others have their numbers
/// beside the faces.
fn read_as(format: Format, bytes: &[u8], tagged: bool) -> Result<Soup> {
    match format {
        Format::Obj => obj::read(&with_line_feeds(bytes)),
        Format::Off => off::read(&with_line_feeds(bytes)),
        Format::Ply => ply::read(bytes),
        Format::Stl => stl::read(bytes),
        Format::Medit => medit::read(&with_line_feeds(bytes)),
        Format::Vtk => legacy::read(bytes, tagged),
        Format::Vtu => vtu::read(bytes, tagged),
        Format::Vtp => vtp::read(bytes, tagged),
        Format::Msh => gmsh::read(bytes),
        Format::Inp => abaqus::read(&with_line_feeds(bytes)),
        Format::Meshb => meshb::read(bytes),
    }
}

/// Text whose lines end with a carriage return alone, as old programs wrote it, with line feeds in their place; other
/// text as it is.
fn with_line_feeds(text: &[u8]) -> Cow<'_, [u8]> {
    let end = text.iter().position(|&b| b == b'\r' || b == b'\n');
    let is_old = end.is_some_and(|end| text[end] == b'\r' && text.get(end + 1) != Some(&b'\n'));
    if !is_old {
        return Cow::Borrowed(text);
    }
    text.iter().map(|&b| if b == b'\r' { b'\n' } else { b }).collect::<Vec<u8>>().into()
}

/// The bytes of a file; the format must be able to hold the mesh.
pub(super) fn write(format: Format, mesh: &Mesh, fields: &[CellField]) -> Result<Vec<u8>> {
    match format {
        Format::Obj => Ok(obj::write(mesh, &[])),
        Format::Off => Ok(off::write(mesh)),
        Format::Ply => Ok(ply::write(mesh, fields)),
        Format::Stl => stl::write(mesh),
        Format::Medit => Ok(medit::write(mesh, fields)),
        Format::Vtk => Ok(legacy::write(mesh, fields)),
        Format::Vtu => Ok(vtu::write(mesh, fields)),
        Format::Vtp => Ok(vtp::write(mesh, fields)),
        Format::Msh => Ok(gmsh::write(mesh)),
        Format::Inp => Ok(abaqus::write(mesh)),
        Format::Meshb => Ok(meshb::write(mesh)),
    }
}
