//! Sums the energy over all elements on all threads, in an order that does not depend on their number.
//!
//! Elements are cut into chunks of fixed size. Each chunk gathers its gradient over its own vertices, and then each
//! vertex sums up its chunks in order.

use super::elements::{Elements, Reference};
use super::energy::Law;
use super::lanes::{LANES, Lanes, Vectors, three};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Elements per chunk: a fraction of a millisecond's work, with local gradients in the first cache.
const CHUNK: usize = 1024;

struct Chunk {
    vertices: Vec<u32>,
    corners: Vec<[u16; 4]>,
    gradient: Vec<Vector3<f64>>,
    energy: f64,
}

/// Elements over chunks. About 150 bytes an element, all told.
pub(super) struct Assembly<'a> {
    elements: &'a Elements,
    chunks: Vec<Chunk>,
    /// Of each vertex, the range in `slots`.
    starts: Vec<u32>,
    /// Chunk and place of a vertex in it.
    slots: Vec<(u32, u16)>,
}

/// The state of all elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Census {
    /// Cells with an element of no positive quality.
    pub(super) inverted: usize,
    /// The worst quality; 1 for no element.
    pub(super) worst: f64,
    /// Smallest `det J`; infinite for no element.
    pub(super) least: f64,
    /// Mean over the cells of the worst quality of each; 1 for no cell.
    pub(super) average: f64,
    /// How bad the energy of the springs is, against the worst quality; 0 without any.
    pub(super) tension: f64,
}

/// The state of no element.
const NOTHING: Census = Census { inverted: 0, worst: 1.0, least: f64::INFINITY, average: 0.0, tension: 0.0 };

impl<'a> Assembly<'a> {
    /// For elements over `count` vertices. Linear time.
    pub(super) fn new(elements: &'a Elements, count: usize) -> Self {
        let mut local = vec![(u32::MAX, 0_u16); count];
        let chunks: Vec<Chunk> =
            elements.corners.chunks(CHUNK).enumerate().map(|(i, c)| chunk(i as u32, c, &mut local)).collect();
        let (starts, slots) = slots(&chunks, count);
        Self { elements, chunks, starts, slots }
    }

    /// The energy at `points`, and its gradient; 0 where the energy is infinite.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled), within a chunk's time.
    pub(super) fn evaluate(
        &mut self,
        points: &[Point],
        law: &Law,
        gradient: &mut [Vector3<f64>],
        context: &Context,
    ) -> Result<f64> {
        let elements = self.elements;
        let infinite = AtomicBool::new(false);
        self.chunks.par_iter_mut().enumerate().for_each(|(i, chunk)| {
            let over = infinite.load(Relaxed) || context.is_cancelled();
            if !(over || chunk.evaluate(elements, i * CHUNK, points, law)) {
                infinite.store(true, Relaxed);
            }
        });
        context.check()?;
        if infinite.into_inner() {
            gradient.fill(Vector3::zeros());
            return Ok(f64::INFINITY);
        }
        let (chunks, starts, slots) = (&self.chunks, &self.starts, &self.slots);
        gradient.par_iter_mut().enumerate().with_min_len(1024).for_each(|(v, g)| {
            let range = starts[v] as usize..starts[v + 1] as usize;
            *g = slots[range].iter().map(|&(c, i)| chunks[c as usize].gradient[usize::from(i)]).sum();
        });
        let energy: f64 = self.chunks.iter().map(|c| c.energy).sum();
        Ok(energy + elements.springs.pull(points, gradient))
    }

    /// The quality at `points`.
    pub(super) fn census(&self, points: &[Point]) -> Census {
        let cells = self.elements.cells();
        let per_chunk = CHUNK / self.elements.per_cell;
        let chunks = (0..cells.div_ceil(per_chunk)).into_par_iter();
        let part = |i: usize| self.part(points, i * per_chunk..((i + 1) * per_chunk).min(cells));
        let parts: Vec<Census> = chunks.map(part).collect();
        let mut all = Census { tension: self.elements.springs.tension(points), ..NOTHING };
        for part in parts {
            all.inverted += part.inverted;
            all.worst = all.worst.min(part.worst);
            all.least = all.least.min(part.least);
            all.average += part.average / cells as f64;
        }
        Census { average: if cells == 0 { 1.0 } else { all.average }, ..all }
    }

    /// Cells with an element of no positive quality.
    pub(super) fn inverted(&self, points: &[Point]) -> Vec<usize> {
        let cells = self.elements.cells();
        let bad = |&cell: &usize| self.part(points, cell..cell + 1).inverted > 0;
        (0..cells).into_par_iter().with_min_len(CHUNK / self.elements.per_cell).filter(bad).collect()
    }

