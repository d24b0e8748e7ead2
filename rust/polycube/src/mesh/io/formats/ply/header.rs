//! The header of a PLY file.

use crate::error::Result;
use crate::mesh::io::scalar::{Endian, Scalar};
use crate::mesh::io::scan::{Scanner, number, quoted};

/// How the numbers after the header are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Binary(Endian),
}

/// A number, or a list of numbers, of every item of an element.
pub(super) struct Property {
    name: Vec<u8>,
    /// The type of the length of a list.
    pub(super) length: Option<Scalar>,
    /// The type of the number, or of the numbers of the list.
    pub(super) scalar: Scalar,
}

/// A table of items.
pub(super) struct Element {
    pub(super) name: Vec<u8>,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// The property with one of `names`.
    pub(super) fn find(&self, names: &[&str]) -> Option<usize> {
        let wanted = |p: &Property| names.iter().any(|name| name.as_bytes() == p.name);
        self.properties.iter().position(wanted)
    }
}

/// Reads up to the first byte after the line `end_header`.
pub(super) fn header(scanner: &mut Scanner) -> Result<(Encoding, Vec<Element>)> {
    let mut elements: Vec<Element> = Vec::new();
    let mut encoding = None;
    let magic = scanner.rest_of_line().unwrap_or_default();
    if magic.trim_ascii() != b"ply" {
        return Err(scanner.unexpected("ply", magic));
    }
    loop {
        // The place of an error is this line, not the next.
        let at = scanner.clone();
        let line = scanner.rest_of_line().ok_or_else(|| at.truncated("end_header"))?;
        let words: Vec<_> = words(line).collect();
        match (words.as_slice(), elements.last_mut()) {
            ([], _) | ([b"comment" | b"obj_info", ..], _) => {}
            ([b"format", kind, _], _) => {
                let known = self::encoding(kind);
                encoding = Some(known.ok_or_else(|| at.unexpected("an encoding", kind))?);
            }
            ([b"element", name, count], _) => elements.push(Element {
                name: name.to_vec(),
                count: number(count).ok_or_else(|| at.unexpected("a count", count))?,
                properties: Vec::new(),
            }),
            ([b"property", rest @ ..], Some(element)) => {
                let property = property(rest);
                let property = property.ok_or_else(|| at.unexpected("a property", line));
                element.properties.push(property?);
            }
            ([b"end_header"], _) => {
                let encoding = encoding.ok_or_else(|| at.error("the header names no format"))?;
                return Ok((encoding, elements));
            }
            _ => return Err(at.error(format!("the header says {}", quoted(line)))),
        }
    }
}

fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

fn encoding(word: &[u8]) -> Option<Encoding> {
    match word {
        b"ascii" => Some(Encoding::Text),
        b"binary_little_endian" => Some(Encoding::Binary(Endian::Little)),
        b"binary_big_endian" => Some(Encoding::Binary(Endian::Big)),
        _ => None,
    }
}

fn property(words: &[&[u8]]) -> Option<Property> {
    let (length, kind, name) = match words {
        [b"list", length, kind, name] => (Some(scalar(length)?), kind, name),
        [kind, name] => (None, kind, name),
        _ => return None,
    };
    Some(Property { name: name.to_vec(), length, scalar: scalar(kind)? })
}

fn scalar(word: &[u8]) -> Option<Scalar> {
    Some(match word {
        b"char" | b"int8" => Scalar::I8,
        b"uchar" | b"uint8" => Scalar::U8,
        b"short" | b"int16" => Scalar::I16,
        b"ushort" | b"uint16" => Scalar::U16,
        b"int" | b"int32" => Scalar::I32,
        b"uint" | b"uint32" => Scalar::U32,
        b"float" | b"float32" => Scalar::F32,
        b"double" | b"float64" => Scalar::F64,
        _ => return None,
    })
}
