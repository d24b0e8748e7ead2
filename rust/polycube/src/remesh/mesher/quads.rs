//! Quadrilaterals: the lattice's surface mapped onto the shape (paper, section 7, "Coarse Quad-Layouts").

use super::embedding::Embedding;
use super::remesher::Remesher;
use crate::context::Context;
use crate::error::Result;
use crate::measure::{Quality, quadrilateral_scaled_jacobian};
use crate::mesh::{CellField, Cells, Mesh, Point};
use crate::remesh::lattice::Carrier;

/// A quadrilateral mesh of the shape's surface. Fields have one value per quadrilateral.
#[derive(Clone, Debug, PartialEq)]
pub struct Quads {
    /// The mesh, in the units of the shape, counter-clockwise seen from outside. Its vertices lie on the shape.
    pub mesh: Mesh,
    /// The same vertices on the polycube, in lattice units.
    pub polycube: Vec<Point>,
    /// The corner, edge or facet that each vertex lies on.
    pub carriers: Vec<Carrier>,
    /// The label, 0 to 5.
    pub label: Vec<i8>,
    /// The patch, from 0: as many as `surface_patches`.
    pub patch_id: Vec<u32>,
    /// The padding block below it in the padded base complex: from `blocks` to `blocks_padded`.
    pub block_id: Vec<u32>,
    /// How many vertices the map did not hold, so that the nearest point of it was taken.
    pub guessed: usize,
}

impl Quads {
    /// The scaled Jacobians of the quadrilaterals: how near each is to a rectangle.
    /// Linear time.
    pub fn quality(&self) -> Quality {
        let Cells::Quads(quads) = self.mesh.cells() else { return Quality::new(Vec::new()) };
        Quality::new(quads.iter().map(|q| quadrilateral_scaled_jacobian(self.mesh.points(), q)).collect())
    }

    /// The fields `label`, `patch_id` and `block_id` for mesh files.
    pub fn fields(&self) -> Vec<CellField> {
        let numbers = |ids: &[u32]| ids.iter().map(|&i| i as i32).collect();
        let labels = self.label.iter().map(|&l| i32::from(l)).collect();
        vec![
            CellField::integer("label", labels),
            CellField::integer("patch_id", numbers(&self.patch_id)),
            CellField::integer("block_id", numbers(&self.block_id)),
        ]
    }
}

impl Quads {
    /// The mesh edges that lie on edges of the polycube, as pairs of vertices, the lower one first, in ascending order.
    /// O(n log n) for n quadrilaterals.
    pub fn feature_edges(&self) -> Vec<[u32; 2]> {
        let mut sides: Vec<([u32; 2], i8)> = Vec::with_capacity(4 * self.label.len());
        for (i, &label) in self.label.iter().enumerate() {
            let quad = self.mesh.cells().cell(i);
            let side = |k: usize| [quad[k].min(quad[(k + 1) % 4]), quad[k].max(quad[(k + 1) % 4])];
            sides.extend((0..4).map(|k| (side(k), label)));
        }
        sides.sort_unstable();
        // Both facets at an edge of the polycube look along other axes, and two of one label do not meet at a side.
        let at_edge = |pair: &&[([u32; 2], i8)]| pair.iter().any(|(_, label)| *label != pair[0].1);
        sides.chunk_by(|a, b| a.0 == b.0).filter(at_edge).map(|pair| pair[0].0).collect()
    }
}

impl Remesher<'_> {
    /// The surface of the lattice on the shape: corners go to corners, lattice vertices of an edge along the edge,
    /// others through the triangles of their facet. O(n log n) for n quadrilaterals.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
    pub(crate) fn quads(&self, context: &Context) -> Result<Quads> {
        let grid = &self.grid;
        let embedding = self.surface_points(context)?;
        let ring = grid.surface_vertices();
        let mut number = vec![0; grid.vertices.len()];
        for (i, &v) in (0..).zip(&ring) {
            number[v as usize] = i;
        }
        let quads = grid.squares.iter().map(|s| s.vertices.map(|v| number[v as usize])).collect();
        Ok(Quads {
            mesh: Mesh::new(ring.iter().map(|&v| embedding.points[v as usize]).collect(), Cells::Quads(quads))?,
            polycube: ring.iter().map(|&v| Point::from(grid.position(v as usize))).collect(),
            carriers: ring.iter().map(|&v| grid.carriers[v as usize]).collect(),
            label: grid.squares.iter().map(|s| s.label.index() as i8).collect(),
            patch_id: grid.squares.iter().map(|s| s.patch).collect(),
            block_id: grid.squares.iter().map(|s| grid.blocks.len() as u32 + s.face).collect(),
            guessed: embedding.guessed,
        })
    }

    /// The facet of each quadrilateral.
    pub(crate) fn facets(&self) -> Vec<u32> {
        self.grid.squares.iter().map(|s| s.facet).collect()
    }

    /// The lattice's vertices with those on the surface where `quads` has them.
    pub(crate) fn points_of(&self, quads: &Quads) -> Vec<Point> {
        let mut points = vec![Point::origin(); self.grid.vertices.len()];
        let ring = self.grid.surface_vertices();
        ring.iter().zip(quads.mesh.points()).for_each(|(&v, p)| points[v as usize] = *p);
        points
    }

    /// The vertices of [`quads`](Self::quads) among `points`, which has the vertices of [`hexes`](Self::hexes) with
    /// this `padding`.
    pub(crate) fn surface_of(&self, points: &[Point], padding: usize) -> Vec<Point> {
        let ring = self.grid.surface_vertices();
        match padding {
            0 => ring.iter().map(|&v| points[v as usize]).collect(),
            // The outermost layer comes last.
            _ => points[points.len() - ring.len()..].to_vec(),
        }
    }

    /// The lattice's vertices with those on the surface put on the shape.
    pub(crate) fn surface_points(&self, context: &Context) -> Result<Embedding> {
        let grid = &self.grid;
        let mut embedding = Embedding::new(grid.vertices.len());
        for (v, &carrier) in grid.carriers.iter().enumerate().filter(|(_, carrier)| carrier.is_surface()) {
            context.tick_every(v, grid.carriers.len())?;
            embedding.place(v, self.surface.place(carrier, grid.position(v)));
        }
        Ok(embedding)
    }
}
