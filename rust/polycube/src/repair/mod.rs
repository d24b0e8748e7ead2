//! Repairs of an input where there is one right answer: what other tools write that differs from a polycube in how it
//! is stored, not in what it is. Vertices keep their numbers.

mod orient;
mod surplus;
mod weld;
mod winding;

use crate::input::Input;
use crate::mesh::{Cells, Face, Mesh, Point};
use std::collections::HashMap;
use std::fmt;

/// What was done to an input. Written, for people and in reports, as a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, bitcode::Encode, bitcode::Decode)]
pub enum Repair {
    /// So many vertices gave way to others at the same place.
    Welded(usize),
    /// So many cells that were there before were left out.
    Duplicates(usize),
    /// So many faces inside the solid, which other faces enclose, were left out.
    InnerFaces(usize),
    /// So many cells of a volume that were numbered left-handed were turned.
    TurnedCells(usize),
    /// So many faces of a surface that looked inward, or against their neighbours, were turned.
    TurnedFaces(usize),
    /// So many labels were turned to the side that their faces now look to.
    TurnedLabels(usize),
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Welded(n) => write!(f, "repaired: {n} vertices at the place of others were welded to them"),
            Self::Duplicates(n) => write!(f, "repaired: {n} cells that were there before were left out"),
            Self::InnerFaces(n) => write!(f, "repaired: {n} faces inside the solid were left out"),
            Self::TurnedCells(n) => write!(f, "repaired: {n} cells that were numbered left-handed were turned"),
            Self::TurnedFaces(n) => write!(f, "repaired: {n} faces were turned to look outward"),
            Self::TurnedLabels(n) => write!(f, "repaired: {n} labels were turned to the side that their faces look to"),
        }
    }
}

impl serde::Serialize for Repair {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// An input after repairs.
#[derive(Clone, Debug)]
pub struct Repaired {
    /// The polycube; its vertices have the numbers that they had.
    pub polycube: Mesh,
    /// The shape, if there was one.
    pub shape: Option<Mesh>,
    /// The labels of the boundary faces, if there were any.
    pub labels: Option<Vec<i8>>,
    /// What was done, in the order in which it was.
    pub repairs: Vec<Repair>,
}

impl Repaired {
    /// What was done, if anything was.
    pub(crate) fn repairs(repaired: &Option<Self>) -> &[Repair] {
        repaired.as_ref().map_or(&[], |repaired| &repaired.repairs)
    }

    /// What there is now to be simplified.
    pub fn input(&self) -> Input<'_> {
        Input { polycube: &self.polycube, shape: self.shape.as_ref(), labels: self.labels.as_deref() }
    }
}

/// Repairs what has one right answer; nothing where there is nothing to repair, or where shape and labels do not go
/// with the polycube. O(n log n) for n cells.
///
/// - cells of a volume that are numbered left-handed, some or all, are mirrored;
/// - vertices at one place are welded where that closes a surface or joins cells;
/// - faces that are there twice, and those inside a solid that is closed without them, are left out;
/// - faces of a surface that look inward, or against their neighbours, are turned, and labels with them where they
///   went with the side that the faces looked to.
pub fn repair(input: &Input) -> Option<Repaired> {
    let mut work = Work::new(input)?;
    work.weld();
    work.leave_out_duplicates();
    if work.cells.is_volume() {
        work.turn_cells();
    } else {
        work.leave_out_inner_faces();
        work.turn_faces();
    }
    work.finish()
}

/// An input under repair.
struct Work<'a> {
    points: &'a [Point],
    shape: Option<&'a [Point]>,
    cells: Cells,
    labels: Option<Vec<i8>>,
    repairs: Vec<Repair>,
}

impl<'a> Work<'a> {
    fn new(input: &Input<'a>) -> Option<Self> {
        let cells = input.polycube.cells();
        let points = input.polycube.points();
        let fits = input.shape.is_none_or(|s| s.cells() == cells && s.points().len() == points.len());
        let faces = input.labels.map_or(0, <[i8]>::len);
        let labelled = input.labels.is_none() || cells.boundary().is_ok_and(|b| b.len() == faces);
        (fits && labelled && !cells.is_empty()).then(|| Self {
            points,
            shape: input.shape.map(Mesh::points),
            cells: cells.clone(),
            labels: input.labels.map(<[i8]>::to_vec),
            repairs: Vec::new(),
        })
    }

    /// Takes `cells` for those there were, with the labels of the boundary faces that stay.
    fn replace(&mut self, cells: Cells, vertex: impl Fn(u32) -> u32) {
        if let Some(labels) = &mut self.labels {
            let mut known: HashMap<[u32; 4], i8> = HashMap::new();
            for (face, &label) in self.cells.boundary().iter().flatten().zip(&*labels) {
                known.entry(key(face.vertices(), &vertex)).or_insert(label);
            }
            let own = |f: &Face| known.get(&key(f.vertices(), |v| v)).copied().unwrap_or(-1);
            *labels = cells.boundary().map(|faces| faces.iter().map(own).collect()).unwrap_or_default();
        }
        self.cells = cells;
    }

    fn finish(self) -> Option<Repaired> {
        if self.repairs.is_empty() {
            return None;
        }
        let mesh = |points: &[Point]| Mesh::new(points.to_vec(), self.cells.clone()).ok();
        let shape = match self.shape {
            Some(points) => Some(mesh(points)?),
            None => None,
        };
        Some(Repaired { polycube: mesh(self.points)?, shape, labels: self.labels, repairs: self.repairs })
    }
}

/// The vertices of a face, as they are renumbered, in ascending order.
fn key(corners: &[u32], vertex: impl Fn(u32) -> u32) -> [u32; 4] {
    let mut key = [u32::MAX; 4];
    key.iter_mut().zip(corners).for_each(|(k, &v)| *k = vertex(v));
    key.sort_unstable();
    key
}

#[cfg(test)]
mod tests;
