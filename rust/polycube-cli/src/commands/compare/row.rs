//! What came of one pair, for all ways to write it.

use polycube::Error;
use polycube::compare::Comparison;
use serde::Serialize;

/// What came of one pair.
#[derive(Debug, Serialize)]
pub struct Row {
    /// The name of its polycube.
    pub model: String,
    /// Its shape.
    pub shape: String,
    /// The polycube.
    pub polycube: String,
    /// Nothing if it failed.
    pub comparison: Option<Comparison>,
    /// Why it failed.
    pub error: Option<Error>,
}
