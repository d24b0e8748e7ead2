//! Untangles what is near inverted elements, while all else stays: a small part of the work where there are few.

use super::Settings;
use super::elements::Elements;
use super::freedom::{Constraints, Freedom};
use super::problem::Problem;
use super::untangle;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;

/// Rings of vertices around inverted cells that move: few at first, more where that is not enough.
const RINGS: [usize; 2] = [2, 4];
/// It is no less work than moving all where the part is larger than this.
const LARGE: f64 = 0.25;

/// Untangles what is near inverted elements, and all of the mesh if that does not help at all; whether none is inverted then. Sliding
/// vertices are on their guides before and after.
pub(super) fn untangle(
    problem: &mut Problem,
    points: &mut Vec<Point>,
    settings: &Settings,
    context: &Context,
) -> Result<bool> {
    let before = problem.assembly.inverted(points).len();
    for (i, rings) in RINGS.into_iter().enumerate() {
        let context = context.stage("untangle", 0.1 * i as f64, 0.1 * (i + 1) as f64);
        if !untangle_near(problem, points, rings, settings, &context)? {
            break;
        }
    }
    let left = problem.assembly.inverted(points).len();
    if left == before {
        let start = points.clone();
        untangle::untangle(problem, points, settings, &context.stage("untangle", 0.2, 1.0))?;
        if problem.assembly.inverted(points).len() >= left {
            points.copy_from_slice(&start);
            problem.constraints.project(points);
        }
    }
    Ok(problem.assembly.inverted(points).is_empty())
}

/// Moves the vertices within so many `rings` of inverted elements, if that leaves fewer of them. Whether there may be some left, and
/// the part was not too large.
fn untangle_near(
    problem: &mut Problem,
    points: &mut [Point],
    rings: usize,
    settings: &Settings,
    context: &Context,
) -> Result<bool> {
    let bad = problem.assembly.inverted(points);
    let part = Part::new(problem.elements, problem.constraints.freedom, &bad, rings);
    if bad.is_empty() || part.elements.len() as f64 > LARGE * problem.elements.len() as f64 {
        return Ok(false);
    }
    let mut moved: Vec<Point> = part.vertices.iter().map(|&v| points[v as usize]).collect();
    let mut constraints = Constraints::new(&part.freedom, problem.constraints.guides)?;
    constraints.project(&mut moved);
    let mut own = Problem::new(&part.elements, constraints, moved.len());
    untangle::untangle(&mut own, &mut moved, settings, context)?;
    problem.iterations += own.iterations;
    if own.assembly.inverted(&moved).len() < bad.len() {
        for (&v, point) in part.vertices.iter().zip(moved) {
            points[v as usize] = problem.constraints.place(v as usize, point);
        }
    }
    Ok(true)
}

/// Some cells with their vertices numbered anew; those that other cells have, too, are held.
struct Part {
    vertices: Vec<u32>,
    elements: Elements,
    freedom: Vec<Freedom>,
}

impl Part {
    /// The cells with vertices within so many `rings` of the cells `bad`, which move.
    fn new(elements: &Elements, freedom: &[Freedom], bad: &[usize], rings: usize) -> Self {
        let near = near(elements, freedom.len(), bad, rings);
        let cells = elements.cells_with(&near);
        let mut vertices: Vec<u32> = cells.iter().flat_map(|&c| elements.vertices_of(c)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let own = |v: u32| vertices.partition_point(|&w| w < v) as u32;
        let elements = elements.some(&cells, own);
        let allowed = |&v: &u32| if near[v as usize] { freedom[v as usize] } else { Freedom::Fixed };
        let freedom = vertices.iter().map(allowed).collect();
        Self { vertices, elements, freedom }
    }
}

/// Whether each of `count` vertices is within so many `rings` of the cells `bad`.
fn near(elements: &Elements, count: usize, bad: &[usize], rings: usize) -> Vec<bool> {
    let mut near = vec![false; count];
    bad.iter().flat_map(|&c| elements.vertices_of(c)).for_each(|v| near[v as usize] = true);
    for _ in 1..rings {
        let cells = elements.cells_with(&near);
        cells.iter().flat_map(|&c| elements.vertices_of(c)).for_each(|v| near[v as usize] = true);
    }
    near
}
