//! Which part of a mesh must move so that elements can be turned the right way round.

use super::corners::Corners;
use crate::optimise::Freedom;

/// A part of a mesh that can be untangled by itself: what moves in it touches no element outside.
pub(super) struct Region {
    /// Ascending.
    pub(super) elements: Vec<u32>,
    /// The vertices that move; ascending.
    pub(super) moving: Vec<u32>,
    /// How many of the elements are turned over.
    bad: usize,
}

/// How large a region shall be, if facets allow it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// Least number of rings of elements around those turned over.
    pub(super) rings: usize,
    /// Least number of elements for each turned over: a large fold needs a large neighbourhood to be drawn smooth in.
    pub(super) elements: usize,
}

/// The regions around the elements `bad`. Those without a vertex that can move are in none, as nothing turns them.
pub(super) fn regions(corners: &Corners, bad: &[usize], room: Room) -> Vec<Region> {
    let mut growth = Growth::new(corners, bad);
    for ring in 1.. {
        let regions = growth.regions();
        let small = |r: &&Region| ring <= room.rings || r.elements.len() < room.elements * r.bad;
        let grown = regions.iter().filter(small).filter(|region| growth.grow(region)).count();
        if grown == 0 {
            return regions;
        }
    }
    Vec::new()
}

/// Vertices that move, ring by ring more of them.
struct Growth<'a> {
    corners: &'a Corners,
    around: Around,
    /// Elements turned over, ascending.
    bad: Vec<u32>,
    moves: Vec<bool>,
}

impl<'a> Growth<'a> {
    fn new(corners: &'a Corners, bad: &[usize]) -> Self {
        let own = |v: u32| (v as usize) < corners.vertices && is_free(corners, v);
        let can_turn = |e: &u32| corners.tetrahedra[*e as usize].iter().any(|&v| own(v));
        let bad = bad.iter().map(|&e| e as u32).filter(can_turn).collect();
        let mut growth = Self { corners, around: Around::new(corners), bad, moves: vec![false; corners.points.len()] };
        for i in 0..growth.bad.len() {
            growth.free(growth.bad[i]);
        }
        growth
    }

    /// Lets the vertices of an element move. Returns whether that is new for one of them.
    fn free(&mut self, element: u32) -> bool {
        let mut new = false;
        for v in self.corners.tetrahedra[element as usize] {
            let free = is_free(self.corners, v);
            new |= free && !std::mem::replace(&mut self.moves[v as usize], free);
        }
        new
    }

    /// Lets all vertices of a region move. Returns whether that is new for one of them.
    fn grow(&mut self, region: &Region) -> bool {
        region.elements.iter().filter(|&&e| self.free(e)).count() > 0
    }

    /// What moves now, in parts that share no element.
    fn regions(&self) -> Vec<Region> {
        let mut seen = vec![false; self.corners.tetrahedra.len()];
        let mut regions: Vec<Region> = Vec::new();
        for &start in &self.bad {
            if !seen[start as usize] {
                regions.push(self.region(start, &mut seen));
            }
        }
        regions
    }

    /// The region that element `start` is in, all of it marked as `seen`.
    fn region(&self, start: u32, seen: &mut [bool]) -> Region {
        seen[start as usize] = true;
        let (mut elements, mut moving, mut next) = (vec![start], Vec::new(), 0);
        while next < elements.len() {
            let corners = self.corners.tetrahedra[elements[next] as usize];
            for v in corners.into_iter().filter(|&v| self.moves[v as usize]) {
                moving.push(v);
                let touching = self.around.of(v).iter().copied();
                elements.extend(touching.filter(|&e| !std::mem::replace(&mut seen[e as usize], true)));
            }
            next += 1;
        }
        elements.sort_unstable();
        moving.sort_unstable();
        moving.dedup();
        let bad = elements.iter().filter(|e| self.bad.binary_search(e).is_ok()).count();
        Region { elements, moving, bad }
    }
}

fn is_free(corners: &Corners, vertex: u32) -> bool {
    corners.freedom[vertex as usize] != Freedom::Fixed
}

/// The elements at each vertex.
struct Around {
    /// Of each vertex, the range in `elements`.
    starts: Vec<u32>,
    elements: Vec<u32>,
}

impl Around {
    fn new(corners: &Corners) -> Self {
        let mut starts = vec![0_u32; corners.points.len() + 1];
        corners.tetrahedra.iter().flatten().for_each(|&v| starts[v as usize + 1] += 1);
        (1..starts.len()).for_each(|v| starts[v] += starts[v - 1]);
        let mut next = starts.clone();
        let mut elements = vec![0; 4 * corners.tetrahedra.len()];
        for (i, tetrahedron) in corners.tetrahedra.iter().enumerate() {
            for &v in tetrahedron {
                elements[next[v as usize] as usize] = i as u32;
                next[v as usize] += 1;
            }
        }
        Self { starts, elements }
    }

    fn of(&self, vertex: u32) -> &[u32] {
        &self.elements[self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize]
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
