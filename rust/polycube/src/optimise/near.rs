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
    let mut bad = problem.assembly.inverted(points);
    let before = bad.len();
    for (i, rings) in RINGS.into_iter().enumerate() {
        let near = near(problem.elements, points.len(), &bad, rings);
        let cells = problem.elements.cells_with(&near);
        if bad.is_empty() || cells.len() as f64 > LARGE * problem.elements.cells() as f64 {
            break;
        }
        let part = Part::new(problem.elements, problem.constraints.freedom, &near, &cells);
        let context = context.stage("untangle", 0.1 * i as f64, 0.1 * (i + 1) as f64);
        untangle_part(problem, points, &part, bad.len(), settings, &context)?;
        bad = problem.assembly.inverted(points);
    }
    if bad.len() < before {
        return Ok(bad.is_empty());
    }
    let start = points.clone();
    untangle::untangle(problem, points, settings, &context.stage("untangle", 0.2, 1.0))?;
    let left = problem.assembly.census(points).inverted;
    if left >= before {
        points.copy_from_slice(&start);
        problem.constraints.project(points);
    }
    Ok(left == 0)
}

/// Moves the vertices of a part with so many inverted cells, if that leaves fewer of them.
fn untangle_part(
    problem: &mut Problem,
    points: &mut [Point],
    part: &Part,
    inverted: usize,
    settings: &Settings,
    context: &Context,
) -> Result<()> {
    let mut moved: Vec<Point> = part.vertices.iter().map(|&v| points[v as usize]).collect();
    let mut constraints = Constraints::new(&part.freedom, problem.constraints.guides)?;
    constraints.project(&mut moved);
    let mut own = Problem::new(&part.elements, constraints, moved.len());
    untangle::untangle(&mut own, &mut moved, settings, context)?;
    problem.iterations += own.iterations;
    if own.assembly.census(&moved).inverted < inverted {
        for (&v, point) in part.vertices.iter().zip(moved) {
            points[v as usize] = problem.constraints.place(v as usize, point);
        }
    }
    Ok(())
}

/// Some cells with their vertices numbered anew; those that other cells have, too, are held.
struct Part {
    vertices: Vec<u32>,
    elements: Elements,
    freedom: Vec<Freedom>,
}

impl Part {
    /// Some `cells`, in which the vertices `near` move.
    fn new(elements: &Elements, freedom: &[Freedom], near: &[bool], cells: &[usize]) -> Self {
        let mut vertices: Vec<u32> = cells.iter().flat_map(|&c| elements.vertices_of(c)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let own = |v: u32| vertices.partition_point(|&w| w < v) as u32;
        let elements = elements.some(cells, own);
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
