//! Errors on their way to C++, and panics made errors.

use polycube::{Error, Place};
use std::fmt;

/// Separates the parts of an error in the text that cxx carries across.
const SEPARATOR: char = '\x1f';

/// Result of every function of the bridge.
pub type Result<T> = std::result::Result<T, Failure>;

/// An error as C++ reads it: kind, element, index, second index, message and remedy.
#[derive(Debug)]
pub struct Failure(pub Error);

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Error { kind, file, place, message, remedy, .. } = &self.0;
        let (element, index, second) = place.map_or((0, 0, 0), numbers);
        let message = file.iter().chain([message]).map(|text| plain(text)).collect::<Vec<_>>().join(": ");
        let s = SEPARATOR;
        write!(f, "{}{s}{element}{s}{index}{s}{second}{s}{message}{s}{}", *kind as u8, plain(remedy))
    }
}

/// The text without what would cut it short on the way.
fn plain(text: &str) -> String {
    text.replace([SEPARATOR, '\0'], " ")
}

/// The number of a place's element, its index and its second index.
pub fn numbers(place: Place) -> (u8, u64, u64) {
    match place {
        Place::Vertex(i) => (1, i.into(), 0),
        Place::Edge(a, b) => (2, a.into(), b.into()),
        Place::Face(i) => (3, i.into(), 0),
        Place::Cell(i) => (4, i.into(), 0),
        Place::PolycubeEdge(i) => (5, i.into(), 0),
        Place::Facet(i) => (6, i.into(), 0),
        Place::Line(i) => (7, i as u64, 0),
    }
}

/// Does `work`; a panic becomes an error of [`polycube::ErrorKind::Internal`].
pub fn guard<T>(work: impl FnOnce() -> polycube::Result<T>) -> Result<T> {
    polycube_host::guard(work).map_err(Failure)
}
