//! What is true of every block structure.

use super::*;
use std::collections::BTreeMap;

/// Fails where blocks are not those of the mesh.
pub(super) fn check(hexes: &GroupedHexes, blocks: &Blocks) {
    grids_hold_the_mesh(hexes, blocks);
    neighbours_look_at_each_other(blocks);
    classes_go_on_in_neighbours(blocks);
    faces_between_blocks_are_all(hexes, blocks);
}

/// Every hexahedron is in one block, at the place whose eight vertices it has, and every vertex used is in a grid.
fn grids_hold_the_mesh(hexes: &GroupedHexes, blocks: &Blocks) {
    let mut found = vec![0; hexes.cells().len()];
    for block in &blocks.blocks {
        let [m, n, o] = block.size;
        assert_eq!(block.vertices.len(), ((m + 1) * (n + 1) * (o + 1)) as usize);
        assert_eq!(block.cells.len(), (m * n * o) as usize);
        for (at, &cell) in block.cells.iter().enumerate() {
            let at = at as u32;
            let [i, j, k] = [at % m, at / m % n, at / m / n];
            let corner = |octant: u32| block.vertex([i + (octant & 1), j + (octant >> 1 & 1), k + (octant >> 2)]);
            let there: BTreeSet<u32> = (0..8).map(corner).collect();
            assert_eq!(there, hexes.cells()[cell as usize].iter().copied().collect());
            assert_eq!(hexes.blocks().of()[cell as usize], block.group);
            found[cell as usize] += 1;
        }
    }
    assert!(found.iter().all(|&count| count == 1));
    let all: BTreeSet<u32> = blocks.blocks.iter().flat_map(|b| b.vertices.iter().copied()).collect();
    assert_eq!(all, hexes.cells().iter().flatten().copied().collect());
}

/// Where an axis goes on: the axis there and whether it runs the same way.
fn goes_on(transform: [i8; 3], axis: usize) -> (usize, i64) {
    (usize::from(transform[axis].unsigned_abs()) - 1, transform[axis].signum().into())
}

/// The matrix of a transform.
fn matrix(transform: [i8; 3]) -> nalgebra::Matrix3<f64> {
    let mut matrix = nalgebra::Matrix3::zeros();
    for axis in 0..3 {
        let (other, sign) = goes_on(transform, axis);
        matrix[(other, axis)] = sign as f64;
    }
    matrix
}

/// From the other side a neighbour is this block, turned back, and vertex after vertex of the face is the same.
fn neighbours_look_at_each_other(blocks: &Blocks) {
    for (b, block) in blocks.blocks.iter().enumerate() {
        for (face, beyond) in block.faces.iter().enumerate() {
            let Beyond::Block(there) = beyond else { continue };
            let other = &blocks.blocks[there.block as usize];
            let Beyond::Block(back) = other.faces[usize::from(there.face)] else { panic!("it is outside") };
            assert_eq!((back.block as usize, usize::from(back.face)), (b, face));
            let (one, two) = (matrix(there.transform), matrix(back.transform));
            assert_eq!(one * two, nalgebra::Matrix3::identity());
            assert!((one.determinant() - 1.0).abs() < 1e-9, "a face is a mirror: {:?}", there.transform);
            for at in places(block.size, face) {
                assert_eq!(block.vertex(at), other.vertex(beyond_of(block.size, face, there, at)));
            }
        }
    }
}

/// All places on a face.
fn places(size: [u32; 3], face: usize) -> Vec<[u32; 3]> {
    let all = (0..=size[2]).flat_map(|k| (0..=size[1]).flat_map(move |j| (0..=size[0]).map(move |i| [i, j, k])));
    all.filter(|at| at[face / 2] == if face % 2 == 1 { size[face / 2] } else { 0 }).collect()
}

/// Where a place of a face is in the neighbour, as CGNS reckons: from the first one on, along the axes as they go on.
fn beyond_of(size: [u32; 3], face: usize, there: &Neighbour, at: [u32; 3]) -> [u32; 3] {
    let mut start = [0; 3];
    start[face / 2] = if face % 2 == 1 { size[face / 2] } else { 0 };
    let mut place = there.first.map(i64::from);
    for axis in 0..3 {
        let (other, sign) = goes_on(there.transform, axis);
        place[other] += sign * (i64::from(at[axis]) - i64::from(start[axis]));
    }
    place.map(|x| x.try_into().unwrap())
}

/// The classes are those found by going from block to block over faces, and so is which way they run.
fn classes_go_on_in_neighbours(blocks: &Blocks) {
    let mut found = vec![[None; 3]; blocks.blocks.len()];
    let mut count = 0;
    for (start, axis) in (0..blocks.blocks.len()).flat_map(|b| [0, 1, 2].map(|axis| (b, axis))) {
        if found[start][axis].is_some() {
            continue;
        }
        let mut front = vec![(start, axis, 1)];
        while let Some((b, axis, sign)) = front.pop() {
            if let Some(known) = found[b][axis].replace((count, sign)) {
                assert_eq!(known, (count, sign));
                continue;
            }
            for (_, beyond) in blocks.blocks[b].faces.iter().enumerate().filter(|(face, _)| face / 2 != axis) {
                let Beyond::Block(there) = beyond else { continue };
                let (other, way) = goes_on(there.transform, axis);
                front.push((there.block as usize, other, sign * way));
            }
        }
        count += 1;
    }
    assert_eq!(count, blocks.classes.len());
    for (block, found) in blocks.blocks.iter().zip(&found) {
        for axis in [0, 1, 2] {
            assert_eq!(found[axis], Some((block.class[axis] as usize, block.sign[axis].into())));
            assert_eq!(block.size[axis], blocks.classes[block.class[axis] as usize]);
        }
    }
}

/// The faces of hexahedra between one block and another are as many as those on inner faces of blocks; on the outside,
/// they are the faces of the outside with their groups.
fn faces_between_blocks_are_all(hexes: &GroupedHexes, blocks: &Blocks) {
    let mut sides: BTreeMap<[u32; 4], BTreeSet<u32>> = BTreeMap::new();
    for cell in 0..hexes.cells().len() as u32 {
        for face in 0..6 {
            let key = sorted(&HexFace { cell, face }.vertices(hexes.cells()));
            sides.entry(key).or_default().insert(hexes.blocks().of()[cell as usize]);
        }
    }
    let expected = sides.values().filter(|of| of.len() == 2).count();
    let (mut inner, mut outside) = (0, BTreeMap::new());
    for (b, block) in blocks.blocks.iter().enumerate() {
        for (face, beyond) in block.faces.iter().enumerate() {
            let area: u32 = (0..3).filter(|&a| a != face / 2).map(|a| block.size[a]).product();
            match beyond {
                Beyond::Block(there) => inner += if there.block as usize == b { 0 } else { area as usize },
                Beyond::Outside { patch, side } => *outside.entry((*patch, *side)).or_insert(0) += area as usize,
            }
        }
    }
    assert_eq!(inner, 2 * expected);
    let mut groups = BTreeMap::new();
    for (&patch, &side) in hexes.patches().of().iter().zip(hexes.sides().of()) {
        *groups.entry((patch, side)).or_insert(0) += 1;
    }
    assert_eq!(outside, groups);
}
