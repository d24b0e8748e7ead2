//! VTK's XML unstructured grids.

use super::cells::{VtkCells, number_of};
use super::xml::{self, Kind, array, write_array, write_corners};
use crate::error::Result;
use crate::mesh::Mesh;
use crate::mesh::io::field::CellField;
use crate::mesh::io::soup::Soup;

const KIND: Kind = Kind {
    name: "UnstructuredGrid",
    cells: |piece, arrays, tags| {
        let mut cells = |name| arrays.numbers(&array(piece, "Cells", Some(name))?);
        Ok(VtkCells { types: cells("types")?, ends: cells("offsets")?, corners: cells("connectivity")?, tags })
    },
};

/// Reads a mesh, with numbers of its cells if it shall be `tagged`.
pub(in crate::mesh::io::formats) fn read(bytes: &[u8], tagged: bool) -> Result<Soup> {
    xml::read(bytes, &KIND, tagged)
}

/// Writes a mesh.
pub(in crate::mesh::io::formats) fn write(mesh: &Mesh, fields: &[CellField]) -> Vec<u8> {
    let count = mesh.cells().len();
    xml::write(mesh, [KIND.name, &format!("NumberOfCells=\"{count}\"")], fields, |text| {
        text.put("<Cells>\n");
        write_corners(text, mesh);
        let types = std::iter::repeat_n(number_of(mesh.cells().kind()), count);
        write_array(text, "UInt8", "Name=\"types\"", types);
        text.put("</Cells>\n");
    })
}
