//! The structure of a polycube: facets, corners, edges and the levels that are the unknowns of its alignment.
//!
//! [`Structure`] is combinatorial: it knows which facet bounds which, not where anything lies. A position of
//! all its corners is a [`Placement`]: one number per level. [`Polycube`] ties a structure to a mesh.

mod arrangement;
mod charts;
mod convention;
mod extract;
mod label;
mod labelling;
mod order;
mod overlaps;
mod polycube;
mod read;
mod rectangles;
mod surface;
mod violation;

pub use arrangement::{Arrangement, Conflict};
pub(crate) use convention::convention;
pub use label::Label;
pub(crate) use label::{area_vector, cone};
pub(crate) use labelling::Labelling;
pub(crate) use order::ascending;
pub(crate) use overlaps::Overlaps;
pub use polycube::{Deviation, Polycube, Tolerance};
pub(crate) use rectangles::{LevelBox, rectangles};
pub(crate) use surface::HalfEdge;
pub use surface::Surface;
pub use violation::Violation;

/// The coordinate of every level, in the order of [`Structure::levels`].
pub type Placement = Vec<f64>;

/// The placement that has the levels at integers, as alignment leaves them. Exact up to 2⁵³.
pub fn placement_of(levels: &[i64]) -> Placement {
    levels.iter().map(|&x| x as f64).collect()
}

/// The coordinate that a connected set of facets shares: one unknown of the alignment.
///
/// Two facets of one axis that touch at a corner have one level, so collinearity of edges
/// (paper, Eq. 2) holds by construction.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Level {
    /// 0, 1 or 2 for X, Y or Z.
    pub axis: usize,
    /// How many corners have this coordinate.
    pub corners: u32,
}

/// A chart of the polycube: a plane region bounded by loops of edges.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Facet {
    /// The direction it looks at.
    pub label: Label,
    /// Its level.
    pub level: u32,
    /// Its boundary: the outer loop and the holes, in no particular order, each with the facet on its left.
    pub loops: Vec<Vec<Side>>,
}

impl Facet {
    /// The sides of all loops.
    pub fn sides(&self) -> impl Iterator<Item = Side> + '_ {
        self.loops.iter().flatten().copied()
    }
}

/// An edge as it bounds one of its facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Side {
    /// The edge.
    pub edge: u32,
    /// Whether the loop passes it from its lower to its higher corner.
    pub forward: bool,
}

/// A vertex where three or more charts meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Corner {
    /// The mesh vertex.
    pub vertex: u32,
    /// How many edges meet here: 3 to 6.
    pub valence: u32,
    /// Its level along X, Y and Z.
    pub levels: [u32; 3],
}

/// The common border of two facets between two corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Edge {
    /// The direction it runs in: 0, 1 or 2 for X, Y or Z.
    pub axis: usize,
    /// The corner with the lower and the one with the higher coordinate along `axis`.
    pub corners: [u32; 2],
    /// The facet on its left and the one on its right, seen from outside when walking up the axis.
    pub facets: [u32; 2],
}

/// Facets, edges, corners and levels of a polycube, and how they meet.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Structure {
    /// The facets, in the order of their first faces.
    pub facets: Vec<Facet>,
    /// The edges.
    pub edges: Vec<Edge>,
    /// The corners, in the order of their vertices.
    pub corners: Vec<Corner>,
    /// The levels, axis by axis.
    pub levels: Vec<Level>,
}

impl Structure {
    /// The position of corner `corner` under `placement`.
    pub fn position(&self, corner: u32, placement: &[f64]) -> [f64; 3] {
        self.corners[corner as usize].levels.map(|l| placement[l as usize])
    }

    /// The levels at the lower and at the higher end of an edge, along its axis.
    pub fn ends(&self, edge: &Edge) -> [u32; 2] {
        edge.corners.map(|c| self.corners[c as usize].levels[edge.axis])
    }

    /// Whether the facet on the left of an edge goes away from the side that the facet on its right looks at.
    pub fn is_convex(&self, edge: &Edge) -> bool {
        let [left, right] = edge.facets.map(|f| self.facets[f as usize].label);
        left.left(edge.axis) != right.sign()
    }

    /// The levels of the box that an edge fills: a range along its axis, one level along the other two.
    pub fn edge_box(&self, edge: &Edge) -> LevelBox {
        let [low, high] = edge.corners.map(|c| self.corners[c as usize].levels);
        LevelBox { low, high }
    }

    /// The box of coordinates that `levels` fill under `placement`.
    pub fn extent(&self, levels: &LevelBox, placement: &[f64]) -> ([f64; 3], [f64; 3]) {
        let at = |l: u32| placement[l as usize];
        (levels.low.map(at), levels.high.map(at))
    }

    /// The length of the shortest edge under `placement`.
    pub fn shortest_edge(&self, placement: &[f64]) -> f64 {
        let length = |e: &Edge| {
            let [low, high] = self.ends(e);
            placement[high as usize] - placement[low as usize]
        };
        self.edges.iter().map(length).fold(f64::INFINITY, f64::min)
    }

    /// The farthest that a corner moves between two placements.
    pub fn max_displacement(&self, from: &[f64], to: &[f64]) -> f64 {
        let moved = |c: u32| {
            let (p, q) = (self.position(c, from), self.position(c, to));
            (0..3).map(|a| (q[a] - p[a]) * (q[a] - p[a])).sum::<f64>().sqrt()
        };
        (0..self.corners.len() as u32).map(moved).fold(0.0, f64::max)
    }

    /// Connected components of the surface: for every facet the number of its component, from 0.
    pub fn components(&self) -> Vec<u32> {
        let mut component = vec![u32::MAX; self.facets.len()];
        let mut count = 0;
        for seed in 0..self.facets.len() {
            if component[seed] != u32::MAX {
                continue;
            }
            let mut stack = vec![seed];
            component[seed] = count;
            while let Some(f) = stack.pop() {
                for side in self.facets[f].sides() {
                    for g in self.edges[side.edge as usize].facets {
                        if component[g as usize] == u32::MAX {
                            component[g as usize] = count;
                            stack.push(g as usize);
                        }
                    }
                }
            }
            count += 1;
        }
        component
    }

    /// Genus of the whole surface: the number of its handles, over all components.
    pub fn genus(&self) -> usize {
        let components = self.components().into_iter().max().map_or(0, |c| c + 1) as i64;
        let (v, e) = (self.corners.len() as i64, self.edges.len() as i64);
        let facets: i64 = self.facets.iter().map(|f| 2 - f.loops.len() as i64).sum();
        ((2 * components - (v - e + facets)) / 2).max(0) as usize
    }
}
