//! The data arrays of VTK's XML files.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::io::scalar::{Endian, Scalar};
use crate::mesh::io::scan::Scanner;
use base64::Engine;
use base64::prelude::BASE64_STANDARD as STANDARD;
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_zlib_with_limit};
use roxmltree::Node;

/// Numbers that compressed data may inflate to, for each byte of the file. Of regular grids, which are packed best,
/// there is one a byte.
const MOST_PER_BYTE: usize = 8;

/// What the data arrays of a file have in common.
pub(super) struct Arrays<'a> {
    endian: Endian,
    header: Scalar,
    compressed: bool,
    appended: Appended<'a>,
    /// Bytes of appended data that were read so far.
    used: usize,
    /// Numbers that compressed data may still inflate to.
    room: usize,
}

#[derive(Clone, Copy)]
struct Appended<'a> {
    base64: bool,
    data: &'a [u8],
}

impl<'a> Arrays<'a> {
    /// Reads the attributes of the root; `appended` starts with the tag of the appended data, or is empty.
    pub(super) fn new(root: &Node, appended: &'a [u8]) -> Result<Self> {
        let big = root.attribute("byte_order") == Some("BigEndian");
        let long = root.attribute("header_type") == Some("UInt64");
        let compressor = root.attribute("compressor");
        if !matches!(compressor, None | Some("" | "vtkZLibDataCompressor")) {
            let message = format!("data compressed by {}", compressor.unwrap_or_default());
            return Err(
                Error::new(ErrorKind::Unsupported, message).remedy("export it uncompressed or compressed by zlib")
            );
        }
        Ok(Self {
            endian: if big { Endian::Big } else { Endian::Little },
            header: if long { Scalar::U64 } else { Scalar::U32 },
            compressed: compressor.is_some_and(|name| !name.is_empty()),
            appended: appended_data(appended),
            used: 0,
            room: MOST_PER_BYTE.saturating_mul(root.document().input_text().len() + appended.len()),
        })
    }

    /// The numbers of a data array.
    pub(super) fn numbers(&mut self, array: &Node) -> Result<Vec<f64>> {
        self.decode(array).map_err(|error| error.at(line_of(array)))
    }

    fn decode(&mut self, array: &Node) -> Result<Vec<f64>> {
        let scalar = scalar(array.attribute("type").unwrap_or_default())?;
        let text = array.text().unwrap_or_default().as_bytes();
        let bytes = match array.attribute("format") {
            None | Some("ascii") => return ascii(text),
            Some("binary") => self.blocks(&mut Source::base64(text), scalar)?,
            Some("appended") => self.appended(array, scalar)?,
            Some(other) => return Err(bad(&format!("unknown format {other:?}"))),
        };
        Ok(scalar.read_all(&bytes, self.endian))
    }

    fn appended(&mut self, array: &Node, scalar: Scalar) -> Result<Vec<u8>> {
        let offset = array.attribute("offset").and_then(|o| o.trim().parse::<usize>().ok());
        let data = offset.and_then(|o| self.appended.data.get(o..));
        let data = data.ok_or_else(|| bad("the offset is outside the appended data"))?;
        let mut source = Source { base64: self.appended.base64, ..Source::base64(data) };
        let bytes = self.blocks(&mut source, scalar)?;
        // Arrays do not overlap; if they did, a small file could ask for any amount of memory.
        self.used = self.used.saturating_add(source.at);
        if self.used > self.appended.data.len() {
            return Err(bad("the appended arrays overlap"));
        }
        Ok(bytes)
    }

    fn blocks(&mut self, source: &mut Source, scalar: Scalar) -> Result<Vec<u8>> {
        if !self.compressed {
            let size = self.size(source)?;
            return source.take(size);
        }
        let (count, size, last) = (self.size(source)?, self.size(source)?, self.size(source)?);
        let mut packed = Vec::new();
        for _ in 0..count {
            packed.push(self.size(source)?);
        }
        let most = self.room.saturating_mul(scalar.size());
        let mut bytes = Vec::new();
        for (i, length) in packed.into_iter().enumerate() {
            let partial = i + 1 == count && last > 0;
            let expected = if partial { last } else { size };
            bytes.extend(inflate(&source.take(length)?, expected, most - bytes.len())?);
        }
        self.room -= bytes.len().div_ceil(scalar.size());
        Ok(bytes)
    }

