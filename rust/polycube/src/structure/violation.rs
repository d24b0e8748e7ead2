//! What can keep a mesh from being a polycube: one closed list, each with its place and remedy.

use crate::error::{Error, ErrorKind, Place};
use std::fmt;

/// One reason why a mesh is not a polycube.
///
/// The rules, in the order in which they are checked; a later rule is checked only where the earlier ones hold:
/// 1. no cell of a volume repeats a vertex, there is a boundary, and no face of it repeats a vertex;
/// 2. every mesh edge of the boundary has two faces, which pass it in opposite directions;
/// 3. the faces around a vertex form one fan;
/// 4. every face lies within the tolerance of an axis direction (or has a label of its own);
/// 5. neighbouring charts look along different axes; every corner touches all three axes;
/// 6. every chart is a planar region whose boundary loops have four corners or more;
/// 7. polycube edges have a length and are not folded beyond the tolerance; faces lie near the level of their chart;
/// 8. the surface neither touches nor crosses itself, and looks outward.
#[derive(Clone, Debug, PartialEq)]
pub enum Violation {
    /// There is no boundary face.
    Empty,
    /// A face that uses a vertex twice.
    BadFace {
        /// The face.
        face: u32,
    },
    /// A face without area.
    FlatFace {
        /// The face.
        face: u32,
    },
    /// A mesh edge with a face on one side only.
    OpenEdge {
        /// Its vertices.
        edge: [u32; 2],
    },
    /// A mesh edge with more than two faces.
    NonManifoldEdge {
        /// Its vertices.
        edge: [u32; 2],
    },
    /// Two neighbouring faces that pass their common edge in the same direction.
    InconsistentOrientation {
        /// The vertices of the edge.
        edge: [u32; 2],
    },
    /// A vertex where several fans of faces touch.
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
    },
    /// A face too far from every axis direction.
    SkewFace {
        /// The face.
        face: u32,
        /// Angle to the nearest axis, in degrees.
        degrees: f64,
        /// The largest that was allowed.
        limit: f64,
    },
    /// Neighbouring charts of opposite label.
    OppositeCharts {
        /// The vertices of a mesh edge between them.
        edge: [u32; 2],
    },
    /// A corner whose charts do not cover the three axes.
    IncompleteCorner {
        /// The vertex.
        vertex: u32,
    },
    /// A boundary loop of a chart with fewer than four corners.
    TooFewCorners {
        /// A face of the chart.
        face: u32,
        /// How many there are.
        corners: usize,
    },
    /// A chart that is not planar (it has a handle).
    ChartWithHandle {
        /// A face of the chart.
        face: u32,
    },
    /// A polycube edge whose ends have the same level along it.
    ZeroLengthEdge {
        /// Its end vertices.
        ends: [u32; 2],
    },
    /// A polycube edge that turns back on itself, by more than the tolerance.
    NonMonotoneEdge {
        /// The vertices of the mesh edge that goes back farthest.
        edge: [u32; 2],
        /// The first and the last vertex of the run that is out of order.
        run: [u32; 2],
        /// How many vertices the run has.
        vertices: usize,
        /// How far one of them is from its place in order, in the units of the mesh.
        distance: f64,
    },
    /// A vertex too far from the plane of a chart it belongs to.
    OffLevel {
        /// The vertex.
        vertex: u32,
        /// Distance from the plane, in the units of the mesh.
        distance: f64,
    },
    /// Two parts of the surface touch or cross.
    SelfOverlap {
        /// A face of the first part.
        face: u32,
        /// A face of the second part.
        other: u32,
    },
    /// A facet whose border touches or crosses itself, or goes round the wrong way.
    FoldedFacet {
        /// The face of it that is nearest to where it does.
        face: u32,
    },
    /// The surface looks inward.
    InsideOut {
        /// A face of the component.
        face: u32,
    },
    /// A cell that uses a vertex twice: a prism or a pyramid stored as a hexahedron, say.
    CollapsedCell {
        /// The cell.
        cell: u32,
        /// How many different vertices it has.
        corners: usize,
    },
    /// A cell with a face that two other cells have, too.
    CrowdedCell {
        /// The cell.
        cell: u32,
    },
    /// An element of the mesh is inverted or flat inside the polycube.
    InvertedCell {
        /// The cell.
        cell: u32,
    },
}

