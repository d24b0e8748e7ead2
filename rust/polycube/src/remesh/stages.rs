//! Where the time of a remeshing goes.

/// Time spent in each stage, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct Stages {
    /// Simplifying, and placing the levels at the wanted size.
    pub simplify: f64,
    /// Untangling the map.
    pub map: f64,
    /// Meshing.
    pub mesh: f64,
    /// Optimising the hexahedra.
    pub optimise: f64,
    /// Measuring the result.
    pub measure: f64,
    /// All of it, without files.
    pub total: f64,
}
