//! The input of Abaqus and CalculiX: keywords with parameters, numbers counted from 1.

use crate::mesh::io::text::Text;
use crate::mesh::{GroupedHexes, Groups};

/// The numbers that the faces of a C3D8 element have, by their places in `hexahedron::FACES`.
const FACES: [u8; 6] = [6, 4, 3, 5, 1, 2];

/// The most numbers that a line of a set may have.
const PER_LINE: usize = 16;

/// The text of the file.
pub(super) fn write(hexes: &GroupedHexes) -> Vec<u8> {
    let mut text = Text::default();
    text.put("*NODE, NSET=all_nodes\n");
    for (i, point) in (1_u64..).zip(hexes.mesh().points()) {
        // CalculiX reads 20 characters of a number: more digits would cost it the exponent.
        text.put(format_args!("{i}, {:.12e}, {:.12e}, {:.12e}\n", point.x, point.y, point.z));
    }
    text.put("*ELEMENT, TYPE=C3D8, ELSET=all_elements\n");
    for (i, cell) in (1_u64..).zip(hexes.cells()) {
        text.put(i);
        for &v in cell {
            text.put(", ").put(u64::from(v) + 1);
        }
        text.end();
    }
    for (_, name, cells) in hexes.blocks().members() {
        text.put("*ELSET, ELSET=").put(name).end();
        numbers(&mut text, &cells);
    }
    hexes.sides_apart().iter().for_each(|sides| groups(&mut text, hexes, sides));
    groups(&mut text, hexes, hexes.patches());
    text.into_bytes()
}

/// Nodes and faces of groups of the outside.
fn groups(text: &mut Text, hexes: &GroupedHexes, groups: &Groups) {
    for (_, name, faces) in groups.members() {
        let mut nodes: Vec<u32> = faces.iter().flat_map(|&face| hexes.quad(face)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        text.put("*NSET, NSET=").put(name).end();
        numbers(text, &nodes);
        text.put("*SURFACE, TYPE=ELEMENT, NAME=").put(name).end();
        for side in faces.iter().map(|&face| hexes.boundary()[face as usize]) {
            text.put(u64::from(side.cell) + 1).put(", S").put(FACES[usize::from(side.face)]).end();
        }
    }
}

fn numbers(text: &mut Text, members: &[u32]) {
    for line in members.chunks(PER_LINE) {
        let line: Vec<String> = line.iter().map(|&i| (u64::from(i) + 1).to_string()).collect();
        text.put(line.join(", ")).end();
    }
}
