//! Vertices put where a mesh cuts off what sticks out of a shape.

use super::distant_points::{DistantPoint, distant_points};
use super::fitting::{Fitting, POOR};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::{Face, Point, Stars};
use crate::optimise::{Freedom, Settings};

/// How often vertices are moved there,
const ROUNDS: usize = 4;
/// unless the shape is farther than so many times the bound: vertices move by parts of an edge.
const TOO_FAR: f64 = 2.5;
/// A round leaves no more than this part of what the distance exceeds the bound by, or it failed.
const LEFT: f64 = 0.9;
/// They are where the shape is farther from the mesh than this part of the bound: a little less, as optimising moves
/// the others.
const NEARER: f64 = 0.9;
/// What may be left of the least soundness of all, where it is not [`POOR`],
const KEPT: f64 = 0.8;
/// and of that around a vertex when it is moved with care, before the others make way.
const KEPT_AROUND: f64 = 0.3;
/// A vertex reaches what is no farther than this part of the bound from what it slides on.
pub(super) const ON: f64 = 0.1;

/// How vertices are moved.
#[derive(Clone, Copy, PartialEq)]
enum Pull {
    /// All the way, whatever becomes of the hexahedra around: they are untangled.
    Bold,
    /// The same half the way, which often is enough.
    Half,
    /// As far as the hexahedra around stay the right way round.
    Careful,
}

impl Pull {
    /// The parts of the way that are tried.
    fn parts(self) -> &'static [f64] {
        match self {
            Self::Bold => &[1.0],
            Self::Half => &[0.5],
            Self::Careful => &[1.0, 0.5, 0.25],
        }
    }

    /// The next way to try when this one has failed.
    fn next(self) -> Option<Self> {
        match self {
            Self::Bold => Some(Self::Half),
            Self::Half => Some(Self::Careful),
            Self::Careful => None,
        }
    }
}

impl Fitting<'_> {
    /// Moves vertices to where the shape is farther than `bound` from the mesh, as far as no hexahedron gets bad, and
    /// holds them there while the others make way; and again, until the shape is near everywhere. If that cannot be
    /// had, all stay where they were. How far away the shape is then; 0 if it is near.
    pub(crate) fn limit_chord_error(
        &mut self,
        samples: &[Point],
        bound: f64,
        settings: &Settings,
        context: &Context,
    ) -> Result<f64> {
        let mut worst = self.soundness();
        if worst <= 0.0 {
            return Ok(f64::INFINITY);
        }
        context.check()?;
        let around = self.around();
        let faces = self.fitted.mesh.cells().boundary()?;
        let start = self.points().to_vec();
        let mut held = self.freedom.clone();
        let mut pull = Pull::Bold;
        let mut found = self.distant_points(&faces, samples, bound, context)?;
        let far = found.first().map_or(0.0, |g| g.distance);
        if far > TOO_FAR * bound {
            return Ok(far);
        }
        for round in 0..ROUNDS {
            let Some(farthest) = found.first().map(|g| g.distance).filter(|d| *d > bound) else { return Ok(0.0) };
            let [from, to] = [round, round + 1].map(|r| r as f64 / ROUNDS as f64);
            let before = (self.points().to_vec(), held.clone());
            self.pull_all(&found, ON * bound, pull, &around, &mut held);
            context.check()?;
            self.resize()?;
            self.run(&held, settings, &context.stage("fit", from, to))?;
            let left = self.distant_points(&faces, samples, bound, context)?;
            let reached = self.soundness();
            let enough = bound + LEFT * (farthest - bound);
            if left.first().is_none_or(|g| g.distance < enough) && reached > POOR.min(KEPT * worst) {
                worst = worst.max(reached);
                found = left;
                continue;
            }
            // Reached by hexahedra that are poor but not inverted, it is no better reached more gently.
            let is_vain = left.is_empty() && reached > 0.0;
            self.points_mut().copy_from_slice(&before.0);
            held = before.1;
            let Some(next) = pull.next().filter(|_| !is_vain) else { break };
            pull = next;
        }
        if found.first().is_none_or(|g| g.distance <= bound) {
            return Ok(0.0);
        }
        self.points_mut().copy_from_slice(&start);
        Ok(far)
    }

    pub(super) fn distant_points(
        &self,
        faces: &[Face],
        samples: &[Point],
        bound: f64,
        context: &Context,
    ) -> Result<Vec<DistantPoint>> {
        distant_points(
            (&*self.fitted.mesh, faces),
            (self.whole(), samples),
            NEARER * bound,
            &context.stage("fit", 0.0, 0.0),
        )
    }

    /// Pulls vertices to the distant points, the farthest first, and one only of a face and those around it.
    fn pull_all(&mut self, found: &[DistantPoint], tolerance: f64, pull: Pull, around: &Stars, held: &mut [Freedom]) {
        let mut taken = vec![false; held.len()];
        for distant in found {
            let corners = distant.face.vertices();
            if !corners.iter().any(|&v| taken[v as usize]) && self.pull(distant, tolerance, pull, around, held) {
                corners.iter().for_each(|&v| taken[v as usize] = true);
            }
        }
    }

    /// Moves one vertex of the face nearest to a distant point towards it, if one slides through it and may, and holds
    /// it. Whether one did.
    fn pull(
        &mut self,
        distant: &DistantPoint,
        tolerance: f64,
        pull: Pull,
        around: &Stars,
        held: &mut [Freedom],
    ) -> bool {
        let DistantPoint { at, face, .. } = distant;
        let mut corners: Vec<u32> = face.vertices().to_vec();
        let distance = |v: u32| (self.points()[v as usize] - at).norm();
        corners.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        let through = |v: u32| Some((v as usize, self.guide_through(v, at, tolerance)?));
        let Some((v, guide)) = corners.into_iter().find_map(through) else { return false };
        let (from, least) = (self.points()[v], KEPT_AROUND * self.worst_of(around.of(v)));
        for &part in pull.parts() {
            self.points_mut()[v] = guide.contact(&from.lerp(at, part)).point;
            if pull != Pull::Careful || self.worst_of(around.of(v)) > least {
                held[v] = Freedom::Fixed;
                return true;
            }
        }
        self.points_mut()[v] = from;
        false
    }

    /// The cells around each vertex.
    fn around(&self) -> Stars {
        let cells = self.fitted.mesh.cells();
        Stars::new(self.freedom.len(), (0..cells.len()).map(|cell| cells.cell(cell).iter().copied()))
    }

    fn worst_of(&self, cells: &[u32]) -> f64 {
        cells.iter().map(|&cell| self.soundness_of(cell as usize)).fold(1.0, f64::min)
    }
}
