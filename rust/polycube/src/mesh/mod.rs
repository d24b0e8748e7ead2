//! Meshes of triangles, quadrilaterals, tetrahedra or hexahedra, their files, and their boundary.
//!
//! Reading is safe on any input: a malformed file gives an [`Error`] that says where it is wrong,
//! and never a panic, an endless loop, or memory out of proportion to the size of the file.

mod blocks;
mod checked;
mod compact;
mod grouped_surface;
mod groups;
pub(crate) mod hexahedron;
mod io;
mod simplices;
mod stars;

pub use blocks::{BLOCK_FACES, Beyond, Block, Blocks, Neighbour};
pub use checked::Mesh;
pub use grouped_surface::GroupedSurface;
pub use groups::{GroupedHexes, Groups};
pub use hexahedron::HexFace;
pub use io::{
    CellField, FieldValues, Format, LabelOrder, SolverFormat, Staged, parse_labels, read, read_bytes,
    read_grouped_surface, read_labels, read_labels_of, read_pair, write, write_atomically, write_bytes, write_labels,
    write_solver, write_solver_bytes, write_textured_bytes,
};
pub use simplices::{Face, Simplices};
pub(crate) use stars::Stars;

use crate::error::{Error, ErrorKind};
use nalgebra::Point3;
use std::fmt;
use std::str::FromStr;

/// A point in space.
pub type Point = Point3<f64>;

/// The kinds of cells there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, bitcode::Encode, bitcode::Decode)]
pub enum CellKind {
    /// Surface of triangles.
    Triangles,
    /// Surface of quadrilaterals.
    Quads,
    /// Volume of tetrahedra.
    Tetrahedra,
    /// Volume of hexahedra.
    Hexahedra,
}

impl CellKind {
    /// Every kind.
    pub const ALL: [Self; 4] = [Self::Triangles, Self::Quads, Self::Tetrahedra, Self::Hexahedra];
}

impl fmt::Display for CellKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Triangles => "triangles",
            Self::Quads => "quadrilaterals",
            Self::Tetrahedra => "tetrahedra",
            Self::Hexahedra => "hexahedra",
        })
    }
}

impl FromStr for CellKind {
    type Err = Error;

    /// Reads what [`Display`](fmt::Display) writes, and the short names `quads`, `tets` and `hexes`.
    fn from_str(name: &str) -> crate::Result<Self> {
        match name {
            "triangles" => Ok(Self::Triangles),
            "quads" | "quadrilaterals" => Ok(Self::Quads),
            "tets" | "tetrahedra" => Ok(Self::Tetrahedra),
            "hexes" | "hexahedra" => Ok(Self::Hexahedra),
            _ => Err(Error::new(ErrorKind::Option, format!("there is no cell kind '{name}'"))
                .remedy("use triangles, quads, tets or hexes")),
        }
    }
}

/// The cells of a mesh, all of one kind. Indices count from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cells {
    /// Surface of triangles, counter-clockwise seen from outside.
    Triangles(Vec<[u32; 3]>),
    /// Surface of quadrilaterals, counter-clockwise seen from outside.
    Quads(Vec<[u32; 4]>),
    /// Volume of tetrahedra: the fourth vertex sees the first three counter-clockwise from their
    /// other side (VTK's order: positive `det(b - a, c - a, d - a)`).
    Tetrahedra(Vec<[u32; 4]>),
    /// Volume of hexahedra in VTK's order: bottom counter-clockwise seen from the top, then the top above it.
    Hexahedra(Vec<[u32; 8]>),
}

impl Cells {
    /// Number of cells.
    pub fn len(&self) -> usize {
        match self {
            Self::Triangles(c) => c.len(),
            Self::Quads(c) => c.len(),
            Self::Tetrahedra(c) => c.len(),
            Self::Hexahedra(c) => c.len(),
        }
    }

    /// The kind of the cells.
    pub fn kind(&self) -> CellKind {
        match self {
            Self::Triangles(_) => CellKind::Triangles,
            Self::Quads(_) => CellKind::Quads,
            Self::Tetrahedra(_) => CellKind::Tetrahedra,
            Self::Hexahedra(_) => CellKind::Hexahedra,
        }
    }

    /// Whether there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The vertices of cell `i`.
    ///
    /// # Panics
    /// When `i` is not below [`len`](Self::len).
    pub fn cell(&self, i: usize) -> &[u32] {
        match self {
            Self::Triangles(c) => &c[i],
            Self::Quads(c) => &c[i],
            Self::Tetrahedra(c) => &c[i],
            Self::Hexahedra(c) => &c[i],
        }
    }

    /// Whether the cells fill a volume.
    pub fn is_volume(&self) -> bool {
        matches!(self, Self::Tetrahedra(_) | Self::Hexahedra(_))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_cell_kinds_are_read_back() {
        for kind in CellKind::ALL {
            assert_eq!(kind.to_string().parse::<CellKind>(), Ok(kind));
        }
        assert_eq!("hexes".parse::<CellKind>(), Ok(CellKind::Hexahedra));
        assert_eq!("prism".parse::<CellKind>().unwrap_err().kind, ErrorKind::Option);
    }
}
