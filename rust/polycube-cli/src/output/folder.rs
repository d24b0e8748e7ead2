//! A folder of files that appear together or not at all.

use polycube::mesh::{CellKind, Format, Staged, write_atomically};
use polycube::{Context, Error, ErrorKind, Result};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The file that tells that a folder was filled by this program.
pub const REPORT: &str = "report.json";

/// The file with the label of each boundary face of the polycube beside it.
pub const LABELS: &str = "polycube.labels";

/// Files under temporary names in their folder, until all of them are complete.
pub struct Output {
    folder: PathBuf,
    /// The folders that did not exist before, outermost first.
    made: Vec<PathBuf>,
    files: Vec<(PathBuf, Staged)>,
}

impl Output {
    /// Makes the folder, unless it is there.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] naming the folder.
    pub fn new(folder: &Path) -> Result<Self> {
        let mut output = Self { folder: folder.to_owned(), made: Vec::new(), files: Vec::new() };
        output.make(folder)?;
        Ok(output)
    }

    /// Makes a folder with all that it lies in.
    fn make(&mut self, folder: &Path) -> Result<()> {
        let ancestors: Vec<&Path> = folder.ancestors().filter(|p| !p.as_os_str().is_empty()).collect();
        self.made.extend(ancestors.into_iter().rev().filter(|p| !p.exists()).map(Path::to_owned));
        fs::create_dir_all(folder).map_err(|e| failed("create the folder", folder, &e))
    }

    /// Where the file `name` will be.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Writes a file to the disk under a temporary name; `name` may begin with the names of folders.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] naming the file; the folder is then as it was before.
    pub fn add(&mut self, name: &str, bytes: &[u8]) -> Result<()> {
        let path = self.path(name);
        if path.is_dir() {
            return Err(failed("write", &path, &io::ErrorKind::IsADirectory.into()));
        }
        if let Some(parent) = path.parent() {
            self.make(parent)?;
        }
        let file = Staged::new(&self.folder, bytes).map_err(|e| failed("write", &path, &e))?;
        self.files.push((path, file));
        Ok(())
    }

    /// The meshes `NAME.EXT` of an earlier run, which left its report, in every format that holds a kind of cells.
    pub fn meshes_left(&self, names: &[(&str, &[CellKind])]) -> Vec<PathBuf> {
        let able = |kinds: &[CellKind], format: Format| kinds.iter().any(|&kind| format.holds(kind));
        let all = names.iter().flat_map(|&(name, kinds)| {
            let formats = Format::ALL.into_iter().filter(move |&f| able(kinds, f));
            formats.map(move |format| format!("{name}.{format}"))
        });
        self.left(all)
    }

    /// The files with these names, if an earlier run left its report.
    pub fn left(&self, names: impl IntoIterator<Item = String>) -> Vec<PathBuf> {
        let any = self.path(REPORT).is_file();
        names.into_iter().filter(|_| any).map(|name| self.path(&name)).collect()
    }

    /// Gives all files their names, unless the context was cancelled, and removes those `stale` of an earlier run that
    /// this one neither read (`inputs`) nor writes.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`]; [`ErrorKind::Io`] naming the file that could not be renamed or removed.
    pub fn publish(mut self, stale: &[PathBuf], inputs: &[&Path], context: &Context) -> Result<()> {
        context.tick(1.0)?;
        self.made.clear();
        let inputs: Vec<PathBuf> = inputs.iter().filter_map(|p| fs::canonicalize(p).ok()).collect();
        let is_used = |path: &Path| {
            let read = fs::canonicalize(path).is_ok_and(|p| inputs.contains(&p));
            read || self.files.iter().any(|(written, _)| written == path)
        };
        for path in stale.iter().filter(|p| p.is_file() && !is_used(p)) {
            fs::remove_file(path).map_err(|e| failed("remove", path, &e))?;
            for folder in path.ancestors().skip(1).take_while(|&p| p != self.folder) {
                // Fails where something else is in it, which is as it should be.
                let _ = fs::remove_dir(folder);
            }
        }
        for (path, file) in std::mem::take(&mut self.files) {
            file.publish(&path).map_err(|e| failed("write", &path, &e))?;
        }
        Ok(())
    }
}

