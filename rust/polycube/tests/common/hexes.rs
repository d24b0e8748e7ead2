//! Counts blocks and patches on an actual mesh of hexahedra, face by face, knowing nothing of levels or facets.

use polycube::layout::Counts;
use std::collections::{BTreeMap, BTreeSet};

/// The faces of a hexahedron in VTK's order, outward.
const FACES: [[usize; 4]; 6] = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]];

/// The edges of a hexahedron.
const EDGES: [[usize; 2]; 12] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];

type Edge = [u32; 2];

/// Vertices of a face, ascending.
type Key = [u32; 4];

/// Patches by tracing the surface of the hexahedra, blocks of their base complex, and blocks of the base complex
/// after a layer of hexahedra was put around them.
pub fn count(hexes: &[[u32; 8]]) -> Counts {
    let surface = boundary(hexes);
    Counts { surface_patches: patches(&surface), blocks: blocks(hexes), blocks_padded: blocks(&padded(hexes)) }
}

/// The faces that belong to one hexahedron only, outward.
fn boundary(hexes: &[[u32; 8]]) -> Vec<[u32; 4]> {
    let mut seen: BTreeMap<Key, Vec<[u32; 4]>> = BTreeMap::new();
    for face in hexes.iter().flat_map(|h| FACES.map(|f| f.map(|i| h[i]))) {
        seen.entry(key(face)).or_default().push(face);
    }
    seen.into_values().filter(|f| f.len() == 1).map(|f| f[0]).collect()
}

/// The hexahedra with one more on every face of the boundary.
fn padded(hexes: &[[u32; 8]]) -> Vec<[u32; 8]> {
    let offset = 1 + hexes.iter().flatten().copied().max().unwrap_or(0);
    let cover = boundary(hexes).into_iter().map(|[a, b, c, d]| {
        let [e, f, g, h] = [a, b, c, d].map(|v| v + offset);
        [a, b, c, d, e, f, g, h]
    });
    hexes.iter().copied().chain(cover).collect()
}

/// A face between two hexahedra, or on the boundary.
#[derive(Default)]
struct Face {
    hexes: Vec<usize>,
    is_sheet: bool,
}

/// Cuts the hexahedra along the sheets of all singular edges and counts the parts.
fn blocks(hexes: &[[u32; 8]]) -> usize {
    let mut faces: BTreeMap<Key, Face> = BTreeMap::new();
    let mut valence: BTreeMap<Edge, usize> = BTreeMap::new();
    for (i, h) in hexes.iter().enumerate() {
        FACES.iter().for_each(|f| faces.entry(key(f.map(|k| h[k]))).or_default().hexes.push(i));
        EDGES.iter().for_each(|e| *valence.entry(ascending(e.map(|k| h[k]))).or_default() += 1);
    }
    let mut at_edge: BTreeMap<Edge, Vec<Key>> = BTreeMap::new();
    for face in hexes.iter().flat_map(|h| FACES.map(|f| f.map(|i| h[i]))) {
        sides(face).for_each(|e| at_edge.entry(e).or_default().push(key(face)));
    }
    at_edge.values_mut().for_each(|list| {
        list.sort_unstable();
        list.dedup();
    });
    let outer: BTreeSet<Edge> = boundary(hexes).into_iter().flat_map(sides).collect();
    let regular = |e: &Edge| valence[e] == if outer.contains(e) { 2 } else { 4 };
    let singular = valence.keys().filter(|e| !regular(e));
    let mut front: Vec<Key> = singular.flat_map(|e| at_edge[e].iter().copied()).collect();
    while let Some(at) = front.pop() {
        let Some(face) = faces.get_mut(&at).filter(|f| f.hexes.len() == 2 && !f.is_sheet) else { continue };
        face.is_sheet = true;
        let own = face.hexes.clone();
        let across = edges_of(&at, hexes, own[0]).filter(|e| regular(e) && !outer.contains(e));
        let beyond = |f: &&Key| faces[*f].hexes.iter().all(|h| !own.contains(h));
        let next: Vec<Key> =
            across.flat_map(|e| at_edge[&e].iter().filter(beyond).copied().collect::<Vec<_>>()).collect();
        front.extend(next);
    }
    let joined = faces.values().filter(|f| !f.is_sheet && f.hexes.len() == 2).map(|f| [f.hexes[0], f.hexes[1]]);
    parts(hexes.len(), joined)
}

/// The four edges of the face `at` of a hexahedron.
fn edges_of(at: &Key, hexes: &[[u32; 8]], hex: usize) -> impl Iterator<Item = Edge> + use<> {
    let face = FACES.map(|f| f.map(|i| hexes[hex][i])).into_iter().find(|f| key(*f) == *at);
    face.into_iter().flat_map(sides)
}

/// Traces separatrices from every vertex of other than four faces and counts the patches between them.
fn patches(surface: &[[u32; 4]]) -> usize {
    let mut left: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    for (i, face) in surface.iter().enumerate() {
        (0..4).for_each(|k| assert_eq!(left.insert([face[k], face[(k + 1) % 4]], i), None));
    }
    let valence = |v: u32| left.range([v, 0]..=[v, u32::MAX]).count();
    // The next edge out of `v`, counter-clockwise.
    let turn = |v: u32, w: u32| {
        let face = &surface[left[&[v, w]]];
        let at = face.iter().position(|&x| x == v).unwrap_or(0);
        face[(at + 3) % 4]
    };
    let mut marked: BTreeSet<Edge> = BTreeSet::new();
    for &[from, to] in left.keys().filter(|e| valence(e[0]) != 4) {
        let (mut v, mut w) = (from, to);
        marked.insert(ascending([v, w]));
        while valence(w) == 4 {
            let straight = turn(w, turn(w, v));
            (v, w) = (w, straight);
            marked.insert(ascending([v, w]));
        }
    }
    let joined = left.iter().filter(|(e, _)| !marked.contains(&ascending(**e)));
    parts(surface.len(), joined.map(|(&[a, b], &i)| [i, left[&[b, a]]]))
}

/// Connected sets of `count` things of which some pairs are joined.
fn parts(count: usize, joined: impl Iterator<Item = [usize; 2]>) -> usize {
    let mut beside = vec![Vec::new(); count];
    for [a, b] in joined {
        beside[a].push(b);
        beside[b].push(a);
    }
    let mut seen = vec![false; count];
    let mut parts = 0;
    for seed in 0..count {
        let mut stack = vec![seed];
        parts += usize::from(!seen[seed]);
        while let Some(i) = stack.pop() {
            if !std::mem::replace(&mut seen[i], true) {
                stack.extend(&beside[i]);
            }
        }
    }
    parts
}

fn sides([a, b, c, d]: [u32; 4]) -> impl Iterator<Item = Edge> {
    [[a, b], [b, c], [c, d], [d, a]].into_iter().map(ascending)
}

fn ascending([a, b]: Edge) -> Edge {
    [a.min(b), a.max(b)]
}

fn key(mut face: [u32; 4]) -> Key {
    face.sort_unstable();
    face
}
