//! Wavefront OBJ: vertices and faces, these with the numbers of their materials or groups; all else is ignored.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::io::scan::{Scanner, number, number_in, quoted, without_mark};
use crate::mesh::io::soup::Soup;
use crate::mesh::io::text::Text;
use crate::mesh::{Mesh, Point};
use std::collections::BTreeMap;

/// Reads a mesh; vertices are neither merged nor dropped.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut soup = Soup::default();
    let mut corners = Vec::new();
    let (mut material, mut group) = (None, None);
    // Names of material, group and object: the first that is there names the faces.
    let mut names = [None; 3];
    let mut scanner = Scanner::new(without_mark(bytes));
    loop {
        let line = scanner.line();
        let Some(text) = scanner.rest_of_line() else {
            break;
        };
        let start = text.iter().position(|b| !b.is_ascii_whitespace());
        let rest = match text.get(start.unwrap_or(text.len())..) {
            Some([b'v' | b'f', rest @ ..]) if rest.first().is_none_or(separates) => rest,
            Some(other) => {
                match name_of(other) {
                    Some((0, name)) => (material, names[0]) = (number_in(name), Some(soup.group(name))),
                    Some((1, name)) => (group, names[1]) = (number_in(name), Some(soup.group(name))),
                    Some((i, name)) => names[i] = Some(soup.group(name)),
                    None => {}
                }
                continue;
            }
            None => continue,
        };
        let is_vertex = start.is_some_and(|s| text[s] == b'v');
        // Only these lines continue: a path or a comment that ends in a backslash does not.
        let statement = Statement { rest, line, is_vertex };
        statement.read(&mut scanner, &mut soup, &mut corners)?;
        if !is_vertex {
            soup.tag(material.or(group));
            soup.put_in(names.into_iter().flatten().next());
        }
    }
    Ok(soup)
}

/// What follows the name of a material (0), a group (1) or an object (2).
fn name_of(statement: &[u8]) -> Option<(usize, &[u8])> {
    let keywords = [&b"usemtl "[..], b"g ", b"o "];
    let named = |(i, keyword): (usize, &[u8])| Some((i, statement.strip_prefix(keyword)?.trim_ascii()));
    keywords.into_iter().enumerate().find_map(named).filter(|(_, name)| !name.is_empty())
}

struct Statement<'a> {
    rest: &'a [u8],
    line: usize,
    is_vertex: bool,
}

impl Statement<'_> {
    fn read(&self, scanner: &mut Scanner, soup: &mut Soup, corners: &mut Vec<u32>) -> Result<()> {
        let mut point = Point::origin();
        let mut count = 0;
        let mut text = self.rest;
        corners.clear();
        loop {
            for word in words(text) {
                if !self.is_vertex {
                    corners.push(self.corner(word, soup.points.len())?);
                } else if count < 3 {
                    point[count] = number(word).ok_or_else(|| self.bad("a coordinate", word))?;
                    count += 1;
                }
            }
            if !continues(text) {
                break;
            }
            text = scanner.rest_of_line().unwrap_or_default();
        }
        if !self.is_vertex {
            return soup.polygon(corners, self.line);
        }
        if count < 3 {
            return Err(self.error(format!("a vertex with {count} of 3 coordinates")));
        }
        soup.points.push(point);
        Ok(())
    }

    /// The vertex of `a`, `a/b`, `a//c` or `a/b/c`; negative numbers count back from the vertex read last.
    fn corner(&self, word: &[u8], vertices: usize) -> Result<u32> {
        let first = word.split(|&b| b == b'/').next().unwrap_or_default();
        let index: i64 = number(first).ok_or_else(|| self.bad("a vertex number", word))?;
        let zero_based = match index {
            0 => None,
            1.. => Some(index - 1),
            _ => i64::try_from(vertices).ok().and_then(|n| n.checked_add(index)),
        };
        let vertex = zero_based.and_then(|i| u32::try_from(i).ok());
        vertex.ok_or_else(|| self.error(format!("there is no vertex {index}")))
    }

    fn error(&self, message: String) -> Error {
        Error::new(ErrorKind::Parse, message).at(Place::Line(self.line))
    }

    fn bad(&self, what: &str, word: &[u8]) -> Error {
        self.error(format!("expected {what}, found {}", quoted(word)))
    }
}

fn separates(byte: &u8) -> bool {
    byte.is_ascii_whitespace() || *byte == b'\\'
}

/// The words of a physical line, up to a comment.
fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let end = text.iter().position(|&b| b == b'#').unwrap_or(text.len());
    text[..end].split(separates).filter(|word| !word.is_empty())
}

fn continues(text: &[u8]) -> bool {
    text.trim_ascii_end().ends_with(b"\\") && !text.contains(&b'#')
}

/// Writes a surface, with texture coordinates of the corners of each cell if there are any.
pub(in crate::mesh::io) fn write(mesh: &Mesh, uv: &[[[f64; 2]; 4]]) -> Vec<u8> {
    let mut text = Text::default();
    for point in mesh.points() {
        text.put("v ").point(point).end();
    }
    let places = placed(mesh, uv, &mut text);
    for i in 0..mesh.cells().len() {
        text.put('f');
        match uv {
            [] => text.indices(mesh.cells().cell(i), 1).end(),
            _ => textured(&mut text, mesh.cells().cell(i), &places[4 * i..]),
        }
    }
    text.into_bytes()
}

/// Lists the texture coordinates, those that corners at one vertex have in common once, and gives the number of each
/// corner's: readers cut a mesh open where these differ.
fn placed(mesh: &Mesh, uv: &[[[f64; 2]; 4]], text: &mut Text) -> Vec<u64> {
    let corners = uv.iter().enumerate().flat_map(|(i, uv)| mesh.cells().cell(i).iter().zip(uv));
    let mut known = BTreeMap::new();
    let mut number = |(&vertex, &[u, v]): (&u32, &[f64; 2])| {
        let next = known.len() as u64 + 1;
        *known.entry((vertex, u.to_bits(), v.to_bits())).or_insert_with(|| {
            text.put("vt ").float(u).put(' ').float(v).end();
            next
        })
    };
    corners.map(&mut number).collect()
}

/// The corners of a face with the numbers of their texture coordinates.
fn textured(text: &mut Text, corners: &[u32], places: &[u64]) {
    for (&corner, &at) in corners.iter().zip(places) {
        text.put(' ').put(u64::from(corner) + 1).put('/').put(at);
    }
    text.end();
}
