//! What is promised of the hexahedra: none inverted, the same for any number of threads.

use super::quality;
use crate::align::Strategy;
use crate::context::Context;
use crate::generate::{Example, example};
use crate::mesh::{CellKind, Mesh};
use crate::remesh::{RemeshOptions, Remeshed, Size, remesh};
use crate::simplify::{Input, Options};

fn run((polycube, shape): &(Mesh, Mesh), hexes: usize) -> Remeshed {
    let input = Input { polycube, shape: Some(shape), labels: None };
    let simplify = Options { strategy: Strategy::Paper, ..Options::default() };
    let options = RemeshOptions { simplify, size: Some(Size::Hexes(hexes)), ..RemeshOptions::default() };
    remesh(&input, &options, &Context::default()).unwrap()
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
