//! What VTK's XML files of any type have in common: text, inline base64 and appended data, plain or compressed by zlib.

use super::cells::{VtkCells, choose_tags, points};
use super::xml_data::{Arrays, find, line_of};
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::io::field::{CellField, FieldValues};
use crate::mesh::io::soup::Soup;
use crate::mesh::io::text::Text;
use crate::mesh::{Mesh, Point};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use roxmltree::{Document, Node};

/// A type of files: its name, and what reads the cells of a piece, whose numbers, if that is wanted, are given.
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) cells: fn(&Node, &mut Arrays, Vec<f64>) -> Result<VtkCells>,
}

/// Reads a file; the data on points are ignored, and those on cells, unless they shall be `tagged` with them. Several
/// pieces are put one after the other.
pub(super) fn read(bytes: &[u8], kind: &Kind, tagged: bool) -> Result<Soup> {
    // Appended data may be raw bytes, which XML does not allow: only what comes before is XML.
    let head = find(bytes, b"<AppendedData").unwrap_or(bytes.len());
    let (head, appended) = bytes.split_at(head);
    let parse = |message: &str| Error::new(ErrorKind::Parse, message);
    let text = std::str::from_utf8(head).map_err(|_| parse("the XML is not UTF-8"))?;
    let end = if appended.is_empty() { "" } else { "</VTKFile>" };
    let text = format!("{text}{end}");
    check_tags(&text)?;
    let document = Document::parse(&text).map_err(|error| {
        let line = error.pos().row as usize;
        parse(&format!("the XML is malformed: {error}")).at(Place::Line(line))
    })?;
    let root = document.root_element();
    if root.attribute("type") != Some(kind.name) {
        let message = format!("not a VTK file of type {}", kind.name);
        return Err(Error::new(ErrorKind::Unsupported, message)
            .remedy("export an unstructured grid as .vtu, or a surface as .vtp"));
    }
    let mut arrays = Arrays::new(&root, appended)?;
    let mut soup = Soup::default();
    for piece in root.descendants().filter(|node| node.has_tag_name("Piece")) {
        let base = u32::try_from(soup.points.len()).unwrap_or(u32::MAX);
        soup.points.extend(points_of(&piece, &mut arrays)?);
        let tags = if tagged { tags_of(&piece, &mut arrays)? } else { Vec::new() };
        (kind.cells)(&piece, &mut arrays, tags)?.add_to(&mut soup, base)?;
    }
    Ok(soup)
}

/// Refuses XML that no program writes for a mesh: attributes and namespaces by the thousand would take the
/// parser time and memory out of proportion to the size of the file.
fn check_tags(text: &str) -> Result<()> {
    let tags = text.split('<').skip(1).filter(|tag| tag.starts_with(|c: char| c.is_alphabetic()));
    let longest = tags.map(|tag| tag.find('>').unwrap_or(tag.len())).max();
    if longest.unwrap_or(0) > 4096 || text.matches("xmlns").count() > 8 {
        let message = "a tag with too many attributes, or too many namespaces";
        return Err(Error::new(ErrorKind::Parse, message).remedy("export the mesh again"));
    }
    Ok(())
}

fn points_of(piece: &Node, arrays: &mut Arrays) -> Result<Vec<Point>> {
    let coordinates = array(piece, "Points", None)?;
    if coordinates.attribute("NumberOfComponents") != Some("3") {
        let message = "the points do not have three components";
        return Err(Error::new(ErrorKind::Parse, message).at(line_of(&coordinates)));
    }
    Ok(points(&arrays.numbers(&coordinates)?))
}

