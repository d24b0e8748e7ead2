//! Fit a polycube mesh into a new structure by a Laplace problem.

use super::check::check_mesh;
use super::cotangent::cotangent_weights;
use super::harmonic::extend_harmonic;
use super::mean_value::mean_value_weights;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::{Face, Mesh, Point, Simplices, split_quad};

/// Moves the vertices of a polycube onto prescribed coordinates, the others with them, smoothly.
///
/// `fixed[v][axis]` is the coordinate vertex `v` must have: all three at a polycube corner, two on
/// an edge, one in a facet, none inside, in the units of `mesh`. The answer has one point for
/// each vertex of `mesh`; prescribed coordinates are met to the last bit.
///
/// The displacement of the free coordinates is harmonic, for each axis on its own, with weights
/// from `mesh` as it comes (paper, section 6): first on the boundary surface with cotangent weights,
/// where a coordinate that is free on both sides of a polycube edge runs across it, then, for a
/// volume, inside with mean value coordinates and the whole boundary held. Quadrilaterals and
/// hexahedra count as their [simplices](crate::mesh::Cells::simplices).
///
/// As both kinds of weights reproduce linear functions, this is the Laplace problem of the
/// positions; asking for the displacement makes the answer *exactly* the input where nothing is to
/// move, on thin or inverted elements, too:
/// - a triangle thinner than 1e-6 (doubled area over longest edge squared) counts as equilateral;
/// - negative cotangents stay, so an obtuse triangulation may overshoot its boundary a little;
/// - an inner vertex with an inverted or flat tetrahedron around it moves as the plain mean of its
///   neighbours;
/// - a vertex of no cell stays where it is, whatever `fixed` says.
///
/// The answer may hold flipped elements: see [`flipped`](super::flipped()). Relative residual 1e-10
/// (down to 1e-6 where rounding forbids better). One thread, the same bits on every machine.
/// Roughly linear time and memory: 2 µs and 500 bytes a tetrahedron.
///
/// # Errors
/// [`ErrorKind::Mismatch`] unless `fixed` has one entry for each vertex, [`ErrorKind::Option`] when
/// one is not finite; [`ErrorKind::Mesh`] for a vertex index out of range, a point that is not
/// finite, or a face of three cells; [`ErrorKind::Polycube`] naming a vertex of a component without
/// any prescribed coordinate on some axis; [`ErrorKind::Cancelled`]; [`ErrorKind::Internal`] if the
/// solver fails.
pub fn morph(mesh: &Mesh, fixed: &[[Option<f64>; 3]], context: &Context) -> Result<Vec<Point>> {
    check(mesh, fixed)?;
    let mut known: Vec<[bool; 3]> = fixed.iter().map(|f| f.map(|c| c.is_some())).collect();
    let mut moves: Vec<[f64; 3]> = (0..fixed.len()).map(|v| prescribed(mesh, fixed, v)).collect();
    let surface = surface(mesh)?;
    let solid = match mesh.cells.simplices() {
        Simplices::Tetrahedra(t) => Some(t),
        Simplices::Triangles(_) => None,
    };
    let end = if solid.is_some() { 0.3 } else { 1.0 };
    let part = |from, to| context.stage("morph", from, to);
    let weights = cotangent_weights(&mesh.points, &surface, &part(0.0, end / 4.0))?;
    extend_harmonic(&weights, &known, &mut moves, &part(end / 4.0, end))?;
    let mut used: Vec<bool> = (0..weights.len()).map(|v| !weights.range(v).is_empty()).collect();
    if let Some(tetrahedra) = solid {
        drop(weights);
        let inner: Vec<bool> = used.iter().map(|&outer| !outer).collect();
        hold(&mut known, &used);
        let weights = mean_value_weights(&mesh.points, &tetrahedra, &inner, &part(0.3, 0.6))?;
        extend_harmonic(&weights, &known, &mut moves, &part(0.6, 1.0))?;
        for (v, used) in used.iter_mut().enumerate() {
            *used |= !weights.range(v).is_empty();
        }
    }
    let place = |v: usize| {
        if used[v] { placed(mesh, fixed, &moves, v) } else { mesh.points[v] }
    };
    let points = (0..used.len()).map(place).collect();
    context.tick(1.0)?;
    Ok(points)
}

/// By how much `fixed` moves vertex `v`; 0 where it says nothing.
fn prescribed(mesh: &Mesh, fixed: &[[Option<f64>; 3]], v: usize) -> [f64; 3] {
    std::array::from_fn(|k| fixed[v][k].map_or(0.0, |c| c - mesh.points[v][k]))
}

/// Where vertex `v` ends.
fn placed(mesh: &Mesh, fixed: &[[Option<f64>; 3]], moves: &[[f64; 3]], v: usize) -> Point {
    let place = |k: usize| fixed[v][k].unwrap_or(mesh.points[v][k] + moves[v][k]);
    Point::new(place(0), place(1), place(2))
}

