//! A hexahedral mesh on the way to be improved, with its surface on that of the shape.

use super::sliding::Sliding;
use crate::context::Context;
use crate::error::Result;
use crate::measure::soundness;
use crate::mesh::Point;
use crate::optimise::{Elements, Freedom, Guide, Settings, optimise};
use crate::remesh::lattice::Carrier;
use crate::remesh::mesher::Hexes;
use rayon::prelude::*;

/// How often the sizes that hexahedra should have are averaged with those around.
pub(crate) const SMOOTHING: usize = 3;
/// A trial with more than this part of its hexahedra inverted leads to nothing.
const HOPELESS: f64 = 0.01;
/// Hexahedra less sound than this may have vertices released where the shape is smooth.
pub(crate) const POOR: f64 = 0.6;

/// A mesh on the way to be improved.
pub(crate) struct Fitting<'a> {
    pub(crate) elements: Elements,
    pub(crate) guides: Vec<&'a dyn Guide>,
    pub(crate) sliding: &'a Sliding,
    pub(crate) hexes: &'a mut Hexes,
    pub(crate) freedom: Vec<Freedom>,
    pub(crate) released: usize,
}

impl<'a> Fitting<'a> {
    /// Whether many hexahedra are inverted.
    pub(crate) fn is_hopeless(&self) -> bool {
        self.hexes.quality().inverted as f64 > HOPELESS * self.hexes.cells().len() as f64
    }

    /// Puts every surface vertex on what it slides on.
    pub(crate) fn project(&mut self) {
        let guides = &self.guides;
        let each = self.hexes.mesh.points_mut().par_iter_mut().zip(&self.freedom).with_min_len(256);
        each.for_each(|(point, freedom)| {
            if let Freedom::Guided(g) = freedom {
                *point = guides[*g as usize].contact(point).point;
            }
        });
    }

    /// What a vertex slides on, if that passes no farther from a point than `tolerance`.
    pub(crate) fn guide_through(&self, v: u32, at: &Point, tolerance: f64) -> Option<&'a dyn Guide> {
        let Freedom::Guided(g) = self.freedom[v as usize] else { return None };
        Some(self.guides[g as usize]).filter(|g| (g.contact(at).point - at).norm() <= tolerance)
    }

    /// One optimisation; how many hexahedra are inverted after it.
    pub(crate) fn run(&mut self, freedom: &[Freedom], settings: &Settings, context: &Context) -> Result<usize> {
        let points = self.hexes.mesh.points_mut();
        Ok(optimise(points, &self.elements, freedom, &self.guides, settings, context)?.inverted_after)
    }

    /// Lets vertices of hexahedra whose soundness is `bar` or less slide on all of the surface, where `may` agrees.
    pub(crate) fn release(&mut self, bar: f64, may: impl Fn(&Sliding, Carrier, &Point) -> bool) {
        let Hexes { mesh, carriers, .. } = &*self.hexes;
        let mean = self.elements.mean_determinant();
        let bad = self.hexes.cells().iter().filter(|c| soundness(mesh.points(), c, mean) <= bar);
        for v in bad.flatten().map(|&v| v as usize) {
            let bound = matches!(carriers[v], Carrier::Corner(_) | Carrier::Edge(_));
            let free = self.freedom[v] == self.sliding.released();
            if bound && !free && may(self.sliding, carriers[v], &mesh.points()[v]) {
                self.freedom[v] = self.sliding.released();
                self.released += 1;
            }
        }
    }

    /// All of the shape's surface.
    pub(crate) fn whole(&self) -> &dyn Guide {
        self.sliding.whole()
    }

    /// Asks for boxes of the sizes that the hexahedra have by now.
    pub(crate) fn resize(&mut self) -> Result<()> {
        let (cells, points) = (self.hexes.cells(), self.hexes.mesh.points());
        // What is tangled is best untangled towards what it is; only then it makes sense to ask for fair sizes.
        let tangled = self.hexes.quality().inverted > 0;
        let like = if tangled { Elements::boxes_like } else { Elements::fair_boxes_like };
        self.elements = like(cells, points, SMOOTHING)?;
        Ok(())
    }
}
