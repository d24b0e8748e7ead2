//! Vertices held where a shape sticks out of its mesh.
//!
//! Left alone, the vertices around a bump on a facet or an edge slide down its sides, and it is cut off. The lattice as
//! it was mapped reaches it: from there, the nearest vertex is put on the top and stays there.

use super::chord_error::ON;
use super::distant_points::DistantPoint;
use super::fitting::{Fitting, elements};
use super::sliding::Hold;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::{Face, Point, Stars};
use crate::optimise::{Freedom, Settings};

/// How often more vertices are held.
const ROUNDS: usize = 3;
/// A round leaves no more than this part of the distance, or it failed.
const LEFT: f64 = 0.9;
/// The least soundness that the worst hexahedron may come down to, where it was not less before.
const SOUND: f64 = 0.3;

/// Vertices that are held in a place.
pub(crate) struct Anchors<'a> {
    /// Where vertices are before the mesh is optimised.
    start: &'a [Point],
    faces: &'a [Face],
    faces_at: Stars,
    /// The vertices that have faces.
    surface: Vec<u32>,
    held: Vec<(u32, Point)>,
    /// Vertices of faces that have a held one.
    taken: Vec<bool>,
}

impl<'a> Anchors<'a> {
    /// None yet, for a mesh with these boundary faces, which starts from these places.
    pub(crate) fn new(start: &'a [Point], faces: &'a [Face]) -> Self {
        let faces_at = Stars::new(start.len(), faces.iter().map(|f| f.vertices().iter().copied()));
        let surface = (0..start.len() as u32).filter(|&v| !faces_at.of(v as usize).is_empty()).collect();
        Self { start, faces, faces_at, surface, held: Vec::new(), taken: vec![false; start.len()] }
    }

    /// Holds, for the distant points of the shape, farthest first, the vertex that starts nearest, unless one is held
    /// beside it, it starts no nearer than the mesh came, or would have to leave a crease. How many were added.
    pub(crate) fn add(&mut self, fitting: &Fitting, found: &[DistantPoint], tolerance: f64) -> usize {
        let before = self.held.len();
        for distant in found {
            let Some(v) = self.nearest(&distant.at) else { continue };
            let (from, carrier) = (self.start[v as usize], fitting.fitted.carriers[v as usize]);
            let may =
                fitting.guide_through(v, &distant.at, tolerance).is_some() || fitting.sliding.is_smooth(carrier, &from);
            if self.taken[v as usize] || (from - distant.at).norm() >= distant.distance || !may {
                continue;
            }
            self.held.push((v, distant.at));
            for &f in self.faces_at.of(v as usize) {
                self.faces[f as usize].vertices().iter().for_each(|&u| self.taken[u as usize] = true);
            }
        }
        self.held.len() - before
    }

    fn nearest(&self, at: &Point) -> Option<u32> {
        let distance = |v: u32| (self.start[v as usize] - at).norm_squared();
        self.surface.iter().copied().min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
    }

    /// Puts the held vertices in their places and keeps them there.
    pub(crate) fn hold(&self, points: &mut [Point], freedom: &mut [Freedom]) {
        for &(v, at) in &self.held {
            points[v as usize] = at;
            freedom[v as usize] = Freedom::Fixed;
        }
    }
}

impl Fitting<'_> {
    /// Makes the mesh anew from where its vertices were at the `start`, with vertices held on what sticks out of it, as
    /// long as that brings the shape nearer, which is `far` away, and no hexahedron becomes bad. How far away it is
    /// then; 0 if it is within `bound`.
    pub(super) fn anchor(
        &mut self,
        start: &[Point],
        (samples, bound): (&[Point], f64),
        mut far: f64,
        settings: &Settings,
        context: &Context,
    ) -> Result<f64> {
        let faces = self.fitted.mesh.cells().boundary()?;
        let mut anchors = Anchors::new(start, &faces);
        for round in 0..ROUNDS {
            let [from, to] = [round, round + 1].map(|r| r as f64 / ROUNDS as f64);
            let context = context.stage("fit", from, to);
            let worst = self.soundness();
            if far == 0.0 || worst <= 0.0 {
                break;
            }
            let found = self.distant_points(&faces, samples, bound, &context)?;
            let before = (self.points().to_vec(), self.freedom.clone(), self.released);
            if anchors.add(self, &found, ON * bound) == 0 {
                break;
            }
            self.start_again(start, &anchors, samples, settings, &context)?;
            let left = self.limit_chord_error(samples, bound, settings, &context)?;
            if left > LEFT * far || self.soundness() < SOUND.min(worst) {
                self.points_mut().copy_from_slice(&before.0);
                (self.freedom, self.released) = (before.1, before.2);
                break;
            }
            far = left;
        }
        Ok(far)
    }

    /// Optimises the mesh from the start, inside first.
    fn start_again(
        &mut self,
        start: &[Point],
        anchors: &Anchors,
        samples: &[Point],
        settings: &Settings,
        context: &Context,
    ) -> Result<()> {
        self.freedom = self.sliding.freedoms(self.fitted.carriers, Hold::Corners);
        self.released = 0;
        self.points_mut().copy_from_slice(start);
        anchors.hold(self.fitted.mesh.points_mut(), &mut self.freedom);
        self.elements = elements(&self.fitted, self.sliding, self.points(), true)?;
        let inside = self.sliding.freedoms(self.fitted.carriers, Hold::Surface);
        let untangling = Settings { improve_rounds: 0, polish_rounds: 0, ..settings.clone() };
        self.run(&inside, &untangling, context)?;
        self.run(&self.freedom.clone(), &untangling, context)?;
        self.passes(samples, settings, context)
    }
}
