//! The integer problem of one axis: levels that attract each other, stay near their targets, and keep their distances.
//!
//! Minimise over integers `x`
//!
//! ```text
//! Σ_pairs weight (x_a − x_b)²  +  λ Σ_i weight_i (x_i − target_i)²        λ = 2^−halvings
//! subject to  x_high − x_low ≥ gap   and   Σ coefficient · x ≥ at_least
//! ```
//!
//! This is Eq. 1 of the paper with one unknown per facet instead of one per corner coordinate: collinearity (Eq. 2)
//! then holds by construction, lengths (Eq. 3) are differences, and separation planes (Eq. 4) are general linear rows.
//!
//! Targets are rounded once to multiples of `2^−FRACTION_BITS`. From then on cost and marginal costs are integers in
//! units of `2^−(halvings + 2 · FRACTION_BITS)`, so every machine takes the same decisions.

pub(crate) use super::difference::Difference;
use super::potential;
use crate::error::{Error, ErrorKind, Result};
use serde::{Deserialize, Serialize};
use std::fmt;

/// The pull of one variable towards its target: `weight (x − target)²`, times λ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShapeTerm {
    /// Number of corners on the facet, at least 1.
    pub weight: u32,
    /// Where the level lies in the shape, in lattice units, within `±MAX_LEVEL`.
    pub target: f64,
}

/// The pull between two variables: `weight (x_a − x_b)²`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PairTerm {
    /// One variable.
    pub a: u32,
    /// The other variable; a pair of a variable with itself costs nothing.
    pub b: u32,
    /// Number of corner pairs that ask for this alignment.
    pub weight: u32,
}

/// The constraint `Σ coefficient · x[variable] ≥ at_least`, for what is not a difference (paper, Eq. 4).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Linear {
    /// Variables with their coefficients.
    pub terms: Vec<(u32, f64)>,
    /// The least value of the sum.
    pub at_least: f64,
}

/// One axis of the alignment problem; the formula is in the module documentation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Problem {
    /// One term for each variable; its length is the number of variables.
    pub shape: Vec<ShapeTerm>,
    /// Pairs to align. Repeated pairs add up.
    pub pairs: Vec<PairTerm>,
    /// λ = 2^−halvings, at most [`Problem::MAX_HALVINGS`].
    pub halvings: u32,
    /// Distances to keep.
    pub differences: Vec<Difference>,
    /// Constraints that are not differences. Only [`super::solve::LinearSolver`] accepts them.
    #[serde(default)]
    pub linear: Vec<Linear>,
}

/// The first constraint that given levels do not satisfy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Infeasibility {
    /// There are this many levels, which is not the number of variables.
    Length(usize),
    /// The level of this variable is outside `±MAX_LEVEL`.
    Range(usize),
    /// The difference with this index.
    Difference(usize),
    /// The linear constraint with this index.
    Linear(usize),
}

impl fmt::Display for Infeasibility {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length(n) => write!(f, "{n} levels do not match the number of variables"),
            Self::Range(i) => write!(f, "level {i} is out of range"),
            Self::Difference(i) => write!(f, "difference {i} is violated"),
            Self::Linear(i) => write!(f, "linear constraint {i} is violated"),
        }
    }
}

impl Problem {
    /// Targets are rounded (half away from zero) to multiples of `2^−FRACTION_BITS`.
    pub const FRACTION_BITS: u32 = 20;
    /// Bound on the size of targets and levels.
    pub const MAX_LEVEL: i64 = 1 << 21;
    /// Bound on the sum of all weights, of pairs and of shape terms together.
    pub const MAX_WEIGHT: u64 = 1 << 22;
    /// Bound on the number of halvings of λ. With the other bounds the exact cost stays below `2^127`:
    /// squared distance 44, weight 22, fraction 2 · 20 and λ 20 bits.
    pub const MAX_HALVINGS: u32 = 20;
    /// How far below `at_least` the sum of a [`Linear`] constraint may stay.
    pub const LINEAR_TOLERANCE: f64 = 1e-6;

    /// The number of variables.
    pub fn len(&self) -> usize {
        self.shape.len()
    }

    /// Whether there are no variables.
    pub fn is_empty(&self) -> bool {
        self.shape.is_empty()
    }

    /// The target of `variable` in units of `2^−FRACTION_BITS`, as every solver uses it.
    pub fn fixed_target(&self, variable: usize) -> i64 {
        (self.shape[variable].target * f64::from(1 << Self::FRACTION_BITS)).round() as i64
    }

