//! Untangles what is near inverted cells, while all else stays: a small part of the work where there are few.

use super::Settings;
use super::elements::Elements;
use super::freedom::{Constraints, Freedom};
use super::optimisation::Optimisation;
use super::region::{Region, Room, regions};
use super::untangle::{Untangling, untangle_all};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use rayon::prelude::*;

/// How much around inverted cells moves: little at first, more where that is not enough.
const ROOMS: [Room; 2] = [Room { rings: 2, elements: 50 }, Room { rings: 4, elements: 200 }];

/// Regions that have more than this part of all cells together are left alone, the largest first: moving all is no more
/// work then.
const LARGE: f64 = 0.25;
/// But not where they have fewer elements than this, which take a second at most.
const SMALL: usize = 50_000;

/// Rounds in which a region must get much better.
const PATIENCE: usize = 3;

/// Untangles the regions around inverted cells, each by itself. Returns how many cells are still inverted. Sliding
/// vertices are on their guides before and after.
pub(super) fn untangle_near(
    problem: &mut Optimisation,
    points: &mut [Point],
    settings: &Settings,
    context: &Context,
) -> Result<usize> {
    let most = problem.elements.cells_in(SMALL).max((LARGE * problem.elements.cells() as f64) as usize);
    let mut bad = problem.assembly.inverted(points);
    for (i, room) in ROOMS.into_iter().enumerate() {
        let [from, to] = [i, i + 1].map(|i| i as f64 / ROOMS.len() as f64);
        if bad.is_empty() {
            break;
        }
        let context = context.stage("untangle", from, to);
        let regions = regions(problem.elements, &problem.constraints, &bad, room, most, &context)?;
        untangle_regions(problem, points, &regions, settings, &context)?;
        bad = problem.assembly.inverted(points);
    }
    Ok(bad.len())
}

/// No region sees what moves in another, so all are done at once.
fn untangle_regions(
    problem: &mut Optimisation,
    points: &mut [Point],
    regions: &[Region],
    settings: &Settings,
    context: &Context,
) -> Result<()> {
    let part =
        |i: usize| context.stage("untangle", i as f64 / regions.len() as f64, (i + 1) as f64 / regions.len() as f64);
    let untangling = Untangling { patience: PATIENCE, ..Untangling::new(settings) };
    let (elements, constraints) = (problem.elements, &problem.constraints);
    let solve = |(i, region)| {
        LocalProblem::new(elements, constraints, region).untangled(constraints, points, &untangling, &part(i))
    };
    let solved = regions.par_iter().enumerate().map(solve).collect::<Result<Vec<_>>>()?;
    for (iterations, moves) in solved {
        problem.iterations += iterations;
        for (v, point) in moves {
            points[v as usize] = problem.constraints.place(v as usize, point);
        }
    }
    Ok(())
}

/// The cells of a region with their vertices numbered anew; those that do not move in it are held.
struct LocalProblem {
    vertices: Vec<u32>,
    elements: Elements,
    freedom: Vec<Freedom>,
}

impl LocalProblem {
    fn new(elements: &Elements, constraints: &Constraints, region: &Region) -> Self {
        let mut vertices: Vec<u32> = region.cells.iter().flat_map(|&c| elements.vertices_of(c as usize)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let own = |v: u32| vertices.partition_point(|&w| w < v) as u32;
        let elements = elements.some(&region.cells, own);
        let moves = |v: &u32| region.moving.binary_search(v).is_ok();
        let allowed = |v: &u32| if moves(v) { constraints.freedom[*v as usize] } else { Freedom::Fixed };
        let freedom = vertices.iter().map(allowed).collect();
        Self { vertices, elements, freedom }
    }

    /// After how many iterations which vertices go where; none if that leaves no fewer cells inverted.
    fn untangled(
        mut self,
        constraints: &Constraints,
        points: &[Point],
        untangling: &Untangling,
        context: &Context,
    ) -> Result<(usize, Vec<(u32, Point)>)> {
        let mut points: Vec<Point> = self.vertices.iter().map(|&v| points[v as usize]).collect();
        self.elements.match_size(&points);
        let mut constraints = Constraints::new(&self.freedom, constraints.guides)?;
        constraints.project(&mut points);
        let mut problem = Optimisation::new(&self.elements, constraints, points.len());
        let before = problem.assembly.census(&points).inverted;
        untangle_all(&mut problem, &mut points, untangling, context)?;
        let better = problem.assembly.census(&points).inverted < before;
        let moves = self.vertices.into_iter().zip(points).zip(&self.freedom);
        let moves = moves.filter(|(_, freedom)| better && **freedom != Freedom::Fixed).map(|(to, _)| to).collect();
        Ok((problem.iterations, moves))
    }
}
