//! Files of labels: 0 to 5 for +X −X +Y −Y +Z −Z, −1 for none.

use super::file::{read_file, write_atomically};
use super::label_order::LabelOrder;
use super::scan::{number, quoted, without_mark};
use super::soup::Soup;
use super::{Format, format_of, formats};
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::{Cells, Face, Mesh};
use std::collections::HashMap;
use std::path::Path;

/// Reads one label per face from a text file of one integer in `-1..=5` per line, or from a mesh file whose faces have
/// such numbers: references in MEDIT's, cell data in VTK's (an array named `label` or the like, or the only one of
/// integers), physical groups in Gmsh's; in OBJ and Abaqus' materials, groups or element sets whose names end with the
/// number or are those of a direction (`plus_x`, `-Y`).
///
/// # Errors
/// [`ErrorKind::Io`] when the file cannot be read, [`ErrorKind::Parse`] with the line when a line is not
/// a label, [`ErrorKind::Mismatch`] when there are not `face_count` of them.
pub fn read_labels(path: &Path, face_count: usize) -> Result<Vec<i8>> {
    let labels = read_numbers(path, 5).and_then(|labels| counted(labels, face_count));
    labels.map_err(|e| e.in_file(path.display()))
}

/// Reads labels as [`read_labels`] does, from the bytes of the file.
///
/// # Errors
/// As [`read_labels`], but never [`ErrorKind::Io`].
pub fn parse_labels(bytes: &[u8], face_count: usize) -> Result<Vec<i8>> {
    counted(numbers(bytes, 5)?, face_count)
}

fn counted(labels: Vec<i8>, face_count: usize) -> Result<Vec<i8>> {
    if labels.len() != face_count {
        let message = format!("{} labels for {face_count} faces", labels.len());
        return Err(
            Error::new(ErrorKind::Mismatch, message).remedy("give one label per face of the mesh, in its order")
        );
    }
    Ok(labels)
}

/// Reads the label of each boundary face of `mesh` from a file as [`read_labels`] takes it, which has as many as one of
/// these, in its order; a mesh file has those of the faces that it lists:
/// - one for each boundary face ([`Cells::boundary`]): the faces of a surface in the order of the file, those of a
///   volume cell by cell and in VTK's order of the faces of a cell;
/// - one for each face of `source`, the file that the mesh was read from, before its polygons were cut into triangles;
///   or, for a volume, for each face that the file lists beside its cells;
/// - four for each tetrahedron, of the faces opposite to its corners 0, 1, 2 and 3, with −1 for those inside.
///
/// What number stands for which direction `order` tells; without one, numbers are returned as they are, up to 6, for a
/// check to tell which order they are in. A boundary face that `source` does not list has the label −1.
///
/// # Errors
/// Those of [`read_labels`] and of reading `source`; [`ErrorKind::Option`] for a number that `order` does not have.
pub fn read_labels_of(mesh: &Mesh, source: Option<&Path>, path: &Path, order: Option<&LabelOrder>) -> Result<Vec<i8>> {
    let here = |error: Error| error.in_file(path.display());
    let (bytes, largest) = (read_file(path)?, order.map_or(6, |_| i8::MAX));
    let numbers = match Format::from_path(path) {
        Ok(format) => of_mesh_file(mesh, format, &bytes, largest),
        Err(_) => numbers(&bytes, largest).and_then(|numbers| for_faces(mesh, source, numbers)),
    };
    let numbers = numbers.map_err(here)?;
    order.map_or(Ok(numbers.clone()), |order| order.apply(&numbers)).map_err(here)
}

/// The numbers of the boundary faces, from those of whatever they were given for. A volume whose file lists as many
/// faces as there are outside may mean either: the order in which each number looks more to one side is taken.
fn for_faces(mesh: &Mesh, source: Option<&Path>, numbers: Vec<i8>) -> Result<Vec<i8>> {
    let (count, boundary) = (numbers.len(), mesh.cells().boundary()?);
    let faces = boundary.len();
    if count == faces && !mesh.cells().is_volume() {
        return Ok(numbers);
    }
    let mut layouts = vec![format!("{faces} boundary faces")];
    if let Cells::Tetrahedra(cells) = mesh.cells() {
        if count == 4 * cells.len() {
            let corners =
                cells.iter().flat_map(|t| [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]].map(|f| f.map(|k| t[k])));
            return Ok(by_corners(&boundary, corners.zip(numbers)));
        }
        layouts.push(format!("{} faces of {} tetrahedra", 4 * cells.len(), cells.len()));
    }
    if let Some(held) = source.map(listed).transpose()? {
        let polygons = held.polygons().count();
        if count == polygons {
            let found = of_polygons(mesh, &held, &boundary, &numbers);
            let rather =
                |ours: &[i8], theirs: &[i8]| agreement(mesh, &boundary, ours) >= agreement(mesh, &boundary, theirs);
            return Ok(if count == faces && rather(&numbers, &found) { numbers } else { found });
        }
        if polygons != faces && polygons > 0 {
            layouts.push(format!("{polygons} faces in the file"));
        }
    }
    if count == faces {
        return Ok(numbers);
    }
    let message = format!("{count} labels for a mesh of {}", layouts.join(" or "));
    Err(Error::new(ErrorKind::Mismatch, message).remedy("give one label per face, in the order of the mesh or file"))
}

