//! The nodes and elements of Abaqus' and CalculiX' `.inp`; all else in it is passed over.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::io::scan::{number, number_in, quoted, without_mark};
use crate::mesh::io::soup::Soup;
use crate::mesh::io::text::Text;
use crate::mesh::{CellKind, Mesh, Point};
use std::collections::HashMap;

/// Reads a mesh of one part.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut file = File::default();
    for (i, line) in without_mark(bytes).split(|&b| b == b'\n').enumerate() {
        file.line(line.trim_ascii(), i + 1)?;
    }
    Ok(file.soup)
}

/// What the lines after a keyword are.
#[derive(Clone, Copy, Default)]
enum Section {
    Nodes,
    /// Of a kind, in a set.
    Elements(Kind, Option<Set>),
    #[default]
    Other,
}

/// A set of elements.
#[derive(Clone, Copy)]
struct Set {
    /// The number that its name has.
    number: Option<i64>,
    group: u32,
}

/// What is made of elements.
#[derive(Clone, Copy)]
enum Kind {
    /// A face of so many corners.
    Face(usize),
    Tetrahedron,
    Hexahedron,
    /// A point, a line or the like, which is passed over.
    Nothing,
}

#[derive(Default)]
struct File {
    section: Section,
    /// Whether the line before ended in a comma.
    continued: bool,
    /// The numbers of an element so far, that of the element first.
    numbers: Vec<i64>,
    /// Which vertex a node is.
    vertices: HashMap<i64, u32>,
    soup: Soup,
}

impl File {
    fn line(&mut self, line: &[u8], number: usize) -> Result<()> {
        if line.is_empty() || line.starts_with(b"**") {
            return Ok(());
        }
        let was_continued = std::mem::replace(&mut self.continued, line.ends_with(b","));
        let here = |error: Error| error.at(Place::Line(number));
        if line.starts_with(b"*") {
            self.section = section(&line.to_ascii_uppercase(), &mut self.soup).map_err(here)?;
            self.numbers.clear();
            return Ok(());
        }
        match self.section {
            Section::Nodes => self.node(line).map_err(here),
            Section::Elements(kind, set) => self.element((kind, set), line, number, was_continued).map_err(here),
            Section::Other => Ok(()),
        }
    }

    fn node(&mut self, line: &[u8]) -> Result<()> {
        let mut fields = fields(line);
        let tag = integer(fields.next().unwrap_or_default())?;
        let mut point = Point::origin();
        // What is left out is 0.
        for (x, field) in point.iter_mut().zip(fields.filter(|field| !field.is_empty())) {
            *x = number(field).ok_or_else(|| unexpected("a coordinate", field))?;
        }
        let vertex = u32::try_from(self.soup.points.len()).unwrap_or(u32::MAX);
        if self.vertices.insert(tag, vertex).is_some() {
            let message = format!("a second node {tag}");
            return Err(Error::new(ErrorKind::Parse, message).remedy("export one part, without instances"));
        }
        self.soup.points.push(point);
        Ok(())
    }

    /// Takes a line of an element, which may be one of several.
    fn element(&mut self, (kind, set): (Kind, Option<Set>), line: &[u8], at: usize, was_continued: bool) -> Result<()> {
        let corners = match kind {
            Kind::Nothing => return Ok(()),
            Kind::Face(n) => n,
            Kind::Tetrahedron => 4,
            Kind::Hexahedron => 8,
        };
        if !was_continued {
            self.numbers.clear();
        }
        for field in fields(line).filter(|field| !field.is_empty()) {
            self.numbers.push(integer(field)?);
        }
        if self.numbers.len() <= corners && self.continued {
            return Ok(());
        }
        let all = std::mem::take(&mut self.numbers);
        if all.len() != corners + 1 {
            let message = format!("an element of {} nodes where its type has {corners}", all.len().saturating_sub(1));
            return Err(Error::new(ErrorKind::Parse, message));
        }
        let vertex = |tag: &i64| self.vertices.get(tag).copied().ok_or_else(|| no_node(*tag));
        let vertices = all[1..].iter().map(vertex).collect::<Result<Vec<u32>>>()?;
        match (kind, &vertices[..]) {
            (Kind::Tetrahedron, &[a, b, c, d]) => self.soup.tetrahedron([a, b, c, d], at),
            (Kind::Hexahedron, &[a, b, c, d, e, f, g, h]) => self.soup.hexahedron([a, b, c, d, e, f, g, h], at),
            _ => self.soup.polygon(&vertices, at)?,
        }
        self.soup.tag(set.and_then(|set| set.number));
        self.soup.put_in(set.map(|set| set.group));
        Ok(())
    }
}

