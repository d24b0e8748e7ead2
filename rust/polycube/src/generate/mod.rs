//! Polycubes made by the program itself: for demonstrations, tests and benchmarks.
//!
//! A polycube starts as a set of solid cells ([`Voxels`]): unions of [`Cuboid`]s, random ones
//! ([`random_polycube`], [`random_with_corners`]) or the named [`Example`]s. [`Voxels::mesh`] turns
//! it into a mesh of any kind; [`move_levels`] and [`perturb`] take its facets off the lattice, and
//! [`symmetries`] turn and mirror it.

mod deform;
mod examples;
mod levels;
mod manifold;
mod mesh;
mod random;
mod soften;
mod symmetry;
mod voxels;

#[cfg(test)]
mod check;

pub use crate::rng::SplitMix64;
pub use deform::Deformation;
pub use examples::{Example, cube_spikes, double_torus, example, ring, stepped_l};
pub use levels::{move_levels, perturb};
pub use random::{random_polycube, random_with_corners};
pub use symmetry::{scale, symmetries, transform, translate};
pub use voxels::{Cuboid, Voxels};
