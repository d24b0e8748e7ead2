//! Aligning the corners of a polycube on the integer lattice. Nothing here knows about meshes.
//!
//! [`align`] is the way in. Algorithm 1 pairs corners (`neighbours`), turns the pairs and the distances to keep
//! into an integer `problem`, `solve`s it, checks the result exactly, and repeats.

mod chain;
mod classes;
mod difference;
mod effort;
mod guides;
mod judge;
pub(crate) mod options;
mod origin;
mod paper;
mod place;
mod potential;
pub(crate) mod problem;
pub(crate) mod prove;
pub(crate) mod ranks;
mod relax;
mod search;
mod separate;
pub(crate) mod solve;
mod start;
mod unit;

pub use effort::Effort;
pub use guides::{Guides, Symmetry};
pub(crate) use options::AlignOptions;
pub(crate) use options::keeps;
pub use options::{SolverKind, Strategy};
pub use paper::Round;
pub(crate) use paper::neighbours;

use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::layout::{Counts, count};
use crate::range::Range;
use crate::structure::{Arrangement, Conflict, Placement, Structure, placement_of};
use guides::Guided;
use judge::{Judge, is_valid};
use origin::{BOUND, Origin};
use place::place_in_order;
use ranks::Ranks;
use start::guided_start;
use std::time::Instant;

/// Levels on the lattice, and how they got there.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// The lattice coordinate of every level.
    pub levels: Vec<i64>,
    /// Counts of the input as it came.
    pub before: Counts,
    /// Counts of the result; nothing if it is not valid.
    pub after: Option<Counts>,
    /// The rounds of Algorithm 1, in order.
    pub rounds: Vec<Round>,
    /// What a naive rounding broke; empty for every other strategy.
    pub broken: Vec<Conflict>,
    /// The trade-off between few blocks and little displacement, from the fewest blocks on; only from
    /// [`Strategy::Best`].
    pub front: Vec<TradeOff>,
    /// Which trade-off of the front the levels are; nothing if they are none.
    pub chosen: Option<usize>,
    /// How far the objective can go down at most; only from [`Strategy::Best`].
    pub bound: Option<LowerBound>,
}

/// What is proven of the least count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct LowerBound {
    /// No valid polycube of this structure counts less.
    pub count: usize,
    /// Whether the search reached it, so that its result is the optimum.
    pub proven: bool,
    /// Partial orders looked at.
    pub nodes: u64,
}

/// One way to trade blocks for displacement.
#[derive(Clone, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct TradeOff {
    /// What the objective counts.
    pub count: usize,
    /// Root mean square of the corners' displacement, in units of the input, on a lattice of half the shortest edge; 0
    /// for the input itself, where a finer lattice leaves its levels where they are.
    pub displacement: f64,
    /// The number of every level's plane, from 1.
    pub order: Vec<u16>,
}

/// Moves the levels of a valid polycube to integers so that they align.
///
/// `input` is the coordinate of each level; its arrangement must be free of conflicts. The result keeps facets, corners
/// and edges, is embedded, and has no more blocks than the input. Which levels coincide and how the others are ordered
/// does not depend on the scale (paper, Fig. 3), nor on units or position of the input.
///
/// # Errors
/// [`ErrorKind::Option`] for a scale that is not positive or too large for the lattice and for guides that name what
/// does not exist or contradict each other, [`ErrorKind::Polycube`] for an input that touches itself,
/// [`ErrorKind::Unsupported`] for more than 65535 levels along one axis, [`ErrorKind::Infeasible`] if no valid polycube
/// with no more blocks is found that respects the guides, [`ErrorKind::Cancelled`].
#[doc(hidden)]
pub fn align(structure: &Structure, input: &[f64], options: &AlignOptions, context: &Context) -> Result<Alignment> {
    let before = counts_before(structure, input)?;
    let origin = Origin::of(structure, input, options.scale);
    let input = origin.leave(structure, input);
    let task = Task::new(structure, &input, before, options, context)?;
    let mut found = match options.strategy {
        Strategy::Naive => naive(&task)?,
        Strategy::Paper => paper::simplify(&task, context)?,
        Strategy::Best => search::coarsest(&task, context)?,
    };
    if options.strategy != Strategy::Naive {
        check(structure, &found.levels)?;
    }
    found.levels = origin.put_back(structure, found.levels);
    Ok(found)
}

