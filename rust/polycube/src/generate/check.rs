//! What tests ask of a mesh, worked out independently of how it was made.

use crate::mesh::{Cells, Mesh};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// Each corner of a hexahedron with its three neighbours, right-handed.
const CORNERS: [[usize; 4]; 8] =
    [[0, 1, 3, 4], [1, 2, 0, 5], [2, 3, 1, 6], [3, 0, 2, 7], [4, 7, 5, 0], [5, 4, 6, 1], [6, 5, 7, 2], [7, 6, 4, 3]];

const HEX_FACES: [[usize; 4]; 6] = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]];

const TET_FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

fn determinant(mesh: &Mesh, [a, b, c, d]: [u32; 4]) -> f64 {
    let p = |v: u32| mesh.points()[v as usize];
    (p(b) - p(a)).cross(&(p(c) - p(a))).dot(&(p(d) - p(a)))
}

/// The smallest determinant over all tetrahedra, or all corners of all hexahedra.
pub fn smallest_determinant(mesh: &Mesh) -> f64 {
    let all: Vec<f64> = match mesh.cells() {
        Cells::Tetrahedra(cells) => cells.iter().map(|c| determinant(mesh, *c)).collect(),
        Cells::Hexahedra(cells) => {
            cells.iter().flat_map(|c| CORNERS.map(|corner| determinant(mesh, corner.map(|i| c[i])))).collect()
        }
        _ => panic!("a surface has no determinants"),
    };
    all.into_iter().fold(f64::INFINITY, f64::min)
}

/// The enclosed volume by the divergence theorem; negative when oriented inwards.
pub fn volume(mesh: &Mesh) -> f64 {
    let surface = boundary(mesh);
    let faces = (0..surface.cells().len()).map(|i| {
        let p: Vec<Vector3<f64>> = face(&surface, i).iter().map(|v| surface.points()[*v as usize].coords).collect();
        (1..p.len() - 1).map(|k| p[0].cross(&p[k]).dot(&p[k + 1])).sum::<f64>()
    });
    faces.sum::<f64>() / 6.0
}

fn face(mesh: &Mesh, i: usize) -> &[u32] {
    mesh.cells().cell(i)
}

/// The boundary of a volume; a surface itself.
pub fn boundary(mesh: &Mesh) -> Mesh {
    let cells = match mesh.cells() {
        Cells::Tetrahedra(cells) => Cells::Triangles(open(cells, TET_FACES)),
        Cells::Hexahedra(cells) => Cells::Quads(open(cells, HEX_FACES)),
        _ => return mesh.clone(),
    };
    Mesh::of_used(mesh.points(), cells).expect("a part of a mesh").0
}

/// The faces that belong to one cell only; a face of two must be seen from both sides.
fn open<const C: usize, const F: usize, const N: usize>(cells: &[[u32; C]], faces: [[usize; F]; N]) -> Vec<[u32; F]> {
    let mut seen: BTreeMap<[u32; F], Vec<[u32; F]>> = BTreeMap::new();
    for cell in cells {
        for face in faces.map(|f| f.map(|i| cell[i])) {
            let mut key = face;
            key.sort_unstable();
            seen.entry(key).or_default().push(face);
        }
    }
    assert!(seen.values().all(|f| f.len() <= 2), "a face has three cells");
    seen.into_values().filter(|f| f.len() == 1).map(|f| f[0]).collect()
}

/// Every face of a surface from its smallest vertex on, sorted.
pub fn sorted_faces(mesh: &Mesh) -> Vec<Vec<u32>> {
    let turned = |i: usize| {
        let mut f = face(mesh, i).to_vec();
        let first = (0..f.len()).min_by_key(|k| f[*k]).unwrap();
        f.rotate_left(first);
        f
    };
    let mut faces: Vec<_> = (0..mesh.cells().len()).map(turned).collect();
    faces.sort_unstable();
    faces
}

