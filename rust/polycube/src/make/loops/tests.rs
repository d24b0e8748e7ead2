//! Loops on generated shapes of known topology.

use super::check::check;
use super::start::start;
use super::*;
use crate::generate::deform::Deformation;
use crate::generate::{Cuboid, Example, Voxels, example, random_polycube};
use crate::mesh::{CellKind, Mesh, Simplices};
use crate::rng::SplitMix64;
use proptest::prelude::*;

fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    match mesh.cells().simplices() {
        Simplices::Triangles(t) => t.into_owned(),
        Simplices::Tetrahedra(_) => panic!("a surface was made"),
    }
}

fn loops_of(mesh: &Mesh, options: &LoopOptions) -> LoopSet {
    let corners = |set: &LoopSet| Ok((set.corners as f64, ()));
    let found = loops(mesh.points(), &triangles(mesh), options, &Context::default(), corners);
    found.expect("there are loops").swap_remove(0).loops
}

fn check_set(set: &LoopSet) {
    check(&set.mesh, |cut| set.graph.loops[cut as usize].alive);
}

/// A surface with triangles about `step` long, rounded, bent and twisted by `seed`.
fn deformed(voxels: &Voxels, seed: u64, step: f64) -> Mesh {
    let mut mesh = voxels.mesh(CellKind::Triangles, step).expect("the surface is small");
    let mut rng = SplitMix64::new(seed);
    let extent = (0..3).map(|a| voxels.planes(a)[voxels.planes(a).len() - 1]).fold(0.0, f64::max);
    let center = [0, 1, 2].map(|a| voxels.planes(a)[voxels.planes(a).len() - 1] / 2.0);
    let maps = [
        Deformation::Round { center, axes: [true; 3], strength: 0.8 * rng.unit(), core: 0.3 * extent },
        Deformation::Twist { center, axis: rng.below(3) as usize, rate: 0.8 * rng.unit() / extent },
        Deformation::Bend { center, along: 0, towards: 2, curvature: (0.1 + 0.6 * rng.unit()) / extent },
    ];
    for p in mesh.points_mut() {
        *p = maps.iter().fold(*p, |p, map| map.apply(p));
    }
    mesh
}

/// A plate with `holes` holes.
fn plate(holes: i64) -> Voxels {
    let body = Cuboid::new([0, 0, 0], [2 * holes + 1, 3, 1]);
    let hole = |i: i64| Cuboid::new([2 * i + 1, 1, 0], [2 * i + 2, 2, 1]);
    Voxels::from_difference(&[body], &(0..holes).map(hole).collect::<Vec<_>>()).expect("holes apart")
}

/// Where levels of two axes meet on the diagonals of squares, what is cut there has no area and never goes away again.
#[test]
fn levels_of_a_cube_do_not_meet_on_its_diagonals() {
    let mesh =
        Voxels::from_boxes(&[Cuboid::new([0, 0, 0], [2, 2, 2])]).unwrap().mesh(CellKind::Triangles, 1.0).unwrap();
    let (points, triangles) = (mesh.points(), triangles(&mesh));
    let values = Field::new(points, &triangles).solve(2.0, 0.0, &Context::default()).unwrap();
    let cut = start(points, &values, &triangles, 16, &Context::default()).unwrap().mesh;
    let areas: Vec<f64> = (0..cut.triangles.len()).map(|t| cut.area_vector(t).norm()).collect();
    let mean = areas.iter().sum::<f64>() / areas.len() as f64;
    let flat = areas.iter().filter(|area| **area < 1e-9 * mean).count();
    assert!(1000 * flat < areas.len(), "{flat} of {}", areas.len());
}

#[test]
fn a_box_has_eight_corners() {
    let mesh =
        Voxels::from_boxes(&[Cuboid::new([0, 0, 0], [3, 2, 2])]).unwrap().mesh(CellKind::Triangles, 0.5).unwrap();
    let set = loops_of(&mesh, &LoopOptions::default());
    check_set(&set);
    assert_eq!(set.corners, 8);
    assert_eq!(set.graph.loops.iter().filter(|l| l.alive).count(), 3);
}

