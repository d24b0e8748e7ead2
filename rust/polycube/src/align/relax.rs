//! One solve of the integer problem whose result is a valid polycube.

use super::classes::Classes;
use super::judge::Judge;
use super::problem::{Difference, Linear, PairTerm, Problem, ShapeTerm};
use super::ranks::Ranks;
use super::separate::{holds, separations};
use super::solve::Solver;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::structure::{Arrangement, Placement, Structure, placement_of};

/// Two corners that shall come to have the same coordinate along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
pub(super) struct Pair {
    /// 0, 1 or 2 for X, Y or Z.
    pub axis: usize,
    /// The corners, ascending.
    pub corners: [u32; 2],
}

impl Pair {
    /// The levels that become equal.
    pub(super) fn levels(&self, structure: &Structure) -> [u32; 2] {
        self.corners.map(|c| structure.corners[c as usize].levels[self.axis])
    }
}

/// What one round asks for: where the levels want to be, which pairs attract, what must hold.
pub(super) struct Demand<'a> {
    /// The levels of the input, in lattice steps.
    pub targets: &'a [f64],
    /// Alignments to keep.
    pub classes: &'a Classes,
    /// Alignments to try.
    pub pairs: &'a [Pair],
    /// λ = 2^−halvings.
    pub halvings: u32,
    /// Distances to keep.
    pub differences: Vec<Difference>,
    /// Separation planes as the paper has them (Eq. 4), over levels.
    pub planes: Vec<Linear>,
}

/// The optimal valid placement for `demand`, found from `valid`, which satisfies its differences up to rounding.
///
/// The solver knows distances only between parts that face each other. When parts that did not face each other
/// come to touch, the distance that kept them apart in `valid` is added and the problem is solved again. This ends:
/// each time another change of order is forbidden, and with all of them forbidden the order is that of `valid`.
pub(super) fn relax(
    structure: &Structure,
    valid: &[f64],
    mut demand: Demand,
    solver: &dyn Solver,
    context: &Context,
) -> Result<Placement> {
    let mut judge = None;
    let mut start: Vec<i64> = valid.iter().map(|x| x.round() as i64).collect();
    loop {
        let (problem, variables) = problem(structure, &demand);
        let begin: Vec<i64> = variables.classes.iter().map(|&c| start[c as usize]).collect();
        let levels = solver.solve(&problem, Some(&begin), context)?.levels;
        let at = |l: u32| levels[variables.of_level[l as usize] as usize];
        start = (0..structure.levels.len() as u32).map(at).collect();
        let placement = placement_of(&start);
        let mut knows_valid = |ranks: &Ranks| judge.get_or_insert_with(|| Judge::new(structure)).knows_valid(ranks);
        if placement == valid || knows_valid(&Ranks::new(structure, &placement)) {
            return Ok(placement);
        }
        let Some(violated) = violated(&Arrangement::new(structure, &placement), valid) else { return Ok(placement) };
        if violated.is_empty() {
            return Err(Error::new(ErrorKind::Internal, "the surface touches itself though every order is kept"));
        }
        demand.differences.extend(violated);
    }
}

/// Differences that `arrangement` breaks and that keep it valid; nothing when it is valid.
fn violated(arrangement: &Arrangement, valid: &[f64]) -> Option<Vec<Difference>> {
    let (structure, placement) = (arrangement.structure(), arrangement.placement());
    let conflicts = arrangement.conflicts();
    let mut found: Vec<Difference> =
        conflicts.iter().flat_map(|c| separations(structure, c, valid, placement)).collect();
    if conflicts.is_empty() {
        if arrangement.inside_out().is_empty() {
            return None;
        }
        found = changed_order(structure, valid, placement);
    }
    found.sort_unstable_by_key(Difference::rank);
    found.dedup();
    Some(found)
}

/// Every strict order of `valid` that `placement` does not keep. O(n²) for n levels.
fn changed_order(structure: &Structure, valid: &[f64], placement: &[f64]) -> Vec<Difference> {
    let levels = 0..structure.levels.len() as u32;
    let pairs = levels.clone().flat_map(|low| levels.clone().map(move |high| Difference { low, high, gap: 1 }));
    let axis = |l: u32| structure.levels[l as usize].axis;
    let strict = |d: &Difference| axis(d.low) == axis(d.high) && valid[d.low as usize] < valid[d.high as usize];
    pairs.filter(|d| strict(d) && !holds(d, placement)).collect()
}

/// The variables of a problem: one per class.
struct Variables {
    /// The class of each variable.
    classes: Vec<u32>,
    /// The variable of each level.
    of_level: Vec<u32>,
}

impl Variables {
    fn new(classes: &Classes, levels: usize) -> Self {
        let roots: Vec<u32> = (0..levels as u32).filter(|&l| classes.of(l) == l).collect();
        let variable = |l: u32| roots.partition_point(|&r| r < classes.of(l)) as u32;
        let of_level = (0..levels as u32).map(variable).collect();
        Self { classes: roots, of_level }
    }

    fn of(&self, level: u32) -> u32 {
        self.of_level[level as usize]
    }
}

/// The integer problem over classes, all three axes in one.
fn problem(structure: &Structure, demand: &Demand) -> (Problem, Variables) {
    let variables = Variables::new(demand.classes, structure.levels.len());
    let mut shape = vec![ShapeTerm { weight: 0, target: 0.0 }; variables.classes.len()];
    for (level, &v) in
        structure.levels.iter().zip(&variables.of_level).zip(demand.targets).map(|((l, v), t)| ((l, t), v))
    {
        let term = &mut shape[v as usize];
        term.target += f64::from(level.0.corners) * level.1;
        term.weight += level.0.corners;
    }
    shape.iter_mut().for_each(|s| s.target /= f64::from(s.weight));
    let mut pairs: Vec<PairTerm> = demand
        .pairs
        .iter()
        .map(|p| {
            let [a, b] = p.levels(structure).map(|l| variables.of(l));
            PairTerm { a: a.min(b), b: a.max(b), weight: 1 }
        })
        .collect();
    pairs.sort_unstable_by_key(|p| (p.a, p.b));
    pairs.dedup_by(|next, kept| {
        let same = (next.a, next.b) == (kept.a, kept.b);
        kept.weight += u32::from(same) * next.weight;
        same
    });
    let mut differences: Vec<Difference> = demand
        .differences
        .iter()
        .map(|d| Difference { low: variables.of(d.low), high: variables.of(d.high), gap: d.gap })
        .filter(|d| d.low != d.high || d.gap > 0)
        .collect();
    // The greatest gap of two variables comes first and stays.
    differences.sort_unstable_by_key(|d| Difference { gap: !d.gap, ..*d }.rank());
    differences.dedup_by_key(|d| (d.low, d.high));
    let on_variables = |l: &Linear| Linear {
        terms: l.terms.iter().map(|&(level, c)| (variables.of(level), c)).collect(),
        at_least: l.at_least,
    };
    let linear = demand.planes.iter().map(on_variables).collect();
    (Problem { shape, pairs, halvings: demand.halvings, differences, linear }, variables)
}
