//! Hexahedra: the lattice mapped into the shape, with padding around it (paper, section 7).

use super::embedding::Embedding;
use super::quads::Quads;
use super::remesher::Remesher;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::measure::{CellMeasures, Quality, scaled_jacobian};
use crate::mesh::{CellField, Cells, HexFace, Mesh, Point};
use crate::remesh::lattice::{BoundaryFace, Carrier, Grid, Padding, too_fine};
use crate::remesh::map::{VolumeMap, fill_inside, interpolate};

/// Most padding layers there can be.
pub(crate) const MAX_PADDING: usize = 16;

/// The face of a hexahedron of the padding that looks away from the lattice: its top.
const OUTWARD: u8 = 5;

/// A hexahedral mesh of the shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Hexes {
    /// The mesh, in the units of the shape. Nodes in VTK's order. Some hexahedra may be turned over: see the optimiser.
    pub mesh: Mesh,
    /// The same vertices in the polycube, in lattice units; there no hexahedron is turned over, except at corners
    /// whose facets look both ways along an axis.
    pub polycube: Vec<Point>,
    /// The part of the polycube that each vertex lies on. A surface vertex has no other place than its carrier.
    pub carriers: Vec<Carrier>,
    /// For each hexahedron its block of the base complex, from 0: with padding the padded complex (the blocks of the
    /// polycube, then one for each surface face), without it the unpadded one.
    pub block_id: Vec<u32>,
    /// For each hexahedron the label of its facet at the surface (its first one at edges), 0 to 5; −1 inside.
    pub label: Vec<i8>,
    /// The faces of its outside, in the order of the quadrilaterals of the surface.
    pub boundary: Vec<BoundaryFace>,
    /// How many vertices the map did not hold, so that the nearest point of it was taken.
    pub guessed: usize,
}

impl Hexes {
    /// The hexahedra of the mesh.
    pub(crate) fn cells(&self) -> &[[u32; 8]] {
        match self.mesh.cells() {
            Cells::Hexahedra(cells) => cells,
            _ => &[],
        }
    }

    /// The scaled Jacobians of the hexahedra as they are now. Linear time.
    pub fn quality(&self) -> Quality {
        Quality::new(self.cells().iter().map(|c| scaled_jacobian(self.mesh.points(), c)).collect())
    }

    /// What solvers look at beside that. Linear time.
    pub fn measures(&self) -> CellMeasures {
        CellMeasures::new(&self.mesh).unwrap_or_default()
    }

    /// The fields `block_id`, `label`, `scaled_jacobian` and those of [`CellMeasures`] for mesh files.
    pub fn fields(&self) -> Vec<CellField> {
        let blocks = self.block_id.iter().map(|&b| b as i32).collect();
        let labels = self.label.iter().map(|&l| i32::from(l)).collect();
        let mut fields = vec![
            CellField::integer("block_id", blocks),
            CellField::integer("label", labels),
            CellField::real("scaled_jacobian", self.quality().of_cell),
        ];
        fields.extend(self.measures().fields());
        fields
    }
}

