//! The rows of bits against the exact arrangement and the lattice of cells.

use super::Rows;
use super::{Wide, Word};
use crate::generate::random_polycube;
use crate::layout::{Objective, count};
use crate::mesh::CellKind;
use crate::rng::SplitMix64;
use crate::structure::{Arrangement, Polycube, Structure, Tolerance};

const OBJECTIVES: [Objective; 3] = [Objective::BlocksPadded, Objective::Blocks, Objective::SurfacePatches];

fn polycube(seed: u64) -> Polycube {
    let mesh = random_polycube(seed, 6, 10).unwrap().mesh(CellKind::Quads, 1e9).unwrap();
    Polycube::new(&mesh, None, &Tolerance::default()).unwrap()
}

/// The rank of every level and the number of planes.
fn ranks(structure: &Structure, placement: &[f64]) -> (Vec<u16>, [usize; 3]) {
    let mut planes = [0; 3];
    let mut ranks = vec![0; placement.len()];
    for (axis, count) in planes.iter_mut().enumerate() {
        let own = || (0..placement.len()).filter(|&l| structure.levels[l].axis == axis);
        let mut sorted: Vec<f64> = own().map(|l| placement[l]).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.dedup();
        own().for_each(|l| ranks[l] = sorted.partition_point(|&x| x < placement[l]) as u16 + 1);
        *count = sorted.len();
    }
    (ranks, planes)
}

/// What the exact arrangement says: nothing for a placement that is no valid polycube.
fn exact(structure: &Structure, placement: &[f64], objective: Objective) -> Option<usize> {
    let arrangement = Arrangement::new(structure, placement);
    let valid = structure.shortest_edge(placement) > 0.0
        && arrangement.conflicts().is_empty()
        && arrangement.inside_out().is_empty();
    valid.then(|| count(&arrangement).of(objective))
}

/// Moves one level after another onto, before or behind another and compares; how many placements were valid and not.
fn compare<R: Word>(seed: u64, steps: usize) -> [usize; 2] {
    let polycube = polycube(seed);
    let structure = &polycube.structure;
    let mut rows = Rows::<R>::new(structure);
    let mut random = SplitMix64::new(seed);
    let mut at = polycube.placement.clone();
    let mut seen = [0; 2];
    for _ in 0..steps {
        let mut placement = at.clone();
        let [level, onto] = [(); 2].map(|()| random.below(at.len() as u64) as usize);
        if structure.levels[level].axis != structure.levels[onto].axis {
            continue;
        }
        placement[level] = placement[onto] + random.between(-1, 1) as f64 * 1e-6;
        let (order, planes) = ranks(structure, &placement);
        for objective in OBJECTIVES {
            let expected = exact(structure, &placement, objective);
            assert_eq!(rows.count(objective, &order, planes), expected, "seed {seed}, {objective:?}, {placement:?}");
        }
        let counts = rows.counts(&order, planes);
        let each = OBJECTIVES.map(|o| rows.count(o, &order, planes));
        assert_eq!(OBJECTIVES.map(|o| counts.map(|c| c.of(o))), each, "seed {seed}");
        let valid = rows.is_valid(&order, planes);
        assert_eq!(valid, counts.is_some(), "seed {seed}");
        seen[usize::from(valid)] += 1;
        if valid {
            at = placement;
        }
    }
    seen
}

#[test]
fn rows_agree_with_the_arrangement_on_valid_and_broken_orders() {
    let mut seen = [0; 2];
    for seed in 0..60 {
        let these = match seed % 4 {
            0 => compare::<u64>(seed, 60),
            1 => compare::<u128>(seed, 60),
            2 => compare::<Wide<4>>(seed, 60),
            _ => compare::<Wide<16>>(seed, 60),
        };
        seen = [seen[0] + these[0], seen[1] + these[1]];
    }
    assert!(seen[0] > 300 && seen[1] > 300, "both kinds must occur: {seen:?}");
}
