//! Hexahedra, or the quadrilaterals of a surface alone, made to fit the shape: optimised with their surface on that of
//! the shape, and near to it everywhere.

mod anchors;
mod chord_error;
mod distant_points;
mod fitting;
mod improve;
mod sliding;
mod springs;

pub(crate) use fitting::Fitted;
pub(crate) use improve::{Aim, Improved, NEARER, improve};
