//! Algorithm 1 of the paper: pair corners, align them, halve λ, until nothing more can be aligned.

mod constraints;
#[cfg(test)]
mod for_bench;
pub(crate) mod neighbours;
mod pairs;
mod restart;

pub(crate) use restart::{descend, simplify};

use super::classes::Classes;
use super::guides::Guided;
use super::problem::{Difference, Linear, Problem};
pub(super) use super::relax::Pair;
use super::relax::{Demand, relax};
use super::solve::Solver;
use crate::align::to_integers;
use crate::context::Context;
use crate::error::Result;
use crate::layout::Counts;
use crate::structure::{Arrangement, Placement, Structure};
use constraints::structural;
use pairs::{Linked, candidates, near_corners};

/// One round of Algorithm 1.
#[derive(Clone, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct Round {
    /// The weight of the attraction to the input.
    pub lambda: f64,
    /// Corner pairs that were asked to align.
    pub pairs: usize,
    /// Levels that became aligned.
    pub alignments: usize,
    /// Counts after the round.
    pub counts: Counts,
    /// Where the levels lie after the round, on the lattice of the rounds; `rescale` brings them to
    /// the scale of a result. Not written to reports.
    #[serde(skip)]
    pub levels: Vec<i64>,
}

/// A round whose result is not yet counted.
struct Step {
    lambda: f64,
    pairs: usize,
    alignments: usize,
    levels: Vec<i64>,
}

impl Step {
    fn counted(&self, counts: Counts) -> Round {
        let Self { lambda, pairs, alignments, ref levels } = *self;
        Round { lambda, pairs, alignments, counts, levels: levels.clone() }
    }
}

/// Where Algorithm 1 ended.
pub(super) struct Outcome<'a> {
    structure: &'a Structure,
    /// A valid placement, integer after the first round.
    pub placement: Placement,
    /// The alignments found.
    pub classes: Classes,
    /// The distances that keep the placement a polycube.
    structural: Vec<Difference>,
    /// What happened on the way.
    steps: Vec<Step>,
}

impl<'a> Outcome<'a> {
    /// A valid placement with the alignments that it has: levels of one axis with one coordinate.
    pub(super) fn of(structure: &'a Structure, placement: &[f64]) -> Self {
        let mut classes = Classes::new(placement.len());
        let levels = structure.levels.len() as u32;
        for (a, b) in (0..levels).flat_map(|b| (0..b).map(move |a| (a, b))) {
            let same_axis = structure.levels[a as usize].axis == structure.levels[b as usize].axis;
            if same_axis && placement[a as usize] == placement[b as usize] {
                classes.join(a, b);
            }
        }
        let structural = structural(&Arrangement::new(structure, placement));
        Self { structure, placement: placement.to_vec(), classes, structural, steps: Vec::new() }
    }

    /// The finalisation of section 6: as near to `targets` as the alignments found allow, with λ = 1.
    pub(super) fn settle(&self, targets: &[f64], solver: &dyn Solver, context: &Context) -> Result<Placement> {
        let differences = self.structural.clone();
        let demand =
            Demand { targets, classes: &self.classes, pairs: &[], halvings: 0, differences, planes: Vec::new() };
        relax(self.structure, &self.placement, demand, solver, context)
    }
}

/// How Algorithm 1 runs.
pub(super) struct PaperSettings<'a> {
    /// Stop before λ falls below this; 0 for the natural end.
    pub lambda_min: f64,
    /// The solver of the integer problems.
    pub solver: &'a dyn Solver,
    /// What must stay; the input of a run must respect it.
    pub guided: &'a Guided,
    /// Whether every pair gets the separation plane of Eq. 4, which the solver must then accept; else a pair is
    /// kept apart only if its corners would meet, along the axis where they are furthest apart.
    pub oblique_planes: bool,
}

/// Aligns the corners of a valid placement, given in lattice steps.
pub(super) fn run<'a>(
    structure: &'a Structure,
    input: &[f64],
    settings: &PaperSettings,
    context: &Context,
) -> Result<Outcome<'a>> {
    let mut state = Run::new(structure, input, settings);
    for halvings in 0..=Problem::MAX_HALVINGS {
        let lambda = 0.5_f64.powi(halvings as i32);
        context.tick(f64::from(halvings) / f64::from(Problem::MAX_HALVINGS))?;
        if lambda < settings.lambda_min || !state.round(halvings, context)? {
            break;
        }
    }
    Ok(state.outcome())
}

/// What the present arrangement asks the next round to do.
#[derive(Clone)]
struct Plan {
    /// Those of the structure first, then those of the guides.
    differences: Vec<Difference>,
    /// How many of them are the structure's.
    structural: usize,
    pairs: Vec<Pair>,
    planes: Vec<Linear>,
}

