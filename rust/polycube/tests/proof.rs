//! The proof of the fewest blocks against plain enumeration, on polycubes small enough for both.

mod common;

use common::models::model;
use common::read;
use polycube::Context;
use polycube::generate::{Cuboid, Voxels, random_polycube};
use polycube::layout::{Objective, count};
use polycube::mesh::CellKind;
use polycube::parts::{Proof, Ranks, Rows, SplitMix64, prove};
use polycube::structure::{Arrangement, Polycube, Structure};
use std::time::Duration;

const OBJECTIVES: [Objective; 3] = [Objective::BlocksPadded, Objective::Blocks, Objective::SurfacePatches];

/// Every weak order of the levels of one axis in which both ends of each edge are in order, as rank per level.
///
/// Nothing when there are more than `most`.
fn weak_orders(structure: &Structure, axis: usize, most: usize) -> Option<Vec<Vec<(u32, u16)>>> {
    let levels: Vec<u32> = (0..structure.levels.len() as u32).collect();
    let levels: Vec<u32> = levels.into_iter().filter(|&l| structure.levels[l as usize].axis == axis).collect();
    let ends: Vec<[u32; 2]> = structure.edges.iter().map(|e| structure.ends(e)).collect();
    let mut found = Vec::new();
    let mut open = vec![(levels, Vec::new(), 1_u16)];
    while let Some((rest, order, rank)) = open.pop() {
        if rest.is_empty() {
            found.push(order);
            if found.len() > most {
                return None;
            }
            continue;
        }
        let is_free = |l: &u32| !ends.iter().any(|[low, high]| high == l && rest.contains(low));
        let free: Vec<u32> = rest.iter().copied().filter(is_free).collect();
        for choice in 1..1_u32 << free.len() {
            let plane: Vec<u32> = (0..free.len()).filter(|i| choice >> i & 1 == 1).map(|i| free[i]).collect();
            let mut order: Vec<(u32, u16)> = order.clone();
            order.extend(plane.iter().map(|&l| (l, rank)));
            open.push((rest.iter().copied().filter(|l| !plane.contains(l)).collect(), order, rank + 1));
        }
    }
    Some(found)
}

/// The optimum of each objective over all valid orders, if there are no more than `most` orders to look at.
fn brute_force(structure: &Structure, most: usize) -> Option<[usize; 3]> {
    let mut left = most;
    let mut orders = Vec::new();
    for axis in 0..3 {
        let own = weak_orders(structure, axis, left)?;
        left /= own.len();
        orders.push(own);
    }
    let mut rows = Rows::<u64>::new(structure);
    let mut best = [usize::MAX; 3];
    let mut ranks = Ranks { of_level: vec![0; structure.levels.len()], planes: [0; 3] };
    for x in &orders[0] {
        for y in &orders[1] {
            for z in &orders[2] {
                for (axis, order) in [x, y, z].into_iter().enumerate() {
                    order.iter().for_each(|&(l, r)| ranks.of_level[l as usize] = r);
                    ranks.planes[axis] = order.iter().map(|o| usize::from(o.1)).max().unwrap_or(0);
                }
                if rows.count(Objective::Blocks, &ranks.of_level, ranks.planes).is_some() {
                    let counts = count(&Arrangement::new(structure, &ranks.placement()));
                    best = std::array::from_fn(|i| best[i].min(counts.of(OBJECTIVES[i])));
                }
            }
        }
    }
    Some(best)
}

/// The order of the levels when each moves by less than half the least distance, so that hardly two coincide.
fn shaken(polycube: &Polycube, seed: u64) -> Ranks {
    let mut rng = SplitMix64::new(seed);
    let mut noise = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
    let placement: Vec<f64> = polycube.placement.iter().map(|x| x + 0.9 * noise()).collect();
    Ranks::new(&polycube.structure, &placement)
}

fn run(structure: &Structure, objective: Objective, from: &Ranks, nodes: u64) -> Proof {
    prove(structure, objective, from, nodes, None, &Context::default()).expect("a proof")
}

/// The cost of an order, counted the slow way.
fn cost(structure: &Structure, objective: Objective, ranks: &Ranks) -> usize {
    let arrangement = Arrangement::new(structure, &ranks.placement());
    assert!(arrangement.conflicts().is_empty());
    count(&arrangement).of(objective)
}

/// Compares with the optima at every budget; the structure with all its orders must be small.
fn compare(structure: &Structure, from: &Ranks, optima: [usize; 3], name: &str) {
    for (objective, optimum) in OBJECTIVES.into_iter().zip(optima) {
        let mut bound = 0;
        for nodes in [0, 1, 2, 5, 10, 20, 50, 100, 1000, 10_000_000] {
            let proof = run(structure, objective, from, nodes);
            assert!(proof.bound <= optimum && optimum <= proof.count, "{name} {objective:?} {optimum} {proof:?}");
            assert_eq!(proof.proven, proof.bound == proof.count);
            assert_eq!(proof.count, cost(structure, objective, &proof.best), "{name}");
            assert!(proof.bound >= bound, "{name} {objective:?}: a larger budget gave a lower bound");
            assert_eq!(proof, run(structure, objective, from, nodes), "{name}");
            bound = proof.bound;
        }
        assert_eq!(bound, optimum, "{name} {objective:?}");
    }
}

