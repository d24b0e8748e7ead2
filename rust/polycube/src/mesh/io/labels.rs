//! Facet labels, one per face: -1 for none, 0..=5 for +x, -x, +y, -y, +z, -z.

use super::file::{read_file, write_atomically};
use super::scan::{number, quoted, without_mark};
use crate::error::{Error, ErrorKind, Place, Result};
use std::path::Path;

/// Reads one label per face from a text file of one integer in `-1..=5` per line.
///
/// # Errors
/// [`ErrorKind::Io`] when the file cannot be read, [`ErrorKind::Parse`] with the line when a line is not
/// a label, [`ErrorKind::Mismatch`] when there are not `face_count` of them.
pub fn read_labels(path: &Path, face_count: usize) -> Result<Vec<i8>> {
    parse_labels(&read_file(path)?, face_count).map_err(|e| e.in_file(path.display()))
}

/// Reads labels as [`read_labels`] does, from the bytes of the file.
///
/// # Errors
/// As [`read_labels`], but never [`ErrorKind::Io`].
pub fn parse_labels(bytes: &[u8], face_count: usize) -> Result<Vec<i8>> {
    let text = without_mark(bytes).trim_ascii_end();
    let mut labels = Vec::new();
    if !text.is_empty() {
        for (i, line) in text.split(|&b| b == b'\n').enumerate() {
            labels.push(label(line).map_err(|error| error.at(Place::Line(i + 1)))?);
        }
    }
    if labels.len() != face_count {
        let message = format!("{} labels for {face_count} faces", labels.len());
        return Err(
            Error::new(ErrorKind::Mismatch, message).remedy("give one label per face of the mesh, in its order")
        );
    }
    Ok(labels)
}

fn label(line: &[u8]) -> Result<i8> {
    let word = line.trim_ascii();
    let value = number(word).filter(|label| (-1..=5).contains(label));
    value.ok_or_else(|| {
        let message = format!("expected a label, found {}", quoted(word));
        Error::new(ErrorKind::Parse, message).remedy("write one integer from -1 to 5 per line")
    })
}

/// Writes one label per line, whole or not at all.
///
/// # Errors
/// [`ErrorKind::Option`] for a label outside `-1..=5`, [`ErrorKind::Io`] when the file cannot be written.
pub fn write_labels(path: &Path, labels: &[i8]) -> Result<()> {
    if let Some(i) = labels.iter().position(|label| !(-1..=5).contains(label)) {
        let message = format!("label {} of face {i} is not in -1..=5", labels[i]);
        return Err(Error::new(ErrorKind::Option, message));
    }
    let text: String = labels.iter().map(|label| format!("{label}\n")).collect();
    write_atomically(path, text.as_bytes())
}