    /// The integer nearest to the target of `variable`; of two equally near the lower.
    pub fn rounded_target(&self, variable: usize) -> i64 {
        let half = 1 << (Self::FRACTION_BITS - 1);
        -((half - self.fixed_target(variable)) >> Self::FRACTION_BITS)
    }

    /// The exact cost in units of `2^−(halvings + 2 · FRACTION_BITS)`; linear in the size of the problem.
    ///
    /// Saturates for levels outside `±MAX_LEVEL`.
    ///
    /// # Panics
    /// If `levels` is shorter than the problem, or the problem would not pass [`validate`](Self::validate).
    pub fn exact_cost(&self, levels: &[i64]) -> i128 {
        let square = |d: i128, weight: u32| d.saturating_mul(d).saturating_mul(i128::from(weight));
        let pairs = self.pairs.iter().map(|p| {
            let apart = i128::from(levels[p.a as usize]) - i128::from(levels[p.b as usize]);
            square(apart, p.weight)
        });
        let pairs = pairs.fold(0, i128::saturating_add);
        let shape = self.shape.iter().enumerate().map(|(i, s)| {
            let apart = (i128::from(levels[i]) << Self::FRACTION_BITS) - i128::from(self.fixed_target(i));
            square(apart, s.weight)
        });
        let scale = 1 << (self.halvings + 2 * Self::FRACTION_BITS);
        shape.fold(pairs.saturating_mul(scale), i128::saturating_add)
    }

    /// The cost as a real number: [`exact_cost`](Self::exact_cost) times its unit.
    ///
    /// # Panics
    /// As [`exact_cost`](Self::exact_cost).
    pub fn cost(&self, levels: &[i64]) -> f64 {
        let unit = -((self.halvings + 2 * Self::FRACTION_BITS) as i32);
        self.exact_cost(levels) as f64 * 2.0_f64.powi(unit)
    }

    /// Whether `levels` satisfy every constraint.
    ///
    /// # Errors
    /// The first constraint that they violate.
    ///
    /// # Panics
    /// If a constraint names no variable, which [`validate`](Self::validate) finds.
    pub fn is_feasible(&self, levels: &[i64]) -> std::result::Result<(), Infeasibility> {
        if levels.len() != self.len() {
            return Err(Infeasibility::Length(levels.len()));
        }
        let range = -Self::MAX_LEVEL..=Self::MAX_LEVEL;
        if let Some(i) = levels.iter().position(|x| !range.contains(x)) {
            return Err(Infeasibility::Range(i));
        }
        let short = |d: &Difference| levels[d.high as usize] - levels[d.low as usize] < d.gap;
        if let Some(i) = self.differences.iter().position(short) {
            return Err(Infeasibility::Difference(i));
        }
        match self.linear.iter().position(|l| !l.holds(levels)) {
            Some(i) => Err(Infeasibility::Linear(i)),
            None => Ok(()),
        }
    }

    /// Checks indices, ranges and that the differences do not contradict each other.
    ///
    /// Linear constraints are not tested for contradictions. Complexity as [`feasible_near`](Self::feasible_near).
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for an index or number out of range,
    /// [`ErrorKind::Infeasible`] with the cycle of differences whose gaps add up to more than zero.
    pub fn validate(&self) -> Result<()> {
        self.feasible_start().map(drop)
    }

    /// Levels that satisfy every difference and lie near the rounded targets.
    ///
    /// # Errors
    /// As [`validate`](Self::validate).
    pub fn feasible_start(&self) -> Result<Vec<i64>> {
        self.check_numbers()?;
        let near: Vec<i64> = (0..self.len()).map(|i| self.rounded_target(i)).collect();
        self.feasible_near(&near)
    }

    /// Levels that satisfy every difference and lie near `near`; `near` itself if it is feasible.
    ///
    /// Takes the midpoint of the least solution above `near` and the greatest below it. Both are longest paths
    /// (Bellman–Ford: O(variables · differences) at worst, a few passes over the differences as a rule), and the
    /// rounded midpoint of two solutions of difference constraints is a solution.
    ///
    /// # Errors
    /// As [`validate`](Self::validate), and [`ErrorKind::Option`] if `near` is of another length or out of range.
    pub fn feasible_near(&self, near: &[i64]) -> Result<Vec<i64>> {
        self.check_numbers()?;
        if let Err(violation @ (Infeasibility::Length(_) | Infeasibility::Range(_))) = self.is_feasible(near) {
            return Err(out_of_range(format!("starting point: {violation}")));
        }
        potential::between(&self.differences, near)
    }

