//! The integer lattice inside a polycube: unit cells, the unit squares of its surface, and what each belongs to.

use super::boundary::BoundaryFace;
use super::carrier::Carrier;
use super::keys::{Keys, rank, ranks, too_fine};
use crate::error::{Error, ErrorKind, Result};
use crate::layout::{Block, Complex, Lattice, Patch, Separatrices};
use crate::mesh::HexFace;
use crate::mesh::hexahedron::OCTANTS;
use crate::structure::{Arrangement, Label, Structure, placement_of};

/// A unit square of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Square {
    /// Its lattice vertices, counter-clockwise seen from outside.
    pub(crate) vertices: [u32; 4],
    pub(crate) label: Label,
    pub(crate) facet: u32,
    /// The patch of the layout traced on the surface.
    pub(crate) patch: u32,
    /// The surface face of the base complex.
    pub(crate) face: u32,
}

/// Unit cells and their vertices, both ordered by z, then y, then x.
pub(crate) struct Grid {
    pub(crate) keys: Keys,
    /// The lowest vertex of each cell.
    pub(crate) cells: Vec<u64>,
    /// The block of each cell.
    pub(crate) block: Vec<u32>,
    pub(crate) vertices: Vec<u64>,
    pub(crate) carriers: Vec<Carrier>,
    /// Cells over vertices, in VTK's order.
    pub(crate) hexes: Vec<[u32; 8]>,
    pub(crate) squares: Vec<Square>,
    /// The blocks of the base complex, between integer corners.
    pub(crate) blocks: Vec<[[i64; 3]; 2]>,
    /// The surface faces of the base complex.
    pub(crate) faces: Vec<Rectangle>,
    /// The patches traced on the surface.
    pub(crate) patches: Vec<Rectangle>,
}

/// A rectangle of the surface between integer corners, counter-clockwise seen from outside.
pub(crate) struct Rectangle {
    pub(crate) corners: [[i64; 3]; 4],
    pub(crate) label: Label,
}

impl Grid {
    /// Cuts a valid polycube on the lattice into unit cells. O(n log n) time, O(n) memory for n cells.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] when the lattice is finer than 32-bit indices can count.
    pub(crate) fn new(structure: &Structure, levels: &[i64]) -> Result<Self> {
        let placement = placement_of(levels);
        let arrangement = Arrangement::new(structure, &placement);
        let lattice = Lattice::new(&arrangement);
        let complex = Complex::new(&lattice, &arrangement);
        let keys = keys(&lattice)?;
        let blocks: Vec<[[i64; 3]; 2]> = complex.blocks().iter().map(|b| corners(&lattice, b)).collect();
        check_size(&blocks)?;
        let (cells, block) = unit_cells(&keys, &blocks);
        let mut vertices: Vec<u64> = (0..8).flat_map(|c| cells.iter().map(move |k| k + Keys::octant(c))).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let hexes = hexes(&cells, &vertices)?;
        let faces = complex.surface_faces();
        let patches = Separatrices::new(&lattice, &arrangement).patches();
        let squares = Tilings { keys: &keys, lattice: &lattice }.squares(&arrangement, &patches, &faces, &vertices)?;
        let [faces, patches] = [faces, patches].map(|r| rectangles(&lattice, &r));
        let mut grid = Self { keys, cells, block, carriers: vec![], vertices, hexes, squares, blocks, faces, patches };
        grid.carriers = grid.find_carriers(structure, levels)?;
        Ok(grid)
    }

    /// The lattice coordinates of a vertex.
    pub(crate) fn position(&self, vertex: usize) -> [f64; 3] {
        self.keys.vertex(self.vertices[vertex]).map(|x| x as f64)
    }

    /// The cell whose lowest vertex is `low`, if it is solid.
    pub(crate) fn cell_at(&self, low: [i64; 3]) -> Option<usize> {
        let key = self.keys.checked_key(low)?;
        rank(&self.cells, key).map(|c| c as usize)
    }

