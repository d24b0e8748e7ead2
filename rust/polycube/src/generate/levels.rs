//! Moves the levels of a polycube's facets, off the lattice if need be.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Mesh;
use crate::rng::SplitMix64;
use petgraph::unionfind::UnionFind;

/// Moves every facet of a surface along its axis by `offset(facet)`; each facet stays flat.
///
/// `labels` holds the label of each face: 0..5 = +X −X +Y −Y +Z −Z. A facet is a set of faces of
/// one axis that are connected through edges or vertices, since facets that touch at a corner
/// share their level; facets count from 0 in the order of their first face. Only the vertices of a
/// facet move: the faces beside it stretch, and turn over where an offset exceeds their length.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a volume; [`ErrorKind::Mismatch`] when there is not one label
/// per face; [`ErrorKind::Polycube`] at a label outside 0..5.
pub(super) fn move_levels(mesh: &Mesh, labels: &[i8], mut offset: impl FnMut(usize) -> f64) -> Result<Mesh> {
    check(mesh, labels)?;
    let (facet, count) = facets(mesh, labels);
    let offsets: Vec<f64> = (0..count).map(&mut offset).collect();
    let mut points = mesh.points().to_vec();
    for (key, facet) in facet.into_iter().enumerate() {
        if let Some(facet) = facet {
            points[key / 3][key % 3] += offsets[facet];
        }
    }
    mesh.clone().with_points(points)
}

/// Moves every facet by a random offset of up to `fraction` of the shortest edge of the mesh, the
/// same for a `seed` everywhere. No rectangle turns over; a triangle may whose corners move with different facets.
///
/// # Errors
/// [`ErrorKind::Option`] when `fraction` is outside `0..0.5`, and those of `move_levels`.
pub fn perturb(mesh: &Mesh, labels: &[i8], fraction: f64, seed: u64) -> Result<Mesh> {
    if !(0.0..0.5).contains(&fraction) {
        let message = format!("facets cannot move by {fraction} of the shortest edge");
        return Err(Error::new(ErrorKind::Option, message).remedy("use a fraction from 0 up to, but below, 0.5"));
    }
    let range = fraction * shortest_edge(mesh);
    let mut rng = SplitMix64::new(seed);
    move_levels(mesh, labels, |_| range * (2.0 * rng.unit() - 1.0))
}

