//! The dictionary of OpenFOAM's blockMesh: the corners of blocks, how many hexahedra they have, and their edges.
//! Between edges blockMesh interpolates, and then puts the vertices of faces on surfaces, which are written, too.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::hexahedron::FACES;
use crate::mesh::io::text::Text;
use crate::mesh::{Beyond, Block, Blocks, GroupedHexes, Point};
use std::collections::{BTreeMap, BTreeSet};

/// The files of a case, in the order of [`write`].
pub(super) const FILES: [&str; 3] =
    ["system/blockMeshDict", "constant/triSurface/boundary.obj", "constant/triSurface/between.obj"];

const HEADER: &str = "\
FoamFile
{
    version 2.0;
    format ascii;
    class dictionary;
    object blockMeshDict;
}
";

/// The surfaces that vertices inside faces are put on: the outside, and all faces between blocks.
const OUTSIDE: &str = "boundary";
const BETWEEN: &str = "between";

/// Of the edges along each axis of a block, in the order of `hexahedron::EDGES`, the order that blockMesh has them in.
const EDGE_ORDER: [[usize; 4]; 3] = [[0, 1, 3, 2], [0, 1, 3, 2], [0, 1, 2, 3]];

/// The texts of the files.
///
/// # Errors
/// [`ErrorKind::Unsupported`] where two edges or faces have the same corners, by which alone blockMesh knows them.
pub(super) fn write(hexes: &GroupedHexes, blocks: &Blocks) -> Result<[Vec<u8>; 3]> {
    check_faces(hexes, blocks)?;
    let corners: BTreeSet<u32> = blocks.blocks.iter().flat_map(corners).collect();
    let corners = corners.into_iter().zip(0..).collect();
    let dictionary = Dictionary { hexes, blocks, corners, edges: edges(hexes, blocks)? };
    Ok([dictionary.text(), surface(hexes, blocks, true), surface(hexes, blocks, false)].map(Text::into_bytes))
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
        let faces = self.faces();
        text.put(HEADER).put("geometry\n{\n");
        self.geometry(&mut text, &faces);
        text.put("}\nvertices\n(\n");
        self.corners.keys().for_each(|&v| text.put('(').point(self.point(v)).put(')').end());
        text.put(");\nblocks\n(\n");
        self.blocks.blocks.iter().for_each(|block| self.block(&mut text, block));
        text.put(");\nedges\n(\n");
        self.edges.values().filter(|edge| edge.len() > 2).for_each(|edge| self.edge(&mut text, edge));
        text.put(");\nfaces\n(\n");
        for (block, face, surface) in faces {
            text.put(format_args!("project ({}) {surface}\n", self.numbers(&corners_of(block, face))));
        }
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

    /// The surfaces that faces are put on.
    fn geometry(&self, text: &mut Text, faces: &[(&Block, usize, &str)]) {
        for surface in [OUTSIDE, BETWEEN].iter().filter(|surface| faces.iter().any(|face| face.2 == **surface)) {
            // Versions look in different folders for what has no path.
            let file = format!("$FOAM_CASE/constant/triSurface/{surface}.obj");
            text.put(format_args!("{surface}\n{{\n    type triSurfaceMesh;\n    file \"{file}\";\n}}\n"));
        }
    }

    /// The faces that are put on a surface: those with vertices inside. blockMesh divides by how many there are.
    fn faces(&self) -> Vec<(&Block, usize, &'static str)> {
        let all = once_each(self.blocks).into_iter();
        let inside = |block: &Block, face: usize| (0..3).all(|axis| axis == face / 2 || block.size[axis] > 1);
        let surface = |beyond| if matches!(beyond, Beyond::Block(_)) { BETWEEN } else { OUTSIDE };
        all.filter(|(block, face)| inside(block, *face))
            .map(|(block, face)| (block, face, surface(block.faces[face])))
            .collect()
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

/// Every face of blocks, those between two as that of the first.
fn once_each(blocks: &Blocks) -> Vec<(&Block, usize)> {
    let all = (0..).zip(&blocks.blocks).flat_map(|(b, block)| (0..FACES.len()).map(move |face| (b, block, face)));
    let is_first = |&(b, block, face): &(u32, &Block, usize)| match block.faces[face] {
        Beyond::Block(there) => (b, face) < (there.block, there.face.into()),
        Beyond::Outside { .. } => true,
    };
    all.filter(is_first).map(|(_, block, face)| (block, face)).collect()
}

/// The faces on the outside, or those between blocks, as an OBJ file.
fn surface(hexes: &GroupedHexes, blocks: &Blocks, outside: bool) -> Text {
    let all = once_each(blocks).into_iter();
    let wanted = all.filter(|(block, face)| matches!(block.faces[*face], Beyond::Outside { .. }) == outside);
    let quads: Vec<[u32; 4]> = wanted.flat_map(|(block, face)| block.quads(face)).collect();
    let number: BTreeMap<u32, u32> =
        quads.iter().flatten().copied().collect::<BTreeSet<u32>>().into_iter().zip(0..).collect();
    let mut text = Text::default();
    text.put(if outside { "# The outside\n" } else { "# All faces between blocks\n" });
    number.keys().for_each(|&v| text.put("v ").point(&hexes.mesh().points()[v as usize]).end());
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
