//! Vertices at one place.

use super::{Repair, Work};
use crate::mesh::{Cells, Point};
use crate::structure::{Surface, Violation};
use nalgebra::Vector3;

/// Vertices nearer to each other than this part of the size are at one place.
const NEAR: f64 = 1e-9;

impl Work<'_> {
    /// Welds vertices that lie at one place in the polycube, and in the shape, where that closes a surface or joins
    /// cells of a volume.
    pub(super) fn weld(&mut self) {
        let open = open_edges(&self.cells, self.points.len());
        let candidates: Vec<u32> = match open {
            Some(ends) if ends.is_empty() => return,
            Some(ends) => ends,
            None => used(&self.cells, self.points.len()),
        };
        let first = self.first_at_place(candidates);
        let welded = (0..).zip(&first).filter(|(v, first)| v != *first).count();
        if welded == 0 {
            return;
        }
        let cells = renumbered(&self.cells, &first);
        if is_better(&self.cells, &cells, self.points.len()) {
            self.replace(cells, |v| first[v as usize]);
            self.repairs.push(Repair::Welded(welded));
        }
    }

    /// For each vertex the first of `candidates` at its place; itself where there is none. O(n log n).
    fn first_at_place(&self, mut candidates: Vec<u32>) -> Vec<u32> {
        let mut first: Vec<u32> = (0..self.points.len() as u32).collect();
        let near = |points: &[Point], reach: f64, v: u32, w: u32| {
            (0..3).all(|a| (points[v as usize][a] - points[w as usize][a]).abs() <= reach)
        };
        let (reach, far) = (NEAR * size(self.points), self.shape.map_or(0.0, |shape| NEAR * size(shape)));
        let together = |v: u32, w: u32| near(self.points, reach, v, w) && self.shape.is_none_or(|s| near(s, far, v, w));
        // In a direction in which hardly two vertices of a lattice are at one height.
        let along = |v: u32| self.points[v as usize].coords.dot(&Vector3::new(1.0, 0.754_877_666_2, 0.569_840_290_9));
        candidates.sort_by(|&v, &w| along(v).total_cmp(&along(w)).then(v.cmp(&w)));
        for (i, &v) in candidates.iter().enumerate() {
            let before = candidates[..i].iter().rev().take_while(|&&w| along(v) - along(w) <= 3.0 * reach);
            let found = before.copied().find(|&w| together(v, w));
            if let Some(w) = found {
                first[v as usize] = first[w as usize];
            }
        }
        lowest(first)
    }
}

/// The same groups, each with its lowest number for the one that they had in common.
fn lowest(group: Vec<u32>) -> Vec<u32> {
    let mut least: Vec<u32> = (0..group.len() as u32).collect();
    for (v, &g) in (0..).zip(&group) {
        least[g as usize] = least[g as usize].min(v);
    }
    group.into_iter().map(|g| least[g as usize]).collect()
}

fn size(points: &[Point]) -> f64 {
    let range = |a: usize| {
        let along = points.iter().map(|p| p[a]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    };
    range(0).max(range(1)).max(range(2))
}

/// The vertices of the open edges of a surface; nothing for a volume.
fn open_edges(cells: &Cells, vertices: usize) -> Option<Vec<u32>> {
    if cells.is_volume() {
        return None;
    }
    let violations = cells.boundary().ok().and_then(|faces| Surface::new(faces, vertices).err()).unwrap_or_default();
    let ends = violations.iter().filter_map(|v| if let Violation::OpenEdge { edge } = v { Some(*edge) } else { None });
    let mut ends: Vec<u32> = ends.flatten().collect();
    ends.sort_unstable();
    ends.dedup();
    Some(ends)
}

fn used(cells: &Cells, vertices: usize) -> Vec<u32> {
    let mut used = vec![false; vertices];
    (0..cells.len()).flat_map(|i| cells.cell(i)).for_each(|&v| used[v as usize] = true);
    (0..).zip(used).filter(|(_, used)| *used).map(|(v, _)| v).collect()
}

/// Whether a surface has fewer open edges, or a volume fewer faces outside, and no cell lost a vertex.
fn is_better(old: &Cells, new: &Cells, vertices: usize) -> bool {
    let distinct = |cell: &[u32]| cell.iter().enumerate().all(|(i, v)| !cell[..i].contains(v));
    let kept = (0..new.len()).all(|i| distinct(new.cell(i)) || !distinct(old.cell(i)));
    let outside = |cells: &Cells| match open_edges(cells, vertices) {
        Some(ends) => Some(ends.len()),
        None => cells.boundary().ok().map(|faces| faces.len()),
    };
    kept && outside(old).zip(outside(new)).is_some_and(|(old, new)| new < old)
}

fn renumbered(cells: &Cells, number: &[u32]) -> Cells {
    fn each<const N: usize>(cells: &[[u32; N]], number: &[u32]) -> Vec<[u32; N]> {
        cells.iter().map(|cell| cell.map(|v| number[v as usize])).collect()
    }
    match cells {
        Cells::Triangles(c) => Cells::Triangles(each(c, number)),
        Cells::Quads(c) => Cells::Quads(each(c, number)),
        Cells::Tetrahedra(c) => Cells::Tetrahedra(each(c, number)),
        Cells::Hexahedra(c) => Cells::Hexahedra(each(c, number)),
    }
}
