//! Options of the façade, there and back.

use crate::ffi::{GuidesData, OptionsData, Real, ToleranceData};
use polycube::align::{Effort, Guides, SolverKind, Strategy, Symmetry};
use polycube::layout::Objective;
use polycube::simplify::SimplifyOptions;
use polycube::structure::Tolerance;
use polycube::{Error, ErrorKind, Result};
use std::time::Duration;

const STRATEGIES: [Strategy; 3] = [Strategy::Naive, Strategy::Paper, Strategy::Best];
const SOLVERS: [SolverKind; 2] = [SolverKind::Exact, SolverKind::Linear];
const OBJECTIVES: [Objective; 3] = [Objective::BlocksPadded, Objective::Blocks, Objective::SurfacePatches];

impl Real {
    /// The number, if there is one.
    pub fn get(self) -> Option<f64> {
        self.some.then_some(self.value)
    }
}

impl From<Option<f64>> for Real {
    fn from(value: Option<f64>) -> Self {
        Self { some: value.is_some(), value: value.unwrap_or_default() }
    }
}

impl From<Tolerance> for ToleranceData {
    fn from(Tolerance { degrees, distance, merge }: Tolerance) -> Self {
        Self { degrees, distance, merge }
    }
}

/// The core's options.
///
/// # Errors
/// [`ErrorKind::Option`] for a value out of its range.
pub fn options(data: &OptionsData) -> Result<SimplifyOptions> {
    let effort = Effort {
        steps_per_level: data.steps_per_level,
        proof_nodes: data.proof_nodes,
        time_limit: data.time_limit.get().map(seconds).transpose()?,
    };
    Ok(SimplifyOptions {
        strategy: pick(&STRATEGIES, data.strategy, "strategy")?,
        scale: data.scale.get(),
        lambda_min: data.lambda_min,
        solver: pick(&SOLVERS, data.solver, "solver")?,
        objective: data.has_objective.then(|| pick(&OBJECTIVES, data.objective, "objective")).transpose()?,
        effort,
        simplicity: data.simplicity.get(),
        max_displacement: data.max_displacement.get(),
        max_distortion: data.max_distortion.get(),
        guides: guides(&data.guides),
        tolerance: tolerance(&data.tolerance),
        no_repair: data.no_repair,
        ..SimplifyOptions::default()
    })
}

/// The core's tolerance.
pub fn tolerance(&ToleranceData { degrees, distance, merge }: &ToleranceData) -> Tolerance {
    Tolerance { degrees, distance, merge }
}

fn guides(data: &GuidesData) -> Guides {
    let indices = |list: &[u32]| list.iter().map(|&i| i as usize).collect();
    let ends = data.together_ends.iter();
    let starts = std::iter::once(&0).chain(ends.clone());
    Guides {
        fixed: indices(&data.fixed),
        fixed_faces: indices(&data.fixed_faces),
        fixed_labels: Vec::new(),
        together: starts.zip(ends).map(|(&from, &to)| indices(&data.together[from..to])).collect(),
        apart: data.apart.iter().map(|p| [p.first as usize, p.second as usize]).collect(),
        symmetry: data.symmetry.iter().map(|s| Symmetry { axis: s.axis as usize, at: s.at }).collect(),
    }
}

fn pick<T: Copy>(all: &[T], index: u8, what: &str) -> Result<T> {
    let found = all.get(usize::from(index)).copied();
    found.ok_or_else(|| Error::new(ErrorKind::Option, format!("there is no {what} number {index}")))
}

fn seconds(value: f64) -> Result<Duration> {
    let duration = Duration::try_from_secs_f64(value).ok().filter(|_| value > 0.0);
    duration.ok_or_else(|| {
        let message = format!("time_limit is {value}");
        Error::new(ErrorKind::Option, message).remedy("use a number of seconds above 0 that a clock can hold")
    })
}

/// The defaults of the core, for C++ to compare its own with.
pub fn default_options() -> OptionsData {
    defaults(&SimplifyOptions::default())
}

/// `options` as C++ sees them, without guides.
pub fn defaults(options: &SimplifyOptions) -> OptionsData {
    let number = |at: Option<usize>| at.unwrap_or_default() as u8;
    let objective = options.objective.and_then(|o| OBJECTIVES.iter().position(|x| *x == o));
    OptionsData {
        strategy: number(STRATEGIES.iter().position(|x| *x == options.strategy)),
        scale: options.scale.into(),
        lambda_min: options.lambda_min,
        solver: number(SOLVERS.iter().position(|x| *x == options.solver)),
        has_objective: objective.is_some(),
        objective: number(objective),
        steps_per_level: options.effort.steps_per_level,
        proof_nodes: options.effort.proof_nodes,
        time_limit: options.effort.time_limit.map(|t| t.as_secs_f64()).into(),
        simplicity: options.simplicity.into(),
        max_displacement: options.max_displacement.into(),
        max_distortion: options.max_distortion.into(),
        no_repair: options.no_repair,
        tolerance: options.tolerance.into(),
        guides: GuidesData {
            fixed: Vec::new(),
            fixed_faces: Vec::new(),
            together: Vec::new(),
            together_ends: Vec::new(),
            apart: Vec::new(),
            symmetry: Vec::new(),
        },
    }
}
