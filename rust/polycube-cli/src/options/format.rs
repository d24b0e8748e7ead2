//! Formats of mesh files, by their extensions.

use polycube::Error;
use polycube::mesh::Format;

/// A mesh file format by its extension.
pub fn format(text: &str) -> Result<Format, String> {
    text.parse().map_err(|e: Error| e.to_string())
}
