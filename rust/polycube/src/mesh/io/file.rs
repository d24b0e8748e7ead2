//! Whole files in and out, without ever leaving half a file behind.

use crate::error::{Error, ErrorKind, Result};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The whole file at `path`.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>> {
    let fail = |error: io::Error| io_error("read", path, &error);
    // A device such as /dev/zero never ends.
    if !fs::metadata(path).map_err(fail)?.is_file() {
        let what = if path.is_dir() { "a folder" } else { "not a regular file" };
        let message = format!("{} is {what}", path.display());
        return Err(Error::new(ErrorKind::Io, message).remedy("name a file"));
    }
    fs::read(path).map_err(fail)
}

/// Writes a file as a whole or not at all: whatever goes wrong, an older file stays as it was.
///
/// The bytes go to a temporary file in the same folder, are flushed to the disk, and the file is renamed. A symbolic
/// link is followed, also where it leads to no file yet; the permissions of an older file are kept; a device or pipe is
/// written to directly.
///
/// # Errors
/// [`ErrorKind::Io`] naming the path and saying what the operating system said. No temporary file is left.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    replace(path, bytes).map_err(|error| io_error("write", path, &error))
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let old = fs::metadata(path).ok();
    let target = match &old {
        Some(data) if data.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Some(data) if !data.is_file() => return fs::write(path, bytes),
        Some(data) if data.permissions().readonly() => {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
        _ => followed(path)?,
    };
    let folder = folder_of(&target);
    let file = Staged::new(&folder, bytes)?;
    if let Some(data) = old {
        file.0.as_file().set_permissions(data.permissions())?;
    }
    file.publish(&target)?;
    // Makes the new name durable too; where folders cannot be opened or synced the file is complete all the same.
    if let Ok(folder) = fs::File::open(&folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

/// Most symbolic links that lead on to one another, as in Linux.
const MOST_LINKS: usize = 40;

/// Where symbolic links at the end of a path lead; there need not be a file.
fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_owned();
    for _ in 0..=MOST_LINKS {
        let Ok(next) = fs::read_link(&target) else { return Ok(target) };
        target = folder_of(&target).join(next);
    }
    Err(io::Error::other("too many symbolic links that lead on to one another"))
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// A file that is complete on the disk under a temporary name, until it gets its own. It goes away where it never does.
#[derive(Debug)]
pub struct Staged(tempfile::NamedTempFile);

impl Staged {
    /// Writes the bytes to a new file in `folder`.
    ///
    /// # Errors
    /// What the operating system says. No file is left then.
    pub fn new(folder: &Path, bytes: &[u8]) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".polycube-").suffix(".tmp");
        // A temporary file is private by default, but this one becomes an ordinary file.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut file = builder.tempfile_in(folder)?;
        file.write_all(bytes)?;
        file.as_file().sync_all()?;
        Ok(Self(file))
    }

    /// Gives the file its name, in the same folder or another of the same disk, in place of any older file.
    ///
    /// # Errors
    /// What the operating system says. The older file is then as it was.
    pub fn publish(self, path: &Path) -> io::Result<()> {
        self.0.persist(path).map(drop).map_err(|error| error.error)
    }
}

pub(super) fn io_error(action: &str, path: &Path, error: &io::Error) -> Error {
    let remedy = match error.kind() {
        io::ErrorKind::NotFound if action == "write" => "create the folder first",
        io::ErrorKind::NotFound => "check the path",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "check the permissions of the file and its folder"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "free some space",
        io::ErrorKind::IsADirectory | io::ErrorKind::NotADirectory => "name a file",
        _ => "",
    };
    let message = format!("cannot {action} {}: {error}", path.display());
    Error::new(ErrorKind::Io, message).remedy(remedy)
}
