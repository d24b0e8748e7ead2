//! The data of points and cells in legacy VTK files.

use super::legacy_numbers::Numbers;
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
    pub(super) fn read(numbers: &mut Numbers, first: &[u8]) -> Result<Vec<Array>> {
        let mut data = Self::new();
        data.section(numbers, first)?;
        while let Some(keyword) = numbers.scanner.word() {
            data.section(numbers, keyword)?;
        }
        Ok(data.arrays)
    }

    fn section(&mut self, numbers: &mut Numbers, keyword: &[u8]) -> Result<()> {
        match keyword {
            b"CELL_DATA" | b"POINT_DATA" => {
                self.of_cells = keyword == b"CELL_DATA";
                self.count = numbers.scanner.count("the number of tuples")?;
                Ok(())
            }
            b"FIELD" => self.field(numbers),
            b"SCALARS" => self.scalars(numbers),
            b"VECTORS" | b"NORMALS" => self.tuples(numbers, 3),
            b"TENSORS" => self.tuples(numbers, 9),
            b"GLOBAL_IDS" | b"PEDIGREE_IDS" => self.tuples(numbers, 1),
            b"METADATA" => {
                numbers.skip_metadata();
                Ok(())
            }
            _ => Err(numbers.scanner.unexpected("data of points or cells", keyword)),
        }
    }

    /// Some named arrays, each with its own number of tuples.
    pub(super) fn field(&mut self, numbers: &mut Numbers) -> Result<()> {
        numbers.scanner.expect("the name of a field")?;
        for _ in 0..numbers.scanner.count("the number of arrays")? {
            let mut name = numbers.scanner.expect("the name of an array")?;
            while name == b"METADATA" {
                numbers.skip_metadata();
                name = numbers.scanner.expect("the name of an array")?;
            }
            let width = numbers.scanner.count("a number of components")?;
            let count = numbers.scanner.count("a number of tuples")?;
            let scalar = numbers.scalar()?;
            self.array(numbers, name, (width, count), scalar)?;
        }
        Ok(())
    }

    fn scalars(&mut self, numbers: &mut Numbers) -> Result<()> {
        let name = numbers.scanner.expect("the name of an array")?;
        let scalar = numbers.scalar()?;
        let width = match numbers.scanner.expect("LOOKUP_TABLE")? {
            b"LOOKUP_TABLE" => 1,
            word => {
                numbers.scanner.expect("LOOKUP_TABLE")?;
                crate::mesh::io::scan::number(word).ok_or_else(|| numbers.scanner.unexpected("LOOKUP_TABLE", word))?
            }
        };
        numbers.scanner.expect("the name of a table of colours")?;
        self.array(numbers, name, (width, self.count), scalar)
    }

    fn tuples(&mut self, numbers: &mut Numbers, width: usize) -> Result<()> {
        let name = numbers.scanner.expect("the name of an array")?;
        let scalar = numbers.scalar()?;
        self.array(numbers, name, (width, self.count), scalar)
    }

    fn array(
        &mut self,
        numbers: &mut Numbers,
        name: &[u8],
        (width, count): (usize, usize),
        scalar: Scalar,
    ) -> Result<()> {
        let all = numbers.read(count.saturating_mul(width), scalar)?;
        if self.of_cells && width == 1 {
            let is_integer = !matches!(scalar, Scalar::F32 | Scalar::F64);
            self.arrays.push((String::from_utf8_lossy(name).into_owned(), is_integer, all));
        }
        Ok(())
    }
}
