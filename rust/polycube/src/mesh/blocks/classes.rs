//! Edges of blocks that have as many hexahedra as one another, and which way they run.

use super::Block;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::GroupedHexes;
use petgraph::unionfind::UnionFind;

/// Numbers the classes in the order of the blocks and axes that have them first, there with the sign 1, and tells every
/// block of them. Returns how many hexahedra lie along each.
///
/// Each axis of each block is there twice, once for each way to run along it. An edge shared joins the ways that run
/// along it alike; where both ways of an axis come together, there is no way to run.
pub(super) fn number(hexes: &GroupedHexes, blocks: &mut [Block]) -> Result<Vec<u32>> {
    let sets = joined(blocks);
    let mut class = vec![None; sets.len()];
    let mut sizes = Vec::new();
    for (b, block) in blocks.iter_mut().enumerate() {
        for axis in 0..3 {
            let [along, against] = [false, true].map(|turned| sets[node(b, axis, turned)]);
            if along == against {
                return Err(no_way(&hexes.blocks().names()[block.group as usize], axis));
            }
            if class[along].is_none() {
                (class[along], class[against]) = (Some((sizes.len() as u32, 1)), Some((sizes.len() as u32, -1)));
                sizes.push(block.size[axis]);
            }
            (block.class[axis], block.sign[axis]) = class[along].unwrap_or_default();
        }
    }
    Ok(sizes)
}

fn node(block: usize, axis: usize, turned: bool) -> usize {
    2 * (3 * block + axis) + usize::from(turned)
}

/// The set that each way along each axis is in, by one of its members.
fn joined(blocks: &[Block]) -> Vec<usize> {
    let mut edges = Vec::with_capacity(12 * blocks.len());
    for (b, block) in blocks.iter().enumerate() {
        for axis in 0..3 {
            edges.extend(block.edges(axis).map(|edge| {
                let turned: Vec<u32> = edge.iter().rev().copied().collect();
                if turned < edge { (turned, (b, axis, true)) } else { (edge, (b, axis, false)) }
            }));
        }
    }
    edges.sort_unstable();
    let mut sets = UnionFind::<usize>::new(6 * blocks.len());
    for pair in edges.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let [(b, axis, turned), (c, other, back)] = [pair[0].1, pair[1].1];
        for way in [false, true] {
            sets.union(node(b, axis, turned != way), node(c, other, back != way));
        }
    }
    sets.into_labeling()
}

fn no_way(block: &str, axis: usize) -> Error {
    let axis = ["i", "j", "k"][axis];
    Error::new(ErrorKind::Mesh, format!("the edges of {block} along {axis} come back turned round"))
        .remedy("give hexahedra that do not run round a Möbius strip")
}
