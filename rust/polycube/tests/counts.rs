//! Patches and blocks: known answers, and the same numbers from an independent count on an actual mesh.

mod common;

use common::{coarse, hexes, read};
use polycube::generate::{Cuboid, Example, Voxels, random_polycube};
use polycube::layout::{Counts, count};
use polycube::mesh::{CellKind, Cells};
use polycube::parts::cube_spikes;
use polycube::structure::Arrangement;

fn counts(voxels: &Voxels) -> Counts {
    let polycube = read(&coarse(voxels, CellKind::Quads));
    count(&Arrangement::new(&polycube.structure, &polycube.placement))
}

/// On unit hexahedra when `step` is 1, on one per cell of the coarsest lattice when it is large.
fn brute(voxels: &Voxels, step: f64) -> Counts {
    match voxels.mesh(CellKind::Hexahedra, step).expect("a mesh").cells() {
        Cells::Hexahedra(cells) => hexes::count(cells),
        _ => unreachable!("hexahedra were asked for"),
    }
}

fn known(surface_patches: usize, blocks: usize, blocks_padded: usize) -> Counts {
    Counts { surface_patches, blocks, blocks_padded }
}

fn boxes(list: &[([i64; 3], [i64; 3])]) -> Voxels {
    let boxes: Vec<Cuboid> = list.iter().map(|b| Cuboid::new(b.0, b.1)).collect();
    Voxels::from_boxes(&boxes).expect("boxes")
}

#[test]
fn a_cube_is_one_block() {
    let cube = boxes(&[([0; 3], [3; 3])]);
    assert_eq!(counts(&cube), known(6, 1, 7));
    assert_eq!(brute(&cube, 1.0), known(6, 1, 7));
}

#[test]
fn aligned_cube_spikes_have_33_blocks() {
    let spikes = cube_spikes(0).unwrap();
    assert_eq!(counts(&spikes), known(78, 33, 111));
    assert_eq!(brute(&spikes, 1e9), known(78, 33, 111));
}

/// Two bars that overlap, and the same with the lower side of the one aligned with the upper side of the other.
#[test]
fn the_inset_of_the_paper_has_33_padded_blocks_and_22_when_aligned() {
    let before = boxes(&[([0, 0, 0], [4, 3, 2]), ([2, 2, 0], [6, 5, 2])]);
    assert_eq!(counts(&before), known(26, 7, 33));
    assert_eq!(brute(&before, 1.0), known(26, 7, 33));
    let after = boxes(&[([0, 0, 0], [4, 2, 2]), ([2, 2, 0], [6, 5, 2])]);
    assert_eq!(counts(&after), known(18, 4, 22));
    assert_eq!(brute(&after, 1.0), known(18, 4, 22));
}

/// A ring of eight blocks: four at the corners and four between, each open on four sides.
#[test]
fn a_square_ring_has_8_blocks() {
    let hole = Cuboid::new([2, 2, -1], [4, 4, 3]);
    let ring = Voxels::from_difference(&[Cuboid::new([0; 3], [6, 6, 2])], &[hole]).unwrap();
    assert_eq!(counts(&ring), known(32, 8, 40));
    assert_eq!(brute(&ring, 1.0), known(32, 8, 40));
}

/// The surface is cut by more sheets than separatrices: the void's sheets reach the outside of the cube.
#[test]
fn a_void_cuts_the_outer_surface_through_the_volume_only() {
    let hole = Cuboid::new([1; 3], [2; 3]);
    let hollow = Voxels::from_difference(&[Cuboid::new([0; 3], [3; 3])], &[hole]).unwrap();
    assert_eq!(counts(&hollow), known(12, 26, 26 + 54 + 6));
    assert_eq!(brute(&hollow, 1.0), known(12, 26, 86));
}

#[test]
fn examples_count_the_same_on_a_mesh() {
    for example in Example::ALL {
        for seed in 0..6 {
            let voxels = example.voxels(seed).unwrap();
            assert_eq!(counts(&voxels), brute(&voxels, 1e9), "{example} {seed}");
        }
    }
}

#[test]
fn random_polycubes_count_the_same_on_a_mesh() {
    for seed in 0..common::cases(1500) {
        let voxels = random_polycube(seed, 1 + seed as usize % 9, 3 + seed as i64 % 10).unwrap();
        assert_eq!(counts(&voxels), brute(&voxels, 1e9), "seed {seed}");
    }
}

/// Refining the mesh adds regular vertices and edges only.
#[test]
fn unit_hexahedra_count_the_same_as_coarse_ones() {
    for seed in 0..common::cases(30) {
        let voxels = random_polycube(seed, 1 + seed as usize % 5, 7).unwrap();
        assert_eq!(brute(&voxels, 1e9), brute(&voxels, 1.0), "seed {seed}");
    }
}
