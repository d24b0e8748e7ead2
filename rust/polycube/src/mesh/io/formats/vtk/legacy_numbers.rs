//! The numbers in legacy VTK files, as text or binary.

use crate::error::Result;
use crate::mesh::io::scalar::{Endian, Scalar};
use crate::mesh::io::scan::Scanner;

/// Reads numbers.
pub(super) struct Numbers<'a> {
    pub(super) scanner: Scanner<'a>,
    binary: bool,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(scanner: Scanner<'a>, binary: bool) -> Self {
        Self { scanner, binary }
    }

    /// Passes over lines up to an empty one.
    pub(super) fn skip_metadata(&mut self) {
        self.scanner.rest_of_line();
        while self.scanner.rest_of_line().is_some_and(|line| !line.trim_ascii().is_empty()) {}
    }

    /// Reads the name of a type.
    pub(super) fn scalar(&mut self) -> Result<Scalar> {
        let name = self.scanner.expect("the type of the numbers")?;
        Ok(match name.to_ascii_lowercase().as_slice() {
            b"char" | b"signed_char" | b"vtktypeint8" => Scalar::I8,
            b"unsigned_char" | b"vtktypeuint8" => Scalar::U8,
            b"short" | b"vtktypeint16" => Scalar::I16,
            b"unsigned_short" | b"vtktypeuint16" => Scalar::U16,
            b"int" | b"vtkidtype" | b"vtktypeint32" => Scalar::I32,
            b"unsigned_int" | b"vtktypeuint32" => Scalar::U32,
            b"long" | b"long_long" | b"vtktypeint64" => Scalar::I64,
            b"unsigned_long" | b"unsigned_long_long" | b"vtktypeuint64" => Scalar::U64,
            b"float" => Scalar::F32,
            b"double" => Scalar::F64,
            _ => return Err(self.scanner.unexpected("a type of numbers", name)),
        })
    }

    /// Reads so many numbers.
    pub(super) fn read(&mut self, count: usize, scalar: Scalar) -> Result<Vec<f64>> {
        if self.binary {
            self.scanner.rest_of_line();
            let bytes = self.scanner.take(count.saturating_mul(scalar.size()), "binary numbers")?;
            return Ok(scalar.read_all(bytes, Endian::Big));
        }
        let mut numbers = Vec::with_capacity(self.scanner.capacity(count, 2));
        for _ in 0..count {
            numbers.push(self.scanner.float("a number")?);
        }
        Ok(numbers)
    }
}