/// Every directed edge of a surface, with the face on its left.
fn directed_edges(mesh: &Mesh) -> BTreeMap<(u32, u32), usize> {
    let mut edges = BTreeMap::new();
    for i in 0..mesh.cells().len() {
        let f = face(mesh, i);
        for k in 0..f.len() {
            let twice = edges.insert((f[k], f[(k + 1) % f.len()]), i);
            assert_eq!(twice, None, "two faces on one side of an edge");
        }
    }
    edges
}

/// Each edge has exactly two faces that agree in orientation, each vertex exactly one fan.
pub fn assert_manifold(mesh: &Mesh) {
    let edges = directed_edges(mesh);
    assert!(edges.keys().all(|(a, b)| edges.contains_key(&(*b, *a))), "open edge");
    // Around a vertex, each face leads from its outgoing edge to the one after its incoming edge.
    let mut faces_at = vec![0; mesh.points().len()];
    let mut first = vec![None; mesh.points().len()];
    for (a, b) in edges.keys() {
        faces_at[*a as usize] += 1;
        first[*a as usize] = Some(*b);
    }
    for (v, start) in first.iter().enumerate() {
        let start = start.expect("a vertex without faces");
        let (mut to, mut turned) = (start, 0);
        while turned == 0 || to != start {
            let f = face(mesh, edges[&(v as u32, to)]);
            let at = f.iter().position(|x| *x == v as u32).unwrap();
            to = f[(at + f.len() - 1) % f.len()];
            turned += 1;
        }
        assert_eq!(turned, faces_at[v], "vertex {v} has several fans");
    }
}

/// Vertices − edges + faces of a closed surface.
pub fn euler(mesh: &Mesh) -> i64 {
    let edges = directed_edges(mesh).len() / 2;
    mesh.points().len() as i64 - edges as i64 + mesh.cells().len() as i64
}

/// The label of each face (+X −X +Y −Y +Z −Z) from its largest normal component.
pub fn labels(mesh: &Mesh) -> Vec<i8> {
    let label = |i: usize| {
        let p = |k: usize| mesh.points()[face(mesh, i)[k] as usize];
        let normal = (p(1) - p(0)).cross(&(p(2) - p(0)));
        let axis = normal.iamax();
        2 * axis as i8 + i8::from(normal[axis] < 0.0)
    };
    (0..mesh.cells().len()).map(label).collect()
}

/// Number of sets of faces with one label, connected through edges.
fn regions(mesh: &Mesh, labels: &[i8]) -> usize {
    let edges = directed_edges(mesh);
    let mut left: BTreeSet<usize> = (0..mesh.cells().len()).collect();
    let mut count = 0;
    while let Some(seed) = left.pop_first() {
        count += 1;
        let mut stack = vec![seed];
        while let Some(i) = stack.pop() {
            let f = face(mesh, i);
            for k in 0..f.len() {
                let next = edges[&(f[(k + 1) % f.len()], f[k])];
                if labels[next] == labels[i] && left.remove(&next) {
                    stack.push(next);
                }
            }
        }
    }
    count
}

/// Number of closed surfaces, connected through edges.
pub fn shells(mesh: &Mesh) -> usize {
    regions(mesh, &vec![0; mesh.cells().len()])
}

/// Number of charts: sets of faces with one label, connected through edges.
pub fn charts(mesh: &Mesh) -> usize {
    regions(mesh, &labels(mesh))
}

/// Number of vertices whose faces lie on planes of all three axes.
pub fn corners(mesh: &Mesh) -> usize {
    let labels = labels(mesh);
    let mut axes = vec![0_u8; mesh.points().len()];
    for (i, label) in labels.iter().enumerate() {
        let at = |v: &u32| *v as usize;
        face(mesh, i).iter().for_each(|v| axes[at(v)] |= 1 << (label / 2));
    }
    axes.iter().filter(|a| **a == 0b111).count()
}