/// The counts of the input, which must be a valid polycube.
fn counts_before(structure: &Structure, input: &[f64]) -> Result<Counts> {
    let levels = |axis: usize| structure.levels.iter().filter(|l| l.axis == axis).count();
    if (0..3).any(|axis| levels(axis) > usize::from(u16::MAX)) {
        return Err(Error::new(ErrorKind::Unsupported, "there are more than 65535 levels along one axis")
            .remedy("cut the polycube into parts"));
    }
    Judge::new(structure).counts(&Ranks::new(structure, input)).ok_or_else(|| {
        Error::new(ErrorKind::Polycube, "the polycube touches or crosses itself, or looks inward")
            .remedy("validate it to see where, and move the parts apart")
    })
}

/// Whether levels are a valid polycube by the exact check.
fn check(structure: &Structure, levels: &[i64]) -> Result<()> {
    let placement = placement_of(levels);
    if is_valid(&Arrangement::new(structure, &placement)) {
        return Ok(());
    }
    Err(Error::new(ErrorKind::Internal, "the polycube found touches itself"))
}

/// The levels of another point of the front that [`align`] found with the same `options` (the scale may differ): no
/// search, only placing. `before` are the counts of the input.
///
/// # Errors
/// [`ErrorKind::Option`] for a scale that is not positive or too large for the lattice, [`ErrorKind::Infeasible`] if
/// what the guides fix leaves no room at this scale, [`ErrorKind::Cancelled`].
pub(crate) fn place(
    structure: &Structure,
    input: &[f64],
    before: Counts,
    point: &TradeOff,
    options: &AlignOptions,
    context: &Context,
) -> Result<Vec<i64>> {
    let origin = Origin::of(structure, input, options.scale);
    let input = origin.leave(structure, input);
    let task = Task::new(structure, &input, before, options, context)?;
    let levels = search::place_trade_off(&task, point, context)?;
    check(structure, &levels)?;
    Ok(origin.put_back(structure, levels))
}

/// What every strategy is given.
struct Task<'a> {
    structure: &'a Structure,
    /// The levels as they came.
    input: &'a [f64],
    /// A valid placement that respects the guides: the input, if it does.
    start: Placement,
    /// The input in lattice steps.
    targets: Placement,
    /// What must stay.
    guided: Guided,
    /// The counts of the input.
    before: Counts,
    /// When to stop searching.
    deadline: Option<Instant>,
    options: &'a AlignOptions,
}

impl<'a> Task<'a> {
    fn new(
        structure: &'a Structure,
        input: &'a [f64],
        before: Counts,
        options: &'a AlignOptions,
        context: &Context,
    ) -> Result<Self> {
        let targets = scaled(input, options.scale)?;
        let guided = Guided::new(structure, input, &options.guides, options.scale)?;
        let start = guided_start(structure, input, &guided, context)?;
        let deadline = options.effort.time_limit.and_then(|limit| Instant::now().checked_add(limit));
        Ok(Self { structure, input, start, targets, guided, before, deadline, options })
    }

    /// The promise: never more blocks than before.
    fn check_blocks(&self, after: &Counts) -> Result<()> {
        if after.blocks_padded <= self.before.blocks_padded {
            return Ok(());
        }
        let (now, before) = (after.blocks_padded, self.before.blocks_padded);
        let message = format!("what the guides ask for takes {now} padded blocks, the input has {before}");
        Err(Error::new(ErrorKind::Infeasible, message)
            .remedy("ask for fewer facets together or apart, or use the strategy `best`"))
    }
}

