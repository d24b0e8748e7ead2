//! Integer placements that keep an order of levels.

use super::classes::Classes;
use super::problem::Difference;
use super::relax::{Demand, relax};
use super::solve::Solver;
use crate::context::Context;
use crate::error::Result;
use crate::structure::{Placement, Structure};

/// The integer placement nearest to `targets` (E_shape) with the order of `valid`: equal levels stay equal, others at least
/// one step apart. Block structure and validity depend on that order alone, so they are the same at every scale.
pub fn place_in_order(
    structure: &Structure,
    valid: &[f64],
    targets: &[f64],
    solver: &dyn Solver,
    context: &Context,
) -> Result<Placement> {
    let mut order: Vec<u32> = (0..structure.levels.len() as u32).collect();
    let key = |l: u32| (structure.levels[l as usize].axis, valid[l as usize] + 0.0);
    order.sort_by(|&a, &b| key(a).0.cmp(&key(b).0).then(key(a).1.total_cmp(&key(b).1)));
    let mut classes = Classes::new(order.len());
    let mut differences = Vec::new();
    for pair in order.windows(2) {
        let [low, high] = [pair[0], pair[1]];
        if key(low) == key(high) {
            classes.join(low, high);
        } else if key(low).0 == key(high).0 {
            differences.push(Difference { low, high, gap: 1 });
        }
    }
    let demand = Demand { targets, classes: &classes, pairs: &[], halvings: 0, differences, planes: Vec::new() };
    relax(structure, valid, demand, solver, context)
}
