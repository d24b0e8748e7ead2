//! Gmsh's format 4.1 as text. Patches are its surfaces and blocks its volumes, counted from 1; both, and sides, are
//! physical groups.

use crate::mesh::io::text::Text;
use crate::mesh::{GroupedHexes, Groups, Point, Stars};

const QUADRILATERAL: u32 = 3;
const HEXAHEDRON: u32 = 5;

/// The text of the file.
pub(super) fn write(hexes: &GroupedHexes) -> Vec<u8> {
    let mut text = Text::default();
    text.put("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    names(&mut text, hexes);
    entities(&mut text, hexes);
    nodes(&mut text, hexes);
    elements(&mut text, hexes);
    text.into_bytes()
}

/// The number of the physical group of a patch, after those of the sides.
fn patch_group(hexes: &GroupedHexes, patch: usize) -> usize {
    hexes.sides_apart().map_or(0, |sides| sides.names().len()) + patch + 1
}

/// The physical groups of a patch with these faces: how many, and their numbers.
fn groups_of(hexes: &GroupedHexes, patch: usize, faces: &[u32]) -> String {
    let own = patch_group(hexes, patch);
    hexes.sides_apart().map_or(format!("1 {own}"), |_| format!("2 {} {own}", hexes.side_of(faces) + 1))
}

fn names(text: &mut Text, hexes: &GroupedHexes) {
    let sides = hexes.sides_apart().into_iter().flat_map(Groups::members).map(|(i, name, _)| (2, i + 1, name));
    let patches = hexes.patches().members().map(|(i, name, _)| (2, patch_group(hexes, i), name));
    let blocks = hexes.blocks().members().map(|(i, name, _)| (3, i + 1, name));
    let all: Vec<_> = sides.chain(patches).chain(blocks).collect();
    text.put("$PhysicalNames\n").put(all.len()).end();
    for (dimension, number, name) in all {
        text.put(format_args!("{dimension} {number} \"{name}\"\n"));
    }
    text.put("$EndPhysicalNames\n");
}

fn entities(text: &mut Text, hexes: &GroupedHexes) {
    let points = hexes.mesh().points();
    let (surfaces, volumes) = (hexes.patches().members().count(), hexes.blocks().members().count());
    text.put("$Entities\n").put(format_args!("0 0 {surfaces} {volumes}\n"));
    for (patch, _, faces) in hexes.patches().members() {
        let vertices = faces.iter().flat_map(|&face| hexes.quad(face));
        entity(text, patch, points, vertices, &groups_of(hexes, patch, &faces));
    }
    for (block, _, cells) in hexes.blocks().members() {
        let vertices = cells.iter().flat_map(|&cell| hexes.cells()[cell as usize]);
        entity(text, block, points, vertices, &format!("1 {}", block + 1));
    }
    text.put("$EndEntities\n");
}

/// An entity with its bounding box and physical groups; what bounds it is not told.
fn entity(text: &mut Text, i: usize, points: &[Point], vertices: impl Iterator<Item = u32>, groups: &str) {
    let all = [Point::from([f64::INFINITY; 3]), Point::from([f64::NEG_INFINITY; 3])];
    let [low, high] = vertices.map(|v| points[v as usize]).fold(all, |[low, high], p| [low.inf(&p), high.sup(&p)]);
    text.put(i + 1).put(' ').point(&low).put(' ').point(&high).put(' ').put(groups).put(" 0\n");
}

/// Each vertex belongs to the patch that it lies on, or else to the block that it lies in, the first of several.
fn nodes(text: &mut Text, hexes: &GroupedHexes) {
    let (patches, points) = (hexes.patches().names().len(), hexes.mesh().points());
    let mut home = vec![u32::MAX; points.len()];
    let mut settle = |vertices: &[u32], entity: u32| {
        vertices.iter().for_each(|&v| home[v as usize] = home[v as usize].min(entity));
    };
    for (face, &patch) in (0..).zip(hexes.patches().of()) {
        settle(&hexes.quad(face), patch);
    }
    for (cell, &block) in hexes.cells().iter().zip(hexes.blocks().of()) {
        settle(cell, patches as u32 + block);
    }
    // A vertex of no hexahedron has to be somewhere.
    home.iter_mut().filter(|home| **home == u32::MAX).for_each(|home| *home = patches as u32);
    let count = patches + hexes.blocks().names().len();
    let members = Stars::new(count, home.iter().map(|&entity| [entity]));
    let filled: Vec<usize> = (0..count).filter(|&e| !members.of(e).is_empty()).collect();
    text.put("$Nodes\n").put(format_args!("{} {} 1 {}\n", filled.len(), points.len(), points.len()));
    for entity in filled {
        let (dimension, number) = if entity < patches { (2, entity + 1) } else { (3, entity - patches + 1) };
        text.put(format_args!("{dimension} {number} 0 {}\n", members.of(entity).len()));
        members.of(entity).iter().for_each(|&v| text.put(u64::from(v) + 1).end());
        members.of(entity).iter().for_each(|&v| text.point(&points[v as usize]).end());
    }
    text.put("$EndNodes\n");
}

/// The hexahedra are numbered first, then the faces of the outside.
fn elements(text: &mut Text, hexes: &GroupedHexes) {
    let (cells, faces) = (hexes.cells(), hexes.boundary().len());
    let (count, all) = (hexes.patches().members().count() + hexes.blocks().members().count(), cells.len() + faces);
    text.put("$Elements\n").put(format_args!("{count} {all} 1 {all}\n"));
    for (patch, _, faces) in hexes.patches().members() {
        text.put(format_args!("2 {} {QUADRILATERAL} {}\n", patch + 1, faces.len()));
        for face in faces {
            text.put(cells.len() as u64 + u64::from(face) + 1).indices(&hexes.quad(face), 1).end();
        }
    }
    for (block, _, members) in hexes.blocks().members() {
        text.put(format_args!("3 {} {HEXAHEDRON} {}\n", block + 1, members.len()));
        for cell in members {
            text.put(u64::from(cell) + 1).indices(&cells[cell as usize], 1).end();
        }
    }
    text.put("$EndElements\n");
}
