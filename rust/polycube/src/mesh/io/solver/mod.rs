//! Files for solvers: hexahedra with their blocks and the groups of their outside. They are only written.

mod block_mesh;
mod foam;
mod inp;
mod json;
mod msh;
mod plot3d;
mod su2;

#[cfg(test)]
mod tests;

use super::file::{Staged, io_error, write_atomically};
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Blocks, GroupedHexes};
use std::path::{Path, PathBuf};
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
    /// The block structure as JSON: `points`, and of each block its grid of vertices, what lies beyond its faces, and
    /// the classes of its edges; the guide has the schema.
    Json,
    /// Plot3D's grid of many blocks, as text: all points of each block. It has no room for names.
    Xyz,
    /// The `system/blockMeshDict` that OpenFOAM's blockMesh makes the blocks of: a patch for each patch, in the group
    /// of its side, and a cell zone for each block. The vertices of edges are in place, those of faces on the surfaces
    /// that are in `constant/triSurface`; what is between is interpolated.
    BlockMesh,
}

impl SolverFormat {
    /// Every format.
    pub const ALL: [Self; 7] = [Self::Msh, Self::Inp, Self::Su2, Self::Foam, Self::Json, Self::Xyz, Self::BlockMesh];

    /// The file extension, without the dot; of OpenFOAM's, which have none, the name of the folder.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Msh => "msh",
            Self::Inp => "inp",
            Self::Su2 => "su2",
            Self::Foam => "foam",
            Self::Json => "json",
            Self::Xyz => "xyz",
            Self::BlockMesh => "blockmesh",
        }
    }

    /// The files of a format that has a folder: where they are in it.
    fn within(self) -> &'static [&'static str] {
        match self {
            Self::Foam => &foam::FILES,
            Self::BlockMesh => &block_mesh::FILES,
            _ => &[],
        }
    }

    /// The files that [`write_solver_bytes`] gives for `name`, with the folders that they lie in, separated by `/`.
    pub fn files(self, name: &str) -> Vec<String> {
        match self {
            Self::Json => vec!["blocks.json".to_owned()],
            Self::Foam | Self::BlockMesh => self.within().iter().map(|file| format!("{self}/{file}")).collect(),
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
            Error::new(ErrorKind::Unsupported, message)
                .remedy(format!("use one of {}", Self::ALL.map(Self::extension).join(", ")))
        })
    }
}

/// The files of a mesh for a solver, each with its name: `NAME.EXT`, of JSON `blocks.json`, and of OpenFOAM those of a
/// case in a folder `foam` or `blockmesh`. The same mesh always gives the same bytes. O(n log n) for n hexahedra.
///
/// # Errors
/// Where the format has the block structure, those of [`Blocks::new`]; of blockMesh [`ErrorKind::Unsupported`], too,
/// where two edges or faces of blocks have the same corners.
pub fn write_solver_bytes(format: SolverFormat, name: &str, hexes: &GroupedHexes) -> Result<Vec<(String, Vec<u8>)>> {
    Ok(format.files(name).into_iter().zip(bytes(format, hexes)?).collect())
}

/// The bytes of each file.
fn bytes(format: SolverFormat, hexes: &GroupedHexes) -> Result<Vec<Vec<u8>>> {
    Ok(match format {
        SolverFormat::Msh => vec![msh::write(hexes)],
        SolverFormat::Inp => vec![inp::write(hexes)],
        SolverFormat::Su2 => vec![su2::write(hexes)],
        SolverFormat::Foam => foam::write(hexes).to_vec(),
        SolverFormat::Json => vec![json::write(hexes, &Blocks::new(hexes)?)?],
        SolverFormat::Xyz => vec![plot3d::write(hexes, &Blocks::new(hexes)?)],
        SolverFormat::BlockMesh => block_mesh::write(hexes, &Blocks::new(hexes)?)?.to_vec(),
    })
}

/// Writes a mesh for the solver that the extension of `path` names, whole or not at all. `NAME.foam` and
/// `NAME.blockmesh` are folders of cases, whose mesh, or `system/blockMeshDict` with its surfaces, is written; what
/// else is in them stays.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for another extension; those of [`write_solver_bytes`]; [`ErrorKind::Io`] naming the
/// file.
pub fn write_solver(path: &Path, hexes: &GroupedHexes) -> Result<()> {
    let format: SolverFormat = path.extension().unwrap_or_default().to_string_lossy().parse()?;
    let bytes = bytes(format, hexes)?;
    if format.within().is_empty() {
        return bytes.iter().try_for_each(|bytes| write_atomically(path, bytes));
    }
    let is_new = !path.exists();
    let done = write_case(path, format.within(), &bytes);
    if done.is_err() && is_new {
        // There may be nothing.
        let _ = fs::remove_dir_all(path);
    }
    done.map_err(|error| io_error("write", path, &error))
}

fn write_case(folder: &Path, files: &[&str], bytes: &[Vec<u8>]) -> io::Result<()> {
    let stage = |(name, bytes): (&&str, &Vec<u8>)| -> io::Result<(PathBuf, Staged)> {
        let path = folder.join(name);
        let within = path.parent().unwrap_or(folder);
        fs::create_dir_all(within)?;
        let staged = Staged::new(within, bytes)?;
        Ok((path, staged))
    };
    let staged = files.iter().zip(bytes).map(stage).collect::<io::Result<Vec<_>>>()?;
    staged.into_iter().try_for_each(|(path, file)| file.publish(&path))
}
