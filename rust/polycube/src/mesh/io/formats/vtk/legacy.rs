//! Legacy VTK files: unstructured grids and polygonal data, versions 2 to 5.1, text and binary.

use super::cells::{POLYGON, VtkCells, choose_tags, number_of, points};
use super::legacy_data::Data;
use super::legacy_numbers::Numbers;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::mesh::io::field::{CellField, FieldValues};
use crate::mesh::io::scalar::Scalar;
use crate::mesh::io::scan::{Scanner, number};
use crate::mesh::io::soup::Soup;
use crate::mesh::io::text::Text;

/// Reads a mesh; the data on points are ignored, and those on cells, unless it shall be `tagged` with them.
pub(in crate::mesh::io::formats) fn read(bytes: &[u8], tagged: bool) -> Result<Soup> {
    let mut reader = Reader::new(bytes)?;
    while let Some(keyword) = reader.numbers.scanner.word() {
        if matches!(keyword, b"CELL_DATA" | b"POINT_DATA") {
            if tagged {
                let mut tags = choose_tags(Data::read(&mut reader.numbers, keyword)?).unwrap_or_default();
                tags.drain(..reader.passed.min(tags.len()));
                reader.cells.tags = tags;
            }
            break;
        }
        reader.section(keyword)?;
    }
    reader.finish()
}

struct Reader<'a> {
    numbers: Numbers<'a>,
    /// Vertices and lines of polygonal data that were passed over.
    passed: usize,
    /// Version 5 lists the offsets of the cells; earlier ones the number of corners before each cell.
    offsets: bool,
    soup: Soup,
    cells: VtkCells,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self> {
        let mut scanner = Scanner::new(bytes);
        let first = scanner.rest_of_line().unwrap_or_default().trim_ascii();
        let version = first.strip_prefix(b"# vtk DataFile Version ");
        let version = version.and_then(|v| number::<f64>(v.trim_ascii()));
        let version = version.ok_or_else(|| scanner.unexpected("# vtk DataFile Version", first))?;
        // The title.
        scanner.rest_of_line();
        let encoding = scanner.expect("ASCII or BINARY")?;
        let binary = encoding == b"BINARY";
        if !binary && encoding != b"ASCII" {
            return Err(scanner.unexpected("ASCII or BINARY", encoding));
        }
        Ok(Self {
            numbers: Numbers::new(scanner, binary),
            passed: 0,
            offsets: version >= 5.0,
            soup: Soup::default(),
            cells: VtkCells { types: Vec::new(), ends: Vec::new(), corners: Vec::new(), tags: Vec::new() },
        })
    }

    fn section(&mut self, keyword: &[u8]) -> Result<()> {
        match keyword {
            b"DATASET" => self.dataset(),
            b"POINTS" => self.points(),
            b"CELLS" => self.cells(),
            b"CELL_TYPES" => {
                let count = self.numbers.scanner.count("the number of cells")?;
                self.cells.types = self.numbers.read(count, Scalar::I32)?;
                Ok(())
            }
            b"POLYGONS" => {
                self.cells()?;
                self.cells.types = vec![f64::from(POLYGON); self.cells.ends.len()];
                Ok(())
            }
            // Their cells are read and forgotten.
            b"VERTICES" | b"LINES" => self.list().map(|(ends, _)| self.passed += ends.len()),
            b"TRIANGLE_STRIPS" => Err(Error::new(ErrorKind::Unsupported, "the faces are triangle strips")
                .remedy("export the faces as polygons")),
            b"FIELD" => self.field(),
            b"METADATA" => {
                self.numbers.skip_metadata();
                Ok(())
            }
            _ => Err(self.numbers.scanner.unexpected("a section of a VTK file", keyword)),
        }
    }

    fn dataset(&mut self) -> Result<()> {
        let name = self.numbers.scanner.expect("the kind of data set")?;
        if matches!(name, b"UNSTRUCTURED_GRID" | b"POLYDATA") {
            return Ok(());
        }
        let message = format!("a data set of kind {}", crate::mesh::io::scan::quoted(name));
        Err(Error::new(ErrorKind::Unsupported, message).remedy("export an unstructured grid or polygonal data"))
    }

    fn points(&mut self) -> Result<()> {
        let count = self.numbers.scanner.count("the number of points")?;
        let scalar = self.numbers.scalar()?;
        let coordinates = self.numbers.read(count.saturating_mul(3), scalar)?;
        self.soup.points = points(&coordinates);
        Ok(())
    }

    fn cells(&mut self) -> Result<()> {
        (self.cells.ends, self.cells.corners) = self.list()?;
        Ok(())
    }

    /// Reads a list of cells: where the corners of each end, and the corners.
    fn list(&mut self) -> Result<(Vec<f64>, Vec<f64>)> {
        let count = self.numbers.scanner.count("the number of cells")?;
        let size = self.numbers.scanner.count("the size of the list of cells")?;
        if !self.offsets {
            let numbers = self.numbers.read(size, Scalar::I32)?;
            return self.split(count, &numbers);
        }
        let mut ends = self.named(b"OFFSETS", count)?;
        if !ends.is_empty() {
            ends.remove(0);
        }
        Ok((ends, self.named(b"CONNECTIVITY", size)?))
    }

    fn split(&self, count: usize, numbers: &[f64]) -> Result<(Vec<f64>, Vec<f64>)> {
        let mut ends = Vec::with_capacity(count.min(numbers.len()));
        let mut corners = Vec::with_capacity(numbers.len());
        let mut rest = numbers;
        while let Some((&length, tail)) = rest.split_first() {
            let cell = crate::mesh::io::scalar::whole(length).ok().and_then(|n| tail.split_at_checked(n as usize));
            let (cell, tail) =
                cell.ok_or_else(|| self.numbers.scanner.error(format!("cell {} has {length} corners", ends.len())))?;
            corners.extend_from_slice(cell);
            ends.push(corners.len() as f64);
            rest = tail;
        }
        if ends.len() != count {
            let message = format!("{} cells where {count} were announced", ends.len());
            return Err(self.numbers.scanner.error(message));
        }
        Ok((ends, corners))
    }

    fn named(&mut self, name: &[u8], count: usize) -> Result<Vec<f64>> {
        let what = String::from_utf8_lossy(name);
        let word = self.numbers.scanner.expect(&what)?;
        if word != name {
            return Err(self.numbers.scanner.unexpected(&what, word));
        }
        let scalar = self.numbers.scalar()?;
        self.numbers.read(count, scalar)
    }

    /// Skips a field.
    fn field(&mut self) -> Result<()> {
        Data::new().field(&mut self.numbers).map(|_| ())
    }

    fn finish(mut self) -> Result<Soup> {
        self.cells.add_to(&mut self.soup, 0)?;
        Ok(self.soup)
    }
}

