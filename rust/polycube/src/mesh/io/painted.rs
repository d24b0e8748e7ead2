//! Groups of faces in mesh files: materials, groups, references, physical groups, arrays of cells.

use super::file::read_file;
use super::polygon::triangles;
use super::soup::GroupKey;
use super::{Format, about, format_of, formats};
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::groups::plain_names;
use crate::mesh::{Cells, GroupedSurface, Groups, Mesh};
use std::collections::BTreeMap;
use std::path::Path;

/// The name of the group of all faces that are in none.
const NONE: &str = "other";

/// Reads the groups of the faces that a mesh file lists, those beside a volume, too: in OBJ by the names of materials,
/// or else groups or objects; in Gmsh's files by physical groups; in Abaqus' by the sets of elements; in MEDIT's by
/// references and in VTK's by an array of the cells (named `label` or the like, or the only one of integers), both as
/// `group_N`. Faces in no group are in `other`.
///
/// What else than letters, digits and underscores is in a name becomes an underscore; a name that does not begin with
/// a letter gets `group_` in front, and one that would be there twice a number at its end.
///
/// # Errors
/// Those of [`read`](super::read()); [`ErrorKind::Parse`] where no face is in a group.
pub fn read_grouped_surface(path: &Path) -> Result<GroupedSurface> {
    let (format, bytes) = (format_of(path)?, read_file(path)?);
    grouped_surface(format, &bytes).map_err(about(format, path, &bytes))
}

fn grouped_surface(format: Format, bytes: &[u8]) -> Result<GroupedSurface> {
    let held = formats::read_tagged(format, bytes)?;
    held.mesh()?;
    let keys: Vec<Option<GroupKey>> = held.groups_of_polygons().collect();
    if keys.iter().all(Option::is_none) {
        let message = format!("no face in this .{format} file is in a group");
        return Err(Error::new(ErrorKind::Parse, message).remedy(
            "name materials or groups in OBJ, physical groups in Gmsh's files, element sets in Abaqus'; give faces \
             references in MEDIT's, an array of integers of the cells in VTK's",
        ));
    }
    let mut of_key = BTreeMap::new();
    for &key in &keys {
        let next = of_key.len() as u32;
        of_key.entry(key).or_insert(next);
    }
    let mut names = vec![String::new(); of_key.len()];
    of_key.iter().for_each(|(key, &i)| names[i as usize] = name(*key));
    let (mut cells, mut of) = (Vec::new(), Vec::new());
    for (corners, key) in held.polygons().zip(&keys) {
        let cut = triangles(&held.points, corners);
        of.extend(std::iter::repeat_n(of_key[key], cut.len()));
        cells.extend(cut);
    }
    let mesh = Mesh::new(held.points.clone(), Cells::Triangles(cells))?;
    GroupedSurface::new(mesh, Groups::new(plain_names(names), of)?)
}

fn name(key: Option<GroupKey>) -> String {
    match key {
        Some(GroupKey::Name(name)) => name.to_owned(),
        Some(GroupKey::Number(number)) => format!("group_{number}").replace('-', "minus_"),
        None => NONE.to_owned(),
    }
}
