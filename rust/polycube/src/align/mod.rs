//! Aligning the corners of a polycube on the integer lattice. Nothing here knows about meshes.

mod classes;
mod constraints;
pub mod neighbours;
mod order;
mod pairs;
mod paper;
pub mod problem;
mod relax;
mod separate;
pub mod solve;
pub use classes::*;
pub use constraints::*;
pub use order::*;
pub use paper::*;
pub use relax::*;
