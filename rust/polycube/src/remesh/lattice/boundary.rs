//! The faces on the outside of a hexahedral mesh.

use crate::mesh::HexFace;
use crate::structure::Label;

/// A face on the outside of a hexahedral mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, bitcode::Encode, bitcode::Decode)]
pub struct BoundaryFace {
    /// The face.
    pub face: HexFace,
    /// The direction it has on the polycube.
    pub label: Label,
    /// The facet of the polycube that it lies on, as in [`Structure`](crate::structure::Structure).
    pub facet: u32,
}