    /// The census of some cells, with the sum for the average.
    fn part(&self, points: &[Point], cells: std::ops::Range<usize>) -> Census {
        let mut census = NOTHING;
        for cell in cells {
            let mut worst = 1.0_f64;
            for e in self.elements_of(cell) {
                // `min` passes over NaN, which is as bad as can be.
                let quality = self.elements.quality(e, points);
                worst = if quality.is_nan() { -1.0 } else { worst.min(quality) };
                census.least = census.least.min(self.elements.det(e, points));
            }
            census.inverted += usize::from(worst <= 0.0);
            census.worst = census.worst.min(worst);
            census.average += worst;
        }
        census
    }

    fn elements_of(&self, cell: usize) -> std::ops::Range<usize> {
        cell * self.elements.per_cell..(cell + 1) * self.elements.per_cell
    }
}

fn chunk(index: u32, corners: &[[u32; 4]], local: &mut [(u32, u16)]) -> Chunk {
    let mut vertices = Vec::new();
    let mut number = |v: u32| {
        let place = &mut local[v as usize];
        if place.0 != index {
            *place = (index, vertices.len() as u16);
            vertices.push(v);
        }
        place.1
    };
    let corners = corners.iter().map(|c| c.map(&mut number)).collect();
    let gradient = vec![Vector3::zeros(); vertices.len()];
    Chunk { vertices, corners, gradient, energy: 0.0 }
}

impl Chunk {
    /// Sums up the energies and the forces on the vertices. Returns whether the energy is finite; if not, there is no
    /// sum.
    fn evaluate(&mut self, elements: &Elements, first: usize, points: &[Point], law: &Law) -> bool {
        self.energy = 0.0;
        self.gradient.fill(Vector3::zeros());
        for (i, corners) in self.corners.chunks(LANES).enumerate() {
            let side = Side::new(elements, first + i * LANES, corners.len());
            let Some((energy, slopes)) = law.value(elements.measure, &side.edges(points), &side.reference()) else {
                return false;
            };
            let weight = side.weight();
            (0..corners.len()).for_each(|lane| self.energy += weight.0[lane] * energy.0[lane]);
            let forces = three(|k| three(|axis| slopes[k][axis] * weight));
            for (lane, &[o, a, b, c]) in corners.iter().enumerate() {
                let on = three(|k| Vector3::from(three(|axis| forces[k][axis].0[lane])));
                self.gradient[usize::from(a)] += on[0];
                self.gradient[usize::from(b)] += on[1];
                self.gradient[usize::from(c)] += on[2];
                self.gradient[usize::from(o)] -= on[0] + on[1] + on[2];
            }
        }
        true
    }
}

/// Elements side by side; where there are too few, the last one fills up.
struct Side<'a> {
    elements: &'a Elements,
    at: [usize; LANES],
}

impl<'a> Side<'a> {
    #[inline(always)]
    fn new(elements: &'a Elements, first: usize, count: usize) -> Self {
        Self { elements, at: std::array::from_fn(|lane| first + lane.min(count - 1)) }
    }

    #[inline(always)]
    fn edges(&self, points: &[Point]) -> [Vectors; 3] {
        let point = |k: usize| -> Vectors {
            let at = |lane: usize| &points[self.elements.corners[self.at[lane]][k] as usize];
            three(|axis| Lanes::each(|lane| at(lane)[axis]))
        };
        let origin = point(0);
        let mut edges = three(|k| {
            let end = point(k + 1);
            three(|axis| end[axis] - origin[axis])
        });
        if !self.elements.offsets.is_empty() {
            let offset = |lane: usize| &self.elements.offsets[self.at[lane]];
            edges[2] = three(|axis| edges[2][axis] + Lanes::each(|lane| offset(lane)[axis]));
        }
        edges
    }

    #[inline(always)]
    fn reference(&self) -> Reference<Lanes> {
        let of = |lane: usize| &self.elements.references[self.at[lane]];
        let entry = |k: usize| Lanes::each(|lane| of(lane).metric[k]);
        let metric = [entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)];
        Reference { metric, det: Lanes::each(|lane| of(lane).det) }
    }

    #[inline(always)]
    fn weight(&self) -> Lanes {
        Lanes::each(|lane| self.elements.weights[self.at[lane]])
    }
}

fn slots(chunks: &[Chunk], count: usize) -> (Vec<u32>, Vec<(u32, u16)>) {
    let mut starts = vec![0_u32; count + 1];
    chunks.iter().flat_map(|c| &c.vertices).for_each(|v| starts[*v as usize + 1] += 1);
    (0..count).for_each(|v| starts[v + 1] += starts[v]);
    let mut next = starts.clone();
    let mut slots = vec![(0, 0); starts[count] as usize];
    for (c, chunk) in chunks.iter().enumerate() {
        for (i, v) in chunk.vertices.iter().enumerate() {
            slots[next[*v as usize] as usize] = (c as u32, i as u16);
            next[*v as usize] += 1;
        }
    }
    (starts, slots)
}
