//! Vertices of the lattice placed in the shape, one by one.

use super::site::Site;
use crate::mesh::Point;

/// Where vertices lie in the shape, and how many of them are guesses.
pub(super) struct Embedding {
    pub(super) points: Vec<Point>,
    /// Vertices that the map does not hold.
    pub(super) guessed: usize,
}

impl Embedding {
    /// `count` vertices at the origin.
    pub(super) fn new(count: usize) -> Self {
        Self { points: vec![Point::origin(); count], guessed: 0 }
    }

    /// Puts vertex `v` where a map says, if it does; counts it as a guess unless the map holds it.
    pub(super) fn place(&mut self, v: usize, found: Option<(Point, bool)>) {
        if let Some((point, _)) = found {
            self.points[v] = point;
        }
        if !found.is_some_and(|(_, held)| held) {
            self.guessed += 1;
        }
    }

    /// Adds an inner vertex here, to `polycube` and to `sites`; tells its number.
    pub(super) fn push(&mut self, polycube: &mut Vec<Point>, sites: &mut Vec<Site>) -> usize {
        self.points.push(Point::origin());
        polycube.push(Point::origin());
        sites.push(Site::Inside);
        self.points.len() - 1
    }
}
