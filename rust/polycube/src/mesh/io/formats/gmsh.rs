//! Gmsh's `.msh`, versions 2.2 and 4.1, as text or binary. Points and lines are passed over.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::io::scalar::{Endian, Scalar};
use crate::mesh::io::scan::Scanner;
use crate::mesh::io::soup::Soup;
use crate::mesh::io::text::Text;
use crate::mesh::{CellKind, Mesh, Point};
use std::collections::HashMap;

/// Reads a mesh.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut file = File::new(bytes)?;
    while let Some(word) = file.scanner.word() {
        let name = word.strip_prefix(b"$").ok_or_else(|| file.scanner.unexpected("a section, as $Nodes", word))?;
        file.scanner.rest_of_line();
        match (name, file.version) {
            (b"PhysicalNames", _) => file.names()?,
            (b"Entities", _) => file.entities()?,
            (b"Nodes", Version::Two) => file.nodes_2()?,
            (b"Nodes", Version::Four) => file.nodes_4()?,
            (b"Elements", Version::Two) => file.elements_2()?,
            (b"Elements", Version::Four) => file.elements_4()?,
            _ => {}
        }
        file.scanner.past(&[b"$End", name].concat())?;
    }
    Ok(file.soup)
}

#[derive(Clone, Copy)]
enum Version {
    Two,
    Four,
}

/// A file and what was read of it.
struct File<'a> {
    scanner: Scanner<'a>,
    version: Version,
    /// The order of bytes of a binary file.
    binary: Option<Endian>,
    /// Which vertex a node is.
    vertices: HashMap<i64, u32>,
    /// The first physical group of the entities that are in any, by their dimensions and tags.
    groups: HashMap<(i64, i64), i64>,
    /// The physical groups of surfaces that have names, with their places in the soup.
    names: HashMap<i64, u32>,
    soup: Soup,
}

impl<'a> File<'a> {
    /// Reads the format.
    fn new(bytes: &'a [u8]) -> Result<Self> {
        let mut scanner = Scanner::new(bytes);
        let word = scanner.expect("$MeshFormat")?;
        if word != b"$MeshFormat" {
            return Err(scanner.unexpected("$MeshFormat", word));
        }
        let version = match scanner.expect("the version of the format")? {
            b"2.2" | b"2" => Version::Two,
            b"4.1" => Version::Four,
            other => {
                let message = format!("version {} of Gmsh's format", String::from_utf8_lossy(other));
                return Err(Error::new(ErrorKind::Unsupported, message).remedy("save it as version 4.1 or 2.2"));
            }
        };
        let is_binary = scanner.count("0 for text or 1 for binary")? == 1;
        scanner.rest_of_line();
        let one = if is_binary { scanner.take(4, "the number 1 that tells the order of bytes")? } else { &[] };
        let binary = is_binary.then(|| if one == 1_i32.to_be_bytes() { Endian::Big } else { Endian::Little });
        scanner.past(b"$EndMeshFormat")?;
        Ok(Self {
            scanner,
            version,
            binary,
            vertices: HashMap::new(),
            groups: HashMap::new(),
            names: HashMap::new(),
            soup: Soup::default(),
        })
    }

    fn number(&mut self, scalar: Scalar, endian: Endian, what: &str) -> Result<f64> {
        Ok(scalar.read(self.scanner.take(scalar.size(), what)?, endian))
    }

    /// An integer, of four bytes in a binary file.
    fn integer(&mut self, what: &str) -> Result<i64> {
        match self.binary {
            Some(endian) => Ok(self.number(Scalar::I32, endian, what)? as i64),
            None => self.scanner.integer(what),
        }
    }

    /// A size or the tag of a node or element, of eight bytes in a binary file.
    fn size(&mut self, what: &str) -> Result<i64> {
        match self.binary {
            Some(endian) => Ok(self.number(Scalar::I64, endian, what)? as i64),
            None => self.scanner.integer(what),
        }
    }

