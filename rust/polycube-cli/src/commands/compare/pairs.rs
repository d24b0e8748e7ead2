//! The pairs of shape and polycube that a command line names.

use crate::input::meshes::read_text;
use polycube::mesh::Format;
use polycube::{Error, ErrorKind, Place, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// What stands before the extension of a polycube, and of a shape.
const POLYCUBE: &str = ".polycube";
const SHAPE: &str = ".shape";

/// Two files.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The shape.
    pub shape: PathBuf,
    /// Its polycube.
    pub polycube: PathBuf,
}

impl Pair {
    /// The pair of `NAME.polycube.EXT`.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for another name.
    fn of(polycube: &Path) -> Result<Self> {
        let name = polycube.file_stem().unwrap_or_default().to_string_lossy();
        let (Some(name), Some(extension)) = (name.strip_suffix(POLYCUBE), polycube.extension()) else {
            let message = format!("{} is not named NAME{POLYCUBE}.EXT", polycube.display());
            return Err(Error::new(ErrorKind::Option, message)
                .remedy("rename it, with its shape as NAME.shape.EXT beside it, or use --pair SHAPE POLYCUBE"));
        };
        let shape = polycube.with_file_name(format!("{name}{SHAPE}.{}", extension.to_string_lossy()));
        Ok(Self { shape, polycube: polycube.to_owned() })
    }

    /// The polycube's name without folder and without `.polycube`.
    pub fn model(&self) -> String {
        let name = self.polycube.file_name().unwrap_or_default().to_string_lossy();
        name.replacen(&format!("{POLYCUBE}."), ".", 1)
    }
}

/// All pairs in the order named: inputs, then `pair` (shape and polycube in turns), then the list. Folders are sorted.
///
/// # Errors
/// [`ErrorKind::Option`] for a file of another name or if there is no pair at all; [`ErrorKind::Io`] if the list or a
/// folder cannot be read; [`ErrorKind::Parse`] with the line of the list. Whether the meshes are there is not looked
/// at.
pub fn collect(inputs: &[PathBuf], pair: &[PathBuf], list: Option<&Path>) -> Result<Vec<Pair>> {
    let mut pairs = Vec::new();
    for input in inputs {
        if input.is_dir() { pairs.extend(in_folder(input)?) } else { pairs.push(named(input)?) }
    }
    pairs.extend(pair.chunks_exact(2).map(|p| Pair { shape: p[0].clone(), polycube: p[1].clone() }));
    if let Some(list) = list {
        pairs.extend(in_list(list)?);
    }
    if pairs.is_empty() {
        let error = Error::new(ErrorKind::Option, "there is nothing to compare");
        return Err(error.remedy("name polycubes NAME.polycube.EXT, folders of them, --pair or --list"));
    }
    Ok(pairs)
}

/// The pair of a polycube named by the user.
fn named(polycube: &Path) -> Result<Pair> {
    Pair::of(polycube).map_err(|error| match polycube.exists() {
        true => error,
        false => Error::new(ErrorKind::Io, format!("{} does not exist", polycube.display())).remedy("check the path"),
    })
}

/// The polycubes in a folder, at least one, that have a known extension and a shape beside them.
fn in_folder(folder: &Path) -> Result<Vec<Pair>> {
    let failed = |e| Error::new(ErrorKind::Io, format!("cannot read the folder {}: {e}", folder.display()));
    let entries = fs::read_dir(folder).map_err(failed)?.collect::<std::io::Result<Vec<_>>>().map_err(failed)?;
    let mut files: Vec<PathBuf> = entries.into_iter().map(|e| e.path()).filter(|p| p.is_file()).collect();
    files.sort();
    let named = files.iter().filter(|p| Format::from_path(p).is_ok()).filter_map(|p| Pair::of(p).ok());
    let pairs: Vec<Pair> = named.filter(|p| p.shape.is_file()).collect();
    if pairs.is_empty() {
        let error = Error::new(ErrorKind::Option, format!("there are no pairs in the folder {}", folder.display()));
        return Err(error.remedy("name them NAME.polycube.EXT and NAME.shape.EXT, or use --pair SHAPE POLYCUBE"));
    }
    Ok(pairs)
}

fn in_list(list: &Path) -> Result<Vec<Pair>> {
    let text = read_text(list, "list of polycubes or pairs")?;
    let folder = list.parent().unwrap_or(Path::new(""));
    let lines = (1..).zip(text.lines().map(str::trim)).filter(|(_, l)| !l.is_empty() && !l.starts_with('#'));
    lines.map(|(number, line)| in_line(folder, line).map_err(|e| in_place(e, list, number))).collect()
}

fn in_line(folder: &Path, line: &str) -> Result<Pair> {
    let names: Vec<&str> = line.split('\t').map(str::trim).filter(|n| !n.is_empty()).collect();
    match names[..] {
        [polycube] => Pair::of(&folder.join(polycube)),
        [shape, polycube] => Ok(Pair { shape: folder.join(shape), polycube: folder.join(polycube) }),
        _ => Err(Error::new(ErrorKind::Parse, "more than two names").remedy("give a shape and its polycube on a line")),
    }
}

fn in_place(mut error: Error, list: &Path, line: usize) -> Error {
    error.kind = ErrorKind::Parse;
    error.in_file(list.display()).at(Place::Line(line))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(shape: &str, polycube: &str) -> Pair {
        Pair { shape: shape.into(), polycube: polycube.into() }
    }

    #[test]
    fn a_shape_lies_beside_its_polycube() {
        let found = Pair::of(Path::new("a/b.c.polycube.obj")).unwrap();
        assert_eq!(found, pair("a/b.c.shape.obj", "a/b.c.polycube.obj"));
        assert_eq!(found.model(), "b.c.obj");
        for bad in ["a.obj", "a.polycube", "polycube.obj", ""] {
            assert_eq!(Pair::of(Path::new(bad)).unwrap_err().kind, ErrorKind::Option, "{bad}");
        }
        assert_eq!(pair("s", "d/cube.obj").model(), "cube.obj");
    }

    #[test]
    fn folders_and_lists() {
        let root = tempfile::tempdir().unwrap();
        for name in ["b.polycube.obj", "b.shape.obj", "a.polycube.mesh", "a.shape.mesh", "c.polycube.obj"] {
            fs::write(root.path().join(name), "").unwrap();
        }
        for name in ["b.polycube.txt", "b.shape.txt", "x.obj"] {
            fs::write(root.path().join(name), "").unwrap();
        }
        let models = |pairs: Vec<Pair>| pairs.iter().map(Pair::model).collect::<Vec<_>>();
        assert_eq!(models(in_folder(root.path()).unwrap()), ["a.mesh", "b.obj"]);
        let list = root.path().join("list");
        fs::write(&list, "# a comment\n\n c.polycube.obj \nx y.obj\tz.obj\r\n").unwrap();
        let found = collect(&[], &["1".into(), "2".into()], Some(&list)).unwrap();
        assert_eq!(found[0], pair("1", "2"));
        assert_eq!(found[1].shape, root.path().join("c.shape.obj"));
        assert_eq!(found[2].shape, root.path().join("x y.obj"));
        fs::write(&list, "\na\tb\tc\n").unwrap();
        let error = collect(&[], &[], Some(&list)).unwrap_err();
        assert_eq!((error.kind, error.place), (ErrorKind::Parse, Some(Place::Line(2))));
        assert_eq!(collect(&[], &[], None).unwrap_err().kind, ErrorKind::Option);
    }
}
