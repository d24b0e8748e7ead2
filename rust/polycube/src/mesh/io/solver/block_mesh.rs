//! The dictionary of OpenFOAM's blockMesh: the corners of blocks, how many hexahedra they have, and their edges.
//! Between edges blockMesh interpolates, and then puts the vertices of the outside on a surface, which is written, too.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::hexahedron::FACES;
use crate::mesh::io::text::Text;
use crate::mesh::{Beyond, Block, Blocks, GroupedHexes, Point};
use std::collections::{BTreeMap, BTreeSet};

/// The files of a case, in the order of [`write`].
pub(super) const FILES: [&str; 2] = ["system/blockMeshDict", "constant/triSurface/boundary.obj"];

const HEADER: &str = "\
FoamFile
{
    version 2.0;
    format ascii;
    class dictionary;
    object blockMeshDict;
}
geometry
{
    boundary
    {
        type triSurfaceMesh;
        // Not by its name alone, as versions look in different folders.
        file \"$FOAM_CASE/constant/triSurface/boundary.obj\";
    }
}";

/// Of the edges along each axis of a block, in the order of `hexahedron::EDGES`, the order that blockMesh has them in.
const EDGE_ORDER: [[usize; 4]; 3] = [[0, 1, 3, 2], [0, 1, 3, 2], [0, 1, 2, 3]];

/// The texts of the files.
///
/// # Errors
/// [`ErrorKind::Unsupported`] where two edges or faces have the same corners, by which alone blockMesh knows them.
pub(super) fn write(hexes: &GroupedHexes, blocks: &Blocks) -> Result<[Vec<u8>; 2]> {
    check_faces(hexes, blocks)?;
    let corners: BTreeSet<u32> = blocks.blocks.iter().flat_map(corners).collect();
    let corners = corners.into_iter().zip(0..).collect();
    let dictionary = Dictionary { hexes, blocks, corners, edges: edges(hexes, blocks)? };
    Ok([dictionary.text(), surface(hexes)].map(Text::into_bytes))
}

struct Dictionary<'a> {
    hexes: &'a GroupedHexes<'a>,
    blocks: &'a Blocks,
    /// The number that each corner of a block gets.
    corners: BTreeMap<u32, u32>,
    /// All edges of blocks with their vertices, by their ends, the lower one first.
    edges: BTreeMap<[u32; 2], Vec<u32>>,
}

impl Dictionary<'_> {
    fn text(&self) -> Text {
        let mut text = Text::default();
        text.put(HEADER).put("\nvertices\n(\n");
        self.corners.keys().for_each(|&v| text.put('(').point(self.point(v)).put(')').end());
        text.put(");\nblocks\n(\n");
        self.blocks.blocks.iter().for_each(|block| self.block(&mut text, block));
        text.put(");\nedges\n(\n");
        self.edges.values().filter(|edge| edge.len() > 2).for_each(|edge| self.edge(&mut text, edge));
        text.put(");\nfaces\n(\n");
        self.faces(&mut text);
        text.put(");\nboundary\n(\n");
        self.boundary(&mut text);
        text.put(");\n");
        text
    }

    fn point(&self, v: u32) -> &Point {
        &self.hexes.mesh().points()[v as usize]
    }

    /// A block with how far each vertex of its edges is from the last one: a section for each hexahedron.
    fn block(&self, text: &mut Text, block: &Block) {
        let [i, j, k] = block.size;
        text.put("hex (").put(self.numbers(&corners(block)));
        text.put(format_args!(
            ") {} ({i} {j} {k})\nedgeGrading\n(\n",
            self.hexes.blocks().names()[block.group as usize]
        ));
        for (axis, order) in EDGE_ORDER.into_iter().enumerate() {
            let edges = block.edges(axis);
            order.into_iter().for_each(|e| self.sections(text, &edges[e]));
        }
        text.put(")\n");
    }

    fn sections(&self, text: &mut Text, edge: &[u32]) {
        text.put('(');
        for pair in edge.windows(2) {
            text.put('(').float((self.point(pair[1]) - self.point(pair[0])).norm()).put(" 1 1)");
        }
        text.put(")\n");
    }

    fn edge(&self, text: &mut Text, edge: &[u32]) {
        let [.., last] = edge else { return };
        text.put("polyLine ").put(self.numbers(&[edge[0], *last])).put(" (");
        edge[1..edge.len() - 1].iter().for_each(|&v| {
            text.put('(').point(self.point(v)).put(')');
        });
        text.put(")\n");
    }

    /// The faces that are put on the surface. Those without inner vertices are where they belong, and blockMesh would
    /// divide by their number.
    fn faces(&self, text: &mut Text) {
        for (block, face) in self.blocks.blocks.iter().flat_map(|block| (0..FACES.len()).map(move |face| (block, face)))
        {
            let has_inner = (0..3).all(|axis| axis == face / 2 || block.size[axis] > 1);
            if has_inner && matches!(block.faces[face], Beyond::Outside { .. }) {
                let numbers = self.numbers(&corners_of(block, face));
                text.put(format_args!("project ({numbers}) boundary\n"));
            }
        }
    }

    /// The patches with the faces of blocks.
    fn boundary(&self, text: &mut Text) {
        let mut faces: BTreeMap<(u32, u32), Vec<[u32; 4]>> = BTreeMap::new();
        for block in &self.blocks.blocks {
            for (face, beyond) in block.faces.iter().enumerate() {
                if let &Beyond::Outside { patch, side } = beyond {
                    faces.entry((patch, side)).or_default().push(corners_of(block, face));
                }
            }
        }
        for ((patch, side), faces) in faces {
            let [patch, side] = [(self.hexes.patches(), patch), (self.hexes.sides(), side)]
                .map(|(groups, number)| &groups.names()[number as usize]);
            text.put(format_args!("{patch}\n{{\n    type patch;\n    inGroups ({side});\n    faces\n    (\n"));
            for face in faces {
                text.put(format_args!("        ({})\n", self.numbers(&face)));
            }
            text.put("    );\n}\n");
        }
    }

    /// The numbers of corners.
    fn numbers(&self, vertices: &[u32]) -> String {
        let numbers: Vec<String> = vertices.iter().map(|v| self.corners[v].to_string()).collect();
        numbers.join(" ")
    }
}

