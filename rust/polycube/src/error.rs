//! The one error type: what kind, where, what is wrong, and what to do about it.

use std::fmt;

/// Result of every fallible call in this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// The closed set of things that can go wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorKind {
    /// A file could not be read, created, written or renamed.
    Io,
    /// A file's text or bytes do not follow its format.
    Parse,
    /// The format, cell kind or option is not supported.
    Unsupported,
    /// The mesh cannot be used: empty, NaN, open, non-manifold, badly oriented.
    Mesh,
    /// The mesh is not a polycube.
    Polycube,
    /// Shape and polycube do not have the same connectivity.
    Mismatch,
    /// An option is out of its range or contradicts another.
    Option,
    /// No integer polycube satisfies the constraints.
    Infeasible,
    /// The caller cancelled.
    Cancelled,
    /// A fault of this library.
    Internal,
}

/// The element an error is about. Indices count from 0 in the mesh as read; lines count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, bitcode::Encode, bitcode::Decode)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// A vertex of the mesh.
    Vertex(u32),
    /// A mesh edge, by its two vertices.
    Edge(u32, u32),
    /// A boundary face.
    Face(u32),
    /// A cell of the mesh.
    Cell(u32),
    /// A polycube edge, by its index in the structure.
    PolycubeEdge(u32),
    /// A facet of the structure.
    Facet(u32),
    /// A line of a text file, counted from 1.
    Line(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertex(v) => write!(f, "vertex {v}"),
            Self::Edge(a, b) => write!(f, "edge {a}-{b}"),
            Self::Face(i) => write!(f, "face {i}"),
            Self::Cell(i) => write!(f, "cell {i}"),
            Self::PolycubeEdge(i) => write!(f, "polycube edge {i}"),
            Self::Facet(i) => write!(f, "facet {i}"),
            Self::Line(i) => write!(f, "line {i}"),
        }
    }
}

/// What went wrong, where, and how to mend it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, serde::Serialize)]
#[error("{}{}{message}{}", prefix(.file.as_ref()), prefix(.place.as_ref()), suffix(.remedy))]
pub struct Error {
    /// Which of the closed set of kinds this is.
    pub kind: ErrorKind,
    /// The name of the file that is wrong, or of both where they do not go together; nothing for what came from memory,
    /// and where the message names the file.
    pub file: Option<String>,
    /// The element concerned, where there is one.
    pub place: Option<Place>,
    /// The option that is wrong, by the name of its field; `guides` for all that guides ask for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub option: Option<&'static str>,
    /// What is wrong, in plain words.
    pub message: String,
    /// What the user can do about it; empty where nothing can be advised.
    pub remedy: String,
}

fn prefix(of: Option<&impl fmt::Display>) -> String {
    of.map(|x| format!("{x}: ")).unwrap_or_default()
}

fn suffix(remedy: &str) -> String {
    if remedy.is_empty() { String::new() } else { format!(" ({remedy})") }
}

impl Error {
    /// An error of `kind` saying `message`, with no place and no remedy yet.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Self { kind, file: None, place: None, option: None, message: message.into(), remedy: String::new() }
    }

    /// The same error, naming the element it is about.
    #[must_use]
    pub fn at(mut self, place: Place) -> Self {
        self.place = Some(place);
        self
    }

    /// The same error, naming the file it is in, unless one is named.
    #[must_use]
    pub fn in_file(mut self, name: impl fmt::Display) -> Self {
        self.file.get_or_insert_with(|| name.to_string());
        self
    }

    /// The same error, naming the option it is about by its field.
    #[must_use]
    pub(crate) fn in_option(mut self, name: &'static str) -> Self {
        self.option = Some(name);
        self
    }

    /// The same error, telling what to do about it.
    #[must_use]
    pub fn remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = remedy.into();
        self
    }
}
