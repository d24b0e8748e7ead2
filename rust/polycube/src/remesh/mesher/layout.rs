//! The coarse layout as meshes: one hexahedron per block, one quadrilateral per patch, and the singular edges.

use super::remesher::Remesher;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::hexahedron::OCTANTS;
use crate::mesh::{CellField, Cells, Mesh, Point};
use crate::remesh::lattice::{Padding, Rectangle, rank};

/// A line of edges at which an irregular number of blocks meet.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularEdge {
    /// Its vertices in order, at least two.
    pub points: Vec<Point>,
    /// How many blocks meet at it: without padding, on the surface, 1 or 3; with padding, inside, 3, 5 or more.
    pub valence: u32,
}

/// Blocks and patches as single cells. Neighbours share whole faces and sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// One hexahedron for each block, in the order of [`Hexes::block_id`](super::Hexes::block_id); VTK's node order.
    /// Nothing for a surface alone: the corners of blocks inside have no place there.
    pub blocks: Option<Mesh>,
    /// One quadrilateral for each patch, in the order of [`Quads::patch_id`](super::Quads::patch_id), counter-clockwise
    /// seen from outside.
    pub patches: Mesh,
    /// The label of every patch, 0 to 5.
    pub patch_label: Vec<i8>,
    /// The singular edges: those of the polycube in their order, then with padding those from corners to the surface.
    pub singular: Vec<SingularEdge>,
}

impl Layout {
    /// The field `block_id` of `blocks`, for mesh files.
    pub fn block_fields(&self) -> Vec<CellField> {
        let count = self.blocks.as_ref().map_or(0, |blocks| blocks.cells().len());
        vec![CellField::integer("block_id", (0..count as i32).collect())]
    }
}

impl Remesher<'_> {
    /// The layout on the vertices of a hexahedral mesh of this polycube: `points` has the vertices of
    /// [`hexes`](Self::hexes) with the same `padding`, in the shape (also after optimisation) or in the polycube.
    ///
    /// With padding one block stands on every surface face of the base complex. O(n) for n vertices.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] when `points` are not as many as [`hexes`](Self::hexes) gives.
    pub(crate) fn layout(&self, points: &[Point], padding: usize) -> Result<Layout> {
        let numbers = Numbers { remesher: self, around: Padding::new(&self.grid, padding), padding };
        let expected = self.grid.vertices.len() + padding * numbers.around.ring.len();
        if points.len() != expected {
            let message = format!("{} points for {expected} vertices of the lattice", points.len());
            return Err(Error::new(ErrorKind::Mismatch, message).remedy("give the points of `hexes` with this padding"));
        }
        let blocks = numbers.blocks()?;
        let patches = numbers.patches()?;
        Ok(Layout {
            blocks: Some(Mesh::of_used(points, Cells::Hexahedra(blocks))?.0),
            patches: Mesh::of_used(points, Cells::Quads(patches))?.0,
            patch_label: self.grid.patches.iter().map(|p| p.label.index() as i8).collect(),
            singular: numbers.singular(points)?,
        })
    }
}

/// The numbers of a padded mesh's vertices.
struct Numbers<'a, 'b> {
    remesher: &'a Remesher<'b>,
    around: Padding,
    padding: usize,
}

impl Numbers<'_, '_> {
    /// The vertex over the lattice point `at` in a layer; layer 0 is the lattice.
    fn vertex(&self, at: [i64; 3], layer: usize) -> Result<u32> {
        let grid = &self.remesher.grid;
        let found = rank(&grid.vertices, grid.keys.key(at));
        let found = found.ok_or_else(|| Error::new(ErrorKind::Internal, "a corner of a block is off the lattice"))?;
        Ok(self.around.number(grid, found, layer))
    }

    fn ring(&self, face: &Rectangle, layer: usize) -> Result<[u32; 4]> {
        let [a, b, c, d] = face.corners.map(|at| self.vertex(at, layer));
        Ok([a?, b?, c?, d?])
    }

    fn blocks(&self) -> Result<Vec<[u32; 8]>> {
        let grid = &self.remesher.grid;
        let mut blocks = Vec::new();
        for &[low, high] in &grid.blocks {
            let mut hex = [0; 8];
            for (corner, octant) in hex.iter_mut().zip(OCTANTS) {
                let at = std::array::from_fn(|a| if octant >> a & 1 == 1 { high[a] } else { low[a] });
                *corner = self.vertex(at, 0)?;
            }
            blocks.push(hex);
        }
        for face in grid.faces.iter().filter(|_| self.padding > 0) {
            let ([a, b, c, d], [e, f, g, h]) = (self.ring(face, 0)?, self.ring(face, self.padding)?);
            blocks.push([a, b, c, d, e, f, g, h]);
        }
        Ok(blocks)
    }

    fn patches(&self) -> Result<Vec<[u32; 4]>> {
        self.remesher.grid.patches.iter().map(|p| self.ring(p, self.padding)).collect()
    }

    fn singular(&self, points: &[Point]) -> Result<Vec<SingularEdge>> {
        let structure = &self.remesher.map.polycube.structure;
        let layers = u32::from(self.padding > 0);
        let mut singular = Vec::new();
        for edge in 0..structure.edges.len() {
            let vertices = self.chain(edge)?;
            let valence = if structure.is_convex(&structure.edges[edge]) { 1 } else { 3 } + 2 * layers;
            singular.push(SingularEdge { points: at(points, &vertices), valence });
        }
        if self.padding > 0 {
            self.add_pillars(points, &mut singular)?;
        }
        Ok(singular)
    }

    /// Adds the edges from irregular corners through the padding, each with as many blocks as it has squares around.
    fn add_pillars(&self, points: &[Point], singular: &mut Vec<SingularEdge>) -> Result<()> {
        let Remesher { map, grid, .. } = self.remesher;
        let mut squares = vec![0; grid.vertices.len()];
        grid.squares.iter().flat_map(|s| s.vertices).for_each(|v| squares[v as usize] += 1);
        for corner in &map.structure().corners {
            let position = corner.levels.map(|l| map.levels[l as usize]);
            let vertices: Vec<u32> =
                (0..=self.padding).map(|layer| self.vertex(position, layer)).collect::<Result<_>>()?;
            match squares[vertices[0] as usize] {
                4 => {}
                valence => singular.push(SingularEdge { points: at(points, &vertices), valence }),
            }
        }
        Ok(())
    }

    /// The lattice vertices along an edge of the polycube.
    fn chain(&self, edge: usize) -> Result<Vec<u32>> {
        let Remesher { map, .. } = self.remesher;
        let structure = map.structure();
        let edge = &structure.edges[edge];
        let [low, high] = edge.corners.map(|c| structure.corners[c as usize].levels.map(|l| map.levels[l as usize]));
        let along = |x: i64| {
            let mut at = low;
            at[edge.axis] = x;
            self.vertex(at, 0)
        };
        (low[edge.axis]..=high[edge.axis]).map(along).collect()
    }
}

fn at(points: &[Point], vertices: &[u32]) -> Vec<Point> {
    vertices.iter().map(|&v| points[v as usize]).collect()
}
