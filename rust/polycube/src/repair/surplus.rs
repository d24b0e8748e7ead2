//! Cells that are too many.

use super::winding::winding;
use super::{Repair, Work};
use crate::mesh::{Cells, Face};
use crate::structure::{Surface, Violation};
use std::collections::{HashMap, HashSet};

/// Around a point of a face that other faces enclose they wind at least so often; around one of the outside, half.
const ENCLOSED: f64 = 0.9;

impl Work<'_> {
    /// Leaves out cells with the same vertices as one before.
    pub(super) fn leave_out_duplicates(&mut self) {
        let mut seen = HashSet::with_capacity(self.cells.len());
        let fresh: Vec<bool> = (0..self.cells.len())
            .map(|i| {
                let mut corners = [u32::MAX; 8];
                corners.iter_mut().zip(self.cells.cell(i)).for_each(|(c, &v)| *c = v);
                corners.sort_unstable();
                seen.insert(corners)
            })
            .collect();
        let count = fresh.iter().filter(|fresh| !**fresh).count();
        if count > 0 {
            self.keep(&fresh);
            self.repairs.push(Repair::Duplicates(count));
        }
    }

    /// Leaves out faces of a surface that end at edges of more than two faces and are enclosed by the others, where the
    /// others close.
    pub(super) fn leave_out_inner_faces(&mut self) {
        let Ok(faces) = self.cells.boundary() else { return };
        let Err(violations) = Surface::new(faces.clone(), self.points.len()) else { return };
        if !violations.iter().any(|v| matches!(v, Violation::NonManifoldEdge { .. })) {
            return;
        }
        let sheet = sheets(&faces);
        let count = sheet.iter().max().map_or(0, |s| *s as usize + 1);
        let mut inner = vec![false; count];
        for (s, inner) in (0..).zip(&mut inner) {
            let others = faces.iter().zip(&sheet).filter(|(_, own)| **own != s).map(|(f, _)| f);
            let own = faces.iter().zip(&sheet).find(|(_, own)| **own == s);
            let middle = own.map(|(face, _)| face.middle(self.points));
            *inner = middle.is_some_and(|middle| winding(self.points, others, &middle).abs() > ENCLOSED);
        }
        let kept: Vec<bool> = sheet.iter().map(|&s| !inner[s as usize]).collect();
        if !kept.contains(&true) {
            return;
        }
        let outside = faces.iter().zip(&kept).filter(|(_, kept)| **kept).map(|(f, _)| *f).collect();
        let fewer = Surface::new(outside, self.points.len()).map_or_else(|v| v.len(), |_| 0) < violations.len();
        let count = kept.iter().filter(|kept| !**kept).count();
        if fewer && count > 0 {
            self.keep(&kept);
            self.repairs.push(Repair::InnerFaces(count));
        }
    }

    fn keep(&mut self, kept: &[bool]) {
        fn some<const N: usize>(cells: &[[u32; N]], kept: &[bool]) -> Vec<[u32; N]> {
            cells.iter().zip(kept).filter(|(_, kept)| **kept).map(|(cell, _)| *cell).collect()
        }
        let cells = match &self.cells {
            Cells::Triangles(c) => Cells::Triangles(some(c, kept)),
            Cells::Quads(c) => Cells::Quads(some(c, kept)),
            Cells::Tetrahedra(c) => Cells::Tetrahedra(some(c, kept)),
            Cells::Hexahedra(c) => Cells::Hexahedra(some(c, kept)),
        };
        self.replace(cells, |v| v);
    }
}

/// The number of the sheet of each face: faces hang together over edges of two.
fn sheets(faces: &[Face]) -> Vec<u32> {
    let mut around: HashMap<[u32; 2], Vec<u32>> = HashMap::with_capacity(2 * faces.len());
    let sides = |face: &Face| {
        let v = face.vertices().to_vec();
        (0..v.len()).map(move |k| [v[k].min(v[(k + 1) % v.len()]), v[k].max(v[(k + 1) % v.len()])])
    };
    for (i, face) in (0..).zip(faces) {
        sides(face).for_each(|side| around.entry(side).or_default().push(i));
    }
    let mut sheet = vec![u32::MAX; faces.len()];
    let mut count = 0;
    for seed in 0..faces.len() {
        if sheet[seed] != u32::MAX {
            continue;
        }
        let mut stack = vec![seed as u32];
        while let Some(face) = stack.pop() {
            if std::mem::replace(&mut sheet[face as usize], count) != u32::MAX {
                continue;
            }
            for side in sides(&faces[face as usize]) {
                let beside = &around[&side];
                stack.extend(beside.iter().filter(|&&f| beside.len() == 2 && sheet[f as usize] == u32::MAX));
            }
        }
        count += 1;
    }
    sheet
}
