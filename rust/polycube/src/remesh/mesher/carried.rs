//! Groups of faces of a surface, carried to the boundary of hexahedra that lie on it.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Cells, GroupedSurface, Groups, Mesh, Point};
use crate::remesh::lattice::BoundaryFace;
use crate::spatial::Nearest;
use nalgebra::Vector3;
use rayon::prelude::*;

/// Samples along each side of a quadrilateral.
const SAMPLES: usize = 6;

/// Most rounds of moving quadrilaterals between groups.
const ROUNDS: usize = 20;

/// The groups of a `surface` that a hexahedral mesh lies on, one for each face of its `boundary`: the group that most
/// of the face lies on. Where two meet inside faces, so many of those go to either that the areas of both stay what
/// they are, within a face. O(n log n) for n faces of both.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for other cells than hexahedra; [`ErrorKind::Mismatch`] for a face that the mesh does not
/// have.
pub fn carry_groups(surface: &GroupedSurface, mesh: &Mesh, boundary: &[BoundaryFace]) -> Result<Groups> {
    let Cells::Hexahedra(cells) = mesh.cells() else {
        let message = format!("{} have no faces to carry groups to", mesh.cells().kind());
        return Err(Error::new(ErrorKind::Unsupported, message).remedy("give hexahedra"));
    };
    let unknown = |side: &&BoundaryFace| side.face.cell as usize >= cells.len() || side.face.face >= 6;
    if let Some(BoundaryFace { face, .. }) = boundary.iter().find(unknown) {
        let message = format!("there is no face {} of hexahedron {}", face.face, face.cell);
        return Err(Error::new(ErrorKind::Mismatch, message).remedy("give the boundary of the mesh"));
    }
    let (triangles, names) = (triangles(surface)?, surface.groups().names());
    let index = Nearest::new(triangles.iter().map(|(at, _)| *at));
    let of_face = |side: &BoundaryFace| {
        let corners = side.face.vertices(cells).map(|v| mesh.points()[v as usize]);
        shares(&corners, &triangles, &index)
    };
    let all: Vec<Shares> = boundary.par_iter().with_min_len(32).map(of_face).collect();
    Groups::new(names.to_vec(), balanced(&all, names.len()))
}

/// A surface as triangles with their groups.
fn triangles(surface: &GroupedSurface) -> Result<Vec<([Point; 3], u32)>> {
    let at = |v: u32| surface.mesh().points()[v as usize];
    let faces = surface.mesh().cells().boundary()?;
    let grouped = faces.iter().zip(surface.groups().of());
    Ok(grouped.flat_map(|(face, &group)| face.triangles().map(move |corners| (corners.map(at), group))).collect())
}

/// The groups that a quadrilateral lies on, ascending, with the area that it has on each.
type Shares = Vec<(u32, f64)>;

/// Looks from samples of a quadrilateral to the nearest triangles that look to the same side.
fn shares(corners: &[Point; 4], triangles: &[([Point; 3], u32)], index: &Nearest<3>) -> Shares {
    let [a, b, c, d] = corners;
    let unit = |i: usize| (i as f64 + 0.5) / SAMPLES as f64;
    let (mut normal, mut all) = ((c - a).cross(&(d - b)), Shares::new());
    for (s, t) in (0..SAMPLES).flat_map(|i| (0..SAMPLES).map(move |j| (unit(i), unit(j)))) {
        let (low, high) = (a.lerp(b, s), d.lerp(c, s));
        let local = ((b - a).lerp(&(c - d), t)).cross(&(high - low));
        if local != Vector3::zeros() {
            normal = local;
        }
        let faces = |i: usize| {
            let [p, q, r] = triangles[i].0;
            (q - p).cross(&(r - p)).dot(&normal) > 0.0
        };
        let Some(i) = index.nearest_of(&low.lerp(&high, t), faces) else { continue };
        let (group, area) = (triangles[i].1, local.norm() / (SAMPLES * SAMPLES) as f64);
        match all.binary_search_by_key(&group, |share| share.0) {
            Ok(place) => all[place].1 += area,
            Err(place) => all.insert(place, (group, area)),
        }
    }
    all
}

/// A group for each quadrilateral, so that groups have the areas of all shares in them.
fn balanced(shares: &[Shares], count: usize) -> Vec<u32> {
    let largest = |all: &Shares| all.iter().max_by(|x, y| x.1.total_cmp(&y.1).then(y.0.cmp(&x.0))).map_or(0, |s| s.0);
    let mut of: Vec<u32> = shares.iter().map(largest).collect();
    let area: Vec<f64> = shares.iter().map(|all| all.iter().map(|share| share.1).sum()).collect();
    let mut excess = vec![0.0; count];
    of.iter().zip(&area).for_each(|(&group, area)| excess[group as usize] += area);
    shares.iter().flatten().for_each(|&(group, area)| excess[group as usize] -= area);
    for _ in 0..ROUNDS {
        if !moved(shares, &area, &mut of, &mut excess) {
            break;
        }
    }
    of
}

/// Moves quadrilaterals from groups that have too much to such that have too little, those first that lie nearly as
/// much on either; tells whether any moved.
fn moved(shares: &[Shares], area: &[f64], of: &mut [u32], excess: &mut [f64]) -> bool {
    let share = |i: usize, group: u32| shares[i].iter().find(|share| share.0 == group).map_or(0.0, |share| share.1);
    let others = |i: usize| shares[i].iter().map(move |&(to, part)| (i, to, part));
    let mut moves: Vec<(f64, usize, u32)> = (0..of.len())
        .flat_map(others)
        .filter(|&(i, to, _)| to != of[i])
        .map(|(i, to, part)| ((share(i, of[i]) - part) / area[i], i, to))
        .collect();
    moves.sort_by(|x, y| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2))));
    let (mut any, mut done) = (false, vec![false; of.len()]);
    for (_, i, to) in moves {
        let (from, to_group) = (of[i] as usize, to as usize);
        let (before, after) =
            (excess[from].abs() + excess[to_group].abs(), [excess[from] - area[i], excess[to_group] + area[i]]);
        if !done[i] && after[0].abs() + after[1].abs() < before * (1.0 - 1e-9) {
            [excess[from], excess[to_group]] = after;
            (of[i], done[i], any) = (to, true, true);
        }
    }
    any
}
