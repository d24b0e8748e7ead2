//! Random polycubes from a seed.

use super::voxels::{Cuboid, Voxels};
use crate::error::{Error, ErrorKind, Result};
use crate::rng::SplitMix64;

/// Sides of the boxes that [`random_with_corners`] joins.
const SIDES: [i64; 2] = [2, 9];

/// Extent of [`random_with_corners`] per cube root of the corners: about a third gets solid.
const EXTENT: f64 = 3.6;

/// Rounds after which [`random_with_corners`] returns the closest count so far.
const ROUNDS: usize = 400;

/// The union of `boxes` random boxes in the cube `0..extent`, with pits, tunnels and inner voids
/// cut into it in some cases: manifold, of any genus and any number of components. The same
/// arguments give the same polycube everywhere.
///
/// # Errors
/// [`ErrorKind::Option`] when `boxes` is 0 or `extent` is outside `2..=1000`.
pub fn random_polycube(seed: u64, boxes: usize, extent: i64) -> Result<Voxels> {
    if boxes == 0 || !(2..=1000).contains(&extent) {
        let message = format!("{boxes} boxes in an extent of {extent} make no random polycube");
        return Err(
            Error::new(ErrorKind::Option, message).remedy("ask for one box at least, and an extent from 2 to 1000")
        );
    }
    let mut rng = SplitMix64::new(seed);
    let side = [1, (extent / 2).max(1)];
    let mut voxels = unit_grid(extent)?;
    let boxes: Vec<Cuboid> = (0..boxes).map(|_| random_box(&mut rng, extent, side)).collect();
    boxes.iter().for_each(|b| voxels.set(b, true));
    for b in boxes.iter().filter(|_| rng.one_in(4)).collect::<Vec<_>>() {
        voxels.set(&random_hole(&mut rng, b, extent), false);
    }
    if voxels.count() == 0 {
        voxels.set(&boxes[0], true);
    }
    voxels.make_manifold();
    Ok(voxels.compressed())
}

/// A connected manifold polycube of any genus with about `corners` corners: within 20 % from 100
/// on, and closer the more there are. Its extent grows like the cube root, so that its density stays the same.
///
/// # Errors
/// [`ErrorKind::Option`] when `corners` is outside `8..=1_000_000`.
pub fn random_with_corners(seed: u64, corners: usize) -> Result<Voxels> {
    if !(8..=1_000_000).contains(&corners) {
        let message = format!("a random polycube of {corners} corners is out of range");
        return Err(Error::new(ErrorKind::Option, message).remedy("ask for 8 to 1,000,000 corners"));
    }
    let mut rng = SplitMix64::new(seed);
    let extent = (libm::cbrt(corners as f64) * EXTENT).round() as i64;
    let mut voxels = unit_grid(extent)?;
    voxels.set(&random_box(&mut rng, extent, SIDES), true);
    let mut count = voxels.corners();
    let mut best = (corners.abs_diff(count), voxels.clone());
    for _ in 0..ROUNDS {
        if best.0 * 50 <= corners || count > corners {
            break;
        }
        // A box brings about ten corners, and each round meets about half of what is missing.
        let boxes = ((corners - count) / 20).max(1);
        (0..boxes).for_each(|_| grow(&mut voxels, &mut rng, extent));
        voxels.keep_largest();
        voxels.make_manifold();
        count = voxels.corners();
        if corners.abs_diff(count) < best.0 {
            best = (corners.abs_diff(count), voxels.clone());
        }
    }
    Ok(best.1.compressed())
}

/// No solid cell, between the integer planes of `0..=extent`.
fn unit_grid(extent: i64) -> Result<Voxels> {
    let planes = || (0..=extent).map(|x| x as f64).collect::<Vec<_>>();
    Voxels::empty([planes(), planes(), planes()])
}

/// Adds a box that overlaps the solid cells; one time in five, cuts a hole into one.
fn grow(voxels: &mut Voxels, rng: &mut SplitMix64, extent: i64) {
    // Most boxes miss a young polycube; the bound only guards against an endless search.
    for _ in 0..1_000_000 {
        let b = random_box(rng, extent, SIDES);
        if voxels.touches(&b) {
            voxels.set(&b, true);
            if rng.one_in(5) {
                voxels.set(&random_hole(rng, &b, extent), false);
            }
            return;
        }
    }
}

