//! Blocks are held against what must be true of them, found here from the hexahedra alone.

mod invariants;
mod remeshed;

use super::*;
use crate::map::testing::{hex_box, shuffled};
use crate::mesh::{Cells, Groups, HexFace, Mesh};
use crate::rng::SplitMix64;
use invariants::check;
use std::collections::BTreeSet;

fn cells(mesh: &Mesh) -> &[[u32; 8]] {
    let Cells::Hexahedra(cells) = mesh.cells() else { panic!("not hexahedra") };
    cells
}

/// The mesh in blocks, all of its outside in one patch.
fn grouped(mesh: &Mesh, block: Vec<u32>) -> GroupedHexes<'_> {
    let outside: BTreeSet<[u32; 4]> = mesh.cells().boundary().unwrap().iter().map(|f| sorted(f.vertices())).collect();
    let all = (0..mesh.cells().len() as u32).flat_map(|cell| (0..6).map(move |face| HexFace { cell, face }));
    let boundary: Vec<HexFace> = all.filter(|f| outside.contains(&sorted(&f.vertices(cells(mesh))))).collect();
    let one = |name| Groups::numbered(name, vec![0; boundary.len()]).unwrap();
    let (patches, sides) = (one("patch"), one("side"));
    GroupedHexes::new(mesh, Groups::numbered("block", block).unwrap(), boundary, patches, sides).unwrap()
}

fn sorted(face: &[u32]) -> [u32; 4] {
    let mut face: [u32; 4] = face.try_into().unwrap();
    face.sort_unstable();
    face
}

/// The mesh with each of its hexahedra turned at random, in one of the 24 ways.
fn turned(mesh: &Mesh, seed: u64) -> Mesh {
    let mut random = SplitMix64::new(seed);
    let mut turn = |cell: &[u32; 8]| {
        let mut cell = *cell;
        for _ in 0..8 {
            let about = [[1, 2, 3, 0, 5, 6, 7, 4], [3, 2, 6, 7, 0, 1, 5, 4]][usize::from(random.unit() < 0.5)];
            cell = about.map(|k| cell[k]);
        }
        cell
    };
    let all = cells(mesh).iter().map(&mut turn).collect();
    Mesh::new(mesh.points().to_vec(), Cells::Hexahedra(all)).unwrap()
}

/// The block of each hexahedron where planes cut a box at these coordinates.
fn cut(mesh: &Mesh, planes: [&[f64]; 3]) -> Vec<u32> {
    let middle =
        |cell: &[u32; 8]| cell.iter().map(|&v| mesh.points()[v as usize].coords).sum::<nalgebra::Vector3<f64>>() / 8.0;
    let rank = |cell| [0, 1, 2].map(|a| planes[a].partition_point(|&p| p < middle(cell)[a]) as u32);
    let count = planes.map(|p| p.len() as u32 + 1);
    cells(mesh).iter().map(rank).map(|[x, y, z]| (z * count[1] + y) * count[0] + x).collect()
}

/// The hexahedra of a box whose last layer along z is glued to the first, turned by `turn`: what wraps round.
fn ring(size: [u32; 3], turn: impl Fn(u32, u32) -> [u32; 2]) -> Mesh {
    let mesh = hex_box(size);
    let layer = (size[0] + 1) * (size[1] + 1);
    let glued = |v: u32| match v.checked_sub(size[2] * layer) {
        Some(top) => {
            let [x, y] = turn(top % (size[0] + 1), top / (size[0] + 1));
            y * (size[0] + 1) + x
        }
        None => v,
    };
    let all = cells(&mesh).iter().map(|c| c.map(glued)).collect();
    Mesh::new(mesh.points().to_vec(), Cells::Hexahedra(all)).unwrap()
}

#[test]
fn a_box_cut_by_planes_has_what_is_counted_by_hand() {
    let mesh = hex_box([5, 4, 3]);
    let hexes = grouped(&mesh, cut(&mesh, [&[2.0], &[1.0, 3.0], &[]]));
    let blocks = Blocks::new(&hexes).unwrap();
    check(&hexes, &blocks);
    assert_eq!(
        blocks.blocks.iter().map(|b| b.size).collect::<Vec<_>>(),
        [[2, 1, 3], [3, 1, 3], [2, 2, 3], [3, 2, 3], [2, 1, 3], [3, 1, 3]]
    );
    assert_eq!(blocks.inner_faces(), 7);
    // Two along x, three along y, one along z, in the order of the blocks.
    assert_eq!(blocks.classes, [2, 1, 3, 3, 2, 1]);
    assert_eq!(blocks.blocks[3].class, [3, 4, 2]);
    assert!(blocks.blocks.iter().all(|b| b.sign == [1; 3]));
    let right = Neighbour { block: 1, face: 0, transform: [1, 2, 3], first: [0, 0, 0] };
    assert_eq!(blocks.blocks[0].faces[1], Beyond::Block(right));
}

