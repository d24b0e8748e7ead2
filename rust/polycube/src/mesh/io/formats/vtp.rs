//! VTK's XML surfaces; their vertices and lines are passed over.

use super::vtk_cells::{POLYGON, VtkCells};
use super::vtk_xml::{self, array, write_corners};
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::mesh::io::field::CellField;
use crate::mesh::io::soup::Soup;

const KIND: &str = "PolyData";

/// Reads a surface.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    vtk_xml::read(bytes, KIND, |piece, arrays, soup, base| {
        let is_empty = |name| piece.attribute(name).is_none_or(|count| count.trim() == "0");
        if !is_empty("NumberOfStrips") {
            return Err(Error::new(ErrorKind::Unsupported, "the file holds strips of triangles")
                .remedy("export triangles, as with vtkTriangleFilter"));
        }
        if is_empty("NumberOfPolys") {
            return Ok(());
        }
        let mut polygons = |name| arrays.numbers(&array(piece, "Polys", Some(name))?);
        let (ends, corners) = (polygons("offsets")?, polygons("connectivity")?);
        VtkCells { types: vec![f64::from(POLYGON); ends.len()], ends, corners }.add_to(soup, base)
    })
}

/// Writes a surface.
pub(super) fn write(mesh: &Mesh, fields: &[CellField]) -> Vec<u8> {
    vtk_xml::write(mesh, [KIND, &format!("NumberOfPolys=\"{}\"", mesh.cells().len())], fields, |text| {
        text.put("<Polys>\n");
        write_corners(text, mesh);
        text.put("</Polys>\n");
    })
}