fn no_node(tag: i64) -> Error {
    Error::new(ErrorKind::Parse, format!("there is no node {tag}")).remedy("put the nodes before the elements")
}

fn fields(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|&b| b == b',').map(<[u8]>::trim_ascii)
}

fn integer(field: &[u8]) -> Result<i64> {
    number(field).ok_or_else(|| unexpected("a number of a node or element", field))
}

fn unexpected(what: &str, word: &[u8]) -> Error {
    Error::new(ErrorKind::Parse, format!("expected {what}, found {}", quoted(word)))
}

/// What follows a line with a keyword, in upper case.
fn section(line: &[u8], soup: &mut Soup) -> Result<Section> {
    let mut parts = fields(line);
    match parts.next().unwrap_or_default() {
        b"*NODE" => Ok(Section::Nodes),
        b"*ELEMENT" => {
            let all: Vec<&[u8]> = parts.collect();
            let name = parameter(&all, b"TYPE");
            let name = name.ok_or_else(|| Error::new(ErrorKind::Parse, "elements without a type"))?;
            let set = |name| Set { number: number_in(name), group: soup.group(name) };
            Ok(Section::Elements(kind(name)?, parameter(&all, b"ELSET").map(set)))
        }
        b"*INCLUDE" => Err(Error::new(ErrorKind::Unsupported, "the file includes another").remedy("put them into one")),
        _ => Ok(Section::Other),
    }
}

/// What follows the name of a parameter of a keyword.
fn parameter<'a>(all: &[&'a [u8]], name: &[u8]) -> Option<&'a [u8]> {
    all.iter().find_map(|part| {
        let at = part.iter().position(|&b| b == b'=')?;
        (part[..at].trim_ascii() == name).then(|| part[at + 1..].trim_ascii())
    })
}

/// What is made of elements of a type, as C3D8R.
fn kind(name: &[u8]) -> Result<Kind> {
    const SOLIDS: [&[u8]; 3] = [b"C3D", b"DC3D", b"AC3D"];
    const FACES: [&[u8]; 10] = [b"STRI", b"SFM3D", b"DS", b"S", b"M3D", b"R3D", b"CPS", b"CPE", b"DC2D", b"CAX"];
    let nodes = |prefixes: &[&[u8]]| prefixes.iter().find_map(|prefix| leading(name.strip_prefix(*prefix)?));
    match (nodes(&SOLIDS), nodes(&FACES)) {
        (Some(4), _) => Ok(Kind::Tetrahedron),
        (Some(8), _) => Ok(Kind::Hexahedron),
        (Some(5 | 6), _) => Err(unsupported(name, "a prism or pyramid", "export tetrahedra only or hexahedra only")),
        (Some(10..), _) | (_, Some(6..)) => {
            Err(unsupported(name, "quadratic", "export linear cells, without nodes on edges"))
        }
        (_, Some(n @ (3 | 4))) => Ok(Kind::Face(n)),
        _ => Ok(Kind::Nothing),
    }
}

fn unsupported(name: &[u8], what: &str, remedy: &str) -> Error {
    let message = format!("elements of type {}, {what}", String::from_utf8_lossy(name));
    Error::new(ErrorKind::Unsupported, message).remedy(remedy)
}

/// The number that a text begins with.
fn leading(text: &[u8]) -> Option<usize> {
    let digits = text.iter().take_while(|b| b.is_ascii_digit()).count();
    number(&text[..digits])
}

/// Writes the nodes and the elements, as shells or solids.
pub(super) fn write(mesh: &Mesh) -> Vec<u8> {
    let mut text = Text::default();
    text.put("*NODE").end();
    for (i, point) in (1..).zip(mesh.points()) {
        text.put(i as u64).put(", ").float(point.x).put(", ").float(point.y).put(", ").float(point.z).end();
    }
    let name = match mesh.cells().kind() {
        CellKind::Triangles => "S3",
        CellKind::Quads => "S4",
        CellKind::Tetrahedra => "C3D4",
        CellKind::Hexahedra => "C3D8",
    };
    text.put("*ELEMENT, TYPE=").put(name).end();
    for i in 0..mesh.cells().len() {
        text.put(i + 1);
        for &vertex in mesh.cells().cell(i) {
            text.put(", ").put(u64::from(vertex) + 1);
        }
        text.end();
    }
    text.into_bytes()
}
