//! The file of `--guides`.

use super::meshes::read_text;
use crate::failure::{Failure, Result};
use polycube::align::{Guides, Symmetry};
use polycube::simplify::{Input, read_structure};
use polycube::structure::{Label, Tolerance};
use polycube::{Error, ErrorKind, Place};
use serde::Deserialize;
use std::path::Path;

/// Guides as they are written down: those of the library, and facets by their labels.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct GuidesFile {
    fixed: Vec<usize>,
    /// Labels, 0 to 5, all of whose facets are fixed.
    fixed_labels: Vec<i8>,
    together: Vec<Vec<usize>>,
    apart: Vec<[usize; 2]>,
    symmetry: Vec<Symmetry>,
}

/// What the help says about the file.
pub const NOTES: &str = "\
A file of guides, of which any part may be left out:
  {\"fixed\": [3, 7],
   \"fixed_labels\": [5],
   \"together\": [[0, 4, 9]],
   \"apart\": [[1, 2]],
   \"symmetry\": [{\"axis\": 0, \"at\": 2.5}]}
Facets 3 and 7 and all of label 5 (0 to 5 for +X -X +Y -Y +Z -Z) must not move, facets 0, 4 and 9
must lie in one plane, 1 and 2 must not, and the symmetry about the plane X = 2.5 is kept (axes 0 to
2 for X Y Z). `polycube inspect --facets` lists the numbers of the facets.";

/// Reads guides for `input`, which came from the file `of`.
pub fn read(file: &Path, of: &Path, input: &Input, tolerance: &Tolerance) -> Result<Guides> {
    let text = read_text(file, "JSON file of guides")?;
    let found: GuidesFile = serde_json::from_str(&text).map_err(|e| {
        let text = e.to_string();
        // The line is told as everywhere.
        let message = text.split(" at line ").next().unwrap_or_default();
        Error::new(ErrorKind::Parse, message)
            .in_file(file.display())
            .at(Place::Line(e.line()))
            .remedy("write it as the example that `polycube simplify --help` shows")
    })?;
    let mut guides =
        Guides { fixed: found.fixed, together: found.together, apart: found.apart, symmetry: found.symmetry };
    if found.fixed_labels.is_empty() {
        return Ok(guides);
    }
    let labels: Vec<Label> = found.fixed_labels.iter().map(|&l| label(file, l)).collect::<Result<_>>()?;
    let polycube = read_structure(input, tolerance).map_err(Failure::in_file(of))?;
    let facets = polycube.structure.facets.iter().enumerate();
    guides.fixed.extend(facets.filter(|(_, f)| labels.contains(&f.label)).map(|(i, _)| i));
    Ok(guides)
}

fn label(file: &Path, number: i8) -> Result<Label> {
    Label::new(number).ok_or_else(|| {
        Error::new(ErrorKind::Option, format!("there is no label {number}"))
            .in_file(file.display())
            .remedy("give numbers from 0 to 5, for +X -X +Y -Y +Z -Z")
            .into()
    })
}