/// However hexahedra lie and vertices are numbered, blocks are the same but for their axes.
#[test]
fn hexahedra_may_lie_any_way_in_their_blocks() {
    let mesh = hex_box([5, 4, 3]);
    for seed in 0..20 {
        let mesh = turned(&shuffled(&mesh, seed), seed);
        let hexes = grouped(&mesh, cut(&mesh, [&[2.0], &[1.0, 3.0], &[1.0]]));
        let blocks = Blocks::new(&hexes).unwrap();
        check(&hexes, &blocks);
        assert_eq!((blocks.blocks.len(), blocks.inner_faces()), (12, 20));
        let mut classes = blocks.classes;
        classes.sort_unstable();
        assert_eq!(classes, [1, 1, 1, 2, 2, 2, 3]);
        assert!(blocks.blocks.iter().any(|b| b.sign != [1; 3]));
    }
}

/// A block may be its own neighbour; its edges must not come back turned round.
#[test]
fn a_block_that_meets_itself_is_cut_open() {
    let mesh = ring([2, 2, 5], |x, y| [x, y]);
    let hexes = grouped(&mesh, vec![0; 20]);
    let blocks = Blocks::new(&hexes).unwrap();
    check(&hexes, &blocks);
    let block = &blocks.blocks[0];
    assert_eq!((block.size, blocks.inner_faces()), ([2, 2, 5], 1));
    let Beyond::Block(above) = block.faces[5] else { panic!("open") };
    assert_eq!(above, Neighbour { block: 0, face: 4, transform: [1, 2, 3], first: [0, 0, 0] });
    // By a quarter, edges across run against themselves after two rounds; by half, after one.
    for mesh in [ring([2, 2, 5], |x, y| [y, 2 - x]), ring([2, 2, 5], |x, y| [2 - x, 2 - y])] {
        let halves = (0..20).map(|cell| u32::from(cell >= 8)).collect();
        let error = Blocks::new(&grouped(&mesh, halves)).unwrap_err();
        assert!(error.kind == ErrorKind::Mesh && error.message.contains("block_0 along i"), "{error}");
    }
}

/// Two blocks on top of each other and round again, their corner columns pinched so that all four ends are the same: by
/// its corners no face is told from another.
#[test]
fn faces_with_the_same_corners_are_told_apart() {
    let mesh = ring([2, 2, 4], |x, y| [x, y]);
    let pinched = |v: u32| if v / 9 == 2 && [0, 2, 6, 8].contains(&(v % 9)) { v % 9 } else { v };
    let all = cells(&mesh).iter().map(|c| c.map(pinched)).collect();
    let mesh = Mesh::new(mesh.points().to_vec(), Cells::Hexahedra(all)).unwrap();
    let hexes = grouped(&mesh, (0..16).map(|cell| u32::from(cell >= 8)).collect());
    let blocks = Blocks::new(&hexes).unwrap();
    check(&hexes, &blocks);
    let corners = |face: usize| -> BTreeSet<u32> {
        let block = &blocks.blocks[0];
        block.corners().iter().filter(|c| (c[2] > 0) == (face == 5)).map(|&c| block.vertex(c)).collect()
    };
    assert_eq!(corners(4), corners(5));
    for (face, other) in [(4, 5), (5, 4)] {
        let Beyond::Block(beyond) = blocks.blocks[0].faces[face] else { panic!("open") };
        assert_eq!((beyond.block, beyond.face), (1, other));
    }
}

#[test]
fn what_has_no_block_structure_is_refused_by_name() {
    let mesh = hex_box([3, 3, 1]);
    let refused = |block: Vec<u32>| Blocks::new(&grouped(&mesh, block)).unwrap_err();
    // An L, a ring around a hole that is a block, and two parts.
    for (name, block) in [
        ("block_0", vec![0, 0, 0, 0, 1, 1, 0, 1, 1]),
        ("block_0", vec![0, 0, 0, 0, 1, 0, 0, 0, 0]),
        ("block_1", vec![0, 0, 0, 1, 2, 1, 3, 3, 3]),
    ] {
        let error = refused(block);
        assert!(error.kind == ErrorKind::Mismatch && !error.remedy.is_empty(), "{error}");
        assert_eq!(error.message, format!("{name} is no box of hexahedra"));
    }
    let error = refused(vec![0, 0, 0, 1, 1, 2, 1, 1, 2]);
    assert!(error.message.contains("is not that of one other block"), "{error}");
}

/// A face of the outside in two patches is named with both.
#[test]
fn a_face_in_two_patches_is_refused() {
    let mesh = hex_box([2, 1, 1]);
    let one = grouped(&mesh, vec![0; 2]);
    let patches = Groups::numbered("patch", (0..10).map(|i| u32::from(i >= 5)).collect()).unwrap();
    let blocks = Groups::numbered("block", vec![0; 2]).unwrap();
    let hexes = GroupedHexes::new(&mesh, blocks, one.boundary().to_vec(), patches, one.sides().clone()).unwrap();
    let error = Blocks::new(&hexes).unwrap_err();
    assert!(error.message.ends_with("of block_0 is in patch_0 and in patch_1"), "{error}");
}
