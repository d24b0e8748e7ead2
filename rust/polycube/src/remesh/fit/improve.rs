//! Optimises hexahedra with their surface on that of the shape.

use super::distant_points::{farthest, samples};
use super::fitting::{Fitted, Fitting, POOR};
use super::sliding::{Hold, Sliding};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use crate::optimise::{Settings, optimise};
use crate::structure::Polycube;

/// Most passes of the optimiser over a mesh: each asks for boxes of the sizes that the one before led to.
const PASSES: usize = 4;
/// A pass that raised worst and average quality by less in sum is the last.
const LEAST_GAIN: f64 = 0.015;
/// And so is one that left more than this part of the inverted hexahedra.
const LEFT: f64 = 0.5;
/// Most rounds of untangling after the vertices in the way were released.
const LATE_ROUNDS: usize = 15;
/// A mesh from which a finer one starts may be so many times as far from the shape as the last.
const COARSER: f64 = 2.0;
/// What sticks out is lost where the shape is so many times farther than it shall be,
const FAR: f64 = 2.0;
/// and kept by what leaves no more than this part of that.
pub(crate) const NEARER: f64 = 0.8;
/// More of the shape is lost where it is so many times farther from the mesh than before.
const LOST: f64 = 1.25;
/// How often vertices of inverted hexahedra are released.
const RELEASES: usize = 4;

/// What a mesh is for, and how near the last one shall be to the shape.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Aim {
    /// It is the last.
    Within(f64),
    /// A finer one starts from it.
    Coarse(f64),
    /// It is one of several that show what can be had, and is given up where many hexahedra stay inverted while edges
    /// are held.
    Trial(f64),
}

impl Aim {
    fn is_trial(self) -> bool {
        matches!(self, Self::Trial(_))
    }

    /// How near the last one shall be.
    pub(crate) fn bound(self) -> f64 {
        match self {
            Self::Within(bound) | Self::Coarse(bound) | Self::Trial(bound) => bound,
        }
    }

    /// How near the shape may be expected to be.
    fn nearness(self) -> f64 {
        match self {
            Self::Within(bound) => bound,
            Self::Coarse(bound) | Self::Trial(bound) => COARSER * bound,
        }
    }
}

/// What became of a mesh.
#[derive(Clone, Copy)]
pub(crate) struct Improved {
    /// Vertices that left corners and edges.
    pub(crate) released: usize,
    /// How far the shape is from the mesh; 0 if it is as near as it shall be.
    pub(crate) far: f64,
    /// How sound the worst cell is.
    pub(crate) soundness: f64,
}

impl Improved {
    /// How far the shape is if what sticks out of it is not in the mesh; else 0.
    pub(crate) fn lost(&self, aim: Aim) -> f64 {
        if self.far > FAR * aim.nearness() { self.far } else { 0.0 }
    }
}

/// Moves the vertices of a mesh until no hexahedron is inverted and the worst is as good as can be had.
///
/// Inverted ones are first untangled with the surface held, then with the edges held, so that surface vertices do not
/// slide past each other, from where there is no way back. Vertices of inverted hexahedra may leave corners and edges
/// for the surface around, and so may those of poor ones where the shape has no crease. Where the shape is farther from
/// the mesh than it shall be, vertices are put on what is cut off, as far as the hexahedra stay good; where it is much
/// farther, the mesh is made again with vertices held there from the start.
pub(crate) fn improve(
    polycube: &Polycube,
    fitted: Fitted,
    shape: &[Point],
    settings: &Settings,
    aim: Aim,
    context: &Context,
) -> Result<Improved> {
    let sliding = Sliding::new(polycube, shape, &context.stage("untangle", 0.0, 0.0))?;
    let start = fitted.mesh.points().to_vec();
    let samples = samples(&polycube.surface, shape);
    let mut fitting = Fitting::new(fitted, &sliding)?;
    context.stage("untangle", 0.0, 0.0).tick(0.0)?;
    if !fitting.fit(&start, &samples, settings, aim, context)? {
        return Ok(Improved { released: fitting.released, far: 0.0, soundness: fitting.soundness() });
    }
    let mut far = fitting.keep(&start, &samples, settings, aim, context)?;
    if let Aim::Within(bound) = aim {
        let settings = Settings { untangle_rounds: settings.untangle_rounds.min(LATE_ROUNDS), ..settings.clone() };
        far = fitting.limit_chord_error(&samples, bound, &settings, &context.stage("optimise", 0.8, 0.9))?;
        far = fitting.anchor(&start, (&samples, bound), far, &settings, &context.stage("optimise", 0.9, 1.0))?;
    }
    Ok(Improved { released: fitting.released, far, soundness: fitting.soundness() })
}

