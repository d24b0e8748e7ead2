//! What is looked up in space: the nearest point, the simplex around a point, the boxes that meet a box.

mod barycentric;
mod box_tree;
mod locate;
mod nearest;

pub(crate) use barycentric::{Barycentric, in_tetrahedron, in_triangle};
pub(crate) use box_tree::BoxTree;
pub(crate) use locate::{Location, SimplexIndex, bounds};
pub(crate) use nearest::Nearest;