    /// The vertices of a cell by octant: bit `a` is set on its upper side along axis `a`.
    pub(crate) fn octants(&self, cell: usize) -> [u32; 8] {
        OCTANTS.map(|k| self.hexes[cell][k])
    }

    /// The face of a cell that each surface square is.
    ///
    /// # Errors
    /// [`ErrorKind::Internal`] unless there is a cell behind every square.
    pub(crate) fn boundary(&self) -> Result<Vec<BoundaryFace>> {
        let face = |square: &Square| {
            let lowest = square.vertices.iter().map(|&v| self.vertices[v as usize]).min().unwrap_or_default();
            let Square { label, facet, .. } = *square;
            let (back, upper) = if label.sign() > 0 { (Keys::step(label.axis()), 1) } else { (0, 0) };
            let cell = rank(&self.cells, lowest - back).ok_or_else(torn)?;
            let face = HexFace { cell, face: (2 * label.axis() + upper) as u8 };
            Ok(BoundaryFace { face, label, facet })
        };
        self.squares.iter().map(face).collect()
    }

    /// The vertices on the surface, ascending.
    pub(crate) fn surface_vertices(&self) -> Vec<u32> {
        (0..).zip(&self.carriers).filter(|(_, s)| s.is_surface()).map(|(v, _)| v).collect()
    }

    fn find_carriers(&self, structure: &Structure, levels: &[i64]) -> Result<Vec<Carrier>> {
        let mut carriers = vec![Carrier::Inside; self.vertices.len()];
        for square in &self.squares {
            square.vertices.iter().for_each(|&v| carriers[v as usize] = Carrier::Facet(square.facet));
        }
        let at = |corner: u32| structure.corners[corner as usize].levels.map(|l| levels[l as usize]);
        for (e, edge) in (0..).zip(&structure.edges) {
            let [low, high] = edge.corners.map(at);
            for x in low[edge.axis] + 1..high[edge.axis] {
                let mut vertex = low;
                vertex[edge.axis] = x;
                *self.carrier(&mut carriers, vertex)? = Carrier::Edge(e);
            }
        }
        for c in 0..structure.corners.len() as u32 {
            *self.carrier(&mut carriers, at(c))? = Carrier::Corner(c);
        }
        Ok(carriers)
    }

    fn carrier<'a>(&self, carriers: &'a mut [Carrier], vertex: [i64; 3]) -> Result<&'a mut Carrier> {
        let found = rank(&self.vertices, self.keys.key(vertex));
        found.and_then(|v| carriers.get_mut(v as usize)).ok_or_else(torn)
    }
}

fn keys(lattice: &Lattice) -> Result<Keys> {
    let end =
        |planes: &Vec<f64>, last: bool| if last { planes.last() } else { planes.first() }.map_or(0, |&x| x as i64);
    Keys::new(lattice.planes.each_ref().map(|p| end(p, false)), lattice.planes.each_ref().map(|p| end(p, true)))
}

fn corners(lattice: &Lattice, block: &Block) -> [[i64; 3]; 2] {
    [block.low, block.high].map(|c| lattice.position(c).map(|x| x as i64))
}

fn rectangles(lattice: &Lattice, patches: &[Patch]) -> Vec<Rectangle> {
    let integer = |at: [usize; 3]| lattice.position(at).map(|x| x as i64);
    patches.iter().map(|p| Rectangle { corners: p.corners().map(integer), label: p.label }).collect()
}

fn volume(&[low, high]: &[[i64; 3]; 2]) -> u128 {
    (0..3).map(|a| (high[a] - low[a]) as u128).product()
}

fn check_size(blocks: &[[[i64; 3]; 2]]) -> Result<()> {
    let cells: u128 = blocks.iter().map(volume).sum();
    if cells * 8 <= u128::from(u32::MAX) {
        return Ok(());
    }
    Err(too_fine(&format!("the lattice has {cells} cells, more than this program can index")))
}