/// Writes an unstructured grid as text, with the fields as scalars of the cells.
pub(in crate::mesh::io::formats) fn write(mesh: &Mesh, fields: &[CellField]) -> Vec<u8> {
    let mut text = Text::default();
    text.put("# vtk DataFile Version 3.0\npolycube\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS ");
    text.put(mesh.points().len()).put(" double").end();
    for point in mesh.points() {
        text.point(point).end();
    }
    let cells = mesh.cells().len();
    let width = mesh.cells().cell(0).len();
    text.put(format_args!("CELLS {cells} {}", cells * (width + 1))).end();
    for i in 0..cells {
        text.put(width).indices(mesh.cells().cell(i), 0).end();
    }
    text.put(format_args!("CELL_TYPES {cells}")).end();
    for _ in 0..cells {
        text.put(number_of(mesh.cells().kind())).end();
    }
    if !fields.is_empty() {
        text.put(format_args!("CELL_DATA {cells}")).end();
    }
    for field in fields {
        write_field(&mut text, field);
    }
    text.into_bytes()
}

fn write_field(text: &mut Text, field: &CellField) {
    let kind = match field.values {
        FieldValues::Real(_) => "double",
        FieldValues::Integer(_) => "int",
    };
    text.put(format_args!("SCALARS {} {kind} 1\nLOOKUP_TABLE default", field.name)).end();
    match &field.values {
        FieldValues::Real(values) => values.iter().for_each(|&x| text.float(x).end()),
        FieldValues::Integer(values) => values.iter().for_each(|x| text.put(x).end()),
    }
}
