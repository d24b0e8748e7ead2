//! What lies beyond the faces of blocks.

use super::{BLOCK_FACES, Beyond, Block, Neighbour};
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::GroupedHexes;
use std::collections::BTreeMap;

/// A face of a block: the axis across it, and the two along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    block: u32,
    face: u8,
}

impl Side {
    fn axis(self) -> usize {
        usize::from(self.face / 2)
    }

    fn is_upper(self) -> bool {
        self.face % 2 == 1
    }

    fn along(self) -> [usize; 2] {
        [[1, 2], [0, 2], [0, 1]][self.axis()]
    }

    fn size(self, blocks: &[Block]) -> [u32; 2] {
        self.along().map(|axis| blocks[self.block as usize].size[axis])
    }

    /// The place in the block of a place on the face.
    fn place(self, blocks: &[Block], at: [u32; 2]) -> [u32; 3] {
        let mut place = [if self.is_upper() { blocks[self.block as usize].size[self.axis()] } else { 0 }; 3];
        let [u, v] = self.along();
        (place[u], place[v]) = (at[0], at[1]);
        place
    }

    fn vertex(self, blocks: &[Block], at: [u32; 2]) -> u32 {
        blocks[self.block as usize].vertex(self.place(blocks, at))
    }

    fn vertices(self, blocks: &[Block]) -> Vec<u32> {
        let [m, n] = self.size(blocks);
        (0..=n).flat_map(|v| (0..=m).map(move |u| [u, v])).map(|at| self.vertex(blocks, at)).collect()
    }
}

/// Tells every block what lies beyond its faces. Faces are the same where all their vertices are: two blocks may share
/// two faces that have the same four corners.
pub(super) fn join(hexes: &GroupedHexes, blocks: &mut [Block]) -> Result<()> {
    let all = (0..blocks.len() as u32).flat_map(|block| (0..6).map(move |face| Side { block, face }));
    let mut keys: Vec<(Vec<u32>, Side)> = all.map(|side| (side.vertices(blocks), side)).collect();
    keys.iter_mut().for_each(|(key, _)| key.sort_unstable());
    keys.sort_unstable();
    let outside = outside(hexes);
    for same in keys.chunk_by(|a, b| a.0 == b.0) {
        match *same {
            [(_, side)] => {
                let beyond = group(hexes, blocks, side, &outside)?;
                blocks[side.block as usize].faces[usize::from(side.face)] = beyond;
            }
            [(_, a), (_, b)] => {
                for (one, other) in [(a, b), (b, a)] {
                    let beyond = neighbour(blocks, one, other).ok_or_else(|| parted(hexes, blocks, one))?;
                    blocks[one.block as usize].faces[usize::from(one.face)] = Beyond::Block(beyond);
                }
            }
            _ => return Err(parted(hexes, blocks, same[0].1)),
        }
    }
    Ok(())
}

/// The number of each face of the outside by its vertices in ascending order.
fn outside(hexes: &GroupedHexes) -> BTreeMap<[u32; 4], usize> {
    let key = |i: usize| {
        let mut key = hexes.quad(i as u32);
        key.sort_unstable();
        (key, i)
    };
    (0..hexes.boundary().len()).map(key).collect()
}

/// The groups that a face of the outside is in.
fn group(hexes: &GroupedHexes, blocks: &[Block], side: Side, outside: &BTreeMap<[u32; 4], usize>) -> Result<Beyond> {
    let ([m, n], mut found) = (side.size(blocks), None);
    for at in (0..n).flat_map(|v| (0..m).map(move |u| [u, v])) {
        let mut key = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[u, v]| side.vertex(blocks, [at[0] + u, at[1] + v]));
        key.sort_unstable();
        let &face = outside.get(&key).ok_or_else(|| parted(hexes, blocks, side))?;
        let patch = hexes.patches().of()[face];
        let first = *found.get_or_insert((patch, hexes.sides().of()[face]));
        if first.0 != patch {
            return Err(mixed(hexes, blocks, side, [first.0, patch]));
        }
    }
    let (patch, side) = found.ok_or_else(|| parted(hexes, blocks, side))?;
    Ok(Beyond::Outside { patch, side })
}

/// How the block of one face goes on in that of the other, which is the same face.
fn neighbour(blocks: &[Block], one: Side, other: Side) -> Option<Neighbour> {
    let size = one.size(blocks);
    let all = (0..=size[1]).flat_map(|v| (0..=size[0]).map(move |u| [u, v]));
    // The first axis may go on in the second, and each may run the other way.
    let turned = |bits: u8, [u, v]: [u32; 2]| {
        let [u, v] = if bits & 1 == 1 { [v, u] } else { [u, v] };
        let [m, n] = other.size(blocks);
        [if bits & 2 == 2 { m.wrapping_sub(u) } else { u }, if bits & 4 == 4 { n.wrapping_sub(v) } else { v }]
    };
    let fits = |bits: &u8| {
        let expected = if bits & 1 == 1 { [size[1], size[0]] } else { size };
        let same = |at| one.vertex(blocks, at) == other.vertex(blocks, turned(*bits, at));
        other.size(blocks) == expected && all.clone().all(same)
    };
    let bits = (0..8).find(fits)?;
    let number = |axis: usize, turned: bool| if turned { -(axis as i8 + 1) } else { axis as i8 + 1 };
    let ([a, b], [u, v]) = (one.along(), other.along());
    let along = [number(u, bits & 2 == 2), number(v, bits & 4 == 4)];
    let mut transform = [number(other.axis(), one.is_upper() == other.is_upper()); 3];
    (transform[a], transform[b]) = if bits & 1 == 1 { (along[1], along[0]) } else { (along[0], along[1]) };
    let first = other.place(blocks, turned(bits, [0, 0]));
    Some(Neighbour { block: other.block, face: other.face, transform, first })
}

fn name<'a>(hexes: &'a GroupedHexes, blocks: &[Block], side: Side) -> (&'static str, &'a str) {
    let group = blocks[side.block as usize].group;
    (BLOCK_FACES[usize::from(side.face)], &hexes.blocks().names()[group as usize])
}

fn parted(hexes: &GroupedHexes, blocks: &[Block], side: Side) -> Error {
    let (face, block) = name(hexes, blocks, side);
    Error::new(ErrorKind::Mismatch, format!("face {face} of {block} is not that of one other block"))
        .remedy("cut the blocks so that they share whole faces")
}

fn mixed(hexes: &GroupedHexes, blocks: &[Block], side: Side, patches: [u32; 2]) -> Error {
    let (face, block) = name(hexes, blocks, side);
    let [one, other] = patches.map(|patch| &hexes.patches().names()[patch as usize]);
    Error::new(ErrorKind::Mismatch, format!("face {face} of {block} is in {one} and in {other}"))
        .remedy("cut the block where they meet")
}
