//! Incremental 3D Delaunay triangulation, generic by a symbolic perturbation.

use super::predicates::{Point, in_sphere, orient};
use super::sites::extent;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};

/// The vertex at infinity: with it the hull's facets are cells too and no insertion is a special case.
const INFINITE: u32 = u32::MAX;
/// A neighbour not yet linked.
const UNKNOWN: u32 = u32::MAX;
/// How many insertions pass between two reports.
const REPORT: usize = 512;

/// Four vertices of positive volume and the cell opposite each. In a cell with the vertex at infinity, which is its
/// first, every point outside the hull's facet would give a positive volume in its place.
#[derive(Clone, Copy)]
struct Cell {
    vertices: [u32; 4],
    neighbours: [u32; 4],
    /// Whether the cell was found in or out of conflict by the insertion of that number.
    seen: u32,
}

/// Triangulates `points`, starting from the four of `frame` and inserting `order`.
///
/// The squared length of each point is thought raised by an infinitesimal, far larger for a later point
/// (Devillers and Teillaud 2011). That leaves no five points cospherical and moves no point: the
/// triangulation is unique, whatever the order of insertion, and every tetrahedron of it has a volume.
///
/// # Errors
/// `Cancelled`; `Internal` if a point cannot be found, which the theory rules out.
pub(super) fn tetrahedra(points: &[Point], frame: [u32; 4], order: &[u32], context: &Context) -> Result<Vec<[u32; 4]>> {
    let mut delaunay = Delaunay::new(points, frame);
    for (done, &p) in order.iter().enumerate() {
        if done % REPORT == 0 {
            context.tick(done as f64 / order.len() as f64)?;
        }
        delaunay.insert(p)?;
    }
    Ok(delaunay.cells.iter().filter(|c| !c.is_infinite()).map(|c| c.vertices).collect())
}

impl Cell {
    fn is_infinite(&self) -> bool {
        self.vertices[0] == INFINITE
    }
}

/// Where `wanted` is among four numbers, 0 if it is not. Looks at all, as a guess where to stop is mostly wrong.
fn position(of: &[u32; 4], wanted: u32) -> usize {
    (1..4).fold(0, |found, i| if of[i] == wanted { i } else { found })
}

struct Delaunay<'a> {
    points: &'a [Point],
    /// The largest coordinate; the least is 0.
    extent: f64,
    cells: Vec<Cell>,
    /// Cells to use again.
    free: Vec<u32>,
    /// A finite cell near the last insertion.
    last: u32,
    /// Number of the insertion, twice: `round` marks cells in conflict, `round + 1` the others.
    round: u32,
    /// The cells in conflict with the point inserted.
    cavity: Vec<u32>,
    /// The facets around the cavity: a cell inside and the vertex opposite.
    rim: Vec<(u32, usize)>,
}

impl<'a> Delaunay<'a> {
    fn new(points: &'a [Point], frame: [u32; 4]) -> Self {
        // There are about seven to a point.
        let mut cells = Vec::with_capacity(8 * points.len());
        cells.push(Cell { vertices: frame, neighbours: [1, 2, 3, 4], seen: 0 });
        for i in 0..4 {
            let mut vertices = frame;
            let mut neighbours = [1, 2, 3, 4];
            vertices[i] = INFINITE;
            neighbours[i] = 0;
            // Seen from outside a facet turns the other way.
            let turned = if i == 0 { (1, 2) } else { (0, i) };
            vertices.swap(turned.0, turned.1);
            neighbours.swap(turned.0, turned.1);
            cells.push(Cell { vertices, neighbours, seen: 0 });
        }
        Self {
            points,
            extent: extent(points),
            cells,
            free: Vec::new(),
            last: 0,
            round: 0,
            cavity: Vec::new(),
            rim: Vec::new(),
        }
    }

    fn insert(&mut self, p: u32) -> Result<()> {
        self.round += 2;
        let start = self.locate(p)?;
        self.carve(start, p);
        self.fill(p);
        Ok(())
    }

    fn cell(&self, c: u32) -> &Cell {
        &self.cells[c as usize]
    }

    fn positions(&self, vertices: [u32; 4]) -> [Point; 4] {
        vertices.map(|v| self.points[v as usize])
    }

    /// On which side of the facet opposite vertex `i` the point lies: +1 on the cell's own.
    fn side(&self, mut vertices: [u32; 4], i: usize, p: u32) -> i32 {
        vertices[i] = p;
        orient(self.positions(vertices), self.extent)
    }

