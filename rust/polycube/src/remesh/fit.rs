//! Brings the surface of a mesh nearer to the shape where chords cut it off: quadrilaterals are as flat as the mesh is coarse.

use super::Hexes;
use super::report::cells_of;
use super::site::Site;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::{Face, Mesh, Point, split_quad};
use crate::optimise::{Foot, Nearest, scaled_jacobian};
use nalgebra::Vector3;
use rayon::prelude::*;

/// Rounds of moves at most.
const ROUNDS: usize = 20;
/// Samples farther than this part of the bound pull.
const TAUT: f64 = 0.8;
/// How far vertices may leave the shape, as a part of the bound.
const LIFT: f64 = 0.8;
/// No hexahedron may become worse than this part of the worst.
const KEEP: f64 = 0.9;
/// Samples along the side of a quadrilateral, its ends included.
const SIDE: usize = 5;

/// A point that the surface should reach: the corners of a quadrilateral with their weights in the point of it that is
/// nearest, and the way from there.
struct Pull {
    corners: [u32; 4],
    weights: [f64; 4],
    way: Vector3<f64>,
}

/// Moves surface vertices off corners until no sample of the surface (quadrilaterals `quads` of the mesh's vertices) and of the
/// shape is farther than `bound` from the other, as far as that goes without making a hexahedron worse than the worst is.
/// Returns how many vertices moved.
///
/// A vertex off the shape is nearer to it than the bound, so that the surface lies on both sides of the shape, as the best
/// approximation does, instead of on the inner one.
pub(super) fn fit(hexes: &mut Hexes, quads: &[[u32; 4]], shape: &Mesh, bound: f64, context: &Context) -> Result<usize> {
    let triangles: Vec<[Point; 3]> = triangles(shape)?;
    let target = Nearest::new(triangles.iter().copied());
    let stars = stars(hexes);
    let floor = KEEP * cells_of(hexes).iter().map(|c| scaled_jacobian(&hexes.mesh.points, c)).fold(1.0, f64::min);
    let mut moved = vec![false; hexes.mesh.points.len()];
    for round in 0..ROUNDS {
        context.tick(round as f64 / ROUNDS as f64)?;
        let mut pulls = pulls_of_shape(&hexes.mesh.points, quads, &triangles, TAUT * bound);
        pulls.extend(pulls_of_mesh(&hexes.mesh.points, quads, &target, TAUT * bound));
        let mut any = false;
        for (v, step) in steps(&pulls, hexes.mesh.points.len()) {
            if matches!(hexes.sites[v], Site::Facet(_) | Site::Edge(_)) && floor > 0.0 {
                let done = follow(hexes, &stars[v], v, step, |p| target.distance(p) <= LIFT * bound, floor);
                moved[v] |= done;
                any |= done;
            }
        }
        if !any {
            break;
        }
    }
    Ok(moved.into_iter().filter(|m| *m).count())
}

/// Moves vertex `v` by `step` or a part of it; whether that went.
fn follow(
    hexes: &mut Hexes,
    star: &[u32],
    v: usize,
    step: Vector3<f64>,
    near: impl Fn(&Point) -> bool,
    floor: f64,
) -> bool {
    let from = hexes.mesh.points[v];
    for part in [1.0, 0.5, 0.25] {
        let to = from + step * part;
        hexes.mesh.points[v] = to;
        let cells = cells_of(hexes);
        let good = |&c: &u32| scaled_jacobian(&hexes.mesh.points, &cells[c as usize]) >= floor;
        if near(&to) && star.iter().all(good) {
            return true;
        }
    }
    hexes.mesh.points[v] = from;
    false
}

/// What each vertex should do to follow its pulls, by the vertices' numbers: their least common moves, averaged.
fn steps(pulls: &[Pull], count: usize) -> Vec<(usize, Vector3<f64>)> {
    let mut sums = vec![(Vector3::zeros(), 0.0); count];
    for pull in pulls {
        let square: f64 = pull.weights.iter().map(|w| w * w).sum();
        for (&v, w) in pull.corners.iter().zip(pull.weights) {
            sums[v as usize].0 += pull.way * (w * w / square);
            sums[v as usize].1 += w;
        }
    }
    let step = |(v, (sum, weight)): (usize, (Vector3<f64>, f64))| (weight > 0.0).then(|| (v, sum / weight));
    sums.into_iter().enumerate().filter_map(step).collect()
}

/// The vertices and middles of the shape's triangles that are farther than `bound` from the quadrilaterals.
fn pulls_of_shape(points: &[Point], quads: &[[u32; 4]], shape: &[[Point; 3]], bound: f64) -> Vec<Pull> {
    let fan = |q: &[u32; 4]| {
        let p = q.map(|v| points[v as usize]);
        let centre = Point::from((p[0].coords + p[1].coords + p[2].coords + p[3].coords) / 4.0);
        [0, 1, 2, 3].map(|k| [p[k], p[(k + 1) % 4], centre])
    };
    let index = Nearest::new(quads.iter().flat_map(fan));
    let pull = |sample: Point| {
        let Foot { index: i, point, weights } = index.foot(&sample)?;
        let way = sample - point;
        let (quad, k) = (quads[i / 4], i % 4);
        let mut all = [weights[2] / 4.0; 4];
        all[k] += weights[0];
        all[(k + 1) % 4] += weights[1];
        (way.norm() > bound).then_some(Pull { corners: quad, weights: all, way })
    };
    let samples = |t: &[Point; 3]| {
        let middle = Point::from((t[0].coords + t[1].coords + t[2].coords) / 3.0);
        [t[0], t[1], t[2], middle].into_iter().filter_map(pull).collect::<Vec<_>>()
    };
    shape.par_iter().with_min_len(256).map(samples).collect::<Vec<_>>().into_iter().flatten().collect()
}

/// The samples of the quadrilaterals that are farther than `bound` from the shape.
fn pulls_of_mesh(points: &[Point], quads: &[[u32; 4]], shape: &Nearest<3>, bound: f64) -> Vec<Pull> {
    let unit = |i: usize| i as f64 / (SIDE - 1) as f64;
    let pull = |q: &[u32; 4], (s, t): (f64, f64)| {
        let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
        let at: Vector3<f64> = q.iter().zip(weights).map(|(&v, w)| points[v as usize].coords * w).sum();
        let way = shape.foot(&Point::from(at))?.point.coords - at;
        (way.norm() > bound).then_some(Pull { corners: *q, weights, way })
    };
    let each = |q: &[u32; 4]| {
        let grid = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (unit(i), unit(j))));
        grid.filter_map(|at| pull(q, at)).collect::<Vec<_>>()
    };
    quads.par_iter().with_min_len(64).map(each).collect::<Vec<_>>().into_iter().flatten().collect()
}

fn triangles(shape: &Mesh) -> Result<Vec<[Point; 3]>> {
    let mut all = Vec::new();
    for face in shape.cells.boundary()?.iter() {
        match *face {
            Face::Triangle(t) => all.push(t.map(|v| shape.points[v as usize])),
            Face::Quad(q) => all.extend(split_quad(q).map(|t| t.map(|v| shape.points[v as usize]))),
        }
    }
    Ok(all)
}

/// The hexahedra around each vertex.
fn stars(hexes: &Hexes) -> Vec<Vec<u32>> {
    let mut stars = vec![Vec::new(); hexes.mesh.points.len()];
    for (i, cell) in (0..).zip(cells_of(hexes)) {
        cell.iter().for_each(|&v| stars[v as usize].push(i));
    }
    stars
}
