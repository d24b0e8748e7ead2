//! Text output with full precision.

use crate::mesh::Point;
use std::fmt::{Display, Write};

/// A growing text.
#[derive(Default)]
pub(super) struct Text(String);

impl Text {
    /// Appends anything as it displays itself.
    pub(super) fn put(&mut self, item: impl Display) -> &mut Self {
        // Writing to a string cannot fail.
        let _ = write!(self.0, "{item}");
        self
    }

    /// Appends a number with the fewest digits that read back as the same number.
    pub(super) fn float(&mut self, value: f64) -> &mut Self {
        let size = value.abs();
        if size != 0.0 && size.is_finite() && !(1e-5..1e16).contains(&size) {
            return self.put(format_args!("{value:e}"));
        }
        self.put(value)
    }

    /// Appends the coordinates separated by spaces.
    pub(super) fn point(&mut self, point: &Point) -> &mut Self {
        self.float(point.x).put(' ').float(point.y).put(' ').float(point.z)
    }

    /// Appends the indices, each after a space and counted from `first`.
    pub(super) fn indices(&mut self, indices: &[u32], first: u64) -> &mut Self {
        for &index in indices {
            self.put(' ').put(u64::from(index) + first);
        }
        self
    }

    /// Ends the line.
    pub(super) fn end(&mut self) {
        self.0.push('\n');
    }

    /// The bytes of the text.
    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.0.into_bytes()
    }
}
