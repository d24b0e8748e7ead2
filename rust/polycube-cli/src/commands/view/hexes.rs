//! A hexahedral mesh to show.

use crate::failure::{Failure, Result};
use polycube::measure::scaled_jacobian;
use polycube::mesh::{self, Cells, Point};
use polycube::{Error, ErrorKind};
use std::path::Path;

/// Hexahedra and their quality.
pub struct Hexes {
    /// The vertices.
    pub points: Vec<Point>,
    /// The hexahedra, in VTK's order.
    pub cells: Vec<[u32; 8]>,
    /// The scaled Jacobian of each.
    pub quality: Vec<f64>,
}

/// Reads a mesh of hexahedra.
pub fn read(file: &Path) -> Result<Hexes> {
    let (points, cells) = mesh::read(file).map_err(Failure::in_reading)?.into_parts();
    let kind = cells.kind();
    let Cells::Hexahedra(cells) = cells else {
        let error = Error::new(ErrorKind::Mesh, format!("this is a mesh of {kind}, not of hexahedra"));
        return Err(Failure::in_file(file)(error.remedy("give `--hexes` a mesh of hexahedra")));
    };
    let quality = cells.iter().map(|hex| scaled_jacobian(&points, hex)).collect();
    Ok(Hexes { points, cells, quality })
}
