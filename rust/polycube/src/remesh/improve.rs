//! Optimises hexahedra with their surface on that of the shape.

use super::Hexes;
use super::report::cells_of;
use super::site::Site;
use super::slide::{Hold, Slides};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use crate::optimise::{Elements, Freedom, Guide, Settings, optimise, scaled_jacobian};
use crate::simplify::Simplified;

/// Most passes of the optimiser over a mesh: a bad start spoils the first.
const PASSES: usize = 4;
/// A mesh whose worst scaled Jacobian is above this needs no further pass.
const GOOD: f64 = 0.5;
/// Nor does one that gained less.
const LEAST_GAIN: f64 = 0.02;
/// Most rounds of untangling after the vertices in the way were released.
const LATE_ROUNDS: usize = 15;
/// How often vertices of inverted hexahedra are released.
const RELEASES: usize = 4;

/// Moves the vertices of a mesh until no hexahedron is inverted and the worst is as good as can be had.
///
/// Inverted ones are first untangled with the surface held, then with the edges held, so that surface vertices do not
/// slide past each other, from where there is no way back. If some remain, their vertices may leave corners and edges for
/// the surface around; returns how many did.
pub(super) fn improve(
    map: &Simplified,
    hexes: &mut Hexes,
    shape: &[Point],
    settings: &Settings,
    context: &Context,
) -> Result<usize> {
    let slides = Slides::new(&map.input, shape)?;
    let elements = Elements::boxes_like(cells_of(hexes), &hexes.mesh.points, 3)?;
    let mut job = Job { elements, guides: slides.guides(), slides: &slides, hexes };
    let first = Settings {
        untangle_rounds: 8,
        untangle_iterations: 50,
        improve_rounds: 0,
        polish_rounds: 0,
        ..settings.clone()
    };
    for (hold, part) in [(Hold::Surface, 0.0), (Hold::Edges, 0.15)] {
        let freedom = slides.freedoms(&job.hexes.sites, hold);
        if job.run(&freedom, &first, &context.stage("untangle", part, part + 0.15))? == 0 {
            break;
        }
    }
    let mut freedom = slides.freedoms(&job.hexes.sites, Hold::Corners);
    let mut released = 0;
    let short = Settings { untangle_rounds: 12, ..first };
    for round in 0..RELEASES {
        if job.run(&freedom, &short, &context.stage("untangle", 0.3, 0.3 + 0.1 * round as f64 / RELEASES as f64))? == 0
        {
            break;
        }
        released += job.release(&mut freedom);
    }
    let settings = Settings { untangle_rounds: settings.untangle_rounds.min(LATE_ROUNDS), ..settings.clone() };
    job.passes(&freedom, &settings, &context.stage("optimise", 0.4, 1.0))?;
    Ok(released)
}

/// A mesh on the way to be improved.
struct Job<'a> {
    elements: Elements,
    guides: Vec<&'a dyn Guide>,
    slides: &'a Slides,
    hexes: &'a mut Hexes,
}

impl Job<'_> {
    /// One optimisation; how many hexahedra are inverted after it.
    fn run(&mut self, freedom: &[Freedom], settings: &Settings, context: &Context) -> Result<usize> {
        let points = &mut self.hexes.mesh.points;
        Ok(optimise(points, &self.elements, freedom, &self.guides, settings, context)?.inverted_after)
    }

    /// Lets the vertices of inverted hexahedra slide on all of the surface; how many could not before.
    fn release(&self, freedom: &mut [Freedom]) -> usize {
        let Hexes { mesh, sites, .. } = &*self.hexes;
        let bad = cells_of(self.hexes).iter().filter(|c| scaled_jacobian(&mesh.points, c) <= 0.0);
        let mut count = 0;
        for &v in bad.flatten() {
            let bound = matches!(sites[v as usize], Site::Corner(_) | Site::Edge(_));
            if bound && freedom[v as usize] != self.slides.released() {
                freedom[v as usize] = self.slides.released();
                count += 1;
            }
        }
        count
    }

    /// Passes of the optimiser, until one gains little.
    fn passes(&mut self, freedom: &[Freedom], settings: &Settings, context: &Context) -> Result<()> {
        for pass in 0..PASSES {
            let [from, to] = [pass, pass + 1].map(|p| p as f64 / PASSES as f64);
            let context = context.stage("optimise", from, to);
            let points = &mut self.hexes.mesh.points;
            let done = optimise(points, &self.elements, freedom, &self.guides, settings, &context)?;
            if done.worst_after > GOOD || done.worst_after - done.worst_before < LEAST_GAIN {
                break;
            }
        }
        Ok(())
    }
}
