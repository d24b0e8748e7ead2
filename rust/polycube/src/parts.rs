//! The stages by themselves, for what measures and tests them in this repository: nothing here is promised.

pub use crate::align::neighbours::neighbours;
pub use crate::align::options::AlignOptions;
pub use crate::align::problem::Problem;
pub use crate::align::prove::{Proof, prove};
pub use crate::align::ranks::Ranks;
pub use crate::align::solve::{ExactSolver, LinearSolver, Solver};
pub use crate::align::{Alignment, align};
pub use crate::generate::examples::cube_spikes;
pub use crate::generate::levels::perturb;
pub use crate::generate::random::random_with_corners;
pub use crate::generate::symmetry::{scale, symmetries, transform, translate};
pub use crate::layout::rows::Rows;
pub use crate::map::morph;
pub use crate::rng::SplitMix64;