/// Makes every coordinate of the vertices in `held` known.
fn hold(known: &mut [[bool; 3]], held: &[bool]) {
    for (known, _) in known.iter_mut().zip(held).filter(|(_, held)| **held) {
        *known = [true; 3];
    }
}

/// The boundary as triangles.
fn surface(mesh: &Mesh) -> Result<Vec<[u32; 3]>> {
    let mut triangles = Vec::new();
    for face in mesh.cells.boundary()? {
        match face {
            Face::Triangle(t) => triangles.push(t),
            Face::Quad(q) => triangles.extend(split_quad(q)),
        }
    }
    Ok(triangles)
}

/// Whether the arguments can be used at all.
fn check(mesh: &Mesh, fixed: &[[Option<f64>; 3]]) -> Result<()> {
    if fixed.len() != mesh.points.len() {
        let message = format!("{} prescriptions for {} vertices", fixed.len(), mesh.points.len());
        return Err(Error::new(ErrorKind::Mismatch, message).remedy("give one for each vertex"));
    }
    let finite = |c: &Option<f64>| c.is_none_or(f64::is_finite);
    if let Some(v) = fixed.iter().position(|f| !f.iter().all(finite)) {
        return Err(
            Error::new(ErrorKind::Option, "its prescribed coordinate is not finite").at(Place::Vertex(v as u32))
        );
    }
    check_mesh(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::testing::{hex_box, jittered, levels, quad_box, tet_box, tri_box};
    use nalgebra::{DMatrix, DVector};
    use std::sync::{Arc, Mutex};

    const SIZE: [u32; 3] = [4, 3, 5];

    fn boxes() -> [Mesh; 4] {
        [tri_box(SIZE), quad_box(SIZE), tet_box(SIZE), hex_box(SIZE)].map(|m| jittered(&m, 0.2, 3))
    }

    fn farthest(a: &[Point], b: impl IntoIterator<Item = Point>) -> f64 {
        a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((a - b).amax()))
    }

    fn run(mesh: &Mesh, fixed: &[[Option<f64>; 3]]) -> Vec<Point> {
        morph(mesh, fixed, &Context::default()).unwrap()
    }

    #[test]
    fn present_levels_move_nothing() {
        for mesh in boxes() {
            assert_eq!(run(&mesh, &levels(&mesh)), mesh.points);
        }
    }

    /// The same for a shift of the whole box, where the solver has to work for it.
    #[test]
    fn shifted_and_stretched_levels_move_all_alike() {
        for mesh in boxes() {
            let line = |k: usize, x: f64| [3.0, 0.5, 1.0][k] * x + [0.0, 7.0, -2.0][k];
            let mut fixed = levels(&mesh);
            for f in &mut fixed {
                *f = [0, 1, 2].map(|k| f[k].map(|x| line(k, x)));
            }
            let used = run(&mesh, &fixed);
            let surface = !mesh.cells.is_volume();
            let image = |(p, f): (&Point, &[Option<f64>; 3])| {
                let stays = surface && f.iter().all(Option::is_none);
                if stays { *p } else { Point::new(line(0, p.x), line(1, p.y), line(2, p.z)) }
            };
            assert!(farthest(&used, mesh.points.iter().zip(&fixed).map(image)) < 1e-8);
        }
    }

    #[test]
    fn one_level_moves_its_axis_linearly() {
        for mesh in boxes() {
            let mut fixed = levels(&mesh);
            for f in &mut fixed {
                f[0] = f[0].map(|x| if x == 0.0 { 0.0 } else { 6.0 });
            }
            let moved = run(&mesh, &fixed);
            for ((p, q), f) in mesh.points.iter().zip(moved).zip(&fixed) {
                let used = mesh.cells.is_volume() || f.iter().any(Option::is_some);
                let x = if used { 1.5 * p.x } else { p.x };
                assert!((q.x - x).abs() < 1e-8 && q.y == p.y && q.z == p.z);
            }
        }
    }

    /// A bent right-hand side on the surface, against dense elements.
    #[test]
    fn agrees_with_a_dense_solution() {
        let mesh = jittered(&tri_box([3, 3, 3]), 0.2, 5);
        let mut fixed = levels(&mesh);
        for (f, p) in fixed.iter_mut().zip(&mesh.points) {
            f[2] = f[2].map(|z| z + p.x * p.x * p.y);
        }
        let moved = run(&mesh, &fixed);
        let n = mesh.points.len();
        let mut stiffness = DMatrix::identity(n, n);
        let mut side = DVector::from_fn(n, |v, _| fixed[v][2].map_or(0.0, |z| z - mesh.points[v].z));
        for v in (0..n).filter(|&v| fixed[v][2].is_none() && fixed[v].iter().any(Option::is_some)) {
            stiffness[(v, v)] = 0.0;
            side[v] = 0.0;
        }
        let crate::mesh::Cells::Triangles(triangles) = &mesh.cells else { panic!() };
        for t in triangles {
            for k in 0..3 {
                let [i, j, o] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]].map(|v| v as usize);
                let (a, b) = (mesh.points[i] - mesh.points[o], mesh.points[j] - mesh.points[o]);
                let w = 1.0 / a.angle(&b).tan();
                for (i, j) in [(i, j), (j, i)] {
                    if fixed[i][2].is_none() {
                        stiffness[(i, i)] += w;
                        stiffness[(i, j)] -= w;
                    }
                }
            }
        }
        let expected = stiffness.lu().solve(&side).unwrap();
        for v in 0..n {
            assert!((moved[v].z - mesh.points[v].z - expected[v]).abs() < 1e-8);
        }
    }

    /// Obtuse, stretched, thin: weights of either sign over six orders of magnitude.
    #[test]
    fn slivers_keep_the_precision() {
        for (squeeze, seed) in [(1.0, 1), (1e-3, 2), (300.0, 3)] {
            let mut mesh = jittered(&tri_box([12, 12, 12]), 0.3, seed);
            for p in &mut mesh.points {
                p.y *= squeeze;
            }
            let mut fixed = levels(&mesh);
            for f in &mut fixed {
                *f = f.map(|x| x.map(|x| 2.0 * x + 1.0));
            }
            let moved = run(&mesh, &fixed);
            for ((p, q), f) in mesh.points.iter().zip(moved).zip(&fixed) {
                let image = if f.iter().any(Option::is_some) { p * 2.0 + Point::new(1.0, 1.0, 1.0).coords } else { *p };
                assert!((q - image).amax() < 1e-7 * squeeze.max(1.0));
            }
        }
    }

    #[test]
    fn inner_prescriptions_are_met() {
        let mesh = hex_box([4, 4, 4]);
        let mut fixed = levels(&mesh);
        let centre = 2 + 5 * (2 + 5 * 2);
        fixed[centre][1] = Some(2.5);
        let moved = run(&mesh, &fixed);
        assert_eq!(moved[centre], Point::new(2.0, 2.5, 2.0));
        assert!(moved[centre - 1].y > 2.05);
    }

    #[test]
    fn bad_meshes_still_move() {
        for mut mesh in [tri_box(SIZE), quad_box(SIZE), tet_box(SIZE), hex_box(SIZE)] {
            let mut fixed = levels(&mesh);
            for f in &mut fixed {
                f[1] = f[1].map(|y| 2.0 * y);
            }
            // Two vertices of a facet in one place; an inner one pushed out.
            let at = |x: usize, y: usize, z: usize| x + 5 * (y + 4 * z);
            mesh.points[at(1, 1, 0)] = mesh.points[at(2, 1, 0)];
            mesh.points[at(2, 2, 2)].x = 9.0;
            let moved = run(&mesh, &fixed);
            assert!(moved.iter().all(|p| p.coords.iter().all(|c| c.is_finite() && c.abs() < 10.0)));
        }
    }

    #[test]
    fn a_component_adrift_is_named() {
        for mesh in boxes() {
            let mut fixed = levels(&mesh);
            for f in &mut fixed {
                f[2] = None;
            }
            let error = morph(&mesh, &fixed, &Context::default()).unwrap_err();
            assert_eq!((error.kind, error.place), (ErrorKind::Polycube, Some(Place::Vertex(0))));
            assert!(error.message.contains('z'));
        }
    }

    #[test]
    fn bad_arguments_are_refused() {
        let mesh = tet_box([1, 1, 1]);
        let kind = |mesh: &Mesh, fixed: &[[Option<f64>; 3]]| morph(mesh, fixed, &Context::default()).unwrap_err().kind;
        let mut fixed = levels(&mesh);
        assert_eq!(kind(&mesh, &fixed[1..]), ErrorKind::Mismatch);
        let mut short = mesh.clone();
        short.points.pop();
        assert_eq!(kind(&short, &fixed[1..]), ErrorKind::Mesh);
        short = mesh.clone();
        short.points[3].x = f64::NAN;
        assert_eq!(kind(&short, &fixed), ErrorKind::Mesh);
        fixed[2][1] = Some(f64::INFINITY);
        assert_eq!(kind(&mesh, &fixed), ErrorKind::Option);
    }

    #[test]
    fn progress_ends_at_one_and_cancelling_stops() {
        for mesh in boxes() {
            let seen = Arc::new(Mutex::new(Vec::new()));
            let log = Arc::clone(&seen);
            let context = Context::new(move |_, p| log.lock().unwrap().push(p));
            let mut fixed = levels(&mesh);
            for f in &mut fixed {
                f[0] = f[0].map(|x| x * x);
            }
            morph(&mesh, &fixed, &context).unwrap();
            let seen = seen.lock().unwrap();
            assert!(seen.is_sorted() && seen.len() > 5);
            assert_eq!(seen.last(), Some(&1.0));
            context.cancel();
            assert_eq!(morph(&mesh, &fixed, &context).unwrap_err().kind, ErrorKind::Cancelled);
        }
    }
}
