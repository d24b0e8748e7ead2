//! Vertices of the lattice placed in the shape, one by one.

use crate::mesh::Point;
use crate::remesh::lattice::Carrier;

/// Where vertices lie in the shape, and how many of them are guesses.
pub(crate) struct Embedding {
    pub(crate) points: Vec<Point>,
    /// Vertices that the map does not hold.
    pub(crate) guessed: usize,
}

impl Embedding {
    /// `count` vertices at the origin.
    pub(crate) fn new(count: usize) -> Self {
        Self { points: vec![Point::origin(); count], guessed: 0 }
    }

    /// Puts vertex `v` where a map says, if it does; counts it as a guess unless the map holds it.
    pub(crate) fn place(&mut self, v: usize, found: Option<(Point, bool)>) {
        if let Some((point, _)) = found {
            self.points[v] = point;
        }
        if !found.is_some_and(|(_, held)| held) {
            self.guessed += 1;
        }
    }

    /// Adds an inner vertex here, to `polycube` and to `carriers`; tells its number.
    pub(crate) fn push(&mut self, polycube: &mut Vec<Point>, carriers: &mut Vec<Carrier>) -> usize {
        self.points.push(Point::origin());
        polycube.push(Point::origin());
        carriers.push(Carrier::Inside);
        self.points.len() - 1
    }
}
