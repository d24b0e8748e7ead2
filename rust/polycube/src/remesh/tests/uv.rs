//! Texture coordinates of the quadrilaterals.

use super::Case;
use crate::context::Context;
use crate::generate::{Example, example};
use crate::mesh::CellKind;
use std::collections::BTreeMap;

/// Every quadrilateral is a square of one size that looks up, none lies on another, and those of a patch that meet on
/// the shape meet in the chart; along edges between patches both divide it alike.
#[test]
fn charts_are_grids_of_equal_squares_that_nowhere_overlap() {
    for name in Example::ALL {
        let case = Case::new(format!("{name}"), example(name, 2, CellKind::Quads).unwrap()).sized(3000, 1);
        let quads = case.remesher().quads(&Context::default()).unwrap();
        let uv = quads.uv();
        assert_eq!(uv.len(), quads.label.len());
        let minus = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
        let [first, ..] = uv[0];
        let side = (uv[0][1][0] - first[0]).abs().max((uv[0][1][1] - first[1]).abs());
        let (mut taken, mut corner_of) = (BTreeMap::new(), BTreeMap::new());
        for (i, square) in uv.iter().enumerate() {
            assert!(square.iter().flatten().all(|x| *x > 0.0 && *x < 1.0), "{name}");
            for k in 0..4 {
                let ([ax, ay], [bx, by]) =
                    (minus(square[(k + 1) % 4], square[k]), minus(square[(k + 3) % 4], square[k]));
                let straight = (ax * by - ay * bx - side * side).abs() + (ax * bx + ay * by).abs();
                assert!(straight < 1e-9, "{name}: quadrilateral {i} is no square that looks up");
                // One place of a vertex in each chart: neighbours in a patch meet there, too.
                let vertex = quads.mesh.cells().cell(i)[k];
                let place = *corner_of.entry((quads.patch_id[i], vertex)).or_insert(square[k]);
                assert!(minus(place, square[k]).iter().all(|x| x.abs() < 1e-12), "{name}");
            }
            // The square of the grid that it fills, and no other patch next to it.
            let cell = [0, 1].map(|a| (square.iter().map(|c| c[a]).sum::<f64>() / 4.0 / side).floor() as i64);
            assert_eq!(taken.insert(cell, quads.patch_id[i]), None, "{name}");
        }
        for (&[x, y], patch) in &taken {
            let near = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
            assert!(near.filter_map(|cell| taken.get(&cell)).all(|other| other == patch), "{name}");
        }
    }
}
