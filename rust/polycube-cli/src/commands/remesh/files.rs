//! Which mesh of the result goes into which file.

use crate::failure::Result;
use crate::input::meshes::MeshFiles;
use crate::output::colour;
use polycube::mesh::{CellField, CellKind, Format, Mesh};
use polycube::remesh::Remeshed;
use polycube::{Error, ErrorKind};
use std::path::Path;

/// The formats of the files whose formats can be chosen.
pub struct Formats {
    /// That of the polycube, as it was read.
    pub polycube: Format,
    /// One more of the hexahedra or, where it cannot hold them, of the quadrilaterals.
    extra: Option<Format>,
}

impl Formats {
    /// The format of the file `polycube`, and `extra` if it can hold a result.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] when a format cannot hold what shall be in it.
    pub fn new(polycube: &Path, extra: Option<Format>, meshes: &MeshFiles) -> Result<Self> {
        let polycube = Format::from_path(polycube)?;
        if !polycube.holds(meshes.polycube.cells().kind()) {
            let kind = meshes.polycube.cells().kind();
            return Err(Error::new(ErrorKind::Option, format!("a .{polycube} file cannot hold {kind}")).into());
        }
        if extra == Some(Format::Stl) {
            return Err(Error::new(ErrorKind::Option, "a .stl file cannot hold quadrilaterals or hexahedra")
                .remedy("choose --format from obj, off, ply, mesh, vtk, vtu")
                .into());
        }
        Ok(Self { polycube, extra })
    }
}

/// The names of the meshes that may be written, and what their formats must be able to hold.
pub const MESHES: [(&str, &[CellKind]); 4] = [
    ("layout", &[CellKind::Quads, CellKind::Hexahedra]),
    ("quads", &[CellKind::Quads]),
    ("hexes", &[CellKind::Hexahedra]),
    ("polycube", &CellKind::ALL),
];

/// A mesh of the result on its way into a file.
pub struct File<'a> {
    /// Its name without extension.
    pub name: &'static str,
    /// Its format.
    pub format: Format,
    /// What is in it.
    pub mesh: &'a Mesh,
    /// What is told of each cell.
    pub fields: Vec<CellField>,
}

/// All meshes of a result, each in every format that it is written in.
pub fn files<'a>(result: &'a Remeshed, formats: &Formats) -> Vec<File<'a>> {
    let file = |name, format, mesh, fields| File { name, format, mesh, fields };
    let mut files = vec![
        file("layout", Format::Obj, &result.layout.patches, Vec::new()),
        file("quads", Format::Obj, &result.quads.mesh, Vec::new()),
    ];
    if let Some(mesh) = &result.simplified.polycube {
        files.push(file("polycube", formats.polycube, mesh, Vec::new()));
    }
    let extra = formats.extra.filter(|f| !matches!((f, &result.hexes), (Format::Obj, _)));
    let Some(hexes) = &result.hexes else {
        files.extend(extra.map(|f| file("quads", f, &result.quads.mesh, quad_fields(result, f))));
        return files;
    };
    let fields = hexes.fields();
    let blocks = result.layout.blocks.iter();
    files.extend(blocks.map(|blocks| file("layout", Format::Vtk, blocks, result.layout.block_fields())));
    files.push(file("hexes", Format::Medit, &hexes.mesh, Vec::new()));
    files.push(file("hexes", Format::Vtu, &hexes.mesh, fields.clone()));
    match extra {
        None | Some(Format::Medit | Format::Vtu) => {}
        Some(f) if f.holds(hexes.mesh.cells().kind()) => files.push(file("hexes", f, &hexes.mesh, fields)),
        Some(f) => files.push(file("quads", f, &result.quads.mesh, quad_fields(result, f))),
    }
    files
}

/// The fields of the quadrilaterals, and in PLY a colour for each patch.
fn quad_fields(result: &Remeshed, format: Format) -> Vec<CellField> {
    let mut fields = result.quads.fields();
    if format == Format::Ply {
        let colours: Vec<[u8; 3]> = result.quads.patch_id.iter().map(|&id| colour::bytes(colour::pastel(id))).collect();
        let channel = |c: usize| colours.iter().map(|colour| i32::from(colour[c])).collect();
        let names = ["red", "green", "blue"].into_iter().enumerate();
        fields.extend(names.map(|(c, name)| CellField::integer(name, channel(c))));
    }
    fields
}
