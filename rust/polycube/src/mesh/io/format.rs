//! The file formats.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::CellKind;
use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// A mesh file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// Wavefront `.obj`: triangles or quadrilaterals, as text.
    Obj,
    /// Geomview `.off`: triangles or quadrilaterals, as text.
    Off,
    /// Stanford `.ply`: triangles or quadrilaterals; text or binary read, binary little endian written.
    Ply,
    /// `.stl`: triangles in single precision, without connectivity; text or binary read, binary written.
    Stl,
    /// MEDIT `.mesh` as text: all cells.
    Medit,
    /// Legacy `.vtk`: all cells; text or binary read, text written.
    Vtk,
    /// XML `.vtu`: all cells; every encoding but LZ4 and LZMA read, inline base64 written.
    Vtu,
    /// XML `.vtp`: triangles or quadrilaterals, as `.vtu`.
    Vtp,
    /// Gmsh's `.msh`: all cells; versions 2.2 and 4.1, text or binary, read, 2.2 as text written.
    Msh,
    /// Abaqus' and CalculiX' `.inp`: all cells, as one part.
    Inp,
    /// Binary MEDIT `.meshb`: all cells; versions 1 to 4 read, 3 written.
    Meshb,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 11] = [
        Self::Obj,
        Self::Off,
        Self::Ply,
        Self::Stl,
        Self::Medit,
        Self::Meshb,
        Self::Vtk,
        Self::Vtu,
        Self::Vtp,
        Self::Msh,
        Self::Inp,
    ];

    /// The format that the extension of `path` stands for, in upper or lower case.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for no extension or an unknown one.
    pub fn from_path(path: &Path) -> Result<Self> {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        extension.parse().map_err(|mut error: Error| {
            error.message = format!("{}: {}", path.display(), error.message);
            error
        })
    }

    /// The file extension, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Off => "off",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Medit => "mesh",
            Self::Vtk => "vtk",
            Self::Vtu => "vtu",
            Self::Vtp => "vtp",
            Self::Msh => "msh",
            Self::Inp => "inp",
            Self::Meshb => "meshb",
        }
    }

    /// The kinds of cells that files of this format can hold.
    pub fn cells(self) -> &'static [CellKind] {
        match self {
            Self::Obj | Self::Off | Self::Ply | Self::Vtp => &[CellKind::Triangles, CellKind::Quads],
            Self::Stl => &[CellKind::Triangles],
            Self::Medit | Self::Meshb | Self::Vtk | Self::Vtu | Self::Msh | Self::Inp => &CellKind::ALL,
        }
    }

    /// Whether files of this format can hold cells of `kind`.
    pub fn holds(self, kind: CellKind) -> bool {
        self.cells().contains(&kind)
    }

    /// Refuses cells that files of this format cannot hold.
    pub(super) fn require(self, kind: CellKind) -> Result<()> {
        if self.holds(kind) {
            return Ok(());
        }
        let able = Self::ALL.iter().filter(|f| f.holds(kind));
        let names: Vec<_> = able.map(|f| format!(".{f}")).collect();
        let message = format!("a .{self} file cannot hold {kind}");
        Err(Error::new(ErrorKind::Unsupported, message).remedy(format!("write one of {}", names.join(", "))))
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.extension())
    }
}

impl FromStr for Format {
    type Err = Error;

    /// Reads an extension, in upper or lower case, with or without its dot.
    fn from_str(text: &str) -> Result<Self> {
        let name = text.strip_prefix('.').unwrap_or(text);
        let found = Self::ALL.iter().find(|f| f.extension().eq_ignore_ascii_case(name));
        found.copied().ok_or_else(|| unknown(name))
    }
}

fn unknown(name: &str) -> Error {
    let remedy = match name.to_ascii_lowercase().as_str() {
        "pvtu" | "vtm" => "export one unstructured grid as .vtu",
        _ => "use one of .obj, .off, .ply, .stl, .mesh, .meshb, .vtk, .vtu, .vtp, .msh, .inp",
    };
    let message = match name {
        "" => "no file extension tells the mesh format".to_owned(),
        _ => format!("\"{}\" is not a known mesh format", name.escape_debug()),
    };
    Error::new(ErrorKind::Unsupported, message).remedy(remedy)
}
