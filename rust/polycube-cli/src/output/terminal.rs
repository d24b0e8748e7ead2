//! Printing that never panics, whoever closed the other end.

use polycube::{Error, ErrorKind, Result};
use serde::Serialize;
use std::io::{self, Write};

/// Prints `text` on standard output. A reader that went away has read enough.
///
/// # Errors
/// [`ErrorKind::Io`] when the output cannot be written for another reason.
pub fn print(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::new(ErrorKind::Io, format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints `value` as indented JSON.
///
/// # Errors
/// As [`print()`].
pub fn print_json(value: &impl Serialize) -> Result<()> {
    print(&to_json(value)?)
}

/// `value` as indented JSON with a final line break.
///
/// # Errors
/// [`ErrorKind::Internal`] if it cannot be written as JSON.
pub fn to_json(value: &impl Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(value);
    text.map(|t| t + "\n").map_err(|e| Error::new(ErrorKind::Internal, format!("no JSON for this: {e}")))
}

/// Prints a line on standard error. There is no one to tell if that fails.
pub fn print_error(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}