#[test]
fn plates_of_genus_0_to_12_are_valid_after_every_step() {
    for holes in [0, 1, 2, 5, 12] {
        let mesh = deformed(&plate(holes), holes as u64, 0.25);
        let triangles = triangles(&mesh);
        let values = Field::new(mesh.points(), &triangles).solve(0.5, 0.0, &Context::default()).unwrap();
        let begun = start(mesh.points(), &values, &triangles, 24, &Context::default()).unwrap();
        assert_eq!(begun.fault, None, "genus {holes}");
        check(&begun.mesh, |cut| begun.alive[cut as usize]);
        let graph = LoopGraph::new(&begun.mesh, &begun.alive);
        let energies = Energies::new(&begun.mesh, &begun.alive, &graph);
        let mut moves = Moves::new(&begun.mesh, &begun.alive, graph, energies);
        let first = moves.corners();
        let mut corners = usize::MAX;
        while moves.corners() < corners {
            corners = moves.corners();
            let options = LoopOptions { corners: Some(corners - 1), ..LoopOptions::default() };
            coarsen::coarsen(&mut moves, &options, &Context::default()).unwrap();
            check(&begun.mesh, |cut| moves.graph.loops[cut as usize].alive);
        }
        assert!((8..=first).contains(&corners), "genus {holes}: {first} corners became {corners}");
    }
}

#[test]
fn a_plate_keeps_the_corners_of_its_holes() {
    let mesh = plate(3).mesh(CellKind::Triangles, 0.25).unwrap();
    let set = loops_of(&mesh, &LoopOptions::default());
    check_set(&set);
    assert_eq!(set.corners, 32);
}

#[test]
fn examples_have_valid_loops_at_little_and_much_detail() {
    for one in Example::ALL {
        let (_, shape) = example(one, 1, CellKind::Triangles).unwrap();
        let corners = [0.1, 0.9].map(|detail| {
            let set = loops_of(&shape, &LoopOptions { detail, corners: None });
            check_set(&set);
            set.corners
        });
        assert!(corners[0] <= corners[1], "{one}: {corners:?}");
    }
}

#[test]
fn the_number_of_corners_can_be_asked_for() {
    let (_, shape) = example(Example::CubeSpikes, 1, CellKind::Triangles).unwrap();
    let few = loops_of(&shape, &LoopOptions { detail: 0.5, corners: Some(16) });
    check_set(&few);
    assert!(few.corners <= 16, "{} corners", few.corners);
}

#[test]
fn any_number_of_threads_gives_the_same_loops() {
    let (_, shape) = example(Example::SteppedL, 2, CellKind::Triangles).unwrap();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| loops_of(&shape, &LoopOptions::default()))
    };
    let (one, many) = (with(1), with(4));
    assert_eq!(one.mesh.points, many.mesh.points);
    let alive = |set: &LoopSet| set.graph.loops.iter().map(|l| l.alive).collect::<Vec<_>>();
    assert_eq!(alive(&one), alive(&many));
}

#[test]
fn a_cancelled_search_stops() {
    let (_, shape) = example(Example::Ring, 1, CellKind::Triangles).unwrap();
    let context = Context::default();
    context.cancel();
    let stopped = loops(shape.points(), &triangles(&shape), &LoopOptions::default(), &context, |_| Ok((0.0, ())));
    assert_eq!(stopped.unwrap_err().kind, ErrorKind::Cancelled);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn random_shapes_have_valid_loops(seed in 0_u64..10_000, boxes in 1_usize..6) {
        let voxels = random_polycube(seed, boxes, 6).unwrap();
        let set = loops_of(&deformed(&voxels, seed, 0.5), &LoopOptions::default());
        check_set(&set);
    }
}