impl Remesher<'_> {
    /// The hexahedral mesh of the lattice with `padding` layers around the polycube inside the shape (0 to
    /// [`MAX_PADDING`]).
    ///
    /// Surface vertices lie on the shape: corners on corners, the others on edges and facets through the triangle map.
    /// Inner ones go through the tetrahedral map where the input is a volume; of a surface the inside is solved
    /// for, as a Laplace problem on the lattice. With padding the outermost layer lies on the shape and the
    /// polycube's surface moves inward. The same bits on every machine; O(n log n) for n hexahedra.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for more padding than [`MAX_PADDING`] or more cells than 32-bit indices allow;
    /// [`ErrorKind::Cancelled`]; [`ErrorKind::Internal`] if a solver fails.
    pub(crate) fn hexes(&self, padding: usize, context: &Context) -> Result<Hexes> {
        check_size(&self.grid, padding)?;
        let outer = self.surface_points(&context.stage("map", 0.0, 0.3))?;
        self.filled(outer, self.volume(), padding, &context.stage("map", 0.3, 1.0))
    }

    /// The same with the surface where `quads` has it, which may have moved; the inside is solved for.
    ///
    /// # Errors
    /// Those of [`hexes`](Self::hexes).
    pub(crate) fn hexes_within(&self, quads: &Quads, padding: usize, context: &Context) -> Result<Hexes> {
        check_size(&self.grid, padding)?;
        let outer = Embedding { points: self.points_of(quads), guessed: quads.guessed };
        self.filled(outer, None, padding, context)
    }

    /// The mesh around which the surface lies already.
    fn filled(
        &self,
        mut outer: Embedding,
        volume: Option<&VolumeMap>,
        padding: usize,
        context: &Context,
    ) -> Result<Hexes> {
        self.place_inside(&mut outer, volume, &context.stage("map", 0.0, 0.9))?;
        if padding == 0 {
            return self.unpadded(outer);
        }
        self.padded(outer, volume, padding, &context.stage("padding", 0.9, 1.0))
    }

    /// Fills in the inner vertices.
    fn place_inside(&self, embedding: &mut Embedding, volume: Option<&VolumeMap>, context: &Context) -> Result<()> {
        let Some(volume) = volume else {
            return fill_inside(&self.grid, &mut embedding.points, context);
        };
        for (v, _) in self.grid.carriers.iter().enumerate().filter(|(_, carrier)| !carrier.is_surface()) {
            context.tick_every(v, self.grid.carriers.len())?;
            embedding.place(v, volume.place(self.grid.position(v)));
        }
        Ok(())
    }

    fn unpadded(&self, embedding: Embedding) -> Result<Hexes> {
        let grid = &self.grid;
        let boundary = grid.boundary()?;
        let mut label = vec![-1; grid.hexes.len()];
        for side in boundary.iter().rev() {
            label[side.face.cell as usize] = side.label.index() as i8;
        }
        Ok(Hexes {
            mesh: Mesh::new(embedding.points, Cells::Hexahedra(grid.hexes.clone()))?,
            polycube: (0..grid.vertices.len()).map(|v| Point::from(grid.position(v))).collect(),
            carriers: grid.carriers.clone(),
            block_id: grid.block.clone(),
            label,
            boundary,
            guessed: embedding.guessed,
        })
    }

    fn padded(
        &self,
        mut embedding: Embedding,
        volume: Option<&VolumeMap>,
        layers: usize,
        context: &Context,
    ) -> Result<Hexes> {
        let grid = &self.grid;
        let padding = Padding::new(grid, layers);
        let mut polycube: Vec<Point> = (0..grid.vertices.len()).map(|v| Point::from(grid.position(v))).collect();
        let mut carriers = vec![Carrier::Inside; grid.vertices.len()];
        let outer: Vec<Point> = padding.ring.iter().map(|&v| embedding.points[v as usize]).collect();
        let lattice = volume.is_none().then(|| embedding.points.clone());
        for layer in 0..=layers {
            for (i, &v) in padding.ring.iter().enumerate() {
                context.tick_every(layer * padding.ring.len() + i, (layers + 1) * padding.ring.len())?;
                let at = padding.position(grid, i, layers - layer);
                let slot = if layer == 0 { v as usize } else { embedding.push(&mut polycube, &mut carriers) };
                polycube[slot] = Point::from(at);
                if layer == layers {
                    (embedding.points[slot], carriers[slot]) = (outer[i], grid.carriers[v as usize]);
                } else if let Some(points) = &lattice {
                    embedding.points[slot] = interpolate(grid, points, at)?;
                } else {
                    embedding.place(slot, volume.and_then(|m| m.place(at)));
                }
            }
        }
        self.assemble(&padding, embedding, polycube, carriers)
    }

    fn assemble(
        &self,
        padding: &Padding,
        embedding: Embedding,
        polycube: Vec<Point>,
        carriers: Vec<Carrier>,
    ) -> Result<Hexes> {
        let grid = &self.grid;
        let (mut hexes, mut block_id) = (grid.hexes.clone(), grid.block.clone());
        let mut label = vec![-1; hexes.len()];
        let mut boundary = Vec::with_capacity(grid.squares.len());
        for (hex, square, outermost) in padding.hexes(grid) {
            let square = &grid.squares[square];
            if outermost {
                let face = HexFace { cell: hexes.len() as u32, face: OUTWARD };
                boundary.push(BoundaryFace { face, label: square.label, facet: square.facet });
            }
            hexes.push(hex);
            block_id.push(grid.blocks.len() as u32 + square.face);
            label.push(square.label.index() as i8);
        }
        let mesh = Mesh::new(embedding.points, Cells::Hexahedra(hexes))?;
        Ok(Hexes { mesh, polycube, carriers, block_id, label, boundary, guessed: embedding.guessed })
    }
}

/// Refuses more layers than [`MAX_PADDING`].
pub(crate) fn check_padding(padding: usize) -> Result<()> {
    if padding <= MAX_PADDING {
        return Ok(());
    }
    Err(Error::new(ErrorKind::Option, format!("{padding} padding layers are too many"))
        .in_option("padding")
        .remedy(format!("use 0 to {MAX_PADDING}")))
}

fn check_size(grid: &Grid, padding: usize) -> Result<()> {
    check_padding(padding)?;
    if (grid.hexes.len() + padding * grid.squares.len()) as u128 * 8 > u128::from(u32::MAX) {
        return Err(too_fine("padding makes more hexahedra than this program can index"));
    }
    Ok(())
}
