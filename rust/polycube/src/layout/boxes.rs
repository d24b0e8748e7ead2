//! The pieces of a layout as boxes and rectangles of the lattice.

use super::complex::Complex;
use super::lattice::Lattice;
use super::separatrices::Separatrices;
use crate::mesh::hexahedron::OCTANTS;
use crate::structure::Label;

/// A block: the lattice cells between two lattice vertices, in ranks (see [`Lattice::rank`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Block {
    /// The lower corner.
    pub low: [usize; 3],
    /// The upper corner, above `low` along every axis.
    pub high: [usize; 3],
}

/// A rectangle of the surface between two lattice vertices, in ranks (see [`Lattice::rank`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patch {
    /// The direction it looks at.
    pub label: Label,
    /// The lower corner.
    pub low: [usize; 3],
    /// The upper corner; equal to `low` along the axis of `label`.
    pub high: [usize; 3],
}

impl Block {
    /// The eight corners in VTK's order of a hexahedron's vertices.
    pub fn corners(&self) -> [[usize; 3]; 8] {
        let ends = [self.low, self.high];
        OCTANTS.map(|o| std::array::from_fn(|a| ends[o >> a & 1][a]))
    }
}

impl Patch {
    /// The four corners, counter-clockwise seen from outside.
    pub fn corners(&self) -> [[usize; 3]; 4] {
        let (axis, ends) = (self.label.axis(), [self.low, self.high]);
        let turn =
            if self.label.sign() > 0 { [(0, 0), (1, 0), (1, 1), (0, 1)] } else { [(0, 0), (0, 1), (1, 1), (1, 0)] };
        turn.map(|(i, j)| {
            let mut corner = self.low;
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            (corner[u], corner[v]) = (ends[i][u], ends[j][v]);
            corner
        })
    }
}

impl Complex<'_> {
    /// The blocks of the unpadded base complex, in the order of their lowest cells. They fill the polycube
    /// and meet face to face. O(c) for c lattice cells.
    pub fn blocks(&self) -> Vec<Block> {
        let lattice = self.lattice();
        (0..lattice.len()).filter(|&c| self.starts_block(c)).map(|c| self.block(c)).collect()
    }

    /// The faces of the unpadded base complex on the surface: one padding block grows from each. They tile the
    /// surface and meet side to side; ordered by axis, then by their lowest lattice faces. O(c) for c lattice cells.
    pub fn surface_faces(&self) -> Vec<Patch> {
        let starts = |c: usize, axis: usize| self.starts_surface_face(c, axis);
        let ends = |solid: usize, along: usize| self.is_sheet(solid, along);
        rectangles(self.lattice(), starts, |face, along| ends(face.solid, along))
    }

    fn block(&self, cell: usize) -> Block {
        let lattice = self.lattice();
        let low = lattice.coordinates(cell);
        let high = std::array::from_fn(|axis| {
            let stride = lattice.stride(axis);
            let mut next = cell + stride;
            while lattice.is_solid(next) && !self.is_sheet(next, axis) {
                next += stride;
            }
            lattice.coordinates(next)[axis]
        });
        Block { low, high }
    }
}

impl Separatrices<'_> {
    /// The patches: rectangles inside one facet each, that tile the surface and meet side to side; ordered by
    /// axis, then by their lowest lattice faces. O(c) for c lattice cells.
    pub fn patches(&self) -> Vec<Patch> {
        let starts = |c: usize, axis: usize| self.starts_patch(c, axis);
        rectangles(self.lattice(), starts, |face, along| self.separates(face.at, 3 - face.axis - along))
    }
}

/// A lattice face on the surface.
#[derive(Clone, Copy)]
struct Flat {
    /// The lattice vertex at its lowest corner.
    at: usize,
    axis: usize,
    solid: usize,
    empty: usize,
}

impl Flat {
    fn at(lattice: &Lattice, at: usize, axis: usize) -> Self {
        let below = at - lattice.stride(axis);
        let (solid, empty) = if lattice.is_solid(at) { (at, below) } else { (below, at) };
        Self { at, axis, solid, empty }
    }

    /// Whether the next lattice face along `along` belongs to the same facet.
    fn goes_on(&self, lattice: &Lattice, along: usize) -> bool {
        let stride = lattice.stride(along);
        lattice.is_solid(self.solid + stride) && !lattice.is_solid(self.empty + stride)
    }
}

/// The rectangle above every lattice face that `starts` one; `ends(face, along)` tells whether the line at the lower
/// side of `face` along `along` is a border.
fn rectangles(
    lattice: &Lattice,
    starts: impl Fn(usize, usize) -> bool,
    ends: impl Fn(Flat, usize) -> bool,
) -> Vec<Patch> {
    let faces = (0..3).flat_map(|axis| (0..lattice.len()).map(move |c| (c, axis)));
    let rectangle = |(c, axis): (usize, usize)| {
        let first = Flat::at(lattice, c, axis);
        let low = lattice.coordinates(c);
        let mut high = low;
        for along in (0..3).filter(|&a| a != axis) {
            let mut face = first;
            loop {
                high[along] += 1;
                let goes_on = face.goes_on(lattice, along);
                face = Flat::at(lattice, face.at + lattice.stride(along), axis);
                if !goes_on || ends(face, along) {
                    break;
                }
            }
        }
        let label = Label::facing(axis, !lattice.is_solid(c));
        Patch { label, low, high }
    };
    faces.filter(|&(c, axis)| starts(c, axis)).map(rectangle).collect()
}
