//! Makes the map between the surfaces of shape and polycube one to one before it is used.

use super::refine::Refined;
use crate::context::Context;
use crate::error::Result;
use crate::optimise::{Elements, Freedom, Scope, Settings, optimise};
use crate::simplify::CornerTetrahedra;

/// Untangling alone.
const UNTANGLE: Settings = Settings {
    theta: 0.1,
    scope: Scope::NearFirst,
    untangle_rounds: 40,
    untangle_iterations: 100,
    least_gain: 0.1,
    improve_rounds: 0,
    improve_iterations: 0,
    average: 0.0,
    strength: 0.0,
    polish_rounds: 0,
};

/// Smoothing of a valid map by two rounds of improvement.
const SMOOTH: Settings = Settings { untangle_rounds: 0, improve_rounds: 2, improve_iterations: 50, ..UNTANGLE };

/// How often triangles are split where they cannot be turned the right way round.
const SPLITS: usize = 2;
/// Splitting helps single triangles without room, not a facet that is folded: then more than this part of all are
/// turned over.
const FOLDED: f64 = 0.001;

/// Moves the surface vertices of a polycube in their facets and along their edges so that no triangle is turned over
/// and each looks like that of the shape, as far as that goes; splits triangles where it does not go otherwise, as long
/// as that leaves fewer of them turned over. Where a facet stays folded, how many triangles are turned over; else 0.
pub(crate) fn untangle_surface(refined: &mut Refined, context: &Context) -> Result<usize> {
    spread_chains(refined);
    let mut least = usize::MAX;
    for round in 0..=SPLITS {
        let from = 0.8 * round as f64 / (SPLITS + 1) as f64;
        let bad = relax(refined, false, &context.stage("map", from, 0.8))?;
        if bad.is_empty() {
            relax(refined, true, &context.stage("map", 0.8, 1.0))?;
            break;
        }
        if bad.len() as f64 > FOLDED * refined.polycube.surface.faces().len() as f64 {
            return Ok(bad.len());
        }
        if bad.len() >= least {
            break;
        }
        least = bad.len();
        if round < SPLITS {
            refined.split_facets_of(&bad)?;
        }
    }
    Ok(0)
}

/// Segments of an edge no shorter than this part of their mean are well enough spread.
const LEAST_STEP: f64 = 0.02;

/// Places the vertices of a polycube edge that are out of order or too close by their distances along the edge on the
/// shape.
fn spread_chains(refined: &mut Refined) {
    let Refined { polycube, points, shape, .. } = refined;
    for (edge, chain) in polycube.structure.edges.iter().zip(&polycube.chains) {
        let steps = chain.windows(2).map(|s| (shape[s[0] as usize] - shape[s[1] as usize]).norm());
        let length: f64 = steps.clone().sum();
        let [low, high] = [chain[0], chain[chain.len() - 1]].map(|v| points[v as usize][edge.axis]);
        let at = |i: usize| points[chain[i] as usize][edge.axis];
        let least = LEAST_STEP * (high - low) / (chain.len() - 1) as f64;
        if (1..chain.len()).all(|i| at(i) - at(i - 1) >= least) {
            continue;
        }
        let mut walked = 0.0;
        for (step, &v) in steps.zip(&chain[1..chain.len() - 1]) {
            walked += step;
            points[v as usize][edge.axis] = low + (high - low) * (walked / length).min(1.0);
        }
    }
}

/// One round, in which vertices slide along polycube edges or not; returns the triangles that are still turned over.
///
/// While there are such, edges are held: their vertices would lose their order.
fn relax(refined: &mut Refined, sliding: bool, context: &Context) -> Result<Vec<usize>> {
    let Refined { polycube, points, shape, .. } = refined;
    let mut corners = CornerTetrahedra::of_surface(polycube, points, shape);
    for (freedom, levels) in corners.freedom.iter_mut().zip(&polycube.vertex_levels) {
        if sliding && levels.iter().flatten().count() == 2 {
            *freedom = Freedom::Axes(levels.map(|l| l.is_some()));
        }
    }
    let elements = Elements::tetrahedra_like(&corners.tetrahedra, &corners.rest)?;
    let settings = if sliding { &SMOOTH } else { &UNTANGLE };
    optimise(&mut corners.points, &elements, &corners.freedom, &[], settings, context)?;
    let bad = corners.turned_over();
    corners.points.truncate(points.len());
    *points = corners.points;
    Ok(bad)
}
