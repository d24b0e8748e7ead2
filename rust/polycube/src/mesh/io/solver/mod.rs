//! Files for solvers: hexahedra with their blocks and the groups of their outside. They are only written.

mod foam;
mod inp;
mod msh;
mod su2;

#[cfg(test)]
mod tests;

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::GroupedHexes;
use std::fmt;
use std::str::FromStr;

/// A format that solvers read, with names for blocks and for the groups of the outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SolverFormat {
    /// Gmsh's `.msh`, version 4.1, as text: physical groups for blocks, patches and sides.
    Msh,
    /// `.inp` of Abaqus and CalculiX: C3D8 elements, an element set for each block, and for each patch and side a set
    /// of nodes and a surface. Coordinates have 13 digits, as CalculiX reads no more than 20 characters.
    Inp,
    /// SU2's native `.su2`: a marker for each side. It has no room for blocks and patches.
    Su2,
    /// OpenFOAM's `constant/polyMesh`, as text: a patch for each patch, in the group of its side, and a cell zone for
    /// each block.
    Foam,
}

impl SolverFormat {
    /// Every format.
    pub const ALL: [Self; 4] = [Self::Msh, Self::Inp, Self::Su2, Self::Foam];

    /// The file extension, without the dot; of OpenFOAM, which has none, the name of the folder.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Msh => "msh",
            Self::Inp => "inp",
            Self::Su2 => "su2",
            Self::Foam => "foam",
        }
    }

    /// The files that [`write_solver`] gives for `name`, with the folders that they lie in, separated by `/`.
    pub fn files(self, name: &str) -> Vec<String> {
        match self {
            Self::Foam => foam::FILES.map(|file| format!("{self}/constant/polyMesh/{file}")).to_vec(),
            _ => vec![format!("{name}.{self}")],
        }
    }
}

impl fmt::Display for SolverFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.extension())
    }
}

impl FromStr for SolverFormat {
    type Err = Error;

    /// Reads an extension, in upper or lower case, with or without its dot.
    fn from_str(text: &str) -> Result<Self> {
        let name = text.strip_prefix('.').unwrap_or(text);
        let found = Self::ALL.into_iter().find(|f| f.extension().eq_ignore_ascii_case(name));
        found.ok_or_else(|| {
            let message = format!("\"{}\" is not a format for solvers", name.escape_debug());
            Error::new(ErrorKind::Unsupported, message).remedy("use one of msh, inp, su2, foam")
        })
    }
}

/// The files of a mesh for a solver, each with its name: `NAME.EXT`, and of OpenFOAM those of a case in a folder
/// `foam`. The same mesh always gives the same bytes. O(n log n) for n hexahedra.
pub fn write_solver(format: SolverFormat, name: &str, hexes: &GroupedHexes) -> Vec<(String, Vec<u8>)> {
    let bytes = match format {
        SolverFormat::Msh => vec![msh::write(hexes)],
        SolverFormat::Inp => vec![inp::write(hexes)],
        SolverFormat::Su2 => vec![su2::write(hexes)],
        SolverFormat::Foam => foam::write(hexes).to_vec(),
    };
    format.files(name).into_iter().zip(bytes).collect()
}
