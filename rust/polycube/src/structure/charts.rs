//! From labelled faces to charts.

use super::label::Label;
use super::{HalfEdge, Surface, Violation};

/// Connected sets of faces with one label.
pub(super) struct Charts {
    /// The chart of every face.
    pub(super) of_face: Vec<u32>,
    /// The label of every chart.
    pub(super) labels: Vec<Label>,
    /// The half-edges between two charts, ascending.
    pub(super) borders: Vec<HalfEdge>,
}

impl Charts {
    /// Floods the faces label by label; charts are numbered by their first faces.
    pub(super) fn new(surface: &Surface, labels: Vec<Label>) -> Result<Self, Vec<Violation>> {
        let mut charts = Self { of_face: vec![u32::MAX; labels.len()], labels: Vec::new(), borders: Vec::new() };
        for seed in 0..labels.len() {
            if charts.of_face[seed] == u32::MAX {
                charts.flood(surface, &labels, seed);
            }
        }
        charts.borders = surface.half_edges().filter(|&h| charts.is_border(surface, h)).collect();
        let opposite = |&h: &HalfEdge| charts.label(surface, h) == charts.label(surface, surface.twin(h)).opposite();
        let once = charts.borders.iter().copied().filter(|&h| h < surface.twin(h)).filter(opposite);
        let edge = |h| [surface.start(h), surface.end(h)];
        let violations: Vec<_> = once.map(|h| Violation::OppositeCharts { edge: edge(h) }).collect();
        if violations.is_empty() { charts.check_genus(surface) } else { Err(violations) }
    }

    fn flood(&mut self, surface: &Surface, labels: &[Label], seed: usize) {
        let chart = self.labels.len() as u32;
        self.labels.push(labels[seed]);
        self.of_face[seed] = chart;
        let mut stack = vec![seed];
        while let Some(face) = stack.pop() {
            for side in 0..surface.faces()[face].vertices().len() {
                let other = surface.face(surface.twin((4 * face + side) as HalfEdge));
                if self.of_face[other] == u32::MAX && labels[other] == labels[seed] {
                    self.of_face[other] = chart;
                    stack.push(other);
                }
            }
        }
    }

    /// The chart to the left of `h`.
    pub(super) fn left(&self, surface: &Surface, h: HalfEdge) -> u32 {
        self.of_face[surface.face(h)]
    }

    pub(super) fn label(&self, surface: &Surface, h: HalfEdge) -> Label {
        self.labels[self.left(surface, h) as usize]
    }

    pub(super) fn is_border(&self, surface: &Surface, h: HalfEdge) -> bool {
        self.left(surface, h) != self.left(surface, surface.twin(h))
    }

    /// The border half-edge of the same chart that follows the border half-edge `h`.
    pub(super) fn next_border(&self, surface: &Surface, h: HalfEdge) -> HalfEdge {
        let mut next = surface.next(h);
        while !self.is_border(surface, next) {
            next = surface.next(surface.twin(next));
        }
        next
    }

    /// A flat chart is a disc with holes: its Euler number and its boundary loops must agree, and there is a loop.
    fn check_genus(self, surface: &Surface) -> Result<Self, Vec<Violation>> {
        let mut first = vec![u32::MAX; self.labels.len()];
        for (face, &chart) in (0..).zip(&self.of_face) {
            first[chart as usize] = first[chart as usize].min(face);
        }
        let mut euler = self.inner_euler(surface);
        let mut is_closed = vec![true; self.labels.len()];
        for chart in self.border_loops(surface) {
            euler[chart as usize] += 1;
            is_closed[chart as usize] = false;
        }
        let violation = |chart: usize| match (euler[chart], is_closed[chart]) {
            (2, false) => None,
            (2, true) => Some(Violation::TooFewCorners { face: first[chart], corners: 0 }),
            _ => Some(Violation::ChartWithHandle { face: first[chart] }),
        };
        let violations: Vec<_> = (0..euler.len()).filter_map(violation).collect();
        if violations.is_empty() { Ok(self) } else { Err(violations) }
    }

    /// For every chart its faces and inner vertices, less its inner edges.
    fn inner_euler(&self, surface: &Surface) -> Vec<i64> {
        let mut twice = vec![0_i64; self.labels.len()];
        for (face, &chart) in surface.faces().iter().zip(&self.of_face) {
            twice[chart as usize] += 2 - face.vertices().len() as i64;
        }
        let mut on_border = vec![false; surface.vertex_count()];
        for &h in &self.borders {
            twice[self.left(surface, h) as usize] += 1;
            on_border[surface.start(h) as usize] = true;
        }
        let inner = (0..).zip(on_border).filter(|(_, on_border)| !on_border);
        for h in inner.filter_map(|(vertex, _)| surface.fan(vertex).next()) {
            twice[self.left(surface, h) as usize] += 2;
        }
        twice.iter().map(|t| t / 2).collect()
    }

    /// The chart of every border loop.
    fn border_loops(&self, surface: &Surface) -> Vec<u32> {
        let mut seen = vec![false; 4 * surface.faces().len()];
        let mut loops = Vec::new();
        for &first in &self.borders {
            if !seen[first as usize] {
                loops.push(self.left(surface, first));
            }
            let mut h = first;
            while !std::mem::replace(&mut seen[h as usize], true) {
                h = self.next_border(surface, h);
            }
        }
        loops
    }
}
