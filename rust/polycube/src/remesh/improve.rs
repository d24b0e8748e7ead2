//! Optimises hexahedra with their surface on that of the shape.

use super::Hexes;
use super::gaps::samples;
use super::report::cells_of;
use super::site::Site;
use super::slide::{Hold, Slides};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use crate::optimise::{Elements, Freedom, Guide, Settings, optimise, scaled_jacobian};
use crate::simplify::Simplified;
use rayon::prelude::*;

/// Most passes of the optimiser over a mesh: each asks for boxes of the sizes that the one before led to.
const PASSES: usize = 4;
/// A pass that raised worst and average quality by less in sum is the last.
const LEAST_GAIN: f64 = 0.015;
/// And so is one that left more than this part of the inverted hexahedra.
const LEFT: f64 = 0.5;
/// How often the sizes that hexahedra should have are averaged with those around.
const SMOOTHING: usize = 3;
/// Most rounds of untangling after the vertices in the way were released.
const LATE_ROUNDS: usize = 15;
/// A trial with more than this part of its hexahedra inverted leads to nothing.
const HOPELESS: f64 = 0.01;
/// How often vertices of inverted hexahedra are released.
const RELEASES: usize = 4;
/// Hexahedra of a lower scaled Jacobian may have vertices released where the shape is smooth.
pub(super) const POOR: f64 = 0.6;

/// What a mesh is for.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Aim {
    /// It is the last; the shape shall be no farther from it than this.
    Within(f64),
    /// A finer one starts from it.
    Coarse,
    /// It is one of several that show what can be had, and is given up where many hexahedra stay inverted while edges are held.
    Trial,
}

/// What became of a mesh.
#[derive(Clone, Copy)]
pub(super) struct Improved {
    /// Vertices that left corners and edges.
    pub(super) released: usize,
    /// How far the shape is from the mesh; 0 if it is as near as it shall be.
    pub(super) far: f64,
}

/// Moves the vertices of a mesh until no hexahedron is inverted and the worst is as good as can be had.
///
/// Inverted ones are first untangled with the surface held, then with the edges held, so that surface vertices do not
/// slide past each other, from where there is no way back. Vertices of inverted hexahedra may leave corners and edges for
/// the surface around, and so may those of poor ones where the shape has no crease. Where the shape is farther
/// from the mesh than it shall be, vertices are put on what is cut off, as far as the hexahedra stay good.
pub(super) fn improve(
    map: &Simplified,
    hexes: &mut Hexes,
    shape: &[Point],
    settings: &Settings,
    aim: Aim,
    context: &Context,
) -> Result<Improved> {
    let slides = Slides::new(&map.input, shape, &context.stage("untangle", 0.0, 0.0))?;
    let elements = Elements::boxes_like(cells_of(hexes), &hexes.mesh.points, SMOOTHING)?;
    context.stage("untangle", 0.0, 0.0).tick(0.0)?;
    let freedom = slides.freedoms(&hexes.sites, Hold::Corners);
    let mut job = Job { elements, guides: slides.guides(), slides: &slides, hexes, freedom, released: 0 };
    job.untangle(settings, aim != Aim::Trial, &context.stage("untangle", 0.0, 0.4))?;
    if aim == Aim::Trial && job.is_hopeless() {
        return Ok(Improved { released: job.released, far: 0.0 });
    }
    job.passes(settings, &context.stage("optimise", 0.4, 0.8))?;
    let mut far = 0.0;
    if let Aim::Within(bound) = aim {
        let settings = Settings { untangle_rounds: settings.untangle_rounds.min(LATE_ROUNDS), ..settings.clone() };
        far = job.reach(&samples(&map.input.surface, shape), bound, &settings, &context.stage("optimise", 0.8, 1.0))?;
    }
    Ok(Improved { released: job.released, far })
}

/// How many hexahedra are inverted or flat.
pub(super) fn inverted(hexes: &Hexes) -> usize {
    cells_of(hexes).iter().filter(|c| scaled_jacobian(&hexes.mesh.points, c) <= 0.0).count()
}

/// A mesh on the way to be improved.
pub(super) struct Job<'a> {
    elements: Elements,
    pub(super) guides: Vec<&'a dyn Guide>,
    slides: &'a Slides,
    pub(super) hexes: &'a mut Hexes,
    pub(super) freedom: Vec<Freedom>,
    released: usize,
}

