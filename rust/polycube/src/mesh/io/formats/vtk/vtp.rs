//! VTK's XML surfaces; their vertices and lines are passed over.

use super::cells::{POLYGON, VtkCells};
use super::xml::{self, Kind, array, write_corners};
use super::xml_data::Arrays;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::mesh::io::field::CellField;
use crate::mesh::io::soup::Soup;
use roxmltree::Node;

const KIND: Kind = Kind { name: "PolyData", cells: polygons };

/// Reads a surface, with numbers of its faces if it shall be `tagged`.
pub(in crate::mesh::io::formats) fn read(bytes: &[u8], tagged: bool) -> Result<Soup> {
    xml::read(bytes, &KIND, tagged)
}

fn polygons(piece: &Node, arrays: &mut Arrays, mut tags: Vec<f64>) -> Result<VtkCells> {
    let count = |name| piece.attribute(name).and_then(|count| count.trim().parse::<usize>().ok()).unwrap_or(0);
    if count("NumberOfStrips") > 0 {
        return Err(Error::new(ErrorKind::Unsupported, "the file holds strips of triangles")
            .remedy("export triangles, as with vtkTriangleFilter"));
    }
    // The data are those of vertices and lines first.
    let before = count("NumberOfVerts").saturating_add(count("NumberOfLines"));
    tags.drain(..before.min(tags.len()));
    let mut numbers = |name| match count("NumberOfPolys") {
        0 => Ok(Vec::new()),
        _ => arrays.numbers(&array(piece, "Polys", Some(name))?),
    };
    let (ends, corners) = (numbers("offsets")?, numbers("connectivity")?);
    Ok(VtkCells { types: vec![f64::from(POLYGON); ends.len()], ends, corners, tags })
}

/// Writes a surface.
pub(in crate::mesh::io::formats) fn write(mesh: &Mesh, fields: &[CellField]) -> Vec<u8> {
    xml::write(mesh, [KIND.name, &format!("NumberOfPolys=\"{}\"", mesh.cells().len())], fields, |text| {
        text.put("<Polys>\n");
        write_corners(text, mesh);
        text.put("</Polys>\n");
    })
}