    /// A cell in conflict with `p`, found by walking towards it. In a Delaunay triangulation such a walk
    /// never runs in circles (Edelsbrunner 1990).
    fn locate(&self, p: u32) -> Result<u32> {
        let (mut from, mut at) = (INFINITE, self.last);
        for _ in 0..self.cells.len() {
            let cell = self.cell(at);
            if cell.is_infinite() {
                return Ok(at);
            }
            let leads = |&i: &usize| cell.neighbours[i] != from && self.side(cell.vertices, i, p) < 0;
            match (0..4).find(leads) {
                Some(i) => (from, at) = (at, cell.neighbours[i]),
                None => return Ok(at),
            }
        }
        Err(Error::new(ErrorKind::Internal, "lost on the way to a corner"))
    }

    /// Whether `p` lies in the perturbed circumsphere of cell `c`, or sees the facet if it is infinite.
    fn conflicts(&self, c: u32, p: u32) -> bool {
        let cell = self.cell(c);
        if cell.is_infinite() {
            return match self.side(cell.vertices, 0, p) {
                // In the facet's plane its circle decides, which is where any sphere through it cuts.
                0 => self.conflicts(cell.neighbours[0], p),
                side => side > 0,
            };
        }
        match in_sphere(self.positions(cell.vertices), self.points[p as usize], self.extent) {
            0 => self.conflicts_raised(cell.vertices, p),
            inside => inside > 0,
        }
    }

    /// The same for `p` on the sphere: the most raised of the five points that has a say decides.
    fn conflicts_raised(&self, vertices: [u32; 4], p: u32) -> bool {
        let mut ranked = [0, 1, 2, 3];
        ranked.sort_unstable_by_key(|&i| std::cmp::Reverse(vertices[i]));
        for i in ranked {
            if vertices[i] < p {
                break; // Raising `p` itself takes it out of the sphere.
            }
            match self.side(vertices, i, p) {
                0 => {}
                side => return side > 0,
            }
        }
        false
    }

    /// Collects the cells in conflict with `p`, which hang together, and the facets around them.
    fn carve(&mut self, start: u32, p: u32) {
        self.cavity.clear();
        self.rim.clear();
        self.cells[start as usize].seen = self.round;
        self.cavity.push(start);
        let mut next = 0;
        while let Some(&c) = self.cavity.get(next) {
            next += 1;
            for (i, beyond) in self.cell(c).neighbours.into_iter().enumerate() {
                let mut seen = self.cell(beyond).seen;
                if seen < self.round {
                    seen = self.round + u32::from(!self.conflicts(beyond, p));
                    self.cells[beyond as usize].seen = seen;
                    if seen == self.round {
                        self.cavity.push(beyond);
                    }
                }
                if seen > self.round {
                    self.rim.push((c, i));
                }
            }
        }
    }

    /// Replaces the cavity by the cells that join `p` to its rim.
    fn fill(&mut self, p: u32) {
        let rim = std::mem::take(&mut self.rim);
        for &(c, i) in &rim {
            self.join(c, i, p);
        }
        for &(c, i) in &rim {
            let new = self.cell(c).neighbours[i];
            for j in (0..4).filter(|&j| j != i) {
                if self.cell(new).neighbours[j] == UNKNOWN {
                    let (other, k) = self.around(c, i, j);
                    self.cells[new as usize].neighbours[j] = other;
                    self.cells[other as usize].neighbours[k] = new;
                }
            }
        }
        for &c in &self.cavity {
            self.cells[c as usize].vertices = [INFINITE; 4];
        }
        self.free.extend_from_slice(&self.cavity);
        self.rim = rim;
    }

    /// Makes the cell of `p` and the facet opposite vertex `i` of `c`; `c` points to it from then on.
    fn join(&mut self, c: u32, i: usize, p: u32) {
        let Cell { vertices, neighbours, .. } = *self.cell(c);
        let outer = neighbours[i];
        let new = self.free.pop().unwrap_or(self.cells.len() as u32);
        if new as usize == self.cells.len() {
            self.cells.push(Cell { vertices, neighbours, seen: 0 });
        }
        let cell = &mut self.cells[new as usize];
        *cell = Cell { vertices, neighbours: [UNKNOWN; 4], seen: 0 };
        cell.vertices[i] = p;
        cell.neighbours[i] = outer;
        if !cell.is_infinite() {
            self.last = new;
        }
        let beyond = &mut self.cells[outer as usize].neighbours;
        beyond[position(beyond, c)] = new;
        self.cells[c as usize].neighbours[i] = new;
    }

    /// The new cell on the other side of the facet that `p` spans with the edge opposite vertices `i`
    /// and `j` of `c`, and the facet's number there. Found by turning around that edge through the cavity.
    fn around(&self, c: u32, i: usize, j: usize) -> (u32, usize) {
        let (mut at, mut keep, mut out) = (c, i, j);
        loop {
            let cell = self.cell(at);
            let next = cell.neighbours[out];
            let beyond = self.cell(next);
            if beyond.seen != self.round {
                return (next, keep);
            }
            out = position(&beyond.vertices, cell.vertices[keep]);
            keep = position(&beyond.neighbours, at);
            at = next;
        }
    }
}