/// The corners of a block in VTK's order, which is that of blockMesh.
fn corners(block: &Block) -> [u32; 8] {
    block.corners().map(|at| block.vertex(at))
}

/// The corners of a face of a block, counter-clockwise seen from outside.
fn corners_of(block: &Block, face: usize) -> [u32; 4] {
    FACES[face].map(|k| corners(block)[k])
}

/// The outside as an OBJ file.
fn surface(hexes: &GroupedHexes) -> Text {
    let quads: Vec<[u32; 4]> = (0..hexes.boundary().len()).map(|face| hexes.quad(face as u32)).collect();
    let vertices: BTreeSet<u32> = quads.iter().flatten().copied().collect();
    let mut text = Text::default();
    vertices.iter().for_each(|&v| text.put("v ").point(&hexes.mesh().points()[v as usize]).end());
    let number: BTreeMap<u32, u32> = vertices.into_iter().zip(0..).collect();
    quads.iter().for_each(|quad| text.put('f').indices(&quad.map(|v| number[&v]), 1).end());
    text
}

/// All edges of blocks by their ends.
fn edges(hexes: &GroupedHexes, blocks: &Blocks) -> Result<BTreeMap<[u32; 2], Vec<u32>>> {
    let mut all: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for block in &blocks.blocks {
        for mut edge in (0..3).flat_map(|axis| block.edges(axis)) {
            if edge.first() > edge.last() {
                edge.reverse();
            }
            let ends = [edge[0], edge[edge.len() - 1]];
            if all.entry(ends).or_insert_with(|| edge.clone()) != &edge {
                return Err(ambiguous(hexes, block, "edge"));
            }
        }
    }
    Ok(all)
}

/// Refuses faces that have the corners of another one, and blocks that have a corner twice.
fn check_faces(hexes: &GroupedHexes, blocks: &Blocks) -> Result<()> {
    let mut known: BTreeMap<[u32; 4], usize> = BTreeMap::new();
    let all = || blocks.blocks.iter().flat_map(|block| (0..FACES.len()).map(move |face| (block, face)));
    let key = |block: &Block, face: usize| {
        let mut key = corners_of(block, face);
        key.sort_unstable();
        key
    };
    all().for_each(|(block, face)| *known.entry(key(block, face)).or_default() += 1);
    for (block, face) in all() {
        let sharing = if matches!(block.faces[face], Beyond::Block(_)) { 2 } else { 1 };
        let key = key(block, face);
        if known[&key] != sharing || key.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(ambiguous(hexes, block, "face"));
        }
    }
    Ok(())
}

fn ambiguous(hexes: &GroupedHexes, block: &Block, what: &str) -> Error {
    let name = &hexes.blocks().names()[block.group as usize];
    let message = format!("blockMesh knows a {what} by its corners, and another has those of one of {name}");
    Error::new(ErrorKind::Unsupported, message).remedy("write foam or json instead")
}
