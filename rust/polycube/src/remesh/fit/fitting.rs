//! A mesh on the way to be improved, with its surface on that of the shape.

use super::sliding::{Hold, Sliding};
use crate::context::Context;
use crate::error::Result;
use crate::measure::{ACCEPTED, mean_determinant, soundness};
use crate::mesh::{Cells, Mesh, Point};
use crate::optimise::{Elements, Freedom, Guide, Settings, optimise};
use crate::remesh::lattice::Carrier;
use rayon::prelude::*;

/// How often the sizes that cells should have are averaged with those around.
pub(crate) const SMOOTHING: usize = 3;
/// A trial with more than this part of its cells inverted leads to nothing.
const HOPELESS: f64 = 0.01;
/// Cells less sound than this may have vertices released where the shape is smooth.
pub(crate) const POOR: f64 = 0.6;

/// What is made to fit: hexahedra, or the quadrilaterals of a surface alone.
pub(crate) struct Fitted<'a> {
    pub(crate) mesh: &'a mut Mesh,
    /// What each vertex lies on.
    pub(crate) carriers: &'a [Carrier],
    /// The facet of each quadrilateral; none of hexahedra.
    pub(crate) facets: &'a [u32],
}

/// A mesh on the way to be improved.
pub(crate) struct Fitting<'a> {
    pub(crate) elements: Elements,
    pub(crate) guides: Vec<&'a dyn Guide>,
    pub(crate) sliding: &'a Sliding,
    pub(crate) fitted: Fitted<'a>,
    pub(crate) freedom: Vec<Freedom>,
    pub(crate) released: usize,
    /// How near springs keep it to the shape, if they do.
    pub(crate) kept: Option<f64>,
}

impl<'a> Fitting<'a> {
    /// Before anything is done to it.
    pub(crate) fn new(fitted: Fitted<'a>, sliding: &'a Sliding) -> Result<Self> {
        let elements = elements(&fitted, sliding, fitted.mesh.points(), true)?;
        let freedom = sliding.freedoms(fitted.carriers, Hold::Corners);
        Ok(Self { elements, guides: sliding.guides(), sliding, fitted, freedom, released: 0, kept: None })
    }

    /// Back to where its vertices were at the `start`, to cells of the sizes there, or fair ones.
    pub(crate) fn reset(&mut self, start: &[Point], is_fair: bool) -> Result<()> {
        self.freedom = self.sliding.freedoms(self.fitted.carriers, Hold::Corners);
        self.released = 0;
        self.points_mut().copy_from_slice(start);
        self.elements = elements(&self.fitted, self.sliding, start, is_fair)?;
        Ok(())
    }

    pub(crate) fn points(&self) -> &[Point] {
        self.fitted.mesh.points()
    }

    pub(crate) fn points_mut(&mut self) -> &mut [Point] {
        self.fitted.mesh.points_mut()
    }

    /// How sound a cell is.
    pub(crate) fn soundness_of(&self, cell: usize) -> f64 {
        self.elements.soundness(cell, self.points(), &ACCEPTED)
    }

    /// How many cells are inverted.
    pub(crate) fn inverted(&self) -> usize {
        (0..self.fitted.mesh.cells().len()).filter(|&cell| self.soundness_of(cell) <= 0.0).count()
    }

    /// How sound the worst cell is.
    pub(crate) fn soundness(&self) -> f64 {
        let (points, cells) = (self.points(), self.fitted.mesh.cells());
        match cells {
            Cells::Hexahedra(hexes) => {
                let mean = mean_determinant(points, hexes);
                hexes.iter().map(|hex| soundness(points, hex, mean)).fold(1.0, f64::min)
            }
            _ => (0..cells.len()).map(|cell| self.soundness_of(cell)).fold(1.0, f64::min),
        }
    }

    /// Whether many cells are inverted.
    pub(crate) fn is_hopeless(&self) -> bool {
        self.inverted() as f64 > HOPELESS * self.fitted.mesh.cells().len() as f64
    }

    /// Puts every surface vertex on what it slides on.
    pub(crate) fn project(&mut self) {
        let guides = &self.guides;
        let each = self.fitted.mesh.points_mut().par_iter_mut().zip(&self.freedom).with_min_len(256);
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

    /// One optimisation; how many cells are inverted after it.
    pub(crate) fn run(&mut self, freedom: &[Freedom], settings: &Settings, context: &Context) -> Result<usize> {
        let points = self.fitted.mesh.points_mut();
        Ok(optimise(points, &self.elements, freedom, &self.guides, settings, context)?.inverted_after)
    }

    /// Lets vertices of cells whose soundness is `bar` or less slide on all of the surface, where `may` agrees.
    pub(crate) fn release(&mut self, bar: f64, may: impl Fn(&Sliding, Carrier, &Point) -> bool) {
        let Fitted { mesh, carriers, .. } = &self.fitted;
        let bad = (0..mesh.cells().len()).filter(|&cell| self.soundness_of(cell) <= bar);
        let vertices: Vec<u32> = bad.flat_map(|cell| mesh.cells().cell(cell).iter().copied()).collect();
        for v in vertices.into_iter().map(|v| v as usize) {
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

    /// Asks for cells of the sizes that they have by now.
    pub(crate) fn resize(&mut self) -> Result<()> {
        // What is tangled is best untangled towards what it is; only then it makes sense to ask for fair sizes.
        self.elements = elements(&self.fitted, self.sliding, self.points(), self.inverted() == 0)?;
        Ok(())
    }
}

/// What the cells should look like: boxes or rectangles of the sizes they have in `points`, but, where it `is_fair`,
/// none that is thin.
pub(crate) fn elements(fitted: &Fitted, sliding: &Sliding, points: &[Point], is_fair: bool) -> Result<Elements> {
    match fitted.mesh.cells() {
        Cells::Hexahedra(hexes) if is_fair => Elements::fair_boxes_like(hexes, points, SMOOTHING),
        Cells::Hexahedra(hexes) => Elements::boxes_like(hexes, points, SMOOTHING),
        Cells::Quads(quads) => {
            let normals: Vec<_> =
                quads.iter().zip(fitted.facets).map(|(quad, &facet)| sliding.normal(facet, quad, points)).collect();
            Elements::rectangles_like(quads, points, &normals, SMOOTHING, is_fair)
        }
        _ => Ok(Elements::regular_tetrahedra(&[])),
    }
}