impl Fitting<'_> {
    /// Untangles and improves the mesh from the `start`. Whether it was not given up.
    fn fit(
        &mut self,
        start: &[Point],
        samples: &[Point],
        settings: &Settings,
        aim: Aim,
        context: &Context,
    ) -> Result<bool> {
        self.untangle(settings, !aim.is_trial(), &context.stage("untangle", 0.0, 0.2))?;
        if !aim.is_trial() && self.inverted() > 0 {
            // Fair sizes may not be to be had: then those there are.
            self.reset(start, false)?;
            self.untangle(settings, true, &context.stage("untangle", 0.2, 0.4))?;
        }
        if aim.is_trial() && self.is_hopeless() {
            return Ok(false);
        }
        self.passes(samples, settings, &context.stage("optimise", 0.4, 0.8)).map(|()| true)
    }

    /// Where what sticks out of the shape was lost, makes the mesh again from the `start` with springs that keep it
    /// there, and takes that if it is much nearer. How far the shape is then; 0 where nothing is lost.
    fn keep(
        &mut self,
        start: &[Point],
        samples: &[Point],
        settings: &Settings,
        aim: Aim,
        context: &Context,
    ) -> Result<f64> {
        let faces = self.fitted.mesh.cells().boundary()?;
        let rank = |fitting: &Self| (fitting.inverted(), farthest(fitting.points(), &faces, samples));
        let (inverted, far) = rank(self);
        if far <= FAR * aim.nearness() {
            return Ok(0.0);
        }
        let before = (self.points().to_vec(), self.freedom.clone(), self.released);
        self.reset(start, true)?;
        self.kept = Some(aim.nearness());
        let fitted = self.fit(start, samples, settings, aim, context)?;
        let now = rank(self);
        if !fitted || now.0 > inverted || now.1 > NEARER * far {
            self.kept = None;
            self.points_mut().copy_from_slice(&before.0);
            (self.freedom, self.released) = (before.1, before.2);
            return Ok(far);
        }
        Ok(if now.1 <= FAR * aim.nearness() { 0.0 } else { now.1 })
    }

    /// Untangling alone, with more and more vertices that may move, until no hexahedron is inverted; without patience
    /// only as long as there is hope.
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
            let freedom = self.sliding.freedoms(self.fitted.carriers, hold);
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

    /// Whether the shape with these `samples` is much farther from the mesh than when its vertices were `before`.
    fn loses(&self, samples: &[Point], before: &[Point]) -> Result<bool> {
        let faces = self.fitted.mesh.cells().boundary()?;
        let [then, now] = [before, self.points()].map(|points| farthest(points, &faces, samples));
        Ok(now > LOST * then)
    }

    /// Passes of the optimiser, until one gains little. Vertices of poor cells are released, unless that loses more of
    /// the shape, whose `samples` say so: what sticks out may be worth more than good cells.
    pub(super) fn passes(&mut self, samples: &[Point], settings: &Settings, context: &Context) -> Result<()> {
        let settings = Settings { untangle_rounds: settings.untangle_rounds.min(LATE_ROUNDS), ..settings.clone() };
        let mut may_release = true;
        for pass in 0..PASSES {
            let [from, to] = [pass, pass + 1].map(|p| p as f64 / PASSES as f64);
            context.tick(from)?;
            self.resize()?;
            if let Some(nearness) = self.kept {
                self.fasten(samples, nearness)?;
            }
            context.tick(from)?;
            let (before, start) = (self.released, (self.points().to_vec(), self.freedom.clone()));
            if may_release {
                self.release(POOR, Sliding::is_smooth);
            }
            let points = self.fitted.mesh.points_mut();
            let context = context.stage("optimise", from, to);
            let done = optimise(points, &self.elements, &self.freedom, &self.guides, &settings, &context)?;
            if self.released > before && self.loses(samples, &start.0)? {
                (self.released, may_release) = (before, false);
                self.points_mut().copy_from_slice(&start.0);
                self.freedom = start.1;
                continue;
            }
            let gain = done.worst_after - done.worst_before + done.average_after - done.average_before;
            let stuck = done.inverted_after as f64 > LEFT * done.inverted_before as f64;
            if stuck || gain < LEAST_GAIN && self.released == before {
                break;
            }
        }
        Ok(())
    }
}
