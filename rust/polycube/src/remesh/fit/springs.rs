//! Springs that keep a mesh on what sticks out of a shape.
//!
//! Vertices that slide may leave a bump for better cells. The faces over it are then held near the planes that touch
//! the shape there: across these a face moves against a spring, along them it is free.

use super::fitting::Fitting;
use crate::error::Result;
use crate::mesh::{Face, Point};
use crate::optimise::{Spring, Tangent};
use crate::spatial::Nearest;
use rayon::prelude::*;

/// The energy of the springs of a face at a distance of one bound beyond their slack.
const STIFFNESS: f64 = 40.0;
/// The part of the bound up to which nothing pulls.
const SLACK: f64 = 0.5;

impl Fitting<'_> {
    /// Fastens springs from the nearest places of the mesh to the `samples` of the shape, and from the middles of its
    /// faces to the shape, which pull where these come farther apart than about the `bound`. O(n log n).
    pub(super) fn fasten(&mut self, samples: &[Point], bound: f64) -> Result<()> {
        let faces = self.fitted.mesh.cells().boundary()?;
        let mut fastened = self.at_samples(&faces, samples);
        fastened.par_extend(faces.par_iter().enumerate().filter_map(|(i, face)| Some((i, self.at_middle(face)?))));
        let mut count = vec![0_u32; faces.len()];
        fastened.iter().for_each(|(face, _)| count[*face] += 1);
        let slack = SLACK * bound;
        let stiffness = |face: usize| STIFFNESS / (bound * bound * f64::from(count[face]));
        let springs = fastened.into_iter().map(|(face, s)| Spring { slack, stiffness: stiffness(face), ..s }).collect();
        self.elements.fasten(springs, self.fitted.mesh.points(), STIFFNESS);
        Ok(())
    }

    /// For each sample the face that is nearest, and a spring from there.
    fn at_samples(&self, faces: &[Face], samples: &[Point]) -> Vec<(usize, Spring)> {
        let points = self.points();
        let pieces: Vec<_> = faces.iter().enumerate().flat_map(|(i, f)| f.triangles().map(move |t| (i, t))).collect();
        let index = Nearest::new(pieces.iter().map(|(_, t)| t.map(|v| points[v as usize])));
        let fastened = |at: &Point| {
            let foot = index.foot(at)?;
            let (face, [a, b, c]) = pieces[foot.index];
            let [x, y, z] = foot.weights;
            Some((face, self.spring([a, b, c, c], [x, y, z, 0.0], at)?))
        };
        samples.par_iter().filter_map(fastened).collect()
    }

    fn at_middle(&self, face: &Face) -> Option<Spring> {
        let corners = face.vertices();
        let vertices = [0, 1, 2, 3].map(|k| corners[k % corners.len()]);
        let weights = [0, 1, 2, 3].map(|k| if k < corners.len() { 1.0 / corners.len() as f64 } else { 0.0 });
        self.spring(vertices, weights, &self.whole().contact(&face.middle(self.points())).point)
    }

    /// A spring to the plane that touches the shape at a point of it.
    fn spring(&self, vertices: [u32; 4], weights: [f64; 4], at: &Point) -> Option<Spring> {
        let Tangent::Plane(normal) = self.whole().contact(at).tangent else { return None };
        Some(Spring { vertices, weights, at: *at, normal, slack: 0.0, stiffness: 0.0 })
    }
}