fn check(mesh: &Mesh, labels: &[i8]) -> Result<()> {
    if mesh.cells().is_volume() {
        let message = "levels move on a surface, but this mesh fills a volume";
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    if labels.len() != mesh.cells().len() {
        let message = format!("{} labels for {} faces", labels.len(), mesh.cells().len());
        return Err(Error::new(ErrorKind::Mismatch, message).remedy("give one label per face"));
    }
    match labels.iter().position(|l| !(0..6).contains(l)) {
        Some(i) => Err(Error::new(ErrorKind::Polycube, format!("{} is no label", labels[i]))
            .at(Place::Face(i as u32))
            .remedy("labels are 0 to 5 for +X -X +Y -Y +Z -Z")),
        None => Ok(()),
    }
}

/// The facet that holds each coordinate `3 vertex + axis` (none where no face is across the axis
/// at the vertex), and the number of facets.
fn facets(mesh: &Mesh, labels: &[i8]) -> (Vec<Option<usize>>, usize) {
    let keys = |i: usize| {
        let axis = labels[i] as usize / 2;
        mesh.cells().cell(i).iter().map(move |v| 3 * *v as usize + axis)
    };
    let mut sets = UnionFind::<usize>::new(3 * mesh.points().len());
    for i in 0..labels.len() {
        keys(i).zip(keys(i).skip(1)).for_each(|(a, b)| {
            sets.union(a, b);
        });
    }
    let mut number = vec![None; 3 * mesh.points().len()];
    let mut facet = number.clone();
    let mut count = 0;
    for key in (0..labels.len()).flat_map(keys) {
        facet[key] = Some(*number[sets.find_mut(key)].get_or_insert_with(|| {
            count += 1;
            count - 1
        }));
    }
    (facet, count)
}

fn shortest_edge(mesh: &Mesh) -> f64 {
    let mut shortest = f64::INFINITY;
    for i in 0..mesh.cells().len() {
        let face = mesh.cells().cell(i);
        for (k, v) in face.iter().enumerate() {
            let next = face[(k + 1) % face.len()];
            let edge = mesh.points()[next as usize] - mesh.points()[*v as usize];
            shortest = shortest.min(edge.norm());
        }
    }
    // An empty mesh has no edge to move along.
    if shortest.is_finite() { shortest } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::random::random_with_corners;
    use super::super::{Cuboid, Voxels, check};
    use super::*;
    use crate::mesh::CellKind;

    fn is_axis_aligned(mesh: &Mesh, labels: &[i8]) -> bool {
        labels.iter().enumerate().all(|(i, label)| {
            let axis = *label as usize / 2;
            let at = |v: &u32| mesh.points()[*v as usize][axis];
            let face = mesh.cells().cell(i);
            face.iter().all(|v| at(v) == at(&face[0]))
        })
    }

    #[test]
    fn a_moved_facet_changes_the_volume_by_its_area() {
        let voxels = Voxels::from_boxes(&[Cuboid::new([0; 3], [2, 3, 4])]).unwrap();
        let mesh = voxels.mesh(CellKind::Quads, 1.0).unwrap();
        let labels = check::labels(&mesh);
        let mut count = 0;
        move_levels(&mesh, &labels, |i| {
            assert_eq!(i, count);
            count += 1;
            0.0
        })
        .unwrap();
        assert_eq!(count, 6);
        let moved = move_levels(&mesh, &labels, |i| if i == 0 { -0.5 } else { 0.0 }).unwrap();
        // The first face belongs to the X side at 0.
        assert_eq!(labels[0], 1);
        assert!((check::volume(&moved) - 30.0).abs() < 1e-12);
    }

    #[test]
    fn perturbed_polycubes_stay_polycubes() {
        for (seed, kind) in [(1, CellKind::Quads), (2, CellKind::Triangles)] {
            let voxels = random_with_corners(seed, 200).unwrap();
            let mesh = voxels.mesh(kind, 1.0).unwrap();
            let labels = check::labels(&mesh);
            let moved = perturb(&mesh, &labels, 0.45, seed).unwrap();
            assert!(is_axis_aligned(&moved, &labels));
            assert_eq!(check::labels(&moved), labels);
            assert_ne!(moved, mesh);
            assert_eq!(moved, perturb(&mesh, &labels, 0.45, seed).unwrap());
            assert_eq!(mesh, perturb(&mesh, &labels, 0.0, seed).unwrap());
        }
    }

    #[test]
    fn facets_that_touch_at_a_corner_move_together() {
        // Two towers on a slab, diagonal to each other, and a lower step in one nook between them:
        // at [2, 2, 2] five faces meet, two of them across X that touch at this vertex alone.
        let boxes = [
            Cuboid::new([0, 0, 0], [4, 4, 1]),
            Cuboid::new([0, 0, 1], [2, 2, 2]),
            Cuboid::new([2, 0, 1], [4, 2, 2]),
            Cuboid::new([2, 2, 1], [4, 4, 2]),
            Cuboid::new([0, 0, 2], [2, 2, 3]),
        ];
        let boxes = [&boxes[..], &[Cuboid::new([2, 2, 2], [4, 4, 3])]].concat();
        let touching = Voxels::from_boxes(&boxes).unwrap();
        assert!(!touching.is_manifold());
        let boxes = &boxes[..5];
        let voxels = Voxels::from_boxes(boxes).unwrap();
        assert!(voxels.is_manifold());
        let mesh = voxels.mesh(CellKind::Quads, 1.0).unwrap();
        let labels = check::labels(&mesh);
        let (_, facets) = facets(&mesh, &labels);
        assert!(facets < check::charts(&mesh));
        let mut rng = SplitMix64::new(4);
        let moved = move_levels(&mesh, &labels, |_| 0.4 * rng.unit()).unwrap();
        assert!(is_axis_aligned(&moved, &labels));
        check::assert_manifold(&moved);
    }

    #[test]
    fn unfit_input_is_refused() {
        let voxels = Voxels::from_boxes(&[Cuboid::new([0; 3], [1; 3])]).unwrap();
        let hexes = voxels.mesh(CellKind::Hexahedra, 1.0).unwrap();
        let quads = voxels.mesh(CellKind::Quads, 1.0).unwrap();
        let kind = |mesh, labels: &[i8]| move_levels(mesh, labels, |_| 0.0).unwrap_err().kind;
        assert_eq!(kind(&hexes, &[0]), ErrorKind::Unsupported);
        assert_eq!(kind(&quads, &[0; 5]), ErrorKind::Mismatch);
        assert_eq!(kind(&quads, &[0, 1, 2, 3, 4, 6]), ErrorKind::Polycube);
        assert_eq!(kind(&quads, &[0, 1, 2, 3, 4, -1]), ErrorKind::Polycube);
        for fraction in [-0.1, 0.5, f64::NAN] {
            let error = perturb(&quads, &check::labels(&quads), fraction, 0).unwrap_err();
            assert_eq!(error.kind, ErrorKind::Option);
        }
    }
}
