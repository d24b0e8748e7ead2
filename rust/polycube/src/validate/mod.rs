//! Everything that is wrong with a polycube, or with a shape that one shall be made of, for people and programs.

mod finding;
mod polycube;
mod shape;

pub use finding::{Finding, Subject};
pub use polycube::validate;
pub use shape::validate_shape;
