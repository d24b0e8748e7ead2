//! VTK's XML unstructured grids.

use super::vtk_cells::{VtkCells, number_of};
use super::vtk_xml::{self, array, write_array, write_corners};
use crate::error::Result;
use crate::mesh::Mesh;
use crate::mesh::io::field::CellField;
use crate::mesh::io::soup::Soup;

const KIND: &str = "UnstructuredGrid";

/// Reads a mesh.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    vtk_xml::read(bytes, KIND, |piece, arrays, soup, base| {
        let mut cells = |name| arrays.numbers(&array(piece, "Cells", Some(name))?);
        let cells = VtkCells { types: cells("types")?, ends: cells("offsets")?, corners: cells("connectivity")? };
        cells.add_to(soup, base)
    })
}

/// Writes a mesh.
pub(super) fn write(mesh: &Mesh, fields: &[CellField]) -> Vec<u8> {
    let count = mesh.cells().len();
    vtk_xml::write(mesh, [KIND, &format!("NumberOfCells=\"{count}\"")], fields, |text| {
        text.put("<Cells>\n");
        write_corners(text, mesh);
        let types = std::iter::repeat_n(number_of(mesh.cells().kind()), count);
        write_array(text, "UInt8", "Name=\"types\"", types);
        text.put("</Cells>\n");
    })
}