struct Run<'a, 's> {
    structure: &'a Structure,
    input: &'s [f64],
    settings: &'s PaperSettings<'s>,
    placement: Placement,
    classes: Classes,
    steps: Vec<Step>,
    /// Corners that no pair joins.
    linked: Linked,
    /// Made for the present placement.
    plan: Option<Plan>,
}

impl<'a, 's> Run<'a, 's> {
    fn new(structure: &'a Structure, input: &'s [f64], settings: &'s PaperSettings<'s>) -> Self {
        let classes = settings.guided.classes().clone();
        let linked = Linked::new(structure);
        Self { structure, input, settings, placement: input.to_vec(), classes, steps: Vec::new(), linked, plan: None }
    }

    fn outcome(self) -> Outcome<'a> {
        let Self { structure, placement, classes, steps, plan, .. } = self;
        let kept = plan.map(|mut plan| {
            plan.differences.truncate(plan.structural);
            plan.differences
        });
        let structural = kept.unwrap_or_else(|| structural(&Arrangement::new(structure, &placement)));
        Outcome { structure, placement, classes, structural, steps }
    }

    /// Pairs and aligns once; `false` when no pair is left or no smaller λ can change anything.
    fn round(&mut self, halvings: u32, context: &Context) -> Result<bool> {
        let plan = match self.plan.take() {
            Some(plan) => plan,
            None => self.make_plan(context)?,
        };
        if plan.pairs.is_empty() {
            self.plan = Some(plan);
            return Ok(false);
        }
        let demand = Demand {
            targets: self.input,
            classes: &self.classes,
            pairs: &plan.pairs,
            halvings,
            differences: plan.differences.clone(),
            planes: plan.planes.clone(),
        };
        let placement = relax(self.structure, &self.placement, demand, self.settings.solver, context)?;
        let moved = placement != self.placement;
        self.placement = placement;
        let alignments = self.keep(&plan.pairs);
        let lambda = 0.5_f64.powi(halvings as i32);
        let levels = to_integers(&self.placement);
        self.steps.push(Step { lambda, pairs: plan.pairs.len(), alignments, levels });
        self.plan = (!moved && alignments == 0).then_some(plan);
        Ok(alignments > 0 || lambda * self.pull() >= 1.0)
    }

    fn make_plan(&self, context: &Context) -> Result<Plan> {
        let (structure, placement) = (self.structure, &self.placement);
        let distances = || {
            let arrangement = Arrangement::new(structure, placement);
            let differences = structural(&arrangement);
            (arrangement, differences)
        };
        let (near, (arrangement, mut differences)) =
            rayon::join(|| near_corners(structure, placement, &self.linked, context), distances);
        let structural = differences.len();
        differences.extend(self.settings.guided.differences(placement));
        let pairs = candidates(&arrangement, &near?, &self.classes, &differences);
        let planes = if self.settings.oblique_planes {
            pairs.iter().flat_map(|p| self.oblique(p)).collect()
        } else {
            Vec::new()
        };
        Ok(Plan { differences, structural, pairs, planes })
    }

    /// Joins the levels of every pair that came together.
    fn keep(&mut self, pairs: &[Pair]) -> usize {
        let (structure, placement) = (self.structure, &self.placement);
        let met = |[a, b]: &[u32; 2]| placement[*a as usize] == placement[*b as usize];
        let classes = &mut self.classes;
        pairs.iter().map(|p| p.levels(structure)).filter(met).filter(|&[a, b]| classes.join(a, b)).count()
    }

    /// An upper bound of what moving every level by its present displacement costs in E_shape. Once λ times this
    /// is under the least change of the integer E_align, a smaller λ changes nothing.
    fn pull(&self) -> f64 {
        let levels = self.structure.levels.iter().zip(self.input).zip(&self.placement);
        levels.map(|((l, t), x)| f64::from(l.corners) * (x - t) * (x - t)).sum()
    }

    fn position(&self, corner: u32) -> [f64; 3] {
        self.structure.position(corner, &self.placement)
    }

    fn difference_of(&self, pair: &Pair) -> [f64; 3] {
        let [p, q] = pair.corners.map(|c| self.position(c));
        std::array::from_fn(|k| q[k] - p[k])
    }

    /// Eq. 4: both corners stay on their sides of the plane half way between them. With integer
    /// coordinates `2 n·c` and `n·(c + c')` are integers, so `>` means one half more.
    fn oblique(&self, pair: &Pair) -> [Linear; 2] {
        let normal = self.difference_of(pair);
        let [p, q] = pair.corners.map(|c| self.position(c));
        let middle: f64 = (0..3).map(|k| normal[k] * f64::midpoint(p[k], q[k])).sum();
        let side = |corner: u32, sign: f64| {
            let levels = self.structure.corners[corner as usize].levels;
            let terms = (0..3).filter(|&k| normal[k] != 0.0).map(|k| (levels[k], sign * normal[k])).collect();
            Linear { terms, at_least: sign * middle + 0.5 }
        };
        [side(pair.corners[1], 1.0), side(pair.corners[0], -1.0)]
    }
}
