//! Lattice steps where the shape is long: the levels of a polycube spaced by what lies between them on the shape.

use super::coarse_mesh::CoarseMesh;
use crate::align::{self, Guides};
use crate::context::Context;
use crate::error::Result;
use crate::remesh::lattice::{ScaleSearch, count_hexes};
use crate::remesh::map::LatticeMap;

/// New levels for `map` in the order they have and with about as many hexahedra: the steps between two levels as many
/// as the lattice edges of `coarse` there are long on the shape.
///
/// # Errors
/// Those of [`align::rescale`].
pub(crate) fn spaced(map: &LatticeMap, coarse: &CoarseMesh, padding: usize, context: &Context) -> Result<Vec<i64>> {
    let structure = map.structure();
    let targets = positions(map, coarse);
    let wanted = count_hexes(structure, &map.levels, padding) as f64;
    let free = Guides::default();
    let levels_at =
        |scale: f64, context: &Context| align::rescale(structure, &targets, &map.levels, scale, &free, context);
    let search = ScaleSearch { structure, targets: &targets, levels_at: &levels_at, padding, wanted };
    let scale = search.run(context)?;
    levels_at(scale, context)
}

/// Where each level would lie if lattice steps were as long as on the shape, from 0 for the lowest of each axis.
fn positions(map: &LatticeMap, coarse: &CoarseMesh) -> Vec<f64> {
    let mut targets = vec![0.0; coarse.levels.len()];
    for (axis, lengths) in coarse.lengths().into_iter().enumerate() {
        let mut own: Vec<usize> = (0..targets.len()).filter(|&l| map.structure().levels[l].axis == axis).collect();
        own.sort_by_key(|&l| (coarse.levels[l], l));
        let Some(&first) = own.first() else { continue };
        let lowest = coarse.levels[first];
        let (mut at, mut reached) = (0.0, lowest);
        for l in own {
            at += lengths[(reached - lowest) as usize..(coarse.levels[l] - lowest) as usize].iter().sum::<f64>();
            reached = coarse.levels[l];
            targets[l] = at;
        }
    }
    targets
}
