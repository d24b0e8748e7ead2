//! Options of the façade, there and back.

use crate::ffi::{GuidesData, OptionsData, Real, ToleranceData};
use polycube::align::{Effort, Guides, SolverKind, Strategy, Symmetry};
use polycube::layout::Objective;
use polycube::simplify::{Input, Options, read_structure};
use polycube::structure::Tolerance;
use polycube::{Error, ErrorKind, Place, Result};
use std::ops::RangeInclusive;
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

/// The core's options for `input`, which locked faces are looked up in.
///
/// # Errors
/// [`ErrorKind::Option`] for a value out of its range.
pub fn options(data: &OptionsData, input: &Input) -> Result<Options> {
    let effort = Effort {
        steps_per_level: data.steps_per_level,
        proof_nodes: data.proof_nodes,
        time_limit: data.time_limit.get().map(seconds).transpose()?,
    };
    let objective = data.has_objective.then(|| pick(&OBJECTIVES, data.objective, "objective")).transpose()?;
    let tolerance = tolerance(&data.tolerance)?;
    Ok(Options {
        strategy: pick(&STRATEGIES, data.strategy, "strategy")?,
        scale: data.scale.get(),
        lambda_min: within("lambda_min", data.lambda_min, 0.0..=1.0)?,
        solver: pick(&SOLVERS, data.solver, "solver")?,
        objective,
        effort,
        simplicity: data.simplicity.get().map(|x| within("simplicity", x, 0.0..=1.0)).transpose()?,
        max_displacement: data.max_displacement.get().map(|x| positive("max_displacement", x)).transpose()?,
        max_distortion: data.max_distortion.get().map(|x| within("max_distortion", x, 1.0..=f64::MAX)).transpose()?,
        guides: guides(&data.guides, input, &tolerance)?,
        tolerance,
        ..Options::default()
    })
}

/// The core's tolerance.
///
/// # Errors
/// [`ErrorKind::Option`] for a value out of its range.
pub fn tolerance(data: &ToleranceData) -> Result<Tolerance> {
    Ok(Tolerance {
        degrees: within("tolerance.degrees", data.degrees, 0.0..=45.0)?,
        distance: within("tolerance.distance", data.distance, 0.0..=1.0)?,
        merge: within("tolerance.merge", data.merge, 0.0..=1.0)?,
    })
}

fn guides(data: &GuidesData, input: &Input, tolerance: &Tolerance) -> Result<Guides> {
    let indices = |list: &[u32]| list.iter().map(|&i| i as usize).collect();
    let ends = data.together_ends.iter();
    let starts = std::iter::once(&0).chain(ends.clone());
    let mut guides = Guides {
        fixed: indices(&data.fixed),
        together: starts.zip(ends).map(|(&from, &to)| indices(&data.together[from..to])).collect(),
        apart: data.apart.iter().map(|p| [p.first as usize, p.second as usize]).collect(),
        symmetry: data.symmetry.iter().map(|s| Symmetry { axis: s.axis as usize, at: s.at }).collect(),
    };
    if data.fixed_faces.is_empty() {
        return Ok(guides);
    }
    let polycube = read_structure(input, tolerance)?;
    let faces = polycube.facet_of_face.len();
    if let Some(&face) = data.fixed_faces.iter().find(|&&f| f as usize >= faces) {
        let message = format!("there are only {faces} boundary faces to lock");
        return Err(Error::new(ErrorKind::Option, message).at(Place::Face(face)));
    }
    let fixed: Vec<usize> = indices(&data.fixed_faces);
    guides.fix_faces(&polycube, &fixed);
    Ok(guides)
}

fn pick<T: Copy>(all: &[T], index: u8, what: &str) -> Result<T> {
    let found = all.get(usize::from(index)).copied();
    found.ok_or_else(|| Error::new(ErrorKind::Option, format!("there is no {what} number {index}")))
}

fn within(name: &str, value: f64, range: RangeInclusive<f64>) -> Result<f64> {
    if range.contains(&value) {
        return Ok(value);
    }
    let remedy = format!("use a number from {} to {}", range.start(), range.end());
    Err(Error::new(ErrorKind::Option, format!("{name} is {value}")).remedy(remedy))
}

fn positive(name: &str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Error::new(ErrorKind::Option, format!("{name} is {value}")).remedy("use a number above 0"))
}

fn seconds(value: f64) -> Result<Duration> {
    let duration = Duration::try_from_secs_f64(positive("time_limit", value)?);
    duration.map_err(|e| Error::new(ErrorKind::Option, format!("time_limit is {value}: {e}")))
}

/// The defaults of the core, for C++ to compare its own with.
pub fn default_options() -> OptionsData {
    defaults(&Options::default())
}

/// `options` as C++ sees them, without guides.
pub fn defaults(options: &Options) -> OptionsData {
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
