//! How each vertex may move.

use super::guide::{Guide, Tangent};
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Point;
use nalgebra::Vector3;
use rayon::prelude::*;

/// How a vertex may move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Freedom {
    /// Anywhere.
    #[default]
    Free,
    /// Keeps, to the bit, the coordinates whose entry is true: on a polycube 3 at corners, 2 on edges, 1 on facets.
    Axes([bool; 3]),
    /// Nowhere.
    Fixed,
    /// Slides on the guide of this index.
    Guided(u32),
}

/// The movements left at the present positions.
pub(super) struct Constraints<'a> {
    pub(super) freedom: &'a [Freedom],
    pub(super) guides: &'a [&'a dyn Guide],
    tangents: Vec<Tangent>,
}

impl<'a> Constraints<'a> {
    /// # Errors
    /// [`ErrorKind::Option`] naming the vertex whose guide does not exist.
    pub(super) fn new(freedom: &'a [Freedom], guides: &'a [&'a dyn Guide]) -> Result<Self> {
        let missing = |f: &Freedom| matches!(f, Freedom::Guided(g) if *g as usize >= guides.len());
        if let Some(i) = freedom.iter().position(missing) {
            let message = format!("its guide is not among the {} given", guides.len());
            return Err(Error::new(ErrorKind::Option, message).at(Place::Vertex(i as u32)));
        }
        Ok(Self { freedom, guides, tangents: vec![Tangent::Point; freedom.len()] })
    }

    /// The guide of a vertex, if it has one.
    fn guide(&self, vertex: usize) -> Option<&'a dyn Guide> {
        match self.freedom[vertex] {
            Freedom::Guided(g) => Some(self.guides[g as usize]),
            _ => None,
        }
    }

    /// Puts every sliding vertex on its guide and lets it slide along the tangent there.
    pub(super) fn project(&mut self, points: &mut [Point]) {
        let (freedom, guides) = (self.freedom, self.guides);
        let each = points.par_iter_mut().zip(&mut self.tangents).zip(freedom).with_min_len(256);
        each.for_each(|((point, tangent), freedom)| {
            if let Freedom::Guided(g) = freedom {
                let contact = guides[*g as usize].contact(point);
                (*point, *tangent) = (contact.point, contact.tangent);
            }
        });
    }

    /// `point` as the vertex may have it: on its guide.
    pub(super) fn placed(&self, vertex: usize, point: Point) -> Point {
        self.guide(vertex).map_or(point, |g| g.contact(&point).point)
    }

    /// The same, and the vertex slides along the tangent there from now on.
    pub(super) fn place(&mut self, vertex: usize, point: Point) -> Point {
        let Some(contact) = self.guide(vertex).map(|g| g.contact(&point)) else { return point };
        self.tangents[vertex] = contact.tangent;
        contact.point
    }

    /// The part of `step` that the vertex may take.
    pub(super) fn allowed(&self, vertex: usize, step: Vector3<f64>) -> Vector3<f64> {
        match (self.freedom[vertex], self.tangents[vertex]) {
            (Freedom::Free, _) => step,
            (Freedom::Axes(fixed), _) => Vector3::from([0, 1, 2].map(|a| if fixed[a] { 0.0 } else { step[a] })),
            (Freedom::Guided(_), Tangent::Plane(n)) => step - n * n.dot(&step),
            (Freedom::Guided(_), Tangent::Line(t)) => t * t.dot(&step),
            _ => Vector3::zeros(),
        }
    }

    /// Leaves of each vertex's gradient what it may follow.
    pub(super) fn restrict(&self, gradient: &mut [Vector3<f64>]) {
        let each = gradient.par_iter_mut().enumerate().with_min_len(4096);
        each.for_each(|(v, g)| *g = self.allowed(v, *g));
    }

    /// Whether a vertex can move at all.
    pub(super) fn moves(&self, vertex: usize) -> bool {
        !matches!(self.freedom[vertex], Freedom::Fixed | Freedom::Axes([true, true, true]))
    }

    /// Gives fixed coordinates the bits they had in `from` (adding 0 turns −0 into 0).
    pub(super) fn restore(&self, points: &mut [Point], from: &[Point]) {
        for ((point, from), freedom) in points.iter_mut().zip(from).zip(self.freedom) {
            let fixed = match freedom {
                Freedom::Axes(fixed) => *fixed,
                Freedom::Fixed => [true; 3],
                _ => [false; 3],
            };
            (0..3).filter(|a| fixed[*a]).for_each(|a| point[a] = from[a]);
        }
    }
}
