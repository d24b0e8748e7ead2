//! To be written.

pub mod neighbours;
