//! SU2's native format: cells and markers by the numbers that VTK has for them, counted from 0.

use crate::mesh::GroupedHexes;
use crate::mesh::io::text::Text;

const QUADRILATERAL: u32 = 9;
const HEXAHEDRON: u32 = 12;

/// The text of the file.
pub(super) fn write(hexes: &GroupedHexes) -> Vec<u8> {
    let mut text = Text::default();
    text.put("NDIME= 3\nNELEM= ").put(hexes.cells().len()).end();
    for (i, cell) in hexes.cells().iter().enumerate() {
        text.put(HEXAHEDRON).indices(cell, 0).put(' ').put(i).end();
    }
    let points = hexes.mesh().points();
    text.put("NPOIN= ").put(points.len()).end();
    for (i, point) in points.iter().enumerate() {
        text.point(point).put(' ').put(i).end();
    }
    text.put("NMARK= ").put(hexes.sides().members().count()).end();
    for (_, name, faces) in hexes.sides().members() {
        text.put("MARKER_TAG= ").put(name).put("\nMARKER_ELEMS= ").put(faces.len()).end();
        for face in faces {
            text.put(QUADRILATERAL).indices(&hexes.quad(face), 0).end();
        }
    }
    text.into_bytes()
}