    fn size(&self, source: &mut Source) -> Result<usize> {
        let bytes = source.take(self.header.size())?;
        let size = self.header.read(&bytes, self.endian);
        // Beyond the largest size no data follow anyway.
        Ok(size as usize)
    }
}

/// A block of `expected` bytes or less, which must not be more than `room`: a small file could ask for any amount of
/// memory.
fn inflate(block: &[u8], expected: usize, room: usize) -> Result<Vec<u8>> {
    decompress_to_vec_zlib_with_limit(block, expected.min(room)).map_err(|error| match error.status {
        TINFLStatus::HasMoreOutput if room < expected => {
            bad("the compressed data are larger than those of any mesh in a file of this size")
                .remedy("export it uncompressed")
        }
        _ => bad("the compressed data are damaged"),
    })
}

fn appended_data(bytes: &[u8]) -> Appended<'_> {
    let tag = bytes.iter().position(|&b| b == b'>').unwrap_or(bytes.len());
    let (tag, rest) = bytes.split_at(tag);
    let base64 = find(tag, b"base64").is_some();
    let start = rest.iter().position(|&b| b == b'_').map_or(rest.len(), |i| i + 1);
    let data = &rest[start..];
    Appended { base64, data }
}

fn scalar(name: &str) -> Result<Scalar> {
    Ok(match name {
        "Int8" => Scalar::I8,
        "UInt8" => Scalar::U8,
        "Int16" => Scalar::I16,
        "UInt16" => Scalar::U16,
        "Int32" => Scalar::I32,
        "UInt32" => Scalar::U32,
        "Int64" => Scalar::I64,
        "UInt64" => Scalar::U64,
        "Float32" => Scalar::F32,
        "Float64" => Scalar::F64,
        _ => return Err(bad(&format!("unknown type {name:?}"))),
    })
}

fn ascii(text: &[u8]) -> Result<Vec<f64>> {
    let mut scanner = Scanner::new(text);
    let mut numbers = Vec::with_capacity(scanner.capacity(usize::MAX, 4));
    while scanner.peek().is_some() {
        numbers.push(scanner.float("a number")?);
    }
    Ok(numbers)
}

fn bad(message: &str) -> Error {
    Error::new(ErrorKind::Parse, message)
}

/// Encoded data, decoded as far as asked for.
struct Source<'a> {
    base64: bool,
    data: &'a [u8],
    at: usize,
    /// Decoded bytes not yet taken.
    spare: Vec<u8>,
}

impl<'a> Source<'a> {
    fn base64(data: &'a [u8]) -> Self {
        Self { base64: true, data, at: 0, spare: Vec::new() }
    }

    fn take(&mut self, count: usize) -> Result<Vec<u8>> {
        let short = || bad("the data end early").remedy("the file is cut short: export it again");
        let left = self.data.len() - self.at + self.spare.len();
        if count > left {
            return Err(short());
        }
        if !self.base64 {
            let taken = self.data[self.at..self.at + count].to_vec();
            self.at += count;
            return Ok(taken);
        }
        let mut taken = std::mem::take(&mut self.spare);
        taken.reserve(count.saturating_sub(taken.len()) + 3);
        while taken.len() < count {
            self.quantum(&mut taken)?.ok_or_else(short)?;
        }
        self.spare = taken.split_off(count);
        Ok(taken)
    }

    /// Decodes four characters. Padding ends a part of the data, after which another may begin.
    fn quantum(&mut self, out: &mut Vec<u8>) -> Result<Option<()>> {
        let (mut characters, mut found) = ([0; 4], 0);
        while found < 4 {
            let Some(&byte) = self.data.get(self.at) else {
                return Ok(None);
            };
            self.at += 1;
            if !byte.is_ascii_whitespace() {
                characters[found] = byte;
                found += 1;
            }
        }
        let mut bytes = [0; 3];
        let decoded = STANDARD.decode_slice(characters, &mut bytes);
        let length = decoded.map_err(|e| bad(&format!("the data are not base64: {e}")))?;
        out.extend_from_slice(&bytes[..length]);
        Ok(Some(()))
    }
}

/// Where `needle` first occurs.
pub(super) fn find(bytes: &[u8], needle: &[u8]) -> Option<usize> {
    bytes.windows(needle.len()).position(|window| window == needle)
}

/// The line of a node.
pub(super) fn line_of(node: &Node) -> Place {
    Place::Line(node.document().text_pos_at(node.range().start).row as usize)
}