impl Job<'_> {
    /// Untangling alone, with more and more vertices that may move, until no hexahedron is inverted; without patience only as long as
    /// there is hope.
    fn untangle(&mut self, settings: &Settings, patient: bool, context: &Context) -> Result<()> {
        let first = Settings {
            untangle_rounds: 8,
            untangle_iterations: 50,
            improve_rounds: 0,
            polish_rounds: 0,
            ..settings.clone()
        };
        self.project();
        for (hold, part) in [(Hold::Surface, 0.0), (Hold::Edges, 0.3)] {
            let freedom = self.slides.freedoms(&self.hexes.sites, hold);
            if self.run(&freedom, &first, &context.stage("untangle", part, part + 0.3))? == 0 {
                return Ok(());
            }
        }
        if !patient && self.is_hopeless() {
            return Ok(());
        }
        let short = Settings { untangle_rounds: 12, ..first };
        for round in 0..RELEASES {
            let part = 0.6 + 0.4 * round as f64 / RELEASES as f64;
            if self.run(&self.freedom.clone(), &short, &context.stage("untangle", part, part + 0.1))? == 0 {
                break;
            }
            self.release(0.0, |_, _, _| true);
        }
        Ok(())
    }

    /// Whether many hexahedra are inverted.
    fn is_hopeless(&self) -> bool {
        inverted(self.hexes) as f64 > HOPELESS * cells_of(self.hexes).len() as f64
    }

    /// Puts every surface vertex on what it slides on.
    fn project(&mut self) {
        let guides = &self.guides;
        let each = self.hexes.mesh.points.par_iter_mut().zip(&self.freedom).with_min_len(256);
        each.for_each(|(point, freedom)| {
            if let Freedom::Guided(g) = freedom {
                *point = guides[*g as usize].contact(point).point;
            }
        });
    }

    /// One optimisation; how many hexahedra are inverted after it.
    pub(super) fn run(&mut self, freedom: &[Freedom], settings: &Settings, context: &Context) -> Result<usize> {
        let points = &mut self.hexes.mesh.points;
        Ok(optimise(points, &self.elements, freedom, &self.guides, settings, context)?.inverted_after)
    }

    /// Lets vertices of hexahedra whose scaled Jacobian is `bar` or less slide on all of the surface, where `may` agrees.
    fn release(&mut self, bar: f64, may: impl Fn(&Slides, Site, &Point) -> bool) {
        let Hexes { mesh, sites, .. } = &*self.hexes;
        let bad = cells_of(self.hexes).iter().filter(|c| scaled_jacobian(&mesh.points, c) <= bar);
        for v in bad.flatten().map(|&v| v as usize) {
            let bound = matches!(sites[v], Site::Corner(_) | Site::Edge(_));
            let free = self.freedom[v] == self.slides.released();
            if bound && !free && may(self.slides, sites[v], &mesh.points[v]) {
                self.freedom[v] = self.slides.released();
                self.released += 1;
            }
        }
    }

    /// Passes of the optimiser, until one gains little.
    fn passes(&mut self, settings: &Settings, context: &Context) -> Result<()> {
        let settings = Settings { untangle_rounds: settings.untangle_rounds.min(LATE_ROUNDS), ..settings.clone() };
        for pass in 0..PASSES {
            let [from, to] = [pass, pass + 1].map(|p| p as f64 / PASSES as f64);
            context.tick(from)?;
            self.resize()?;
            context.tick(from)?;
            let before = self.released;
            self.release(POOR, Slides::is_smooth);
            let points = &mut self.hexes.mesh.points;
            let context = context.stage("optimise", from, to);
            let done = optimise(points, &self.elements, &self.freedom, &self.guides, &settings, &context)?;
            let gain = done.worst_after - done.worst_before + done.average_after - done.average_before;
            let stuck = done.inverted_after as f64 > LEFT * done.inverted_before as f64;
            if stuck || gain < LEAST_GAIN && self.released == before {
                break;
            }
        }
        Ok(())
    }

    /// All of the shape's surface.
    pub(super) fn whole(&self) -> &dyn Guide {
        self.slides.whole()
    }

    /// Asks for boxes of the sizes that the hexahedra have by now.
    pub(super) fn resize(&mut self) -> Result<()> {
        self.elements = Elements::boxes_like(cells_of(self.hexes), &self.hexes.mesh.points, SMOOTHING)?;
        Ok(())
    }
}