#[test]
fn the_optimum_of_small_polycubes_is_that_of_enumeration() {
    let mut compared = 0;
    let mut improved = 0;
    for seed in 0..250 {
        let voxels = random_polycube(seed, 2 + seed as usize % 3, 5 + seed as i64 % 4).expect("voxels");
        let mesh = voxels.mesh(CellKind::Quads, 1000.0).expect("a mesh");
        let polycube = read(&mesh);
        let structure = &polycube.structure;
        let Some(optima) = brute_force(structure, 20_000) else { continue };
        let from = shaken(&polycube, seed);
        let start = cost(structure, Objective::BlocksPadded, &from);
        compare(structure, &from, optima, &format!("seed {seed}"));
        compared += 1;
        improved += usize::from(optima[0] < start);
    }
    println!("{compared} compared, {improved} of them with fewer blocks than they came with");
    assert!(compared >= 50 && improved >= 10, "{compared} {improved}");
}

/// A bar with a staircase below and one step above that starts at `x`, between the stairs at 10 and 19.
fn figure_10(x: i64) -> Polycube {
    let boxes = [
        Cuboid::new([0, 0, 0], [40, 20, 10]),
        Cuboid::new([10, 0, -5], [40, 20, 0]),
        Cuboid::new([19, 0, -10], [40, 20, -5]),
        Cuboid::new([x, 0, 10], [40, 20, 15]),
    ];
    read(&Voxels::from_boxes(&boxes).expect("voxels").mesh(CellKind::Quads, 1000.0).expect("a mesh"))
}

#[test]
fn of_two_partners_the_better_one_is_found_though_the_other_is_nearer() {
    let [nearer, farther, between] = [10, 19, 14].map(figure_10);
    let count = |p: &Polycube| cost(&p.structure, Objective::BlocksPadded, &Ranks::new(&p.structure, &p.placement));
    assert!(count(&farther) < count(&nearer) && count(&nearer) < count(&between));
    let structure = &between.structure;
    let from = Ranks::new(structure, &between.placement);
    let optima = brute_force(structure, 100_000).expect("few orders");
    assert_eq!(optima[0], count(&farther));
    compare(structure, &from, optima, "figure 10");
}

#[test]
fn an_order_that_is_not_valid_is_refused() {
    let polycube = figure_10(14);
    let ranks = Ranks { of_level: vec![1; polycube.structure.levels.len()], planes: [1; 3] };
    let result = prove(&polycube.structure, Objective::Blocks, &ranks, 10, None, &Context::default());
    assert_eq!(result.unwrap_err().kind, polycube::ErrorKind::Polycube);
}

#[test]
fn a_cancelled_proof_is_an_error() {
    let polycube = figure_10(14);
    let context = Context::default();
    context.cancel();
    let from = Ranks::new(&polycube.structure, &polycube.placement);
    let result = prove(&polycube.structure, Objective::Blocks, &from, 10, None, &context);
    assert_eq!(result.unwrap_err().kind, polycube::ErrorKind::Cancelled);
}

#[test]
fn published_polycubes_are_certified() {
    let known = [
        ("marco2016sgp-asm", [122, 32, 82]),
        ("marco2016sgp-block", [100, 24, 76]),
        ("marco2016sgp-cubespikes", [111, 33, 78]),
        ("marco2016sgp-femur", [80, 19, 60]),
        ("l12014-kitty", [121, 35, 86]),
        ("l12014-rod", [122, 32, 82]),
    ];
    for (name, optima) in known {
        let Some(polycube) = model(name).map(|mesh| read(&mesh)) else { continue };
        let from = Ranks::new(&polycube.structure, &polycube.placement);
        for (objective, optimum) in OBJECTIVES.into_iter().zip(optima) {
            let proof = run(&polycube.structure, objective, &from, 100_000);
            println!("{name} {objective:?}: {} to {} in {} nodes", proof.bound, proof.count, proof.nodes);
            assert!(proof.proven && proof.count == optimum, "{name} {objective:?} {proof:?}");
        }
    }
}

#[test]
fn a_large_polycube_has_a_bound_at_once() {
    let Some(polycube) = model("l12014-rockerarm_2").map(|mesh| read(&mesh)) else { return };
    let from = Ranks::new(&polycube.structure, &polycube.placement);
    let context = Context::default();
    let limit = Some(Duration::from_millis(500));
    let proof = prove(&polycube.structure, Objective::BlocksPadded, &from, u64::MAX, limit, &context).expect("a proof");
    assert!(proof.bound >= polycube.structure.facets.len() && proof.bound <= proof.count);
}