/// A number of each cell, or none.
fn tags_of(piece: &Node, arrays: &mut Arrays) -> Result<Vec<f64>> {
    let data = piece.children().filter(|node| node.has_tag_name("CellData")).flat_map(|node| node.children());
    let single = |node: &Node| {
        node.has_tag_name("DataArray") && matches!(node.attribute("NumberOfComponents"), None | Some("" | "1"))
    };
    let described = |node: Node| {
        let [name, kind] = ["Name", "type"].map(|key| node.attribute(key).unwrap_or_default());
        (name.to_owned(), kind.contains("Int"), arrays.numbers(&node))
    };
    choose_tags(data.filter(single).map(described).collect()).unwrap_or(Ok(Vec::new()))
}

/// A data array of a piece, by its name or the only one.
pub(super) fn array<'a>(piece: &Node<'a, 'a>, parent: &str, name: Option<&str>) -> Result<Node<'a, 'a>> {
    let parents = piece.children().filter(|node| node.has_tag_name(parent));
    let mut found = parents
        .flat_map(|node| node.children())
        .filter(|node| node.has_tag_name("DataArray") && (name.is_none() || node.attribute("Name") == name));
    found.next().ok_or_else(|| {
        let message = format!("the piece has no array {}", name.unwrap_or(parent));
        Error::new(ErrorKind::Parse, message).at(line_of(piece))
    })
}

/// The bytes of a file of one piece with inline base64 data, and the fields as data of the cells. `counts` are those of
/// the piece, `cells` writes what comes after the points.
pub(super) fn write(
    mesh: &Mesh,
    [kind, counts]: [&str; 2],
    fields: &[CellField],
    cells: impl FnOnce(&mut Text),
) -> Vec<u8> {
    let mut text = Text::default();
    text.put("<?xml version=\"1.0\"?>\n");
    text.put(format_args!("<VTKFile type=\"{kind}\" version=\"1.0\" "));
    text.put(format_args!("byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<{kind}>\n"));
    text.put(format_args!("<Piece NumberOfPoints=\"{}\" {counts}>\n<Points>\n", mesh.points().len()));
    let coordinates = mesh.points().iter().flat_map(|p| p.iter());
    let three = "Name=\"Points\" NumberOfComponents=\"3\"";
    write_array(&mut text, "Float64", three, coordinates.flat_map(|x| x.to_le_bytes()));
    text.put("</Points>\n");
    cells(&mut text);
    text.put("<CellData>\n");
    for field in fields {
        write_field(&mut text, field);
    }
    text.put(format_args!("</CellData>\n</Piece>\n</{kind}>\n</VTKFile>")).end();
    text.into_bytes()
}

/// The corners of the cells and where each ends.
pub(super) fn write_corners(text: &mut Text, mesh: &Mesh) {
    let cells = (0..mesh.cells().len()).map(|i| mesh.cells().cell(i));
    let corners = cells.clone().flatten().map(|&v| i64::from(v));
    write_array(text, "Int64", "Name=\"connectivity\"", corners.flat_map(i64::to_le_bytes));
    let ends = cells.enumerate().map(|(i, c)| ((i + 1) * c.len()) as i64);
    write_array(text, "Int64", "Name=\"offsets\"", ends.flat_map(i64::to_le_bytes));
}

fn write_field(text: &mut Text, field: &CellField) {
    let name = format!("Name=\"{}\"", field.name);
    match &field.values {
        FieldValues::Real(v) => {
            write_array(text, "Float64", &name, v.iter().flat_map(|x| x.to_le_bytes()));
        }
        FieldValues::Integer(v) => {
            write_array(text, "Int32", &name, v.iter().flat_map(|x| x.to_le_bytes()));
        }
    }
}

/// A data array with inline data.
pub(super) fn write_array(text: &mut Text, kind: &str, attributes: &str, data: impl Iterator<Item = u8>) {
    let mut bytes = vec![0; 8];
    bytes.extend(data);
    let size = (bytes.len() - 8) as u64;
    bytes[..8].copy_from_slice(&size.to_le_bytes());
    text.put(format_args!("<DataArray type=\"{kind}\" {attributes} format=\"binary\">\n"));
    text.put(BASE64_STANDARD.encode(&bytes)).put("\n</DataArray>").end();
}