impl Violation {
    /// The element concerned.
    pub fn place(&self) -> Option<Place> {
        Some(match *self {
            Self::Empty => return None,
            Self::NonManifoldVertex { vertex } | Self::IncompleteCorner { vertex } | Self::OffLevel { vertex, .. } => {
                Place::Vertex(vertex)
            }
            Self::BadFace { face }
            | Self::FlatFace { face }
            | Self::SkewFace { face, .. }
            | Self::TooFewCorners { face, .. }
            | Self::ChartWithHandle { face }
            | Self::SelfOverlap { face, .. }
            | Self::FoldedFacet { face }
            | Self::InsideOut { face } => Place::Face(face),
            Self::OpenEdge { edge }
            | Self::NonManifoldEdge { edge }
            | Self::InconsistentOrientation { edge }
            | Self::OppositeCharts { edge }
            | Self::NonMonotoneEdge { edge, .. }
            | Self::ZeroLengthEdge { ends: edge } => Place::Edge(edge[0], edge[1]),
            Self::CollapsedCell { cell, .. } | Self::CrowdedCell { cell } | Self::InvertedCell { cell } => {
                Place::Cell(cell)
            }
        })
    }

    /// A short name of the rule broken, in `snake_case`, for programs.
    pub fn rule(&self) -> &'static str {
        match self {
            Self::Empty => "empty",
            Self::BadFace { .. } => "bad_face",
            Self::FlatFace { .. } => "flat_face",
            Self::OpenEdge { .. } => "open_edge",
            Self::NonManifoldEdge { .. } => "non_manifold_edge",
            Self::InconsistentOrientation { .. } => "inconsistent_orientation",
            Self::NonManifoldVertex { .. } => "non_manifold_vertex",
            Self::SkewFace { .. } => "skew_face",
            Self::OppositeCharts { .. } => "opposite_charts",
            Self::IncompleteCorner { .. } => "incomplete_corner",
            Self::TooFewCorners { .. } => "too_few_corners",
            Self::ChartWithHandle { .. } => "chart_with_handle",
            Self::ZeroLengthEdge { .. } => "zero_length_edge",
            Self::NonMonotoneEdge { .. } => "non_monotone_edge",
            Self::OffLevel { .. } => "off_level",
            Self::SelfOverlap { .. } => "self_overlap",
            Self::FoldedFacet { .. } => "folded_facet",
            Self::InsideOut { .. } => "inside_out",
            Self::CollapsedCell { .. } => "collapsed_cell",
            Self::CrowdedCell { .. } => "crowded_cell",
            Self::InvertedCell { .. } => "inverted_cell",
        }
    }

    /// What is wrong.
    fn message(&self) -> String {
        match self {
            Self::Empty => "the mesh has no faces".into(),
            Self::BadFace { .. } => "the face repeats a vertex".into(),
            Self::FlatFace { .. } => "the face has no area, so it looks nowhere".into(),
            Self::OpenEdge { .. } => "the surface is open here: one face only".into(),
            Self::NonManifoldEdge { .. } => "more than two faces meet here".into(),
            Self::InconsistentOrientation { .. } => "the two faces here are oriented against each other".into(),
            Self::NonManifoldVertex { .. } => "several sheets of the surface touch at this vertex".into(),
            Self::SkewFace { degrees, limit, .. } => {
                format!("the face is {degrees:.1} degrees off the nearest axis, more than {limit}")
            }
            Self::OppositeCharts { .. } => "two charts of opposite label meet here".into(),
            Self::IncompleteCorner { .. } => "the charts at this corner do not cover all three axes".into(),
            Self::TooFewCorners { corners, .. } => {
                format!("a boundary loop of this face's chart has {corners} corners, fewer than 4")
            }
            Self::ChartWithHandle { .. } => "this face's chart has a handle, so it cannot be flat".into(),
            Self::ZeroLengthEdge { .. } => "this polycube edge has no length".into(),
            Self::NonMonotoneEdge { run: [first, last], vertices, distance, .. } => format!(
                "the polycube edge is folded here: its {vertices} vertices from {first} to {last} are out of order, by \
                 up to {distance:.3}, beyond the tolerance"
            ),
            Self::OffLevel { distance, .. } => {
                format!("the vertex lies {distance:.3} off the plane of its chart, beyond the tolerance")
            }
            Self::SelfOverlap { other, .. } => format!("the surface touches or crosses itself: face {other} meets it"),
            Self::FoldedFacet { .. } => {
                "the facet of this face is folded: its border crosses itself or goes round the wrong way".into()
            }
            Self::InsideOut { .. } => "this part of the surface looks inward".into(),
            Self::CollapsedCell { corners, .. } => {
                format!("the cell is collapsed: it has {corners} different corners only")
            }
            Self::CrowdedCell { .. } => "a face of the cell belongs to more than two cells".into(),
            Self::InvertedCell { .. } => "the cell is inverted or flat".into(),
        }
    }

    /// How to mend it.
    fn remedy(&self) -> &'static str {
        match self {
            Self::Empty => "give a mesh with triangles, quadrilaterals, tetrahedra or hexahedra",
            Self::BadFace { .. } => "remove the face and close the hole",
            Self::FlatFace { .. } => "give its label in a label file, or collapse it",
            Self::OpenEdge { .. } => "close the hole, or weld vertices that lie at one place",
            Self::NonManifoldEdge { .. } => "remove duplicate or inner faces",
            Self::InconsistentOrientation { .. } => "recalculate the normals so that all look outward",
            Self::NonManifoldVertex { .. } => "split the vertex, one copy for each sheet",
            Self::SkewFace { .. } => "give labels in a label file, raise the angle tolerance, or flatten the polycube",
            Self::OppositeCharts { .. } => "relabel the faces here so that a third chart lies between them",
            Self::IncompleteCorner { .. } => "relabel the faces around it",
            Self::TooFewCorners { .. } => "relabel its boundary: a facet is at least a rectangle",
            Self::ChartWithHandle { .. } => "relabel the chart in several parts",
            Self::ZeroLengthEdge { .. } => "pull its ends apart, or merge the two charts at its end",
            Self::NonMonotoneEdge { .. } => "unfold the border between the two charts, or raise the level tolerance",
            Self::OffLevel { .. } => "flatten the facet, or raise the level tolerance",
            Self::SelfOverlap { .. } => "move the two parts apart",
            Self::FoldedFacet { .. } => "pull the edges of the facet apart there",
            Self::InsideOut { .. } => "flip its faces",
            Self::CollapsedCell { .. } => {
                "mesh the solid with whole cells: prisms and pyramids cannot be hexahedra here"
            }
            Self::CrowdedCell { .. } => "remove duplicate or overlapping cells",
            Self::InvertedCell { .. } => "untangle the polycube map; it is not injective here",
        }
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Error::from(self.clone()).fmt(f)
    }
}

impl From<Violation> for Error {
    fn from(violation: Violation) -> Self {
        use Violation as V;
        let kind = match violation {
            V::Empty
            | V::BadFace { .. }
            | V::OpenEdge { .. }
            | V::NonManifoldEdge { .. }
            | V::InconsistentOrientation { .. }
            | V::NonManifoldVertex { .. }
            | V::CollapsedCell { .. }
            | V::CrowdedCell { .. } => ErrorKind::Mesh,
            _ => ErrorKind::Polycube,
        };
        let error = Self::new(kind, violation.message()).remedy(violation.remedy());
        match violation.place() {
            Some(place) => error.at(place),
            None => error,
        }
    }
}
