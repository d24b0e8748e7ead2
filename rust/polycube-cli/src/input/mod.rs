//! What a run reads.

pub mod guides;
pub mod meshes;