    /// An interval that holds every level of every optimal solution without linear constraints: the range of the
    /// rounded targets, widened by the sum of the greatest positive gap below each variable.
    ///
    /// Why: a set of levels beyond the targets could move closer as one unless a positive gap reached across its
    /// border, so gaps of distinct variables cover the whole way from the outermost level back to the targets.
    ///
    /// # Panics
    /// If a difference names no variable, which [`validate`](Self::validate) finds.
    pub fn reach(&self) -> (i64, i64) {
        let rounded = || (0..self.len()).map(|i| self.rounded_target(i));
        let mut gaps = vec![0; self.len()];
        for d in &self.differences {
            let gap: &mut i64 = &mut gaps[d.high as usize];
            *gap = d.gap.max(*gap);
        }
        let far = gaps.iter().fold(1_i64, |sum, &gap| sum.saturating_add(gap));
        let (low, high) = (rounded().min().unwrap_or(0), rounded().max().unwrap_or(0));
        (low.saturating_sub(far), high.saturating_add(far))
    }

    /// Checks everything except contradictions between constraints.
    pub(crate) fn check_numbers(&self) -> Result<()> {
        if self.halvings > Self::MAX_HALVINGS {
            return Err(out_of_range(format!("λ is halved {} times", self.halvings)));
        }
        self.check_indices()?;
        self.check_shape()?;
        self.check_constraints()?;
        let (low, high) = self.reach();
        if low < -Self::MAX_LEVEL || high > Self::MAX_LEVEL {
            return Err(out_of_range(format!("levels could reach {low} to {high}")));
        }
        Ok(())
    }

    fn check_indices(&self) -> Result<()> {
        let pairs = self.pairs.iter().flat_map(|p| [p.a, p.b]);
        let differences = self.differences.iter().flat_map(|d| [d.low, d.high]);
        let linear = self.linear.iter().flat_map(|l| l.terms.iter().map(|t| t.0));
        match pairs.chain(differences).chain(linear).find(|&i| i as usize >= self.len()) {
            Some(i) => Err(out_of_range(format!("there is no variable {i}"))),
            None => Ok(()),
        }
    }

    fn check_shape(&self) -> Result<()> {
        let limit = Self::MAX_LEVEL as f64;
        let bad = |s: &ShapeTerm| s.weight == 0 || !(-limit..=limit).contains(&s.target);
        if let Some(i) = self.shape.iter().position(bad) {
            return Err(out_of_range(format!("variable {i} has {:?}", self.shape[i])));
        }
        let weights = self.shape.iter().map(|s| s.weight).chain(self.pairs.iter().map(|p| p.weight));
        let total: u64 = weights.map(u64::from).sum();
        if total > Self::MAX_WEIGHT {
            return Err(out_of_range(format!("the weights add up to {total}")));
        }
        Ok(())
    }

    fn check_constraints(&self) -> Result<()> {
        let far = |d: &Difference| d.gap.unsigned_abs() > 2 * Self::MAX_LEVEL.unsigned_abs();
        if let Some(i) = self.differences.iter().position(far) {
            return Err(out_of_range(format!("difference {i} has {:?}", self.differences[i])));
        }
        let fine = |l: &Linear| {
            let finite = l.at_least.is_finite() && l.terms.iter().all(|t| t.1.is_finite());
            finite && !l.terms.is_empty()
        };
        match self.linear.iter().position(|l| !fine(l)) {
            Some(i) => Err(out_of_range(format!("linear constraint {i} is empty or not finite"))),
            None => Ok(()),
        }
    }
}

impl Linear {
    fn holds(&self, levels: &[i64]) -> bool {
        let sum: f64 = self.terms.iter().map(|&(i, c)| c * levels[i as usize] as f64).sum();
        sum >= self.at_least - Problem::LINEAR_TOLERANCE
    }
}

fn out_of_range(message: String) -> Error {
    let remedy = format!(
        "weights from 1 to {} in all, levels and targets within ±{}, at most {} halvings",
        Problem::MAX_WEIGHT,
        Problem::MAX_LEVEL,
        Problem::MAX_HALVINGS
    );
    Error::new(ErrorKind::Option, message).remedy(remedy)
}
