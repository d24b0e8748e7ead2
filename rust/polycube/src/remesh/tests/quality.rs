//! What is promised of the hexahedra: none inverted, none collapsed, the same for any number of threads.

use super::on_real_data::pair;
use super::{cells, corner_jacobians, quality};
use crate::align::Strategy;
use crate::context::Context;
use crate::data::folder;
use crate::generate::{Example, example};
use crate::mesh::{CellKind, Mesh, Point};
use crate::remesh::{Hexes, RemeshOptions, Remeshed, Size, remesh};
use crate::simplify::{Input, SimplifyOptions};

fn run((polycube, shape): &(Mesh, Mesh), hexes: usize) -> Remeshed {
    let input = Input { polycube, shape: Some(shape), labels: None };
    let simplify = SimplifyOptions { strategy: Strategy::Paper, ..SimplifyOptions::default() };
    let options = RemeshOptions { simplify, size: Some(Size::Hexes(hexes)), ..RemeshOptions::default() };
    remesh(&input, &options, &Context::default()).unwrap()
}

/// The largest ratio of the edges of a cell, and the least corner determinant over the mean of all.
fn sizes(Hexes { mesh, .. }: &Hexes) -> (f64, f64) {
    let around = |k: usize| [[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]][k];
    let at = |v: u32| -> Point { mesh.points()[v as usize] };
    let (mut ratio, mut determinants) = (0.0_f64, Vec::new());
    for hex in cells(mesh) {
        let lengths: Vec<f64> =
            (0..8).flat_map(|k| around(k).map(|i: usize| (at(hex[i]) - at(hex[k])).norm())).collect();
        let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        ratio = ratio.max(lengths.iter().copied().fold(0.0, f64::max) / shortest);
        let product = |k: usize| lengths[3 * k..3 * k + 3].iter().product::<f64>();
        determinants.extend(corner_jacobians(mesh.points(), hex).iter().enumerate().map(|(k, j)| j * product(k)));
    }
    let mean = determinants.iter().sum::<f64>() / determinants.len() as f64;
    (ratio, determinants.into_iter().fold(f64::INFINITY, f64::min) / mean)
}

/// Without a look at sizes these have edges that differ by factors of thousands, and a good least scaled Jacobian.
#[test]
fn no_cell_collapses() {
    if folder().is_none() {
        return;
    }
    let pair = pair("l12014-kitty", "obj");
    let input = Input { polycube: &pair.0, shape: Some(&pair.1), labels: None };
    for padding in 1..=2 {
        let options = RemeshOptions { size: Some(Size::Hexes(4000)), padding, ..RemeshOptions::default() };
        let found = remesh(&input, &options, &Context::default()).unwrap();
        let (ratio, determinant) = sizes(found.hexes.as_ref().unwrap());
        assert!(ratio <= 20.0 && determinant >= 0.01, "{padding} layers: {ratio}, {determinant}");
        let measures = found.report.measures.unwrap();
        assert!((measures.edge_ratio.max / ratio - 1.0).abs() < 1e-9);
        assert!((measures.determinant.min / determinant - 1.0).abs() < 1e-9);
        assert!(found.report.min_sj > Some(0.35), "{:?}", found.report.min_sj);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_valid_hexahedra() {
    let kinds = [CellKind::Triangles, CellKind::Tetrahedra];
    for (name, kind) in [(Example::Ring, kinds[0]), (Example::CubeSpikes, kinds[1])] {
        let pair = example(name, 3, kind).unwrap();
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| run(&pair, 2500))
        };
        let [one, three] = [with(1), with(3)];
        let hexes = [&one, &three].map(|r| r.hexes.as_ref().unwrap());
        assert_eq!(hexes[0], hexes[1], "{name}");
        assert_eq!(one.simplified.polycube, three.simplified.polycube, "{name}");
        let (inverted, worst, _) = quality(hexes[0]);
        assert!(inverted == 0 && worst > 0.3, "{name}: {worst}");
        assert!((hexes[0].block_id.len() as f64 / 2500.0 - 1.0).abs() < 0.25, "{name}");
    }
}
