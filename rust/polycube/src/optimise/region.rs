//! Which parts of a mesh must move so that inverted cells can be turned the right way round.

use super::elements::Elements;
use super::freedom::Constraints;
use crate::mesh::Stars;

/// A part of a mesh that can be untangled by itself: what moves in it touches no cell outside.
pub(super) struct Region {
    /// Ascending.
    pub(super) cells: Vec<u32>,
    /// The vertices that move; ascending.
    pub(super) moving: Vec<u32>,
    /// How many of the cells are inverted.
    bad: usize,
}

/// How large a region shall be, if what is held allows it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// Least number of rings of cells around inverted ones.
    pub(super) rings: usize,
    /// Least number of cells for each inverted one: a large fold needs a large neighbourhood to be drawn smooth in.
    pub(super) cells: usize,
}

/// The regions around the cells `bad`. Those without a vertex that can move are in none, as nothing turns them.
pub(super) fn regions(elements: &Elements, constraints: &Constraints, bad: &[usize], room: Room) -> Vec<Region> {
    let mut growth = Growth::new(elements, constraints, bad);
    for ring in 1.. {
        let regions = growth.regions();
        let small = |r: &&Region| ring <= room.rings || r.cells.len() < room.cells * r.bad;
        let grown = regions.iter().filter(small).filter(|region| growth.grow(region)).count();
        if grown == 0 {
            return regions;
        }
    }
    Vec::new()
}

/// Vertices that move, ring by ring more of them.
struct Growth<'a> {
    elements: &'a Elements,
    constraints: &'a Constraints<'a>,
    stars: Stars,
    /// Inverted cells with a vertex that can move; ascending.
    bad: Vec<u32>,
    moves: Vec<bool>,
}

impl<'a> Growth<'a> {
    fn new(elements: &'a Elements, constraints: &'a Constraints, bad: &[usize]) -> Self {
        let count = constraints.freedom.len();
        let stars = Stars::new(count, (0..elements.cells()).map(|cell| elements.vertices_of(cell)));
        let mut growth = Self { elements, constraints, stars, bad: Vec::new(), moves: vec![false; count] };
        let can_turn = |cell: &usize| elements.vertices_of(*cell).any(|v| constraints.moves(v as usize));
        growth.bad = bad.iter().copied().filter(can_turn).map(|cell| cell as u32).collect();
        for i in 0..growth.bad.len() {
            growth.free(growth.bad[i]);
        }
        growth
    }

    /// Lets the vertices of a cell move. Returns whether that is new for one of them.
    fn free(&mut self, cell: u32) -> bool {
        let mut new = false;
        for v in self.elements.vertices_of(cell as usize) {
            let can = self.constraints.moves(v as usize);
            new |= can && !std::mem::replace(&mut self.moves[v as usize], can);
        }
        new
    }

    /// Lets all vertices of a region move. Returns whether that is new for one of them.
    fn grow(&mut self, region: &Region) -> bool {
        region.cells.iter().filter(|&&cell| self.free(cell)).count() > 0
    }

    /// What moves now, in parts that share no cell.
    fn regions(&self) -> Vec<Region> {
        let mut seen = vec![false; self.elements.cells()];
        let mut regions: Vec<Region> = Vec::new();
        for &start in &self.bad {
            if !seen[start as usize] {
                regions.push(self.region(start, &mut seen));
            }
        }
        regions
    }

    /// The region that cell `start` is in, all of it marked as `seen`.
    fn region(&self, start: u32, seen: &mut [bool]) -> Region {
        seen[start as usize] = true;
        let (mut cells, mut moving, mut next) = (vec![start], Vec::new(), 0);
        while next < cells.len() {
            let vertices = self.elements.vertices_of(cells[next] as usize);
            for v in vertices.filter(|&v| self.moves[v as usize]) {
                moving.push(v);
                let touching = self.stars.of(v as usize).iter().copied();
                cells.extend(touching.filter(|&e| !std::mem::replace(&mut seen[e as usize], true)));
            }
            next += 1;
        }
        cells.sort_unstable();
        moving.sort_unstable();
        moving.dedup();
        let bad = cells.iter().filter(|cell| self.bad.binary_search(cell).is_ok()).count();
        Region { cells, moving, bad }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Cuboid, Voxels};
    use crate::mesh::CellKind;
    use crate::structure::{Polycube, Tolerance};

    const ROOM: Room = Room { rings: 2, elements: 50 };

    fn cube(kind: CellKind, side: i64) -> Corners {
        let mesh = Voxels::from_boxes(&[Cuboid::new([0; 3], [side; 3])]).unwrap().mesh(kind, 1.0).unwrap();
        let polycube = Polycube::new(&mesh, None, &Tolerance::default()).unwrap();
        Corners::new(&polycube, &mesh, &mesh.points)
    }

    #[test]
    fn what_moves_touches_no_element_outside_its_region() {
        for kind in [CellKind::Triangles, CellKind::Tetrahedra] {
            let corners = cube(kind, 12);
            let bad = [0, corners.tetrahedra.len() / 2, corners.tetrahedra.len() - 1];
            let found = regions(&corners, &bad, ROOM);
            assert!((2..=3).contains(&found.len()), "{kind}");
            for region in &found {
                assert!(region.elements.len() >= 50 * region.bad, "{kind}");
                assert!(region.moving.iter().all(|&v| corners.freedom[v as usize] != Freedom::Fixed));
                for (e, t) in corners.tetrahedra.iter().enumerate() {
                    let touches = t.iter().any(|v| region.moving.binary_search(v).is_ok());
                    assert!(!touches || region.elements.binary_search(&(e as u32)).is_ok(), "{kind}, element {e}");
                }
            }
        }
    }

    #[test]
    fn what_cannot_be_turned_is_left_out() {
        let corners = cube(CellKind::Triangles, 1);
        assert!(regions(&corners, &[0, 1], ROOM).is_empty());
    }

    #[test]
    fn a_facet_bounds_its_regions() {
        let corners = cube(CellKind::Triangles, 12);
        let inside = |t: &[u32; 4]| t.iter().all(|&v| corners.freedom[v as usize] != Freedom::Fixed);
        let bad = corners.tetrahedra.iter().position(inside).unwrap();
        let found = regions(&corners, &[bad], Room { rings: 100, elements: 0 });
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].elements.len(), 2 * 12 * 12);
    }
}