    fn real(&mut self) -> Result<f64> {
        let what = "a coordinate";
        match self.binary {
            Some(endian) => self.number(Scalar::F64, endian, what),
            None => self.scanner.float(what),
        }
    }

    fn point(&mut self) -> Result<Point> {
        Ok(Point::new(self.real()?, self.real()?, self.real()?))
    }

    /// Where it is, for an error.
    fn line(&self) -> usize {
        if self.binary.is_some() { 0 } else { self.scanner.line() }
    }

    fn node(&mut self, tag: i64, point: Point) -> Result<()> {
        let vertex = u32::try_from(self.soup.points.len()).unwrap_or(u32::MAX);
        if self.vertices.insert(tag, vertex).is_some() {
            return Err(self.scanner.error(format!("a second node {tag}")).remedy("number the nodes from 1 on"));
        }
        self.soup.points.push(point);
        Ok(())
    }

    fn names(&mut self) -> Result<()> {
        for _ in 0..self.scanner.count("the number of names")? {
            let dimension = self.scanner.integer("a dimension")?;
            let number = self.scanner.integer("a group")?;
            let name = self.scanner.rest_of_line().unwrap_or_default().trim_ascii();
            if dimension == 2 {
                let name = name.strip_prefix(b"\"").and_then(|name| name.strip_suffix(b"\"")).unwrap_or(name);
                self.names.insert(number, self.soup.group(name));
            }
        }
        Ok(())
    }

    fn entities(&mut self) -> Result<()> {
        let mut counts = [0; 4];
        for count in &mut counts {
            *count = self.size("the number of entities")?;
        }
        for (dimension, count) in (0..).zip(counts) {
            for _ in 0..count {
                self.entity(dimension)?;
            }
        }
        Ok(())
    }

    fn entity(&mut self, dimension: i64) -> Result<()> {
        let tag = self.integer("the tag of an entity")?;
        // A point, or the bounds of what is larger.
        for _ in 0..if dimension == 0 { 3 } else { 6 } {
            self.real()?;
        }
        for place in 0..self.size("the number of groups")? {
            let group = self.integer("a group")?;
            if place == 0 {
                self.groups.insert((dimension, tag), group);
            }
        }
        for _ in 0..if dimension == 0 { 0 } else { self.size("the number of entities around")? } {
            self.integer("an entity")?;
        }
        Ok(())
    }

    fn nodes_2(&mut self) -> Result<()> {
        let count = self.scanner.count("the number of nodes")?;
        self.scanner.rest_of_line();
        for _ in 0..count {
            let tag = self.integer("a node")?;
            let point = self.point()?;
            self.node(tag, point)?;
        }
        Ok(())
    }

    fn nodes_4(&mut self) -> Result<()> {
        let blocks = self.header()?;
        for _ in 0..blocks {
            let dimension = self.integer("a dimension")?;
            self.integer("the tag of an entity")?;
            let is_parametric = self.integer("whether coordinates have parameters")? != 0;
            let count = self.size("the number of nodes")?;
            let tags = (0..count).map(|_| self.size("a node")).collect::<Result<Vec<_>>>()?;
            for tag in tags {
                let point = self.point()?;
                self.node(tag, point)?;
                for _ in 0..if is_parametric { dimension } else { 0 } {
                    self.real()?;
                }
            }
        }
        Ok(())
    }

    /// The number of blocks of a section, past its other counts.
    fn header(&mut self) -> Result<i64> {
        let blocks = self.size("the number of blocks")?;
        for what in ["the number of all", "the least tag", "the largest tag"] {
            self.size(what)?;
        }
        Ok(blocks)
    }

    fn elements_2(&mut self) -> Result<()> {
        let count = self.scanner.count("the number of elements")?;
        self.scanner.rest_of_line();
        let mut read = 0;
        while read < count {
            // Text has the number of the element before its type, once for each.
            let (kind, alike, tags) = if self.binary.is_some() {
                let kind = self.integer("the type of an element")?;
                (kind, self.integer("the number of elements")?, self.integer("the number of tags")?)
            } else {
                self.integer("an element")?;
                (self.integer("the type of an element")?, 1, self.integer("the number of tags")?)
            };
            for _ in 0..alike.max(1) {
                if self.binary.is_some() {
                    self.integer("an element")?;
                }
                let mut group = None;
                for _ in 0..tags {
                    let tag = self.integer("a tag")?;
                    group = group.or(Some(tag));
                }
                self.element(kind, group, Self::integer)?;
                read += 1;
            }
        }
        Ok(())
    }

