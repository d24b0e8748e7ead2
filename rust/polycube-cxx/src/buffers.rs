//! Meshes, labels and files as flat buffers.

use crate::failure::{Result, guard};
use crate::ffi::{FieldData, MeshData, MeshView, PairData};
use crate::input::{kind, mesh};
use polycube::generate::Example;
use polycube::mesh::{self as core, CellField, CellKind, Cells, Face, Format, Mesh, Point};
use std::path::Path;

/// x, y, z of every point.
pub fn flat(points: &[Point]) -> Vec<f64> {
    points.iter().flat_map(|p| [p.x, p.y, p.z]).collect()
}

impl From<&Mesh> for MeshData {
    fn from(mesh: &Mesh) -> Self {
        let cells = match mesh.cells() {
            Cells::Triangles(c) => c.as_flattened().to_vec(),
            Cells::Quads(c) | Cells::Tetrahedra(c) => c.as_flattened().to_vec(),
            Cells::Hexahedra(c) => c.as_flattened().to_vec(),
        };
        Self { points: flat(mesh.points()), kind: mesh.cells().kind() as u8, cells }
    }
}

impl MeshData {
    /// No vertices and no cells.
    pub fn empty() -> Self {
        Self { points: Vec::new(), kind: 0, cells: Vec::new() }
    }
}

impl PairData {
    fn new(polycube: &Mesh, shape: &Mesh) -> Self {
        Self { polycube: polycube.into(), shape: shape.into() }
    }
}

/// See `polycube::mesh::read`.
pub fn read_mesh(path: &str) -> Result<MeshData> {
    guard(|| Ok((&core::read(Path::new(path))?).into()))
}

/// See `polycube::mesh::read_pair`.
pub fn read_pair(polycube: &str, shape: &str) -> Result<PairData> {
    guard(|| {
        let (polycube, shape) = core::read_pair(Path::new(polycube), Path::new(shape))?;
        Ok(PairData::new(&polycube, &shape))
    })
}

/// See `polycube::mesh::read_bytes`.
pub fn read_mesh_bytes(extension: &str, bytes: &[u8]) -> Result<MeshData> {
    guard(|| Ok((&core::read_bytes(extension.parse()?, bytes)?).into()))
}

/// See `polycube::mesh::write`.
pub fn write_mesh(path: &str, view: &MeshView, fields: Vec<FieldData>) -> Result<()> {
    guard(|| core::write(Path::new(path), &mesh(view)?, &named(fields)))
}

/// See `polycube::mesh::write_bytes`.
pub fn write_mesh_bytes(extension: &str, view: &MeshView, fields: Vec<FieldData>) -> Result<Vec<u8>> {
    guard(|| core::write_bytes(extension.parse::<Format>()?, &mesh(view)?, &named(fields)))
}

fn named(fields: Vec<FieldData>) -> Vec<CellField> {
    let field = |f: FieldData| match f.is_real {
        true => CellField::real(f.name, f.real),
        false => CellField::integer(f.name, f.integer),
    };
    fields.into_iter().map(field).collect()
}

/// See `polycube::mesh::read_labels`.
pub fn read_labels(path: &str, face_count: usize) -> Result<Vec<i8>> {
    guard(|| core::read_labels(Path::new(path), face_count))
}

/// See `polycube::mesh::write_labels`.
pub fn write_labels(path: &str, labels: &[i8]) -> Result<()> {
    guard(|| core::write_labels(Path::new(path), labels))
}

/// The boundary faces over the same points.
pub fn boundary(view: &MeshView) -> Result<MeshData> {
    guard(|| {
        let mesh = mesh(view)?;
        let faces = mesh.cells().boundary()?;
        let kind = match mesh.cells().kind() {
            CellKind::Triangles | CellKind::Tetrahedra => CellKind::Triangles,
            CellKind::Quads | CellKind::Hexahedra => CellKind::Quads,
        };
        let cells = faces.iter().flat_map(Face::vertices).copied().collect();
        Ok(MeshData { points: view.points.to_vec(), kind: kind as u8, cells })
    })
}

/// See `polycube::measure::scaled_jacobians`.
pub fn scaled_jacobians(view: &MeshView) -> Result<Vec<f64>> {
    guard(|| polycube::measure::scaled_jacobians(&mesh(view)?))
}

/// The names that [`example`] knows.
pub fn example_names() -> Vec<String> {
    Example::ALL.iter().map(Example::to_string).collect()
}

/// See `polycube::generate::example`.
pub fn example(name: &str, seed: u64, cells: u8) -> Result<PairData> {
    guard(|| {
        let (polycube, shape) = polycube::generate::example(name.parse()?, seed, kind(cells)?)?;
        Ok(PairData::new(&polycube, &shape))
    })
}