/// A hole in `b`: all but its skin (a void or a pit), or a tunnel along one axis of its core.
fn random_hole(rng: &mut SplitMix64, b: &Cuboid, extent: i64) -> Cuboid {
    let mut hole = *b;
    let through = rng.below(6) as usize;
    for axis in 0..3 {
        let side = b.max[axis] - b.min[axis];
        if axis == through {
            hole.min[axis] = rng.between(0, b.min[axis]);
            hole.max[axis] = rng.between(b.max[axis], extent);
        } else {
            // A box too thin for a skin on both sides is cut on one side only.
            let skin = rng.between(1, (side / 3).max(1));
            hole.min[axis] += skin.min(side - 1);
            hole.max[axis] -= if side > 2 { skin } else { 0 };
        }
    }
    hole
}

/// A box in the cube `0..extent` with sides in the given range.
fn random_box(rng: &mut SplitMix64, extent: i64, sides: [i64; 2]) -> Cuboid {
    let mut b = Cuboid::new([0; 3], [0; 3]);
    for axis in 0..3 {
        let side = rng.between(sides[0], sides[1]).min(extent);
        b.min[axis] = rng.between(0, extent - side);
        b.max[axis] = b.min[axis] + side;
    }
    b
}

impl Voxels {
    /// Whether a cell inside `b` is solid, on a grid with the planes 0, 1, 2 …
    fn touches(&self, b: &Cuboid) -> bool {
        let range = |axis: usize| b.min[axis]..b.max[axis];
        range(2).any(|z| range(1).any(|y| range(0).any(|x| self.is_solid([x, y, z]))))
    }
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;
    use crate::mesh::CellKind;

    #[test]
    fn every_seed_makes_a_manifold_and_the_seeds_cover_all_topologies() {
        let (mut tunnels, mut parts, mut voids) = (0, 0, 0);
        for seed in 0..500 {
            let boxes = 1 + seed as usize % 12;
            let voxels = random_polycube(seed, boxes, 4 + seed as i64 % 11).unwrap();
            assert!(voxels.is_manifold());
            let mesh = voxels.mesh(CellKind::Quads, 1e9).unwrap();
            check::assert_manifold(&mesh);
            assert!((check::volume(&mesh) - voxels.volume()).abs() < 1e-9);
            let shells = check::shells(&mesh);
            tunnels += usize::from(check::euler(&mesh) < 2 * shells as i64);
            parts += usize::from(voxels.components() > 1);
            voids += usize::from(shells > voxels.components());
        }
        assert!(tunnels > 20 && parts > 20 && voids > 20);
    }

    #[test]
    fn corner_counts_are_met_by_connected_manifolds() {
        for (wish, seeds) in [(100, 20), (1000, 5), (10_000, 2)] {
            for seed in 0..seeds {
                let voxels = random_with_corners(seed, wish).unwrap();
                let count = voxels.corners();
                assert!(count.abs_diff(wish) * 5 <= wish, "{wish}: {count}");
                assert!(voxels.is_manifold());
                assert_eq!(voxels.components(), 1);
            }
        }
    }

    #[test]
    fn corners_are_counted_as_on_the_mesh() {
        let voxels = random_with_corners(3, 200).unwrap();
        let mesh = voxels.mesh(CellKind::Quads, 1.0).unwrap();
        check::assert_manifold(&mesh);
        assert_eq!(check::corners(&mesh), voxels.corners());
    }

    #[test]
    fn a_seed_stands_for_one_polycube() {
        assert_eq!(random_polycube(9, 8, 20), random_polycube(9, 8, 20));
        assert_ne!(random_polycube(9, 8, 20), random_polycube(10, 8, 20));
        assert_eq!(random_with_corners(9, 300), random_with_corners(9, 300));
        assert_ne!(random_with_corners(9, 300), random_with_corners(10, 300));
    }

    #[test]
    fn what_cannot_be_made_is_refused() {
        for (boxes, extent) in [(0, 10), (1, 1), (1, 1001)] {
            let error = random_polycube(0, boxes, extent).unwrap_err();
            assert_eq!(error.kind, ErrorKind::Option);
        }
        for corners in [0, 7, 1_000_001] {
            let error = random_with_corners(0, corners).unwrap_err();
            assert_eq!(error.kind, ErrorKind::Option);
        }
        assert_eq!(random_with_corners(0, 8).unwrap().corners(), 8);
    }
}
