//! Removes inverted elements and raises the worst quality by moving vertices.
//!
//! [`Elements`] say what should look like what, [`Freedom`]s and [`Guide`]s how vertices may move, and [`optimise`]
//! moves them in three phases:
//!
//! 1. **Untangle** (only where something is inverted): minimises the regularised energy of Garanzha et al.,
//!    "Foldover-free maps in 50 lines of code" (ACM TOG 2021), for falling ε, by L-BFGS. Only what is near inverted
//!    elements moves at first: all the rest would have to be solved as well, time and again, and may pull the other
//!    way.
//! 2. **Improve**: minimises the same energy without regularisation, an infinite barrier against inversion, together
//!    with a growing power of the badness of the elements near the worst one.
//! 3. **Polish**: pattern search at the vertices of the worst elements.
//!
//! Sliding vertices move along the tangents of their guides and are put back on them after every round; where that
//! spoils an element, its vertices go back. Everything is a function of the input alone, to the bit, for any number of
//! threads.

mod assembly;
mod elements;
mod energy;
mod field;
mod freedom;
mod guide;
mod improve;
mod lanes;
mod lbfgs;
mod local;
mod optimisation;
mod polish;
mod rectangles;
mod region;
mod relax;
mod room;
mod sizes;
mod springs;
#[cfg(test)]
mod tests;
mod untangle;

pub use elements::Elements;
pub use freedom::Freedom;
pub use guide::{CurveGuide, Guide, SurfaceGuide, Tangent};
pub(crate) use relax::relax;
pub(crate) use springs::Spring;

use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Point;
use freedom::Constraints;
use improve::{BestPoints, improve};
use optimisation::Optimisation;
use untangle::Untangling;

/// What moves to untangle a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scope {
    /// What is near inverted elements.
    Near,
    /// The same, and all of the mesh where that turns none of them.
    #[default]
    NearFirst,
    /// All of the mesh.
    Whole,
}

/// How hard to try. The defaults suit 1,000 to 1,000,000 hexahedra.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Weight of equal volumes against similar shapes, in `0..1` without 1; 0.1 by default.
    pub theta: f64,
    /// What moves to untangle; [`Scope::NearFirst`] by default.
    pub scope: Scope,
    /// Most rounds of untangling, each with a smaller ε; 60 by default.
    pub untangle_rounds: usize,
    /// Most iterations of a round of untangling; 100 by default.
    pub untangle_iterations: usize,
    /// Least share of the energy that a round of untangling is taken to gain, in `0..1` (σ of Garanzha et al.); the
    /// larger, the faster ε falls; 0.1 by default.
    pub least_gain: f64,
    /// Rounds of improvement, with exponents growing from 2 to 64; 0 to leave the mesh untangled only; 6 by default.
    pub improve_rounds: usize,
    /// Most iterations of a round of improvement; 30 by default.
    pub improve_iterations: usize,
    /// Weight of the badness of all elements against their shapes, at least 0; 4 by default.
    pub average: f64,
    /// Weight of the badness of the worst elements against all others' shapes, at least 0; 10 by default.
    pub strength: f64,
    /// Most rounds of polishing; 10 by default.
    pub polish_rounds: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            theta: 0.1,
            scope: Scope::NearFirst,
            untangle_rounds: 60,
            untangle_iterations: 100,
            least_gain: 0.1,
            improve_rounds: 6,
            improve_iterations: 30,
            average: 4.0,
            strength: 10.0,
            polish_rounds: 10,
        }
    }
}

/// What an optimisation did. Qualities are in [`Measure`] of the elements: for hexahedra how sound
/// they are: scaled Jacobians, but no more than lengths of edges and determinants allow.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct OptimiseReport {
    /// Cells with an inverted or flat element in the input.
    pub inverted_before: usize,
    /// The same in the result.
    pub inverted_after: usize,
    /// Worst quality in the input, in −1..1.
    pub worst_before: f64,
    /// Worst quality in the result, in −1..1.
    pub worst_after: f64,
    /// Mean over the cells of the worst quality of each in the input, in −1..1.
    pub average_before: f64,
    /// The same in the result.
    pub average_after: f64,
    /// Iterations of the minimiser.
    pub iterations: usize,
    /// How far the vertex that moved most is from where it was, in the unit of the points.
    pub largest_move: f64,
}

