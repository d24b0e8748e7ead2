//! How far the proof of the fewest blocks gets on a polycube: `prove_time FILE [NODES [SECONDS [all]]]`. Instead of a
//! file, `random:SEED:BOXES:EXTENT` is a generated polycube; `all` proves all three objectives.

use polycube::generate::random_polycube;
use polycube::layout::Objective;
use polycube::mesh::CellKind;
use polycube::mesh::Mesh;
use polycube::parts::{AlignOptions, Ranks, align, prove};
use polycube::structure::{Polycube, Tolerance, placement_of};
use std::time::{Duration, Instant};

fn main() {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().expect("a mesh file");
    let nodes = arguments.next().map_or(1_000_000, |n| n.parse().expect("a number of nodes"));
    let seconds = arguments.next().map_or(60, |n| n.parse().expect("a number of seconds"));
    let all = arguments.next().is_some_and(|a| a == "all");
    let mesh = mesh(&file);
    let polycube = Polycube::new(&mesh, None, &Tolerance::default()).expect("a polycube");
    let s = &polycube.structure;
    let context = polycube::Context::default();
    let aligned = align(s, &polycube.placement, &AlignOptions::default(), &context).expect("an alignment");
    let levels = placement_of(&aligned.levels);
    let start = Ranks::new(s, &levels);
    let of_axis = [0, 1, 2].map(|a| s.levels.iter().filter(|l| l.axis == a).count());
    let objectives = [Objective::BlocksPadded, Objective::Blocks, Objective::SurfacePatches];
    for objective in objectives.into_iter().take(if all { 3 } else { 1 }) {
        let root = prove(s, objective, &start, 0, None, &context).expect("a bound");
        let clock = Instant::now();
        let time = Some(Duration::from_secs(seconds));
        let proof = prove(s, objective, &start, nodes, time, &context).expect("a proof");
        println!(
            "{file} {of_axis:?} {objective:?}: start {} best {} bound {} root {} {} nodes {} time {:.2?}",
            root.count,
            proof.count,
            proof.bound,
            root.bound,
            if proof.proven { "PROVEN" } else { "open" },
            proof.nodes,
            clock.elapsed()
        );
    }
}

fn mesh(name: &str) -> Mesh {
    let Some(random) = name.strip_prefix("random:") else {
        return polycube::mesh::read(std::path::Path::new(name)).expect("a readable mesh");
    };
    let numbers: Vec<u32> = random.split(':').map(|n| n.parse().expect("a number")).collect();
    let [seed, boxes, extent] = numbers[..] else { panic!("three numbers after random:") };
    let voxels = random_polycube(seed.into(), boxes as usize, extent.into()).expect("a polycube");
    voxels.mesh(CellKind::Quads, f64::from(extent)).expect("a mesh")
}
