//! Files for solvers: hexahedra with their blocks and the groups of their outside. They are only written.

mod foam;
mod inp;
mod msh;
mod su2;

#[cfg(test)]
mod tests;

use super::file::{Staged, io_error, write_atomically};
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::GroupedHexes;
use std::path::Path;
use std::str::FromStr;
use std::{fmt, fs, io};

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

    /// The files that [`write_solver_bytes`] gives for `name`, with the folders that they lie in, separated by `/`.
    pub fn files(self, name: &str) -> Vec<String> {
        match self {
            Self::Foam => foam::FILES.map(|file| format!("{self}/{}/{file}", foam::FOLDER)).to_vec(),
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
pub fn write_solver_bytes(format: SolverFormat, name: &str, hexes: &GroupedHexes) -> Vec<(String, Vec<u8>)> {
    format.files(name).into_iter().zip(bytes(format, hexes)).collect()
}

/// The bytes of each file.
fn bytes(format: SolverFormat, hexes: &GroupedHexes) -> Vec<Vec<u8>> {
    match format {
        SolverFormat::Msh => vec![msh::write(hexes)],
        SolverFormat::Inp => vec![inp::write(hexes)],
        SolverFormat::Su2 => vec![su2::write(hexes)],
        SolverFormat::Foam => foam::write(hexes).to_vec(),
    }
}

/// Writes a mesh for the solver that the extension of `path` names, whole or not at all. `NAME.foam` is the folder of a
/// case, whose `constant/polyMesh` is written; what else is in it stays.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for another extension; [`ErrorKind::Io`] naming the file.
pub fn write_solver(path: &Path, hexes: &GroupedHexes) -> Result<()> {
    let format: SolverFormat = path.extension().unwrap_or_default().to_string_lossy().parse()?;
    let bytes = bytes(format, hexes);
    if format != SolverFormat::Foam {
        return bytes.iter().try_for_each(|bytes| write_atomically(path, bytes));
    }
    let is_new = !path.exists();
    let done = write_case(&path.join(foam::FOLDER), &bytes);
    if done.is_err() && is_new {
        // There may be nothing.
        let _ = fs::remove_dir_all(path);
    }
    done.map_err(|error| io_error("write", path, &error))
}

fn write_case(folder: &Path, bytes: &[Vec<u8>]) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let staged = bytes.iter().map(|bytes| Staged::new(folder, bytes)).collect::<io::Result<Vec<_>>>()?;
    foam::FILES.iter().zip(staged).try_for_each(|(name, file)| file.publish(&folder.join(name)))
}
