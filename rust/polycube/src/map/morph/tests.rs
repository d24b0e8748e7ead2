//! The morph on boxes.

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
        assert_eq!(run(&mesh, &levels(&mesh)), mesh.points());
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
        let surface = !mesh.cells().is_volume();
        let image = |(p, f): (&Point, &[Option<f64>; 3])| {
            let stays = surface && f.iter().all(Option::is_none);
            if stays { *p } else { Point::new(line(0, p.x), line(1, p.y), line(2, p.z)) }
        };
        assert!(farthest(&used, mesh.points().iter().zip(&fixed).map(image)) < 1e-8);
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
        for ((p, q), f) in mesh.points().iter().zip(moved).zip(&fixed) {
            let used = mesh.cells().is_volume() || f.iter().any(Option::is_some);
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
    for (f, p) in fixed.iter_mut().zip(mesh.points()) {
        f[2] = f[2].map(|z| z + p.x * p.x * p.y);
    }
    let moved = run(&mesh, &fixed);
    let n = mesh.points().len();
    let mut stiffness = DMatrix::identity(n, n);
    let mut side = DVector::from_fn(n, |v, _| fixed[v][2].map_or(0.0, |z| z - mesh.points()[v].z));
    for v in (0..n).filter(|&v| fixed[v][2].is_none() && fixed[v].iter().any(Option::is_some)) {
        stiffness[(v, v)] = 0.0;
        side[v] = 0.0;
    }
    let crate::mesh::Cells::Triangles(triangles) = mesh.cells() else { panic!() };
    for t in triangles {
        for k in 0..3 {
            let [i, j, o] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]].map(|v| v as usize);
            let (a, b) = (mesh.points()[i] - mesh.points()[o], mesh.points()[j] - mesh.points()[o]);
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
        assert!((moved[v].z - mesh.points()[v].z - expected[v]).abs() < 1e-8);
    }
}

/// Obtuse, stretched, thin: weights of either sign over six orders of magnitude.
#[test]
fn slivers_keep_the_precision() {
    for (squeeze, seed) in [(1.0, 1), (1e-3, 2), (300.0, 3)] {
        let mut mesh = jittered(&tri_box([12, 12, 12]), 0.3, seed);
        for p in mesh.points_mut() {
            p.y *= squeeze;
        }
        let mut fixed = levels(&mesh);
        for f in &mut fixed {
            *f = f.map(|x| x.map(|x| 2.0 * x + 1.0));
        }
        let moved = run(&mesh, &fixed);
        for ((p, q), f) in mesh.points().iter().zip(moved).zip(&fixed) {
            let image = if f.iter().any(Option::is_some) { p * 2.0 + Point::new(1.0, 1.0, 1.0).coords } else { *p };
            assert!((q - image).amax() < 1e-7 * squeeze.max(1.0));
        }
    }
}

/// Walls down to 1e-5 of the box's size thin, where iterating gets nowhere. What is left of every equation is computed
/// from the gradients of linear elements, not from cotangents.
#[test]
fn thin_walls_are_morphed_exactly() {
    let n = 24;
    let mut mesh = tri_box([n, n, n]);
    let mut random = crate::rng::SplitMix64::new(11);
    let lines = [0, 1, 2].map(|_| {
        let mut at = vec![0.0];
        for i in 0..n as usize {
            at.push(at[i] + libm::exp(-11.0 * random.unit()));
        }
        at
    });
    for p in mesh.points_mut() {
        *p = Point::new(lines[0][p.x as usize], lines[1][p.y as usize], lines[2][p.z as usize]);
    }
    let mut fixed = levels(&mesh);
    for (f, p) in fixed.iter_mut().zip(mesh.points()) {
        f[2] = f[2].map(|z| z + p.x * p.y);
    }
    let moved = run(&mesh, &fixed);
    let (mut left, mut pull) = (vec![0.0; moved.len()], vec![0.0; moved.len()]);
    let crate::mesh::Cells::Triangles(triangles) = mesh.cells() else { panic!() };
    for t in triangles.iter().map(|t| t.map(|v| v as usize)) {
        let p = t.map(|v| mesh.points()[v]);
        let normal = (p[1] - p[0]).cross(&(p[2] - p[0]));
        let gradient = [0, 1, 2].map(|k| normal.cross(&(p[(k + 2) % 3] - p[(k + 1) % 3])) / normal.norm_squared());
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let entry = normal.norm() * gradient[i].dot(&gradient[j]);
            let part = entry * (moved[t[j]].z - mesh.points()[t[j]].z);
            left[t[i]] += part;
            pull[t[i]] += if fixed[t[j]][2].is_some() { part } else { 0.0 };
        }
    }
    let free = |v: &usize| fixed[*v][2].is_none() && fixed[*v].iter().any(Option::is_some);
    let size = |of: &[f64]| (0..of.len()).filter(free).map(|v| of[v] * of[v]).sum::<f64>().sqrt();
    assert!(size(&pull) > 0.0 && size(&left) <= 1e-6 * size(&pull), "{:e}", size(&left) / size(&pull));
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
        mesh.points_mut()[at(1, 1, 0)] = mesh.points()[at(2, 1, 0)];
        mesh.points_mut()[at(2, 2, 2)].x = 9.0;
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
