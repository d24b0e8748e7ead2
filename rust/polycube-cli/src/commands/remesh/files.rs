//! Which mesh of the result goes into which file.

use crate::failure::Result;
use crate::input::meshes::MeshFiles;
use crate::options::format::{OutputFormat, solver_formats};
use crate::output::colour;
use polycube::mesh::{
    CellField, CellKind, Format, GroupedSurface, Mesh, SolverFormat, read_grouped_surface, write_bytes,
    write_solver_bytes, write_textured_bytes,
};
use polycube::remesh::Remeshed;
use polycube::{Error, ErrorKind};
use std::path::Path;

/// The formats of the files whose formats can be chosen.
pub struct Formats {
    /// That of the polycube, as it was read.
    pub polycube: Format,
    /// More of the hexahedra or, where one cannot hold them, of the quadrilaterals.
    extra: Vec<Format>,
    /// Those of the hexahedra for solvers.
    solvers: Vec<SolverFormat>,
    /// The groups that the boundary has in those that take any.
    groups: Option<GroupedSurface>,
}

impl Formats {
    /// The format of the file `polycube`, and those `asked` for if they can hold a result; of `surface` alone there
    /// are no hexahedra. Of a format asked for twice there is one.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] when a format cannot hold what shall be in it.
    pub fn new(polycube: &Path, asked: &[OutputFormat], surface: bool, meshes: &MeshFiles) -> Result<Self> {
        let polycube = Format::from_path(polycube)?;
        if !polycube.holds(meshes.polycube.cells().kind()) {
            let kind = meshes.polycube.cells().kind();
            return Err(Error::new(ErrorKind::Option, format!("a .{polycube} file cannot hold {kind}")).into());
        }
        let mut formats = Self { polycube, extra: Vec::new(), solvers: Vec::new(), groups: None };
        for (_, &format) in asked.iter().enumerate().filter(|&(i, format)| !asked[..i].contains(format)) {
            match format {
                OutputFormat::Mesh(Format::Stl) => return Err(no_stl().into()),
                OutputFormat::Mesh(format) => formats.extra.push(format),
                OutputFormat::Solver(solver) if surface => formats.extra.push(without_groups(solver)?),
                OutputFormat::Solver(solver) => formats.solvers.push(solver),
            }
        }
        Ok(formats)
    }

    /// The same with the groups of the faces in this file.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] when no format has groups; those of [`read_grouped_surface`].
    pub fn with_groups(mut self, file: Option<&Path>) -> Result<Self> {
        let Some(file) = file else { return Ok(self) };
        if !self.solvers.iter().any(|&format| has_groups(format)) {
            let remedy = "add --format msh, inp, su2 or foam, without --surface-only";
            return Err(Error::new(ErrorKind::Option, "--groups has no effect").remedy(remedy).into());
        }
        self.groups = Some(read_grouped_surface(file)?);
        Ok(self)
    }
}

/// Whether faces of the boundary may be in any groups: where blocks are told as such, each face of one is in a facet.
fn has_groups(format: SolverFormat) -> bool {
    !matches!(format, SolverFormat::Json | SolverFormat::Xyz | SolverFormat::BlockMesh)
}

fn no_stl() -> Error {
    Error::new(ErrorKind::Option, "a .stl file cannot hold quadrilaterals or hexahedra")
        .remedy(format!("choose --format from obj, off, ply, mesh, meshb, vtk, vtu, {}", solver_formats()))
}

/// The format of this name that surfaces are written in, without groups.
fn without_groups(format: SolverFormat) -> Result<Format> {
    format.extension().parse().map_err(|_: Error| no_surface(format).into())
}

fn no_surface(format: SolverFormat) -> Error {
    Error::new(ErrorKind::Option, format!("the format {format} is for hexahedra, and --surface-only makes none"))
        .remedy("leave out one of the two")
}

/// The name of the hexahedral mesh.
const HEXES: &str = "hexes";

/// The names of the meshes that may be written, and what their formats must be able to hold.
pub const MESHES: [(&str, &[CellKind]); 4] = [
    ("layout", &[CellKind::Quads, CellKind::Hexahedra]),
    ("quads", &[CellKind::Quads]),
    (HEXES, &[CellKind::Hexahedra]),
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
    /// Texture coordinates of each cell, or none.
    pub uv: Vec<[[f64; 2]; 4]>,
}

impl File<'_> {
    /// The bytes of the file.
    ///
    /// # Errors
    /// Those of [`write_bytes`].
    pub fn bytes(&self) -> polycube::Result<Vec<u8>> {
        match self.uv[..] {
            [] => write_bytes(self.format, self.mesh, &self.fields),
            _ => write_textured_bytes(self.mesh, &self.uv),
        }
    }
}

/// All meshes of a result, each in every format that it is written in; `quads.obj` with texture coordinates if asked
/// for.
pub fn files<'a>(result: &'a Remeshed, formats: &Formats, with_uv: bool) -> Vec<File<'a>> {
    let file = |name, format, mesh, fields| File { name, format, mesh, fields, uv: Vec::new() };
    let quads = file("quads", Format::Obj, &result.quads.mesh, Vec::new());
    let uv = if with_uv { result.quads.uv() } else { Vec::new() };
    let mut files = vec![file("layout", Format::Obj, &result.layout.patches, Vec::new()), File { uv, ..quads }];
    if let Some(mesh) = &result.simplified.polycube {
        files.push(file("polycube", formats.polycube, mesh, Vec::new()));
    }
    let written = if result.hexes.is_some() { &[Format::Obj, Format::Medit, Format::Vtu][..] } else { &[Format::Obj] };
    let extra = formats.extra.iter().copied().filter(|f| !written.contains(f));
    let Some(hexes) = &result.hexes else {
        files.extend(extra.map(|f| file("quads", f, &result.quads.mesh, quad_fields(result, f))));
        return files;
    };
    let fields = hexes.fields();
    let blocks = result.layout.blocks.iter();
    files.extend(blocks.map(|blocks| file("layout", Format::Vtk, blocks, result.layout.block_fields())));
    files.push(file(HEXES, Format::Medit, &hexes.mesh, Vec::new()));
    files.push(file(HEXES, Format::Vtu, &hexes.mesh, fields.clone()));
    files.extend(extra.map(|f| match f.holds(hexes.mesh.cells().kind()) {
        true => file(HEXES, f, &hexes.mesh, fields.clone()),
        false => file("quads", f, &result.quads.mesh, quad_fields(result, f)),
    }));
    files
}

/// The files for solvers with their names, which may begin with the names of folders.
///
/// # Errors
/// Those of [`Hexes::grouped`](polycube::remesh::Hexes::grouped) and [`write_solver_bytes`].
pub fn solver_files(result: &Remeshed, formats: &Formats) -> Result<Vec<(String, Vec<u8>)>> {
    let Some(hexes) = result.hexes.as_ref().filter(|_| !formats.solvers.is_empty()) else { return Ok(Vec::new()) };
    let facets = hexes.grouped()?;
    let carried = formats.groups.as_ref().map(|surface| hexes.grouped_by(surface)).transpose()?;
    let groups = |format| carried.as_ref().filter(|_| has_groups(format)).unwrap_or(&facets);
    let files = formats.solvers.iter().map(|&format| write_solver_bytes(format, HEXES, groups(format)));
    Ok(files.collect::<polycube::Result<Vec<_>>>()?.concat())
}

/// The names of all files for solvers that there may be.
pub fn all_solver_files() -> Vec<String> {
    SolverFormat::ALL.into_iter().flat_map(|format| format.files(HEXES)).collect()
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
