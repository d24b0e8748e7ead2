//! The morph on real polycubes.

use super::morph;
use super::testing::{labels, on_levels, real_polycubes, uneven};
use crate::context::Context;
use crate::measure::{distortion, flipped};
use crate::mesh::{Mesh, Point};

fn largest_step(mesh: &Mesh, points: &[Point]) -> f64 {
    mesh.points().iter().zip(points).fold(0.0, |m, (a, b)| m.max((a - b).amax()))
}

#[test]
fn real_polycubes_stay_and_move() {
    for (name, mesh) in real_polycubes() {
        let context = Context::default();
        let same = morph(&mesh, &on_levels(&mesh, |_, x| x), &context).unwrap();
        assert!(largest_step(&mesh, &same) < 1e-12, "{name}");
        let affine = morph(&mesh, &on_levels(&mesh, |k, x| (2.0 + k as f64) * x - 1.0), &context).unwrap();
        let expected = mesh.points().iter().map(|p| Point::new(2.0 * p.x - 1.0, 3.0 * p.y - 1.0, 4.0 * p.z - 1.0));
        let span = 4.0 * mesh.points().iter().fold(0.0_f64, |m, p| m.max(p.coords.amax()));
        let error = expected.zip(&affine).fold(0.0_f64, |m, (a, b)| m.max((a - b).amax()));
        println!("{name}: affine map missed by {:.1e} of the size", error / span);
        assert!(error < 1e-8 * span, "{name}");
        let moved = morph(&mesh, &on_levels(&mesh, uneven), &context).unwrap();
        let moved = mesh.clone().with_points(moved).unwrap();
        let flips = flipped(&moved, &labels(&mesh)).unwrap();
        let before = flipped(&mesh, &labels(&mesh)).unwrap();
        println!(
            "{name}: flipped before {} {} after {} {}",
            before.cells.len(),
            before.faces.len(),
            flips.cells.len(),
            flips.faces.len()
        );
        println!("{name}: {:?}", distortion(&mesh, &moved).unwrap());
    }
}
