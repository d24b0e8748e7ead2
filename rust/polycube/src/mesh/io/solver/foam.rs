//! OpenFOAM's mesh as text: faces with the cell that they look away from and the one that they look at.

use crate::mesh::hexahedron::shared_faces;
use crate::mesh::io::text::Text;
use crate::mesh::{GroupedHexes, HexFace};

/// The files of a mesh in a case, in the order of [`write`].
pub(super) const FILES: [&str; 6] = [
    "constant/polyMesh/points",
    "constant/polyMesh/faces",
    "constant/polyMesh/owner",
    "constant/polyMesh/neighbour",
    "constant/polyMesh/boundary",
    "constant/polyMesh/cellZones",
];

/// The texts of the files.
pub(super) fn write(hexes: &GroupedHexes) -> [Vec<u8>; 6] {
    let (mut faces, neighbours): (Vec<HexFace>, Vec<u32>) = inner_faces(hexes.cells()).into_iter().unzip();
    let boundary = boundary(hexes, &mut faces);
    let counts = [hexes.mesh().points().len(), hexes.cells().len(), faces.len(), neighbours.len()];
    [
        points(hexes),
        faces_of(hexes, &faces),
        owners(&faces, counts),
        neighbours_of(&neighbours, counts),
        boundary,
        zones(hexes),
    ]
    .map(Text::into_bytes)
}

/// The faces between two hexahedra, seen from the one with the lower number, with the other one; ordered by both, as
/// OpenFOAM wants the entries above the diagonal of its matrices.
fn inner_faces(cells: &[[u32; 8]]) -> Vec<(HexFace, u32)> {
    let pairs = shared_faces(cells).into_iter().map(|[owner, neighbour]| (owner, neighbour.cell));
    let mut inner: Vec<_> = pairs.collect();
    inner.sort_unstable_by_key(|&(face, neighbour)| (face.cell, neighbour, face.face));
    inner
}

/// The file of patches, whose faces are added to `faces`, patch by patch.
fn boundary(hexes: &GroupedHexes, faces: &mut Vec<HexFace>) -> Text {
    let patches: Vec<_> = hexes.patches().members().collect();
    let mut text = header("polyBoundaryMesh", "boundary", "");
    text.put(patches.len()).put("\n(\n");
    for (_, name, members) in patches {
        let (count, start) = (members.len(), faces.len());
        text.put(format_args!("    {name}\n    {{\n        type patch;\n"));
        if let Some(sides) = hexes.sides_apart() {
            text.put(format_args!("        inGroups 1({});\n", sides.names()[hexes.side_of(&members)]));
        }
        text.put(format_args!("        nFaces {count};\n        startFace {start};\n    }}\n"));
        faces.extend(members.iter().map(|&i| hexes.boundary()[i as usize]));
        faces[start..].sort_unstable();
    }
    text.put(")\n");
    text
}

fn points(hexes: &GroupedHexes) -> Text {
    let points = hexes.mesh().points();
    let mut text = header("vectorField", "points", "");
    text.put(points.len()).put("\n(\n");
    for point in points {
        text.put('(').point(point).put(")\n");
    }
    text.put(")\n");
    text
}

fn faces_of(hexes: &GroupedHexes, faces: &[HexFace]) -> Text {
    let mut text = header("faceList", "faces", "");
    text.put(faces.len()).put("\n(\n");
    for face in faces {
        let [a, b, c, d] = face.vertices(hexes.cells());
        text.put(format_args!("4({a} {b} {c} {d})\n"));
    }
    text.put(")\n");
    text
}

fn owners(faces: &[HexFace], counts: [usize; 4]) -> Text {
    labels("owner", faces.iter().map(|face| face.cell), faces.len(), counts)
}

fn neighbours_of(neighbours: &[u32], counts: [usize; 4]) -> Text {
    labels("neighbour", neighbours.iter().copied(), neighbours.len(), counts)
}

/// A list of one number for each face, with a note that readers of a part of the mesh look into.
fn labels(object: &str, cells: impl Iterator<Item = u32>, count: usize, counts: [usize; 4]) -> Text {
    let [points, all, faces, inner] = counts;
    let note = format!("    note \"nPoints:{points} nCells:{all} nFaces:{faces} nInternalFaces:{inner}\";\n");
    let mut text = header("labelList", object, &note);
    text.put(count).put("\n(\n");
    cells.for_each(|cell| text.put(cell).end());
    text.put(")\n");
    text
}

fn zones(hexes: &GroupedHexes) -> Text {
    let blocks: Vec<_> = hexes.blocks().members().collect();
    let mut text = header("regIOobject", "cellZones", "");
    text.put(blocks.len()).put("\n(\n");
    for (_, name, cells) in blocks {
        text.put(format_args!("{name}\n{{\n    type cellZone;\n    cellLabels List<label> {}\n(\n", cells.len()));
        cells.iter().for_each(|cell| text.put(cell).end());
        text.put(");\n}\n");
    }
    text.put(")\n");
    text
}

fn header(class: &str, object: &str, note: &str) -> Text {
    let mut text = Text::default();
    text.put("FoamFile\n{\n    version 2.0;\n    format ascii;\n").put(format_args!("    class {class};\n")).put(note);
    text.put(format_args!("    location \"constant/polyMesh\";\n    object {object};\n}}\n"));
    text
}
