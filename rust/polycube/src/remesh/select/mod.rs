//! Which simplified polycube is meshed, found with coarse meshes that cost little.

mod bisection;
mod candidate;
mod candidates;
mod coarse_mesh;
mod multilevel;
mod spacing;
mod tried;

pub(crate) use candidate::Candidate;
pub(crate) use candidates::{Candidates, Verdict, WORTH};
pub(crate) use coarse_mesh::CoarseMesh;
pub(crate) use multilevel::finish;
pub(crate) use tried::alternatives;
pub use tried::{Failure, TriedPoint};
