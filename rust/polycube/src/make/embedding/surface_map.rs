//! The map from the charts of a shape to the facets of its polycube, made one to one.

use crate::context::Context;
use crate::error::Result;
use crate::map::{extend_harmonic, positive_weights};
use crate::mesh::{Face, Point};
use crate::optimise::{Elements, Freedom, Scope, Settings, optimise, relax};
use crate::remesh::Refined;
use crate::simplify::CornerTetrahedra;

/// How often what stays folded is cut finer and tried again.
const ROUNDS: usize = 5;

const UNFOLD: Settings = Settings {
    theta: 0.1,
    scope: Scope::Whole,
    untangle_rounds: 100,
    untangle_iterations: 200,
    least_gain: 0.1,
    improve_rounds: 0,
    improve_iterations: 0,
    average: 0.0,
    strength: 0.0,
    polish_rounds: 0,
};
/// The weight of areas against angles: a map that keeps angles alone all but loses what sticks out of a facet.
const AREAS: f64 = 0.5;
/// Iterations of smoothing.
const ITERATIONS: usize = 400;

/// Lays every chart flat in its facet, with the borders held, then lets vertices slide along the edges. Triangles that
/// cannot be turned the right way round are cut finer. Returns those that stay turned over.
pub(crate) fn unfold(refined: &mut Refined, context: &Context) -> Result<Vec<usize>> {
    lay_flat(refined, &context.stage("map", 0.0, 0.1))?;
    let mut folded = turned_over(refined);
    for round in 0..ROUNDS {
        if folded.is_empty() {
            return smooth(refined, &context.stage("map", 0.8, 1.0)).map(|()| folded);
        }
        if round > 0 {
            refined.split_near(&folded)?;
            folded = turned_over(refined);
        }
        let [from, to] = [round, round + 1].map(|r| 0.1 + 0.7 * r as f64 / ROUNDS as f64);
        unfold_facets(refined, &folded, round, &context.stage("map", from, to))?;
        folded = turned_over(refined);
    }
    Ok(folded)
}

fn turned_over(refined: &Refined) -> Vec<usize> {
    CornerTetrahedra::of_surface(&refined.polycube, &refined.points, &refined.shape).turned_over()
}

/// Untangles the facets of the triangles listed, each as a whole: what is near alone would often be caught. At first
/// triangles shall look as on the shape; where that leaves some turned over, thin ones, which hardly count there, shall
/// look like all others.
fn unfold_facets(refined: &mut Refined, folded: &[usize], round: usize, context: &Context) -> Result<()> {
    let mut marked = vec![false; refined.polycube.structure.facets.len()];
    folded.iter().for_each(|&t| marked[refined.polycube.facet_of_face[t] as usize] = true);
    let mut corners = CornerTetrahedra::of_surface(&refined.polycube, &refined.points, &refined.shape);
    let facets = &refined.polycube.facet_of_face;
    let chosen = |(_, facet): &(&[u32; 4], &u32)| marked[**facet as usize];
    let own: Vec<[u32; 4]> = corners.tetrahedra.iter().zip(facets).filter(chosen).map(|(t, _)| *t).collect();
    let like = |own: &[[u32; 4]]| Elements::tetrahedra_like(own, &corners.rest);
    let elements = if round == 0 { like(&own)? } else { Elements::regular_tetrahedra(&own) };
    optimise(&mut corners.points, &elements, &corners.freedom, &[], &UNFOLD, context)?;
    corners.points.truncate(refined.points.len());
    refined.points = corners.points;
    Ok(())
}

/// Lets vertices slide along the edges.
fn smooth(refined: &mut Refined, context: &Context) -> Result<()> {
    let mut corners = CornerTetrahedra::of_surface(&refined.polycube, &refined.points, &refined.shape);
    for (freedom, levels) in corners.freedom.iter_mut().zip(&refined.polycube.vertex_levels) {
        if levels.iter().flatten().count() == 2 {
            *freedom = Freedom::Axes(levels.map(|l| l.is_some()));
        }
    }
    let elements = Elements::tetrahedra_like(&corners.tetrahedra, &corners.rest)?;
    relax(&mut corners.points, &elements, &corners.freedom, AREAS, ITERATIONS, context)?;
    corners.points.truncate(refined.points.len());
    refined.points = corners.points;
    Ok(())
}

/// Puts the vertices inside facets at the weighted means of their neighbours.
fn lay_flat(refined: &mut Refined, context: &Context) -> Result<()> {
    let known: Vec<[bool; 3]> = refined
        .polycube
        .vertex_levels
        .iter()
        .map(|levels| match levels.iter().flatten().count() {
            0 | 1 => levels.map(|l| l.is_some()),
            _ => [true; 3],
        })
        .collect();
    let mut field: Vec<[f64; 3]> = refined.points.iter().map(|p| [p.x, p.y, p.z]).collect();
    let triangles: Vec<[u32; 3]> = refined.polycube.surface.faces().iter().flat_map(Face::triangles).collect();
    let weights = positive_weights(&refined.shape, &triangles, &context.stage("map", 0.0, 0.1))?;
    extend_harmonic(&weights, &known, &mut field, &context.stage("map", 0.1, 1.0))?;
    refined.points = field.into_iter().map(Point::from).collect();
    Ok(())
}