impl TradeOff {
    /// The number of the point that `simplicity` asks for, from 1 (the first of `count` points) to 0 (the last).
    pub(crate) fn index(simplicity: f64, count: usize) -> usize {
        ((1.0 - simplicity.clamp(0.0, 1.0)) * (count as f64 - 1.0)).round() as usize
    }

    /// The simplicity that asks for the point `index` of `count`.
    pub(crate) fn simplicity(index: usize, count: usize) -> f64 {
        1.0 - index as f64 / count.saturating_sub(1).max(1) as f64
    }

    /// Whether it is the input, whose order is `own`, and where the input lies.
    fn is_input(&self, own: &Ranks) -> bool {
        self.displacement == 0.0 && self.order == own.of_level
    }

    fn ranks(&self, structure: &Structure) -> Ranks {
        let placement: Placement = self.order.iter().map(|&r| f64::from(r)).collect();
        Ranks::new(structure, &placement)
    }
}

/// The alignment at another scale: the order of `levels`, which [`align`] found at any scale, as near as possible to
/// `input` on a lattice with `scale` steps per unit. Takes no search, and no more than sorting.
///
/// # Errors
/// [`ErrorKind::Option`] for a scale that is not positive or too large for the lattice, [`ErrorKind::Infeasible`] if
/// what the guides fix leaves no room at this scale, [`ErrorKind::Cancelled`].
pub(crate) fn rescale(
    structure: &Structure,
    input: &[f64],
    levels: &[i64],
    scale: f64,
    guides: &Guides,
    context: &Context,
) -> Result<Vec<i64>> {
    let origin = Origin::of(structure, input, scale);
    let input = &origin.leave(structure, input);
    let targets = scaled(input, scale)?;
    context.tick(0.0)?;
    let guided = Guided::new(structure, input, guides, scale)?;
    let order = placement_of(levels);
    let levels = place_in_order(structure, &Ranks::new(structure, &order), &targets, &guided)?;
    Ok(origin.put_back(structure, levels))
}

/// The levels rounded to a lattice with `scale` steps per unit, as [`Strategy::Naive`] does: their order may change.
///
/// # Errors
/// [`ErrorKind::Option`] for a scale that is not positive or too large for the lattice, [`ErrorKind::Infeasible`] if
/// rounding brings together what the guides keep apart.
pub(crate) fn round(structure: &Structure, input: &[f64], scale: f64, guides: &Guides) -> Result<Vec<i64>> {
    let origin = Origin::of(structure, input, scale);
    let input = &origin.leave(structure, input);
    let targets = scaled(input, scale)?;
    let levels = Guided::new(structure, input, guides, scale)?.rounded(structure, &targets)?;
    Ok(origin.put_back(structure, levels))
}

fn scaled(input: &[f64], scale: f64) -> Result<Placement> {
    Range::Positive.check("scale", scale)?;
    let targets: Placement = input.iter().map(|x| x * scale).collect();
    if targets.iter().any(|x| x.abs() > BOUND) {
        let most = 2.0 * BOUND;
        return Err(Error::new(
            ErrorKind::Option,
            format!("with scale {scale} the lattice has more than {most} steps"),
        )
        .in_option("scale")
        .remedy("use a smaller scale or a longer edge length"));
    }
    Ok(targets)
}

fn naive(task: &Task) -> Result<Alignment> {
    let levels = task.guided.rounded(task.structure, &task.targets)?;
    let placement = placement_of(&levels);
    let arrangement = Arrangement::new(task.structure, &placement);
    let broken = arrangement.conflicts();
    let after = broken.is_empty().then(|| count(&arrangement));
    let (rounds, front) = (Vec::new(), Vec::new());
    Ok(Alignment { levels, before: task.before, after, rounds, broken, front, chosen: None, bound: None })
}

fn to_integers(placement: &[f64]) -> Vec<i64> {
    placement.iter().map(|&x| x as i64).collect()
}
