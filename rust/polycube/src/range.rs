//! Ranges of options, and what is said of a number that is outside.

use crate::error::{Error, ErrorKind, Result};
use std::fmt;

/// Which numbers an option may have; none is infinite.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Range {
    /// Above 0.
    Positive,
    /// This or more.
    AtLeast(f64),
    /// From the first to the second, both included.
    Within(f64, f64),
}

impl Range {
    /// Refuses `x` for the field `option` if it is outside.
    ///
    /// # Errors
    /// [`ErrorKind::Option`], which names the field.
    pub(crate) fn check(self, option: &'static str, x: f64) -> Result<()> {
        let inside = match self {
            Self::Positive => x > 0.0,
            Self::AtLeast(least) => x >= least,
            Self::Within(least, most) => (least..=most).contains(&x),
        };
        if inside && x.is_finite() {
            return Ok(());
        }
        Err(Error::new(ErrorKind::Option, format!("{option} is {x}"))
            .in_option(option)
            .remedy(format!("give a number {self}")))
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Positive => f.write_str("above 0"),
            Self::AtLeast(least) => write!(f, "of {least} or more"),
            Self::Within(least, most) => write!(f, "from {least} to {most}"),
        }
    }
}
