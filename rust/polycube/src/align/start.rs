//! Where the search begins: a valid order near the input that respects the guides.

use super::guides::Guided;
use super::judge::{Judge, is_valid};
use super::ranks::Ranks;
use super::search::Moves;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::rng::SplitMix64;
use crate::structure::{Arrangement, Placement, Structure};

/// Moves tried per level to make the input respect the guides.
const STEPS_PER_LEVEL: usize = 400;

/// A valid placement that respects `guided`: the input itself, the input with what must be equal or mirrored at its
/// mean, or, if neither does, one found by random moves, in numbers of planes.
///
/// # Errors
/// [`ErrorKind::Infeasible`] if none is found; [`ErrorKind::Cancelled`].
pub(super) fn guided_start(
    structure: &Structure,
    input: &[f64],
    guided: &Guided,
    context: &Context,
) -> Result<Placement> {
    if guided.allows(&Ranks::new(structure, input)) {
        return Ok(input.to_vec());
    }
    let averaged = guided.averaged(structure, input);
    let ranks = Ranks::new(structure, &averaged);
    if guided.allows(&ranks) && is_valid(&Arrangement::new(structure, &averaged)) {
        return Ok(averaged);
    }
    repaired(structure, input, guided, context)
}

/// A walk over valid orders from that of the input that never gets farther from the guides.
fn repaired(structure: &Structure, input: &[f64], guided: &Guided, context: &Context) -> Result<Placement> {
    let moves = Moves::new(structure, &Guided::free(structure), Vec::new());
    let mut judge = Judge::new(structure);
    let mut random = SplitMix64::new(1);
    let mut now = Ranks::new(structure, input);
    let mut missing = guided.missing(&now);
    for _ in 0..STEPS_PER_LEVEL * structure.levels.len() {
        context.check()?;
        let Some((next, _)) = moves.draw(&now, false, &mut random) else { continue };
        let its = guided.missing(&next);
        if its <= missing && judge.counts(&next).is_some() {
            (now, missing) = (next, its);
        }
        if missing == 0 {
            return Ok(now.placement());
        }
    }
    let message = "no valid polycube was found that respects the guides";
    Err(Error::new(ErrorKind::Infeasible, message)
        .remedy("ask for fewer facets together, apart or fixed, or use a larger scale"))
}
