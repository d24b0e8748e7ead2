//! To be written.

pub mod problem;
pub mod solve;
