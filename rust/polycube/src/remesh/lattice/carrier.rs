//! Which part of the polycube a vertex lies on.

/// The part of a polycube that a vertex lies on, and that it must stay on when a mesh is improved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Carrier {
    /// A corner of the structure: the vertex is fixed.
    Corner(u32),
    /// An edge of the structure: the vertex may slide along the edge's image.
    Edge(u32),
    /// A facet of the structure: the vertex may slide on the facet's image.
    Facet(u32),
    /// Inside the polycube: the vertex is free.
    Inside,
}

impl Carrier {
    /// Whether the vertex is on the surface.
    pub fn is_surface(self) -> bool {
        self != Self::Inside
    }
}
