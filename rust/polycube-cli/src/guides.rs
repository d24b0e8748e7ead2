//! The file of `--guides`.

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

/// Reads guides for `input`, which came from the file `of`.
pub fn read(file: &Path, of: &Path, input: &Input, tolerance: &Tolerance) -> Result<Guides> {
    let text = std::fs::read_to_string(file).map_err(|e| {
        Error::new(ErrorKind::Io, format!("cannot read {}: {e}", file.display())).remedy("check the path")
    })?;
    let found: GuidesFile = serde_json::from_str(&text).map_err(|e| {
        Error::new(ErrorKind::Parse, format!("{}: {e}", file.display()))
            .at(Place::Line(e.line()))
            .remedy("write it as the example in README.md")
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
        Error::new(ErrorKind::Option, format!("{}: there is no label {number}", file.display()))
            .remedy("give numbers from 0 to 5, for +X -X +Y -Y +Z -Z")
            .into()
    })
}