    fn elements_4(&mut self) -> Result<()> {
        let blocks = self.header()?;
        for _ in 0..blocks {
            let entity = (self.integer("a dimension")?, self.integer("the tag of an entity")?);
            let group = self.groups.get(&entity).copied().or(Some(entity.1));
            let kind = self.integer("the type of an element")?;
            let count = self.size("the number of elements")?;
            for _ in 0..count {
                self.size("an element")?;
                self.element(kind, group, Self::size)?;
            }
        }
        Ok(())
    }

    /// Reads the nodes of an element of the type `kind`, which is in a group, each a `number`.
    fn element(
        &mut self,
        kind: i64,
        group: Option<i64>,
        number: impl Fn(&mut Self, &str) -> Result<i64>,
    ) -> Result<()> {
        let mut corners = [0; 8];
        let corners = &mut corners[..nodes_of(kind)?];
        for corner in &mut *corners {
            let tag = number(self, "a node")?;
            let vertex = self.vertices.get(&tag).copied();
            *corner = vertex.ok_or_else(|| self.scanner.error(format!("there is no node {tag}")))?;
        }
        let line = self.line();
        match *corners {
            [_, _, _] => self.soup.polygon(corners, line)?,
            [_, _, _, _] if kind == QUADRANGLE => self.soup.polygon(corners, line)?,
            [a, b, c, d] => self.soup.tetrahedron([a, b, c, d], line),
            [a, b, c, d, e, f, g, h] => self.soup.hexahedron([a, b, c, d, e, f, g, h], line),
            _ => return Ok(()),
        }
        self.soup.tag(group);
        self.soup.put_in(group.and_then(|group| self.names.get(&group).copied()));
        Ok(())
    }
}

const QUADRANGLE: i64 = 3;

/// How many nodes an element has.
fn nodes_of(kind: i64) -> Result<usize> {
    match kind {
        15 => Ok(1),
        1 => Ok(2),
        2 => Ok(3),
        QUADRANGLE | 4 => Ok(4),
        5 => Ok(8),
        6 | 7 => {
            let name = if kind == 6 { "prisms" } else { "pyramids" };
            let error = Error::new(ErrorKind::Unsupported, format!("the file holds {name}"));
            Err(error.remedy("export tetrahedra only or hexahedra only"))
        }
        _ => {
            let message = format!("a quadratic or higher cell, Gmsh's type {kind}");
            Err(Error::new(ErrorKind::Unsupported, message)
                .remedy("export linear cells, without nodes on edges: Mesh.ElementOrder = 1"))
        }
    }
}

/// Gmsh's number of a kind of cell.
fn number_of(kind: CellKind) -> i64 {
    match kind {
        CellKind::Triangles => 2,
        CellKind::Quads => QUADRANGLE,
        CellKind::Tetrahedra => 4,
        CellKind::Hexahedra => 5,
    }
}

/// Writes version 2.2 as text, which every version of Gmsh and most others read.
pub(super) fn write(mesh: &Mesh) -> Vec<u8> {
    let mut text = Text::default();
    text.put("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n").put(mesh.points().len()).end();
    for (i, point) in (1..).zip(mesh.points()) {
        text.put(i as u64).put(' ').point(point).end();
    }
    text.put("$EndNodes\n$Elements\n").put(mesh.cells().len()).end();
    let kind = number_of(mesh.cells().kind());
    for i in 0..mesh.cells().len() {
        text.put(format_args!("{} {kind} 2 0 1", i + 1)).indices(mesh.cells().cell(i), 1).end();
    }
    text.put("$EndElements").end();
    text.into_bytes()
}
