//! Lattice steps where the shape is long: the levels of a polycube spaced by what lies between them on the shape.

use super::climb::Rung;
use super::size::{Search, count_hexes};
use crate::align::{self, Options};
use crate::context::Context;
use crate::error::Result;
use crate::simplify::Simplified;

/// A slab counts as no shorter than this part of the mean step, and no longer than one over it.
const LEAST: f64 = 0.2;

/// New levels for `map` in the order they have and with about as many hexahedra: the steps between two levels as many as the
/// lattice edges of `rung` there are long on the shape.
///
/// # Errors
/// Those of [`align::rescale`].
pub(super) fn spaced(map: &Simplified, rung: &Rung, padding: usize, context: &Context) -> Result<Vec<i64>> {
    let structure = &map.input.structure;
    let targets = positions(map, rung);
    let wanted = count_hexes(structure, &map.levels, padding) as f64;
    let search = Search { simplified: map, targets: &targets, padding, wanted };
    let scale = search.run(context)?;
    let options = Options { strategy: align::Strategy::Paper, scale, ..Options::default() };
    align::rescale(structure, &targets, &map.levels, &options, context)
}

/// Where each level would lie if lattice steps were as long as on the shape, from 0 for the lowest of each axis.
fn positions(map: &Simplified, rung: &Rung) -> Vec<f64> {
    let mut targets = vec![0.0; rung.levels.len()];
    for (axis, lengths) in rung.lengths().into_iter().enumerate() {
        let mut own: Vec<usize> = (0..targets.len()).filter(|&l| map.input.structure.levels[l].axis == axis).collect();
        own.sort_by_key(|&l| (rung.levels[l], l));
        let Some(&first) = own.first() else { continue };
        let lowest = rung.levels[first];
        let (mut at, mut reached) = (0.0, lowest);
        for l in own {
            at += lengths[(reached - lowest) as usize..(rung.levels[l] - lowest) as usize].iter().sum::<f64>();
            reached = rung.levels[l];
            targets[l] = at;
        }
    }
    targets
}

/// Keeps odd lengths within bounds and replaces unknown ones by the mean.
pub(super) fn tamed(lengths: [Vec<f64>; 3]) -> [Vec<f64>; 3] {
    let known = || lengths.iter().flatten().copied().filter(|l| *l > 0.0);
    let mean = known().sum::<f64>() / known().count().max(1) as f64;
    let tame = |l: f64| if l > 0.0 { l.clamp(LEAST * mean, mean / LEAST) } else { mean };
    lengths.map(|own| own.into_iter().map(tame).collect())
}
