//! Polycubes made by the program itself: for demonstrations, tests and benchmarks.
//!
//! A polycube starts as a set of solid cells ([`Voxels`]): unions of [`Cuboid`]s, random ones ([`random_polycube`]) or
//! the named [`Example`]s. [`Voxels::mesh`] turns it into a mesh of any kind.

pub(crate) mod deform;
pub(crate) mod examples;
pub(crate) mod levels;
mod manifold;
mod mesh;
pub(crate) mod random;
mod soften;
pub(crate) mod symmetry;
mod voxels;

#[cfg(test)]
mod check;

pub use examples::{Example, example};
pub use random::random_polycube;
pub use voxels::{Cuboid, Voxels};
