//! Algorithm 1 of the paper: pair corners, align them, halve λ, until nothing more can be aligned.

use super::classes::Classes;
use super::constraints::structural;
use super::pairs::{Pair, candidates};
use super::problem::{Linear, Problem};
use super::relax::{Demand, relax};
use super::solve::Solver;
use super::to_integers;
use crate::context::Context;
use crate::error::Result;
use crate::layout::{Counts, count};
use crate::structure::{Arrangement, Placement, Structure};

/// One round of Algorithm 1.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Round {
    /// The weight of the attraction to the input.
    pub lambda: f64,
    /// Corner pairs that were asked to align.
    pub pairs: usize,
    /// Levels that became aligned.
    pub alignments: usize,
    /// Counts after the round.
    pub counts: Counts,
    /// Where the levels lie after the round, on the lattice of the rounds; [`rescale`](super::rescale) brings them to
    /// the scale of a result. Not written to reports.
    #[serde(skip)]
    pub levels: Vec<i64>,
}

/// Where Algorithm 1 ended.
pub struct Outcome {
    /// A valid placement, integer after the first round.
    pub placement: Placement,
    /// The alignments found.
    pub classes: Classes,
    /// What happened on the way.
    pub rounds: Vec<Round>,
}

impl Outcome {
    /// A placement with the alignments that it has: levels of one axis with one coordinate.
    pub fn of(structure: &Structure, placement: Placement) -> Self {
        let mut classes = Classes::new(placement.len());
        let levels = structure.levels.len() as u32;
        for (a, b) in (0..levels).flat_map(|b| (0..b).map(move |a| (a, b))) {
            let same_axis = structure.levels[a as usize].axis == structure.levels[b as usize].axis;
            if same_axis && placement[a as usize] == placement[b as usize] {
                classes.join(a, b);
            }
        }
        Self { placement, classes, rounds: Vec::new() }
    }

    /// The finalisation of section 6: as near to `targets` as the alignments found allow, with λ = 1.
    pub fn settle(
        &self,
        structure: &Structure,
        targets: &[f64],
        solver: &dyn Solver,
        context: &Context,
    ) -> Result<Placement> {
        let differences = structural(&Arrangement::new(structure, &self.placement));
        let demand =
            Demand { targets, classes: &self.classes, pairs: &[], halvings: 0, differences, planes: Vec::new() };
        relax(structure, &self.placement, demand, solver, context)
    }
}

/// How Algorithm 1 runs.
pub struct Settings<'a> {
    /// Stop before λ falls below this; 0 for the natural end.
    pub lambda_min: f64,
    /// The solver of the integer problems.
    pub solver: &'a dyn Solver,
    /// Whether every pair gets the separation plane of Eq. 4, which the solver must then accept; else a pair is
    /// kept apart only if its corners would meet, along the axis where they are furthest apart.
    pub oblique_planes: bool,
}

/// Aligns the corners of a valid placement, given in lattice steps.
pub fn run(structure: &Structure, input: &[f64], settings: &Settings, context: &Context) -> Result<Outcome> {
    let mut state = State {
        structure,
        input,
        settings,
        outcome: Outcome { placement: input.to_vec(), classes: Classes::new(input.len()), rounds: Vec::new() },
    };
    for halvings in 0..=Problem::MAX_HALVINGS {
        let lambda = 0.5_f64.powi(halvings as i32);
        context.tick(f64::from(halvings) / f64::from(Problem::MAX_HALVINGS))?;
        if lambda < settings.lambda_min || !state.round(halvings, context)? {
            break;
        }
    }
    Ok(state.outcome)
}

struct State<'a> {
    structure: &'a Structure,
    input: &'a [f64],
    settings: &'a Settings<'a>,
    outcome: Outcome,
}

impl State<'_> {
    /// Pairs and aligns once; `false` when no pair is left or no smaller λ can change anything.
    fn round(&mut self, halvings: u32, context: &Context) -> Result<bool> {
        let arrangement = Arrangement::new(self.structure, &self.outcome.placement);
        let differences = structural(&arrangement);
        let pairs = candidates(&arrangement, &self.outcome.classes, &differences, context)?;
        if pairs.is_empty() {
            return Ok(false);
        }
        let mut planes = Vec::new();
        if self.settings.oblique_planes {
            planes.extend(pairs.iter().flat_map(|p| self.oblique(p)));
        }
        let demand = Demand {
            targets: self.input,
            classes: &self.outcome.classes,
            pairs: &pairs,
            halvings,
            differences,
            planes,
        };
        self.outcome.placement = relax(self.structure, &self.outcome.placement, demand, self.settings.solver, context)?;
        let alignments = self.keep(&pairs);
        let counts = count(&Arrangement::new(self.structure, &self.outcome.placement));
        let lambda = 0.5_f64.powi(halvings as i32);
        let levels = to_integers(&self.outcome.placement);
        self.outcome.rounds.push(Round { lambda, pairs: pairs.len(), alignments, counts, levels });
        Ok(alignments > 0 || lambda * self.pull() >= 1.0)
    }

    /// Joins the levels of every pair that came together.
    fn keep(&mut self, pairs: &[Pair]) -> usize {
        let outcome = &mut self.outcome;
        let met = |[a, b]: &[u32; 2]| outcome.placement[*a as usize] == outcome.placement[*b as usize];
        let met: Vec<[u32; 2]> = pairs.iter().map(|p| p.levels(self.structure)).filter(met).collect();
        met.into_iter().filter(|&[a, b]| outcome.classes.join(a, b)).count()
    }

    /// An upper bound of what moving every level by its present displacement costs in E_shape. Once λ times this
    /// is under the least change of the integer E_align, a smaller λ changes nothing.
    fn pull(&self) -> f64 {
        let levels = self.structure.levels.iter().zip(self.input).zip(&self.outcome.placement);
        levels.map(|((l, t), x)| f64::from(l.corners) * (x - t) * (x - t)).sum()
    }

    fn difference_of(&self, pair: &Pair) -> [f64; 3] {
        let [p, q] = pair.corners.map(|c| self.structure.position(c, &self.outcome.placement));
        std::array::from_fn(|k| q[k] - p[k])
    }

    /// Eq. 4: both corners stay on their sides of the plane half way between them. With integer
    /// coordinates `2 n·c` and `n·(c + c')` are integers, so `>` means one half more.
    fn oblique(&self, pair: &Pair) -> [Linear; 2] {
        let normal = self.difference_of(pair);
        let [p, q] = pair.corners.map(|c| self.structure.position(c, &self.outcome.placement));
        let middle: f64 = (0..3).map(|k| normal[k] * f64::midpoint(p[k], q[k])).sum();
        let side = |corner: u32, sign: f64| {
            let levels = self.structure.corners[corner as usize].levels;
            let terms = (0..3).filter(|&k| normal[k] != 0.0).map(|k| (levels[k], sign * normal[k])).collect();
            Linear { terms, at_least: sign * middle + 0.5 }
        };
        [side(pair.corners[1], 1.0), side(pair.corners[0], -1.0)]
    }
}
