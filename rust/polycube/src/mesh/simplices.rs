//! Temporary.
use super::Cells;
use crate::error::Result;
/// Face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// t
    Triangle([u32; 3]),
    /// q
    Quad([u32; 4]),
}
impl Face {
    /// v
    pub fn vertices(&self) -> &[u32] {
        match self {
            Self::Triangle(t) => t,
            Self::Quad(q) => q,
        }
    }
}
impl Cells {
    /// b
    pub fn boundary(&self) -> Result<Vec<Face>> {
        Ok(match self {
            Self::Triangles(t) => t.iter().map(|&t| Face::Triangle(t)).collect(),
            Self::Quads(t) => t.iter().map(|&t| Face::Quad(t)).collect(),
            _ => todo!(),
        })
    }
}
