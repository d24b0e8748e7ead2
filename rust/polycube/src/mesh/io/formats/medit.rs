//! MEDIT `.mesh` as text: sections in any order; references of vertices are ignored when read.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::io::field::{CellField, FieldValues};
use crate::mesh::io::scan::Scanner;
use crate::mesh::io::soup::Soup;
use crate::mesh::io::text::Text;
use crate::mesh::{Cells, Mesh};

/// Reads a mesh.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut scanner = Scanner::with_comments(bytes);
    let word = scanner.expect("MeshVersionFormatted")?;
    if !word.eq_ignore_ascii_case(b"MeshVersionFormatted") {
        return Err(scanner
            .unexpected("MeshVersionFormatted", word)
            .remedy("only MEDIT files in text form have the extension .mesh"));
    }
    scanner.count("a version number")?;
    let mut soup = Soup::default();
    while let Some(keyword) = scanner.word() {
        if keyword.eq_ignore_ascii_case(b"End") {
            break;
        }
        section(keyword, &mut scanner, &mut soup)?;
    }
    Ok(soup)
}

fn section(keyword: &[u8], scanner: &mut Scanner, soup: &mut Soup) -> Result<()> {
    match keyword.to_ascii_lowercase().as_slice() {
        b"dimension" => dimension(scanner),
        b"vertices" => vertices(scanner, soup),
        b"triangles" => cells(scanner, soup, |soup, c: &[u32; 3], line| soup.polygon(c, line)),
        b"quadrilaterals" => cells(scanner, soup, |soup, c: &[u32; 4], line| soup.polygon(c, line)),
        b"tetrahedra" => cells(scanner, soup, |soup, c, line| {
            soup.tetrahedron(*c, line);
            Ok(())
        }),
        b"hexahedra" | b"hexaedra" => cells(scanner, soup, |soup, c, line| {
            soup.hexahedron(*c, line);
            Ok(())
        }),
        name if [&b"p2"[..], b"p3", b"q2", b"q3"].iter().any(|end| name.ends_with(end)) => none_of(keyword, scanner),
        b"prisms" | b"pyramids" | b"pentahedra" | b"pentaedra" => none_of(keyword, scanner),
        _ => skip(keyword, scanner),
    }
}

fn dimension(scanner: &mut Scanner) -> Result<()> {
    match scanner.count("the dimension")? {
        3 => Ok(()),
        other => Err(Error::new(ErrorKind::Unsupported, format!("a mesh of dimension {other}"))
            .remedy("export the mesh with three coordinates per vertex")),
    }
}

fn vertices(scanner: &mut Scanner, soup: &mut Soup) -> Result<()> {
    let count = scanner.count("the number of vertices")?;
    if !soup.points.is_empty() {
        return Err(scanner.error("a second list of vertices"));
    }
    soup.points.reserve(scanner.capacity(count, 8));
    for _ in 0..count {
        soup.points.push(scanner.point()?);
        scanner.float("the reference of a vertex")?;
    }
    Ok(())
}

fn cells<const N: usize>(
    scanner: &mut Scanner,
    soup: &mut Soup,
    add: impl Fn(&mut Soup, &[u32; N], usize) -> Result<()>,
) -> Result<()> {
    let count = scanner.count("the number of cells")?;
    for _ in 0..count {
        let mut corners = [0; N];
        for corner in &mut corners {
            *corner = scanner.index(1)?;
        }
        add(soup, &corners, scanner.line())?;
        soup.tag(Some(scanner.integer("the reference of a cell")?));
    }
    Ok(())
}

fn none_of(keyword: &[u8], scanner: &mut Scanner) -> Result<()> {
    if scanner.count("the number of cells")? == 0 {
        return Ok(());
    }
    let name = String::from_utf8_lossy(keyword);
    if name.ends_with(char::is_numeric) {
        let message = format!("the file holds quadratic or higher cells: {name}");
        return Err(Error::new(ErrorKind::Unsupported, message).remedy("export linear cells, without nodes on edges"));
    }
    Err(Error::new(ErrorKind::Unsupported, format!("the file holds {name}"))
        .remedy("export tetrahedra only or hexahedra only"))
}

/// Skips the numbers of a section that is of no use here.
fn skip(keyword: &[u8], scanner: &mut Scanner) -> Result<()> {
    if !keyword[0].is_ascii_alphabetic() {
        return Err(scanner.unexpected("a keyword", keyword).remedy("a count before this line may be too small"));
    }
    while scanner.peek().is_some_and(|word| !word[0].is_ascii_alphabetic()) {
        scanner.word();
    }
    Ok(())
}

/// Writes a mesh, with the integer field `label` or else `block_id` as references.
pub(super) fn write(mesh: &Mesh, fields: &[CellField]) -> Vec<u8> {
    let references = ["label", "block_id"].iter().find_map(|name| {
        fields.iter().find_map(|field| match &field.values {
            FieldValues::Integer(values) if field.name == *name => Some(values),
            _ => None,
        })
    });
    let mut text = Text::default();
    text.put("MeshVersionFormatted 2\nDimension 3\nVertices\n");
    text.put(mesh.points().len()).end();
    for point in mesh.points() {
        text.point(point).put(" 0").end();
    }
    text.put(match mesh.cells() {
        Cells::Triangles(_) => "Triangles\n",
        Cells::Quads(_) => "Quadrilaterals\n",
        Cells::Tetrahedra(_) => "Tetrahedra\n",
        Cells::Hexahedra(_) => "Hexahedra\n",
    });
    text.put(mesh.cells().len()).end();
    for i in 0..mesh.cells().len() {
        for &vertex in mesh.cells().cell(i) {
            text.put(u64::from(vertex) + 1).put(' ');
        }
        text.put(references.map_or(0, |r| r[i])).end();
    }
    text.put("End").end();
    text.into_bytes()
}
