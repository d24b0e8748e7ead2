//! The data of points and cells in legacy VTK files.

use super::legacy::Reader;
use crate::error::Result;
use crate::mesh::io::scalar::Scalar;

/// An array: its name, whether it is of integers, and its numbers.
type Array = (String, bool, Vec<f64>);

/// Arrays of one number a cell, as they are read.
pub(super) struct Data {
    /// Whether what comes is about the cells.
    of_cells: bool,
    /// How many tuples an array has.
    count: usize,
    arrays: Vec<Array>,
}

impl Data {
    pub(super) fn new() -> Self {
        Self { of_cells: false, count: 0, arrays: Vec::new() }
    }

    /// Reads all data from the first keyword on; gives the arrays of one number for each cell.
    pub(super) fn read(reader: &mut Reader, first: &[u8]) -> Result<Vec<Array>> {
        let mut data = Self::new();
        data.section(reader, first)?;
        while let Some(keyword) = reader.scanner.word() {
            data.section(reader, keyword)?;
        }
        Ok(data.arrays)
    }

    fn section(&mut self, reader: &mut Reader, keyword: &[u8]) -> Result<()> {
        match keyword {
            b"CELL_DATA" | b"POINT_DATA" => {
                self.of_cells = keyword == b"CELL_DATA";
                self.count = reader.scanner.count("the number of tuples")?;
                Ok(())
            }
            b"FIELD" => self.field(reader),
            b"SCALARS" => self.scalars(reader),
            b"VECTORS" | b"NORMALS" => self.tuples(reader, 3),
            b"TENSORS" => self.tuples(reader, 9),
            b"GLOBAL_IDS" | b"PEDIGREE_IDS" => self.tuples(reader, 1),
            b"METADATA" => {
                reader.skip_metadata();
                Ok(())
            }
            _ => Err(reader.scanner.unexpected("data of points or cells", keyword)),
        }
    }

    /// Some named arrays, each with its own number of tuples.
    pub(super) fn field(&mut self, reader: &mut Reader) -> Result<()> {
        reader.scanner.expect("the name of a field")?;
        for _ in 0..reader.scanner.count("the number of arrays")? {
            let mut name = reader.scanner.expect("the name of an array")?;
            while name == b"METADATA" {
                reader.skip_metadata();
                name = reader.scanner.expect("the name of an array")?;
            }
            let width = reader.scanner.count("a number of components")?;
            let count = reader.scanner.count("a number of tuples")?;
            let scalar = reader.scalar()?;
            self.array(reader, name, (width, count), scalar)?;
        }
        Ok(())
    }

    fn scalars(&mut self, reader: &mut Reader) -> Result<()> {
        let name = reader.scanner.expect("the name of an array")?;
        let scalar = reader.scalar()?;
        let width = match reader.scanner.expect("LOOKUP_TABLE")? {
            b"LOOKUP_TABLE" => 1,
            word => {
                reader.scanner.expect("LOOKUP_TABLE")?;
                crate::mesh::io::scan::number(word).ok_or_else(|| reader.scanner.unexpected("LOOKUP_TABLE", word))?
            }
        };
        reader.scanner.expect("the name of a table of colours")?;
        self.array(reader, name, (width, self.count), scalar)
    }

    fn tuples(&mut self, reader: &mut Reader, width: usize) -> Result<()> {
        let name = reader.scanner.expect("the name of an array")?;
        let scalar = reader.scalar()?;
        self.array(reader, name, (width, self.count), scalar)
    }

    fn array(
        &mut self,
        reader: &mut Reader,
        name: &[u8],
        (width, count): (usize, usize),
        scalar: Scalar,
    ) -> Result<()> {
        let numbers = reader.numbers(count.saturating_mul(width), scalar)?;
        if self.of_cells && width == 1 {
            let is_integer = !matches!(scalar, Scalar::F32 | Scalar::F64);
            self.arrays.push((String::from_utf8_lossy(name).into_owned(), is_integer, numbers));
        }
        Ok(())
    }
}
