//! The block structure as JSON: points, grids of vertices, and what lies beyond the faces of blocks.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{BLOCK_FACES, Beyond, Block, Blocks, GroupedHexes};
use serde::Serialize;

/// The schema that the guide describes.
const VERSION: u32 = 1;

#[derive(Serialize)]
struct File<'a> {
    version: u32,
    hexes: usize,
    inner_faces: usize,
    classes: &'a [u32],
    points: Vec<[f64; 3]>,
    blocks: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct Entry<'a> {
    name: &'a str,
    size: [u32; 3],
    class: [u32; 3],
    sign: [i8; 3],
    faces: [Face<'a>; 6],
    vertices: &'a [u32],
}

#[derive(Serialize)]
#[serde(untagged)]
enum Face<'a> {
    Block { block: u32, face: &'static str, transform: [i8; 3], first: [u32; 3] },
    Outside { patch: &'a str, side: &'a str },
}

/// The text of the file.
pub(super) fn write(hexes: &GroupedHexes, blocks: &Blocks) -> Result<Vec<u8>> {
    let file = File {
        version: VERSION,
        hexes: hexes.cells().len(),
        inner_faces: blocks.inner_faces(),
        classes: &blocks.classes,
        points: hexes.mesh().points().iter().map(|&point| point.into()).collect(),
        blocks: blocks.blocks.iter().map(|block| entry(hexes, block)).collect(),
    };
    serde_json::to_vec(&file).map_err(|error| Error::new(ErrorKind::Internal, format!("no JSON: {error}")))
}

fn entry<'a>(hexes: &'a GroupedHexes, block: &'a Block) -> Entry<'a> {
    Entry {
        name: &hexes.blocks().names()[block.group as usize],
        size: block.size,
        class: block.class,
        sign: block.sign,
        faces: block.faces.map(|beyond| face(hexes, beyond)),
        vertices: &block.vertices,
    }
}

fn face<'a>(hexes: &'a GroupedHexes, beyond: Beyond) -> Face<'a> {
    match beyond {
        Beyond::Block(there) => Face::Block {
            block: there.block,
            face: BLOCK_FACES[usize::from(there.face)],
            transform: there.transform,
            first: there.first,
        },
        Beyond::Outside { patch, side } => Face::Outside {
            patch: &hexes.patches().names()[patch as usize],
            side: &hexes.sides().names()[side as usize],
        },
    }
}
