//! The meshes and labels that a subcommand works on.

use crate::failure::{Failure, Result};
use polycube::mesh::{self, LabelOrder, Mesh};
use polycube::simplify::Input;
use polycube::{Error, ErrorKind};
use std::path::Path;

/// A file of labels and what its numbers stand for.
#[derive(Clone, Copy)]
pub struct LabelFile<'a> {
    pub file: &'a Path,
    pub order: Option<&'a LabelOrder>,
}

/// A polycube, with the shape and the labels that came with it.
pub struct MeshFiles {
    /// The polycube.
    pub polycube: Mesh,
    /// The shape, with the same cells.
    pub shape: Option<Mesh>,
    /// One label for each boundary face.
    pub labels: Option<Vec<i8>>,
}

impl MeshFiles {
    /// Reads the files.
    pub fn read(polycube: &Path, shape: Option<&Path>, labels: Option<LabelFile>) -> Result<Self> {
        let (mesh, shape) = read_meshes(polycube, shape).map_err(Failure::in_reading)?;
        mesh.cells().boundary().map_err(Failure::in_file(polycube))?;
        let labels = read_labels(labels, polycube, &mesh)?;
        Ok(Self { polycube: mesh, shape, labels })
    }

    /// What the library takes.
    pub fn input(&self) -> Input<'_> {
        Input { polycube: &self.polycube, shape: self.shape.as_ref(), labels: self.labels.as_deref() }
    }
}

/// Reads the polycube and, if there is one, the shape with the same connectivity.
pub fn read_meshes(polycube: &Path, shape: Option<&Path>) -> polycube::Result<(Mesh, Option<Mesh>)> {
    match shape {
        Some(shape) => mesh::read_pair(polycube, shape).map(|(polycube, shape)| (polycube, Some(shape))),
        None => Ok((mesh::read(polycube)?, None)),
    }
}

/// Reads one label for each boundary face of `mesh`, which came from the file `of`, if any are given.
pub fn read_labels(labels: Option<LabelFile>, of: &Path, mesh: &Mesh) -> Result<Option<Vec<i8>>> {
    let Some(LabelFile { file, order }) = labels else { return Ok(None) };
    Ok(Some(mesh::read_labels_of(mesh, Some(of), file, order)?))
}

/// The text of a file that is no mesh but, say, a "list".
pub fn read_text(file: &Path, what: &str) -> polycube::Result<String> {
    let failed = |message: String, remedy: String| Error::new(ErrorKind::Io, message).remedy(remedy);
    if file.is_dir() {
        return Err(failed(format!("{} is a folder", file.display()), format!("name a file: a {what}")));
    }
    std::fs::read_to_string(file)
        .map_err(|e| failed(format!("cannot read {}: {e}", file.display()), "check the path".to_owned()))
}