impl Drop for Output {
    /// Removes what was not published: temporary files, then the folders made for them.
    fn drop(&mut self) {
        self.files.clear();
        for folder in self.made.iter().rev() {
            // Fails where someone else put a file, which is as it should be.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Writes one file as [`write_atomically`] does, unless the context was cancelled, and makes its folder.
///
/// # Errors
/// [`ErrorKind::Option`] for a path without a file name; [`ErrorKind::Io`], and a folder made for the file is removed.
pub fn write_file(path: &Path, bytes: &[u8], context: &Context) -> Result<()> {
    let (Some(_), Some(folder)) = (path.file_name(), path.parent()) else {
        let message = format!("{} is not the name of a file", path.display());
        return Err(Error::new(ErrorKind::Option, message).remedy("name a file to write"));
    };
    context.tick(1.0)?;
    let mut output = Output::new(folder)?;
    write_atomically(path, bytes)?;
    output.made.clear();
    Ok(())
}

fn failed(action: &str, path: &Path, error: &io::Error) -> Error {
    let remedy = match error.kind() {
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => "check the permissions of the folder",
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "free some space",
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => "name a folder, not a file",
        io::ErrorKind::IsADirectory => "remove the folder of that name or choose another output folder",
        _ => "",
    };
    Error::new(ErrorKind::Io, format!("cannot {action} {}: {error}", path.display())).remedy(remedy)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn nothing_is_there_before_everything_is() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("a/b");
        let mut output = Output::new(&folder).unwrap();
        output.add("one", b"1").unwrap();
        output.add("two", b"2").unwrap();
        assert!(!folder.join("one").exists());
        output.publish(&[], &[], &Context::default()).unwrap();
        assert_eq!(names(&folder), ["one", "two"]);
    }

    #[test]
    fn a_cancelled_or_failed_run_leaves_no_trace() {
        let root = tempfile::tempdir().unwrap();
        let context = Context::default();
        context.cancel();
        let mut output = Output::new(&root.path().join("a/b")).unwrap();
        output.add("one", b"1").unwrap();
        assert_eq!(output.publish(&[], &[], &context).unwrap_err().kind, ErrorKind::Cancelled);
        assert!(names(root.path()).is_empty());
        fs::create_dir(root.path().join("taken")).unwrap();
        let mut output = Output::new(root.path()).unwrap();
        output.add("one", b"1").unwrap();
        assert_eq!(output.add("taken", b"2").unwrap_err().kind, ErrorKind::Io);
        drop(output);
        assert_eq!(names(root.path()), ["taken"]);
    }

    #[test]
    fn one_file_is_written_with_its_folder_or_not_at_all() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("a/b/page");
        let cancelled = Context::default();
        cancelled.cancel();
        assert_eq!(write_file(&path, b"1", &cancelled).unwrap_err().kind, ErrorKind::Cancelled);
        fs::create_dir(root.path().join("taken")).unwrap();
        assert_eq!(write_file(&root.path().join("taken"), b"1", &Context::default()).unwrap_err().kind, ErrorKind::Io);
        assert_eq!(names(root.path()), ["taken"]);
        write_file(&path, b"1", &Context::default()).unwrap();
        assert_eq!((fs::read(&path).unwrap(), names(path.parent().unwrap())), (b"1".to_vec(), vec!["page".into()]));
        assert_eq!(write_file(Path::new("/"), b"", &Context::default()).unwrap_err().kind, ErrorKind::Option);
    }

    #[cfg(unix)]
    #[test]
    fn one_file_is_written_through_a_link() {
        let root = tempfile::tempdir().unwrap();
        let (page, link) = (root.path().join("page"), root.path().join("link"));
        std::os::unix::fs::symlink(&page, &link).unwrap();
        write_file(&link, b"1", &Context::default()).unwrap();
        assert_eq!(fs::read(page).unwrap(), b"1");
        assert!(fs::symlink_metadata(link).unwrap().is_symlink());
    }

    #[test]
    fn what_is_stale_goes_unless_it_was_read_or_is_written() {
        let root = tempfile::tempdir().unwrap();
        let [old, new, read] = ["old", "new", "read"].map(|name| root.path().join(name));
        [&old, &new, &read].iter().for_each(|path| fs::write(path, "").unwrap());
        let mut output = Output::new(root.path()).unwrap();
        output.add("new", b"1").unwrap();
        let input = root.path().join("./read");
        output.publish(&[old, new.clone(), read], &[&input], &Context::default()).unwrap();
        assert_eq!(names(root.path()), ["new", "read"]);
        assert_eq!(fs::read(new).unwrap(), b"1");
    }

    #[test]
    fn only_a_folder_with_a_report_has_meshes_left() {
        let root = tempfile::tempdir().unwrap();
        let output = Output::new(root.path()).unwrap();
        let left = || output.meshes_left(&[("hexes", &[CellKind::Hexahedra])]);
        assert!(left().is_empty() && output.left(["a/b".into()]).is_empty());
        fs::write(root.path().join(REPORT), "").unwrap();
        assert_eq!(output.left(["a/b".into()]), [root.path().join("a/b")]);
        let extensions = ["mesh", "meshb", "vtk", "vtu", "msh", "inp"];
        assert_eq!(left(), extensions.map(|e| root.path().join(format!("hexes.{e}"))));
    }
}
