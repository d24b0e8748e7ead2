//! Geomview OFF: vertices and faces as text; normals, colours and texture coordinates are ignored.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::mesh::io::scan::Scanner;
use crate::mesh::io::soup::Soup;
use crate::mesh::io::text::Text;

/// Reads a mesh.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut scanner = Scanner::with_comments(bytes);
    let plain = header(&mut scanner)?;
    let vertices = scanner.count("the number of vertices")?;
    let faces = scanner.count("the number of faces")?;
    // The number of edges is of no use and often left out.
    scanner.rest_of_line();
    let mut soup = Soup::default();
    soup.points.reserve(scanner.capacity(vertices, 6));
    for _ in 0..vertices {
        soup.points.push(scanner.point()?);
        if !plain {
            scanner.rest_of_line();
        }
    }
    let mut corners = Vec::new();
    for _ in 0..faces {
        let count = scanner.count("the number of corners of a face")?;
        let line = scanner.line();
        corners.clear();
        for _ in 0..count {
            corners.push(scanner.index(0)?);
        }
        soup.polygon(&corners, line)?;
        // A colour may follow.
        scanner.rest_of_line();
    }
    Ok(soup)
}

/// Reads the keyword, which some programs leave out; true for the one that lets only positions follow.
fn header(scanner: &mut Scanner) -> Result<bool> {
    if scanner.peek().is_some_and(|word| word.iter().all(u8::is_ascii_digit)) {
        return Ok(true);
    }
    let word = scanner.expect("OFF")?;
    let prefix = word.strip_suffix(b"OFF");
    let prefix = prefix.ok_or_else(|| scanner.unexpected("OFF", word))?;
    let binary = scanner.peek() == Some(b"BINARY");
    if binary || !matches!(prefix, b"" | b"C" | b"N" | b"CN" | b"ST" | b"STC" | b"STN" | b"STCN") {
        let message = "this kind of OFF file is not supported";
        return Err(Error::new(ErrorKind::Unsupported, message).remedy("export three-dimensional OFF as text"));
    }
    Ok(prefix.is_empty())
}

/// Writes a surface.
pub(super) fn write(mesh: &Mesh) -> Vec<u8> {
    let mut text = Text::default();
    let (vertices, faces) = (mesh.points().len(), mesh.cells().len());
    text.put(format_args!("OFF\n{vertices} {faces} 0")).end();
    for point in mesh.points() {
        text.point(point).end();
    }
    for i in 0..faces {
        let corners = mesh.cells().cell(i);
        text.put(corners.len()).indices(corners, 0).end();
    }
    text.into_bytes()
}
