//! What the library works on: a polycube with its shape and labels.

use crate::mesh::Mesh;

/// What is simplified, meshed, compared and validated.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The polycube.
    pub polycube: &'a Mesh,
    /// The shape it was deformed from, with the same cells; used to measure the distortion of the map.
    pub shape: Option<&'a Mesh>,
    /// One label per boundary face of the polycube (0 to 5, −1 for "by the normal").
    pub labels: Option<&'a [i8]>,
}
