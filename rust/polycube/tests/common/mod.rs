//! What the integration tests share.
#![allow(dead_code, reason = "every test file uses a part of it")]

pub mod data;
pub mod dense;
pub mod hexes;
pub mod models;

use polycube::generate::Voxels;
use polycube::mesh::{CellKind, Mesh};
use polycube::structure::{Polycube, Tolerance};
use polycube::{Context, Input, Simplified, SimplifyOptions};

/// The mesh of the voxels with the fewest cells.
pub fn coarse(voxels: &Voxels, kind: CellKind) -> Mesh {
    voxels.mesh(kind, 1e9).expect("solid voxels have a mesh")
}

/// The structure of a mesh that is a polycube.
pub fn read(mesh: &Mesh) -> Polycube {
    Polycube::new(mesh, None, &Tolerance::default()).expect("the mesh is a polycube")
}

/// The label of every boundary face, as a label file has it.
pub fn labels(polycube: &Polycube) -> Vec<i8> {
    polycube.labels().map(|l| l.index() as i8).collect()
}

/// Simplifies a polycube without a shape; its labels come from its normals.
pub fn simplify(mesh: &Mesh, options: &SimplifyOptions) -> polycube::Result<Simplified> {
    let input = Input { polycube: mesh, shape: None, labels: None };
    polycube::simplify::simplify(&input, options, &Context::default())
}

/// The bits of every coordinate.
pub fn bits(mesh: &Mesh) -> Vec<[u64; 3]> {
    mesh.points().iter().map(|p| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()]).collect()
}

/// How many cases a property is tried on: `few` scaled by `POLYCUBE_CASES` percent.
pub fn cases(few: u64) -> u64 {
    let percent = std::env::var("POLYCUBE_CASES").ok().and_then(|x| x.parse().ok()).unwrap_or(100);
    (few * percent / 100).max(1)
}

/// Algorithm 1 with its defaults.
pub fn paper() -> SimplifyOptions {
    SimplifyOptions { strategy: polycube::align::Strategy::Paper, ..SimplifyOptions::default() }
}
