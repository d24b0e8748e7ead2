//! The integer placement of an order of levels.

use super::chain::Plane;
use super::guides::Guided;
use super::problem::Problem;
use super::ranks::Ranks;
use crate::error::{Error, ErrorKind, Result};
use crate::structure::Structure;

/// The integer placement nearest to `targets` with the order `ranks`, as the guides have it. Of two equally near the
/// lower. Block structure and validity depend on the order alone, so they are the same at every scale. O(n log n).
///
/// # Errors
/// [`ErrorKind::Infeasible`] if there is no room for the planes between facets that must not move.
pub(super) fn place_in_order(
    structure: &Structure,
    ranks: &Ranks,
    targets: &[f64],
    guided: &Guided,
) -> Result<Vec<i64>> {
    let mut levels = vec![0; targets.len()];
    for axis in 0..3 {
        let mut planes = vec![Plane { weight: 0, moment: 0, fixed: None }; ranks.planes[axis]];
        let own = || (0..targets.len()).filter(|&l| structure.levels[l].axis == axis);
        let plane_of = |l: usize| usize::from(ranks.of_level[l]) - 1;
        for l in own() {
            let (plane, corners) = (&mut planes[plane_of(l)], i64::from(structure.levels[l].corners));
            plane.weight += corners;
            plane.moment += i128::from(corners) * fixed_point(targets[l]);
        }
        let fits = guided.pin(ranks, axis, &mut planes);
        let placed = guided.place(axis, &planes).filter(|_| fits).ok_or_else(|| no_room(axis))?;
        own().for_each(|l| levels[l] = placed[plane_of(l)]);
    }
    Ok(levels)
}

fn fixed_point(x: f64) -> i128 {
    (x * f64::from(1 << Problem::FRACTION_BITS)).round() as i128
}

fn no_room(axis: usize) -> Error {
    let message =
        format!("the lattice is too coarse along {} for the facets that must not move", ["X", "Y", "Z"][axis]);
    Error::new(ErrorKind::Infeasible, message).remedy("use a larger scale, or fix fewer facets")
}