/// How far the faces of each number look to one side, whichever that is.
fn agreement(mesh: &Mesh, boundary: &[Face], numbers: &[i8]) -> f64 {
    let mut sums = [nalgebra::Vector3::<f64>::zeros(); 7];
    let at = |v: u32| mesh.points()[v as usize];
    for (face, number) in boundary.iter().zip(numbers) {
        let area: nalgebra::Vector3<f64> =
            face.triangles().map(|[a, b, c]| (at(b) - at(a)).cross(&(at(c) - at(a)))).sum();
        if let Some(sum) = usize::try_from(*number).ok().and_then(|n| sums.get_mut(n)) {
            *sum += area;
        }
    }
    sums.iter().map(nalgebra::Vector3::norm).sum()
}

fn listed(source: &Path) -> Result<Soup> {
    let held = formats::read(format_of(source)?, &read_file(source)?);
    held.map_err(|error| error.in_file(source.display()))
}

/// The numbers of the boundary faces, from those of the faces that the file lists.
fn of_polygons(mesh: &Mesh, held: &Soup, boundary: &[Face], numbers: &[i8]) -> Vec<i8> {
    let listed = held.polygons().zip(numbers.iter().copied());
    if mesh.cells().is_volume() {
        return by_corners(boundary, listed);
    }
    // A surface of quadrilaterals has as many as the file: these are polygons that were cut.
    listed.flat_map(|(corners, number)| std::iter::repeat_n(number, corners.len() - 2)).collect()
}

/// The numbers of the boundary faces, from those of faces with these corners, which may be inside.
fn by_corners(boundary: &[Face], known: impl Iterator<Item = (impl AsRef<[u32]>, i8)>) -> Vec<i8> {
    let key = |corners: &[u32]| {
        let mut key = [u32::MAX; 4];
        key.iter_mut().zip(corners).for_each(|(k, &v)| *k = v);
        key.sort_unstable();
        key
    };
    let known: HashMap<[u32; 4], i8> = known.map(|(corners, number)| (key(corners.as_ref()), number)).collect();
    let number = |face: &Face| known.get(&key(face.vertices())).copied().unwrap_or(-1);
    boundary.iter().map(number).collect()
}

/// The numbers, from −1 to `largest`, in a text or of the faces in a mesh file.
fn read_numbers(path: &Path, largest: i8) -> Result<Vec<i8>> {
    let bytes = read_file(path)?;
    match Format::from_path(path) {
        Ok(format) => tags(format, &formats::read_tagged(format, &bytes)?, largest),
        Err(_) => numbers(&bytes, largest),
    }
}

/// The numbers of the boundary faces, from those of the faces that a mesh file lists.
fn of_mesh_file(mesh: &Mesh, format: Format, bytes: &[u8], largest: i8) -> Result<Vec<i8>> {
    let held = formats::read_tagged(format, bytes)?;
    let (numbers, boundary) = (tags(format, &held, largest)?, mesh.cells().boundary()?);
    if numbers.len() == boundary.len() && !mesh.cells().is_volume() {
        return Ok(numbers);
    }
    let found = of_polygons(mesh, &held, &boundary, &numbers);
    if found.len() == boundary.len() {
        return Ok(found);
    }
    let message = format!("the labels are those of {} faces, and the mesh has {}", found.len(), boundary.len());
    Err(Error::new(ErrorKind::Mismatch, message).remedy("name a file with the same faces as the mesh"))
}

/// The numbers of the faces that a mesh file lists.
fn tags(format: Format, held: &Soup, largest: i8) -> Result<Vec<i8>> {
    let tags: Vec<Option<i64>> = held.tags_of_polygons().collect();
    if tags.iter().all(Option::is_none) {
        let message = format!("the faces in this .{format} file have no numbers");
        return Err(Error::new(ErrorKind::Parse, message).remedy(
            "give a text file of one label a line; or references in MEDIT's files, an array `label` of the cells in \
             VTK's, physical groups in Gmsh's, materials or groups with names as `label_3` or `plus_x` in OBJ",
        ));
    }
    let label = |(face, tag): (u32, Option<i64>)| {
        let label = i8::try_from(tag.unwrap_or(-1)).ok().filter(|label| (-1..=largest).contains(label));
        label.ok_or_else(|| {
            let message = format!("{} is no label", tag.unwrap_or_default());
            Error::new(ErrorKind::Parse, message).at(Place::Face(face)).remedy("number the faces from -1 to 5")
        })
    };
    (0..).zip(tags).map(label).collect()
}

/// One number from −1 to `largest` a line.
fn numbers(bytes: &[u8], largest: i8) -> Result<Vec<i8>> {
    let text = without_mark(bytes).trim_ascii_end();
    if text.is_empty() {
        return Ok(Vec::new());
    }
    let line = |(i, line): (usize, &[u8])| label(line, largest).map_err(|error| error.at(Place::Line(i + 1)));
    text.split(|&b| b == b'\n').enumerate().map(line).collect()
}

fn label(line: &[u8], largest: i8) -> Result<i8> {
    let word = line.trim_ascii();
    let value = number(word).filter(|label| (-1..=largest).contains(label));
    value.ok_or_else(|| {
        let message = format!("expected a label, found {}", quoted(word));
        Error::new(ErrorKind::Parse, message).remedy("write one integer from -1 to 5 per line")
    })
}

/// Writes one label per line, whole or not at all.
///
/// # Errors
/// [`ErrorKind::Option`] for a label outside `-1..=5`, [`ErrorKind::Io`] when the file cannot be written.
pub fn write_labels(path: &Path, labels: &[i8]) -> Result<()> {
    if let Some(i) = labels.iter().position(|label| !(-1..=5).contains(label)) {
        let message = format!("label {} of face {i} is not in -1..=5", labels[i]);
        return Err(Error::new(ErrorKind::Option, message));
    }
    let text: String = labels.iter().map(|label| format!("{label}\n")).collect();
    write_atomically(path, text.as_bytes())
}