/// All unit cells with their blocks.
fn unit_cells(keys: &Keys, blocks: &[[[i64; 3]; 2]]) -> (Vec<u64>, Vec<u32>) {
    let mut cells = Vec::new();
    for (b, [low, high]) in (0..).zip(blocks) {
        for z in low[2]..high[2] {
            for y in low[1]..high[1] {
                cells.extend((low[0]..high[0]).map(|x| (keys.key([x, y, z]), b)));
            }
        }
    }
    cells.sort_unstable();
    cells.into_iter().unzip()
}

fn hexes(cells: &[u64], vertices: &[u64]) -> Result<Vec<[u32; 8]>> {
    let mut hexes = vec![[0; 8]; cells.len()];
    for (k, c) in OCTANTS.into_iter().enumerate() {
        let found = ranks(vertices, cells.iter().map(|cell| cell + Keys::octant(c))).ok_or_else(torn)?;
        hexes.iter_mut().zip(found).for_each(|(hex, v)| hex[k] = v);
    }
    Ok(hexes)
}

/// One rectangle of a tiling of the surface.
struct Tile {
    label: Label,
    low: [i64; 3],
    high: [i64; 3],
    id: u32,
}

/// A unit square by its lowest vertex and axis, and the tile that holds it.
type Part = (u64, usize, u32);

/// Brings the three tilings of the surface together: facets, patches, and faces of the base complex.
struct Tilings<'a> {
    keys: &'a Keys,
    lattice: &'a Lattice,
}

impl Tilings<'_> {
    fn squares(&self, at: &Arrangement, patches: &[Patch], faces: &[Patch], vertices: &[u64]) -> Result<Vec<Square>> {
        let label = |facet: u32| at.structure().facets[facet as usize].label;
        let integer = |p: [f64; 3]| p.map(|x| x as i64);
        let tiles = at.tiles().map(|(id, l, h)| Tile { label: label(id), low: integer(l), high: integer(h), id });
        let facets = self.parts(tiles);
        let patches = self.parts((0..).zip(patches).map(|(id, p)| self.tile(id, p)));
        let faces = self.parts((0..).zip(faces).map(|(id, p)| self.tile(id, p)));
        let alike = |a: &[Part], b: &[Part]| a.iter().map(|p| (p.0, p.1)).eq(b.iter().map(|p| (p.0, p.1)));
        if !alike(&facets, &patches) || !alike(&facets, &faces) {
            return Err(torn());
        }
        let together = facets.iter().zip(&patches).zip(&faces);
        together.map(|((f, p), s)| square(vertices, f, label(f.2), p.2, s.2)).collect()
    }

    fn tile(&self, id: u32, patch: &Patch) -> Tile {
        let [low, high] = [patch.low, patch.high].map(|p| self.lattice.position(p).map(|x| x as i64));
        Tile { label: patch.label, low, high, id }
    }

    /// The unit squares of all tiles, ordered by vertex and axis.
    fn parts(&self, tiles: impl Iterator<Item = Tile>) -> Vec<Part> {
        let mut parts = Vec::new();
        for Tile { label, low, mut high, id } in tiles {
            high[label.axis()] += 1;
            for z in low[2]..high[2] {
                for y in low[1]..high[1] {
                    parts.extend((low[0]..high[0]).map(|x| (self.keys.key([x, y, z]), label.axis(), id)));
                }
            }
        }
        parts.sort_unstable();
        parts
    }
}

fn square(vertices: &[u64], part: &Part, label: Label, patch: u32, face: u32) -> Result<Square> {
    let &(key, axis, facet) = part;
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3].map(Keys::step);
    let ring = if label.sign() > 0 { [0, u, u + v, v] } else { [0, v, u + v, u] };
    let mut corners = [0; 4];
    for (corner, step) in corners.iter_mut().zip(ring) {
        *corner = rank(vertices, key + step).ok_or_else(torn)?;
    }
    Ok(Square { vertices: corners, label, facet, patch, face })
}

fn torn() -> Error {
    Error::new(ErrorKind::Internal, "the lattice of the polycube does not fit its surface")
        .remedy("validate the polycube; if it is valid, please report this")
}
