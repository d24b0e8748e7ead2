//! Plot3D's grid file of many blocks, as text without blanking: how many, their vertices along each axis, and of each
//! block all x, all y and all z.

use crate::mesh::io::text::Text;
use crate::mesh::{Blocks, GroupedHexes};

/// The text of the file.
pub(super) fn write(hexes: &GroupedHexes, blocks: &Blocks) -> Vec<u8> {
    let mut text = Text::default();
    text.put(blocks.blocks.len()).end();
    for block in &blocks.blocks {
        let [i, j, k] = block.size.map(|n| u64::from(n) + 1);
        text.put(format_args!("{i} {j} {k}\n"));
    }
    let points = hexes.mesh().points();
    for block in &blocks.blocks {
        for axis in [0, 1, 2] {
            for row in block.vertices.chunks(block.size[0] as usize + 1) {
                row.iter().for_each(|&v| {
                    text.float(points[v as usize][axis]).put(' ');
                });
                text.end();
            }
        }
    }
    text.into_bytes()
}
