//! Whether loops stand for a polycube, read off the cut mesh alone.

use super::NONE;
use super::cut_mesh::CutMesh;

/// Asserts that the living cuts of a mesh are valid. Shares nothing with the code that makes them so.
pub(super) fn check(mesh: &CutMesh, alive: impl Fn(u32) -> bool) {
    let wall = |t: usize, k: usize| mesh.triangles[t].cut[k] != NONE && alive(mesh.triangles[t].cut[k]);
    let regions = flood(mesh, wall);
    let count = regions.iter().max().map_or(0, |r| r + 1);
    let borders = borders(mesh, wall);
    assert_eq!(borders.len(), count, "every region has one border");
    let mut seen = vec![false; count];
    let mut corners = 0;
    for border in &borders {
        let region = regions[border[0].0];
        assert!(!std::mem::replace(&mut seen[region], true), "region {region} has two borders");
        let sides = sides(mesh, border);
        corners += sides.len();
        let mut distinct = sides.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert!(distinct.len() == sides.len() && (3..=6).contains(&sides.len()), "sides {sides:?}");
        for (i, side) in sides.iter().enumerate() {
            assert_ne!(side.0, sides[(i + 1) % sides.len()].0, "sides {sides:?} meet at right angles");
        }
    }
    // Four regions meet in every crossing; with V - E + F of the surface as it was, all regions are discs.
    assert_eq!(corners % 4, 0);
    assert_eq!(count as i64 - corners as i64 / 4, euler_number(mesh), "the regions are discs");
    (0..3).for_each(|axis| check_order(mesh, &alive, axis));
}

fn flood(mesh: &CutMesh, wall: impl Fn(usize, usize) -> bool) -> Vec<usize> {
    let mut region = vec![usize::MAX; mesh.triangles.len()];
    let mut next = 0;
    for seed in 0..region.len() {
        if region[seed] != usize::MAX {
            continue;
        }
        let mut stack = vec![seed];
        while let Some(t) = stack.pop() {
            if std::mem::replace(&mut region[t], next) == usize::MAX {
                let beside = (0..3).filter(|&k| !wall(t, k)).map(|k| mesh.twins[t][k] as usize);
                stack.extend(beside.filter(|&o| region[o] == usize::MAX));
            }
        }
        next += 1;
    }
    region
}

/// The closed rows of walls around regions, each with its region on the left.
fn borders(mesh: &CutMesh, wall: impl Fn(usize, usize) -> bool) -> Vec<Vec<(usize, usize)>> {
    let mut walked = vec![[false; 3]; mesh.triangles.len()];
    let mut borders = Vec::new();
    for t in 0..mesh.triangles.len() {
        for k in (0..3).filter(|&k| wall(t, k)) {
            let mut border = Vec::new();
            let mut at = (t, k);
            while !std::mem::replace(&mut walked[at.0][at.1], true) {
                border.push(at);
                at = after(mesh, &wall, at);
            }
            if !border.is_empty() {
                borders.push(border);
            }
        }
    }
    borders
}

/// The next wall around the region left of a wall.
fn after(mesh: &CutMesh, wall: impl Fn(usize, usize) -> bool, (mut t, k): (usize, usize)) -> (usize, usize) {
    let vertex = mesh.triangles[t].vertices[(k + 1) % 3];
    let mut k = (k + 1) % 3;
    while !wall(t, k) {
        t = mesh.twins[t][k] as usize;
        k = (0..3).find(|&k| mesh.triangles[t].vertices[k] == vertex).expect("a neighbour has the vertex");
    }
    (t, k)
}

/// The axis and sense of every side of a border.
fn sides(mesh: &CutMesh, border: &[(usize, usize)]) -> Vec<(usize, bool)> {
    let cut = |&(t, k): &(usize, usize)| mesh.triangles[t].cut[k];
    let starts = (0..border.len()).filter(|&i| cut(&border[i]) != cut(&border[(i + border.len() - 1) % border.len()]));
    let side = |i: usize| {
        let (t, k) = border[i];
        (mesh.cuts[cut(&border[i]) as usize].axis, mesh.is_above(t, k))
    };
    starts.map(side).collect()
}

fn euler_number(mesh: &CutMesh) -> i64 {
    let mut used = vec![false; mesh.points.len()];
    mesh.triangles.iter().flat_map(|t| t.vertices).for_each(|v| used[v as usize] = true);
    used.iter().filter(|u| **u).count() as i64 - mesh.triangles.len() as i64 / 2
}

/// Asserts that the zones of an axis have an order.
fn check_order(mesh: &CutMesh, alive: &impl Fn(u32) -> bool, axis: usize) {
    let own = |t: usize, k: usize| {
        let cut = mesh.triangles[t].cut[k];
        cut != NONE && alive(cut) && mesh.cuts[cut as usize].axis == axis
    };
    let zones = flood(mesh, own);
    let count = zones.iter().max().map_or(0, |z| z + 1);
    let mut above = vec![std::collections::BTreeSet::new(); count];
    for t in 0..mesh.triangles.len() {
        for k in (0..3).filter(|&k| own(t, k) && mesh.is_above(t, k)) {
            above[zones[mesh.twins[t][k] as usize]].insert(zones[t]);
        }
    }
    // What has nothing above it is taken off until nothing is left.
    let mut left: Vec<usize> = (0..count).collect();
    while !left.is_empty() {
        let lower: Vec<usize> = left.iter().copied().filter(|&z| above[z].iter().any(|a| left.contains(a))).collect();
        assert!(lower.len() < left.len(), "the zones of axis {axis} have an order");
        left = lower;
    }
}
