//! A cursor over the words and raw bytes of a file. Every call consumes input or fails, so no file makes a reader loop.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Point;

/// Reads words separated by white space, counts lines, and hands out runs of raw bytes.
#[derive(Clone)]
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    comments: bool,
}

fn is_blank(byte: u8) -> bool {
    byte.is_ascii_whitespace() || byte == 0x0b
}

impl<'a> Scanner<'a> {
    /// A scanner that takes every byte as it is.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, line: 1, comments: false }
    }

    /// A scanner of plain text that ignores a byte order mark, and all from a `#` to the end of its line.
    pub(super) fn with_comments(bytes: &'a [u8]) -> Self {
        let mut scanner = Self::new(without_mark(bytes));
        scanner.comments = true;
        scanner
    }

    /// The line of the word read last, counted from 1.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// Number of bytes left: the bound of everything a file may claim to hold.
    pub(super) fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// A capacity for `count` items of at least `size` bytes each that the rest of the file can fill.
    pub(super) fn capacity(&self, count: usize, size: usize) -> usize {
        count.min(self.remaining() / size.max(1) + 1)
    }

    fn skip_blank(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            if byte == b'#' && self.comments {
                while self.bytes.get(self.at).is_some_and(|&b| b != b'\n') {
                    self.at += 1;
                }
            } else if is_blank(byte) {
                self.line += usize::from(byte == b'\n');
                self.at += 1;
            } else {
                return;
            }
        }
    }

    /// The next word, on whatever line it is.
    pub(super) fn word(&mut self) -> Option<&'a [u8]> {
        self.skip_blank();
        let rest = &self.bytes[self.at..];
        let ends = |&b: &u8| is_blank(b) || (b == b'#' && self.comments);
        let length = rest.iter().position(ends).unwrap_or(rest.len());
        self.at += length;
        (length > 0).then(|| &rest[..length])
    }

    /// The next word, without moving on.
    pub(super) fn peek(&self) -> Option<&'a [u8]> {
        self.clone().word()
    }

    /// The next word, which `what` describes in the error when there is none.
    pub(super) fn expect(&mut self, what: &str) -> Result<&'a [u8]> {
        self.word().ok_or_else(|| self.truncated(what))
    }

    /// The next word as a number; it may be infinite or NaN.
    pub(super) fn float(&mut self, what: &str) -> Result<f64> {
        let word = self.expect(what)?;
        number(word).ok_or_else(|| self.unexpected(what, word))
    }

    /// The next word as an integer.
    pub(super) fn integer(&mut self, what: &str) -> Result<i64> {
        let word = self.expect(what)?;
        number(word).ok_or_else(|| self.unexpected(what, word))
    }

    /// The next word as a number of things.
    pub(super) fn count(&mut self, what: &str) -> Result<usize> {
        let word = self.expect(what)?;
        number(word).ok_or_else(|| self.unexpected(what, word))
    }

    /// The next word as an index that counts from `first` in the file, made to count from 0.
    pub(super) fn index(&mut self, first: i64) -> Result<u32> {
        let value = self.integer("a vertex index")?;
        let index = value.checked_sub(first).and_then(|i| u32::try_from(i).ok());
        index.ok_or_else(|| self.error(format!("there is no vertex {value}")))
    }

    /// The next three words as a point.
    pub(super) fn point(&mut self) -> Result<Point> {
        let what = "a coordinate";
        Ok(Point::new(self.float(what)?, self.float(what)?, self.float(what)?))
    }

    /// The rest of the line without its end, moving to the start of the next; nothing at the end of the file.
    pub(super) fn rest_of_line(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return None;
        }
        let length = rest.iter().position(|&b| b == b'\n');
        self.at += length.map_or(rest.len(), |l| l + 1);
        self.line += usize::from(length.is_some());
        Some(&rest[..length.unwrap_or(rest.len())])
    }

    /// The next `count` raw bytes.
    pub(super) fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let taken = rest.get(..count).ok_or_else(|| self.truncated(what))?;
        self.at += count;
        self.line += taken.iter().filter(|&&b| b == b'\n').count();
        Ok(taken)
    }

    /// Moves past the next occurrence of `mark`.
    pub(super) fn past(&mut self, mark: &[u8]) -> Result<()> {
        let rest = &self.bytes[self.at..];
        let at = rest.windows(mark.len()).position(|window| window == mark);
        let at = at.ok_or_else(|| self.truncated(&quoted(mark)))?;
        self.take(at + mark.len(), "a mark").map(|_| ())
    }

    /// The error `message` at the current line.
    pub(super) fn error(&self, message: impl Into<String>) -> Error {
        Error::new(ErrorKind::Parse, message).at(Place::Line(self.line))
    }

    /// The error of a file that says `word` where `what` should be.
    pub(super) fn unexpected(&self, what: &str, word: &[u8]) -> Error {
        self.error(format!("expected {what}, found {}", quoted(word)))
    }

    /// The error of a file that ends where `what` should be.
    pub(super) fn truncated(&self, what: &str) -> Error {
        self.error(format!("the file ends where {what} was expected"))
            .remedy("the file is cut short or a count in it is too large: export it again")
    }
}

/// The text without a UTF-8 byte order mark.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// A word as a number.
pub(super) fn number<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// The label, 0 to 5, of a direction that a name of a group stands for, as `plus_x` and `-Y` do, or else the number
/// that it ends with, as in `label_3`.
pub(super) fn number_in(name: &[u8]) -> Option<i64> {
    const DIRECTIONS: [[&[u8]; 2]; 6] = [
        [b"plus_x", b"+x"],
        [b"minus_x", b"-x"],
        [b"plus_y", b"+y"],
        [b"minus_y", b"-y"],
        [b"plus_z", b"+z"],
        [b"minus_z", b"-z"],
    ];
    let name = name.trim_ascii().to_ascii_lowercase();
    let direction = DIRECTIONS.iter().position(|names| names.contains(&name.as_slice()));
    let digits = name.iter().rev().take_while(|b| b.is_ascii_digit()).count();
    direction.map(|label| label as i64).or_else(|| number(&name[name.len() - digits..]))
}

/// A word for an error message: short, and without control characters.
pub(super) fn quoted(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(40)]);
    let dots = if word.len() > 40 { "…" } else { "" };
    format!("\"{}{dots}\"", text.escape_debug())
}