/// Moves `points` until no element is inverted and the worst is as good as can be had. `freedom` says for each point
/// how it may move, `guides` what [`Freedom::Guided`] ones slide on.
///
/// Fixed coordinates keep their bits, and sliding points end on their guides. If the input, put on its guides, has no
/// inverted element, neither has the result, and its worst quality is at least that of the input put on its guides. If
/// it has, they are removed as far as the settings and the boundary allow; [`OptimiseReport::inverted_after`] tells.
/// References are scaled to the mean size of the elements.
///
/// Each iteration takes linear time on all threads of the current rayon pool; about 500 bytes an element.
///
/// # Errors
/// [`ErrorKind::Mismatch`] when there is not one freedom per point; [`ErrorKind::Option`] for a setting out of range or
/// a missing guide; [`ErrorKind::Mesh`] for coordinates that are not finite or vertices that do not exist;
/// [`ErrorKind::Cancelled`]. The points are unchanged after an error.
pub fn optimise(
    points: &mut [Point],
    elements: &Elements,
    freedom: &[Freedom],
    guides: &[&dyn Guide],
    settings: &Settings,
    context: &Context,
) -> Result<OptimiseReport> {
    check(points, elements, freedom, settings)?;
    let constraints = Constraints::new(freedom, guides)?;
    let mut elements = elements.clone();
    elements.match_size(points);
    context.check()?;
    let mut problem = Optimisation::new(&elements, constraints, points.len());
    context.check()?;
    let before = problem.assembly.census(points);
    let mut moved = points.to_vec();
    run(&mut problem, &mut moved, settings, context)?;
    problem.constraints.restore(&mut moved, points);
    let after = problem.assembly.census(&moved);
    let report = OptimiseReport {
        inverted_before: before.inverted,
        inverted_after: after.inverted,
        worst_before: before.worst,
        worst_after: after.worst,
        average_before: before.average,
        average_after: after.average,
        iterations: problem.iterations,
        largest_move: points.iter().zip(&moved).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max),
    };
    points.copy_from_slice(&moved);
    Ok(report)
}

/// All phases from `points`.
fn run(problem: &mut Optimisation, points: &mut Vec<Point>, settings: &Settings, context: &Context) -> Result<()> {
    context.check()?;
    problem.constraints.project(points);
    let mut valid = problem.assembly.census(points).inverted == 0;
    if !valid {
        valid = untangle(problem, points, settings, &context.stage("untangle", 0.0, 0.3))?;
    }
    if !valid && settings.improve_rounds > 0 {
        valid = room::make_room(problem, points, settings, &context.stage("untangle", 0.3, 0.4))?;
    }
    if valid && settings.improve_rounds + settings.polish_rounds > 0 {
        raise(problem, points, settings, context)?;
    }
    context.stage("polish", 0.9, 1.0).tick(1.0)
}

/// The first phase; whether no element is inverted after it.
fn untangle(
    problem: &mut Optimisation,
    points: &mut Vec<Point>,
    settings: &Settings,
    context: &Context,
) -> Result<bool> {
    let scope = settings.scope;
    let before = problem.assembly.census(points).inverted;
    if scope != Scope::Whole {
        let left = local::untangle_near(problem, points, settings, &context.stage("untangle", 0.0, 0.2))?;
        if left < before || scope == Scope::Near {
            return Ok(left == 0);
        }
    }
    let start = points.clone();
    untangle::untangle_all(problem, points, &Untangling::new(settings), &context.stage("untangle", 0.2, 1.0))?;
    let left = problem.assembly.census(points).inverted;
    if left > before {
        points.copy_from_slice(&start);
        problem.constraints.project(points);
    }
    Ok(left == 0)
}

/// The phases after untangling. What is good for most elements at first lowers the worst quality, which polishing makes
/// good again; only where it does not, the best state with a worst quality as in `points` is taken.
fn raise(problem: &mut Optimisation, points: &mut Vec<Point>, settings: &Settings, context: &Context) -> Result<()> {
    let least = problem.assembly.census(points).worst;
    let BestPoints { best, safe } = improve(problem, points, settings, &context.stage("improve", 0.4, 0.9))?;
    let fair = improve::score(&problem.assembly.census(&safe));
    for (state, part) in [(best, 0.9), (safe, 0.95)] {
        *points = state;
        problem.constraints.project(points);
        let context = context.stage("polish", part, part + 0.05);
        polish::polish(problem.elements, &problem.constraints, points, settings.polish_rounds, least, &context)?;
        let census = problem.assembly.census(points);
        if census.worst >= least && improve::score(&census) >= fair {
            break;
        }
    }
    Ok(())
}

fn check(points: &[Point], elements: &Elements, freedom: &[Freedom], settings: &Settings) -> Result<()> {
    if freedom.len() != points.len() {
        let message = format!("{} freedoms for {} points", freedom.len(), points.len());
        return Err(Error::new(ErrorKind::Mismatch, message).remedy("give one freedom per point"));
    }
    let weights = 0.0..f64::INFINITY;
    let Settings { theta, average, strength, least_gain, .. } = *settings;
    let shares = [theta, least_gain].iter().all(|x| (0.0..1.0).contains(x));
    if !(shares && [average, strength].iter().all(|x| weights.contains(x))) {
        let message =
            format!("theta {theta}, average {average}, strength {strength} or least gain {least_gain} is out of range");
        return Err(Error::new(ErrorKind::Option, message)
            .remedy("use 0 <= theta < 1, average >= 0, strength >= 0 and 0 <= least gain < 1"));
    }
    if let Some(v) = points.iter().position(|p| p.coords.iter().any(|x| !x.is_finite())) {
        return Err(Error::new(ErrorKind::Mesh, "a coordinate is not finite").at(Place::Vertex(v as u32)));
    }
    match elements.corners.iter().position(|c| c.iter().any(|v| *v as usize >= points.len())) {
        None => Ok(()),
        Some(i) => Err(Error::new(ErrorKind::Mesh, format!("a vertex is not among the {} points", points.len()))
            .at(Place::Cell(elements.cell(i) as u32))),
    }
}
