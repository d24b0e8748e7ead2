//! Which parts of a mesh must move so that inverted cells can be turned the right way round.

use super::elements::Elements;
use super::freedom::Constraints;
use crate::context::Context;
use crate::error::Result;
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
    /// Least number of elements for each inverted cell: a large fold needs a large neighbourhood to be drawn smooth in.
    pub(super) elements: usize,
}

/// The regions around the cells `bad`, of `most` cells together: the largest are left out. Cells without a vertex that
/// can move are in none, as nothing turns them.
pub(super) fn regions(
    elements: &Elements,
    constraints: &Constraints,
    bad: &[usize],
    room: Room,
    most: usize,
    context: &Context,
) -> Result<Vec<Region>> {
    let mut growth = Growth::new(elements, constraints, bad);
    let enough = |r: &Region| elements.cells_in(room.elements * r.bad).min(most / 2);
    let mut ring = 1;
    loop {
        context.check()?;
        let mut regions = growth.regions();
        let small = |r: &&Region| ring <= room.rings || r.cells.len() < enough(r);
        let grown = regions.iter().filter(small).filter(|region| growth.grow(region)).count();
        if grown == 0 {
            keep_small(&mut regions, most);
            return Ok(regions);
        }
        ring += 1;
    }
}

/// Leaves the largest out until the rest has so many cells at most.
fn keep_small(regions: &mut Vec<Region>, most: usize) {
    regions.sort_by_key(|region| region.cells.len());
    let mut sum = 0;
    regions.retain(|region| {
        sum += region.cells.len();
        sum <= most
    });
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
    use crate::optimise::Freedom;

    const ROOM: Room = Room { rings: 2, elements: 400 };
    const SIDE: usize = 12;
    const MIDDLE: usize = SIDE / 2 * (1 + SIDE + SIDE * SIDE);

    /// A cube of cubes.
    fn cube() -> Elements {
        let at = |[x, y, z]: [usize; 3]| (x + (SIDE + 1) * (y + (SIDE + 1) * z)) as u32;
        let cells = (0..SIDE.pow(3)).map(|i| [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE]).map(|[x, y, z]| {
            let layer = |z| [[x, y, z], [x + 1, y, z], [x + 1, y + 1, z], [x, y + 1, z]].map(at);
            let [low, high] = [layer(z), layer(z + 1)];
            [low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]]
        });
        Elements::cubes(&cells.collect::<Vec<_>>())
    }

    /// Vertices inside the cube are free, so many layers below its surface.
    fn inside(layers: usize) -> Vec<Freedom> {
        let side = SIDE + 1;
        let place = |v: usize| [v % side, v / side % side, v / side / side];
        let deep = |v| place(v).iter().all(|&x| (layers..side - layers).contains(&x));
        (0..side.pow(3)).map(|v| if deep(v) { Freedom::Free } else { Freedom::Fixed }).collect()
    }

    fn found(elements: &Elements, constraints: &Constraints, bad: &[usize], room: Room) -> Vec<Region> {
        regions(elements, constraints, bad, room, elements.cells(), &Context::default()).unwrap()
    }

    #[test]
    fn the_largest_regions_are_left_out() {
        let (elements, freedom) = (cube(), inside(1));
        let constraints = Constraints::new(&freedom, &[]).unwrap();
        let bad = [0, MIDDLE];
        let room = Room { rings: 1, elements: 0 };
        let of = |most| regions(&elements, &constraints, &bad, room, most, &Context::default()).unwrap();
        let [small, large] = &of(elements.cells())[..] else { panic!("two regions") };
        assert!(small.cells.contains(&0) && large.cells.contains(&(MIDDLE as u32)));
        assert_eq!(of(small.cells.len() + large.cells.len() - 1).len(), 1);
        assert!(of(small.cells.len() - 1).is_empty());
    }

    #[test]
    fn what_moves_touches_no_cell_outside_its_region() {
        let (elements, freedom) = (cube(), inside(1));
        let constraints = Constraints::new(&freedom, &[]).unwrap();
        let bad = [0, elements.cells() - 1];
        let found = found(&elements, &constraints, &bad, ROOM);
        assert_eq!(found.len(), 2);
        for region in &found {
            assert!(region.cells.len() >= ROOM.elements / 8 * region.bad);
            assert!(region.moving.iter().all(|&v| freedom[v as usize] == Freedom::Free));
            for cell in 0..elements.cells() {
                let touches = elements.vertices_of(cell).any(|v| region.moving.binary_search(&v).is_ok());
                assert!(!touches || region.cells.binary_search(&(cell as u32)).is_ok(), "cell {cell}");
            }
        }
    }

    #[test]
    fn what_cannot_be_turned_is_left_out() {
        let (elements, freedom) = (cube(), inside(2));
        let constraints = Constraints::new(&freedom, &[]).unwrap();
        assert!(found(&elements, &constraints, &[0, elements.cells() - 1], ROOM).is_empty());
    }

    #[test]
    fn what_is_held_bounds_its_regions() {
        let (elements, freedom) = (cube(), inside(3));
        let constraints = Constraints::new(&freedom, &[]).unwrap();
        let found = found(&elements, &constraints, &[MIDDLE], Room { rings: 100, elements: 0 });
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].moving.len(), (SIDE - 5).pow(3));
        assert_eq!(found[0].cells.len(), (SIDE - 4).pow(3));
    }
}
