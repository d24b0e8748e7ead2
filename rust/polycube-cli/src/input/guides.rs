//! The file of `--guides`.

use super::meshes::read_text;
use crate::failure::Result;
use polycube::align::Guides;
use polycube::{Error, ErrorKind, Place};
use std::path::Path;

/// What the help says about the file.
pub const NOTES: &str = "\
A file of guides, of which any part may be left out:
  {\"fixed\": [3, 7],
   \"fixed_faces\": [120],
   \"fixed_labels\": [5],
   \"together\": [[0, 4, 9]],
   \"apart\": [[1, 2]],
   \"symmetry\": [{\"axis\": 0, \"at\": 2.5}]}
Facets 3 and 7, that of the boundary face 120 and all of label 5 (0 to 5 for +X -X +Y -Y +Z -Z) must
not move, facets 0, 4 and 9 must lie in one plane, 1 and 2 must not, and the symmetry about the plane
X = 2.5 is kept (axes 0 to 2 for X Y Z). `polycube inspect --facets` lists the numbers of the facets.";

/// Reads a file of guides.
pub fn read(file: &Path) -> Result<Guides> {
    let text = read_text(file, "JSON file of guides")?;
    serde_json::from_str(&text).map_err(|e| {
        let text = e.to_string();
        // The line is told as everywhere.
        let message = text.split(" at line ").next().unwrap_or_default();
        Error::new(ErrorKind::Parse, message)
            .in_file(file.display())
            .at(Place::Line(e.line()))
            .remedy("write it as the example that `polycube simplify --help` shows")
            .into()
    })
}
