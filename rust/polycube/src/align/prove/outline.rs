//! The facets as the lower bound sees them: their sides and the lines that must cut them.

use crate::structure::{Facet, Structure};

/// A side of a facet, in the facet's own two axes (0 and 1).
#[derive(Clone, Copy, Debug)]
pub(super) struct Border {
    /// The edge of the structure.
    pub edge: u32,
    /// The axis that it runs along.
    pub along: usize,
    /// Its level on the other axis.
    pub at: u32,
    /// The levels of its ends.
    pub ends: [u32; 2],
    /// Whether the facet lies on the higher side of it.
    pub inside_above: bool,
    /// Whether the solid fills one quarter around it, not three.
    pub convex: bool,
    /// The facet on its other side.
    pub other: u32,
}

/// A line that cuts a facet from a point of its outline straight on to the other end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Line {
    /// The axis of the facet that it runs along.
    pub along: usize,
    /// Its level on the other axis.
    pub at: u32,
    /// Where it starts.
    pub from: u32,
    /// Whether it runs up the axis.
    pub upward: bool,
}

/// The outline of a facet.
#[derive(Clone, Debug)]
pub(super) struct Outline {
    /// The axis of the structure that the facet looks along, and the two that it lies in.
    pub axes: [usize; 3],
    /// The number of its label.
    pub label: usize,
    /// The levels of its sides on its two axes.
    pub levels: [Vec<u32>; 2],
    /// Its sides.
    pub borders: Vec<Border>,
    /// The lines from its reflex corners.
    pub lines: Vec<Line>,
    /// For its outer loop, then for each hole: the levels on both axes.
    pub loops: Vec<[Vec<u32>; 2]>,
}

impl Outline {
    pub(super) fn new(structure: &Structure, number: u32) -> Self {
        let facet = &structure.facets[number as usize];
        let normal = facet.label.axis();
        let axes = [normal, (normal + 1) % 3, (normal + 2) % 3];
        let (mut borders, mut lines, mut loops) = (Vec::new(), Vec::new(), Vec::new());
        for sides in &facet.loops {
            let reflex = lines.len();
            let walk: Vec<(Border, bool)> =
                sides.iter().map(|s| (border(structure, facet, number, axes, s.edge, s.forward), s.forward)).collect();
            for (i, &(side, forward)) in walk.iter().enumerate() {
                lines.extend(lines_at(&side, forward, &walk[(i + 1) % walk.len()]));
                borders.push(side);
            }
            // An outer loop has four convex corners more than reflex ones, which have two lines each.
            let turns = (0..walk.len()).filter(|&i| walk[i].0.along != walk[(i + 1) % walk.len()].0.along).count();
            let is_outer = turns > lines.len() - reflex;
            let at = if is_outer { 0 } else { loops.len() };
            loops.insert(at, levels_of(walk.iter().map(|w| w.0)));
        }
        let levels = levels_of(borders.iter().copied());
        Self { axes, label: facet.label.index(), levels, borders, lines, loops }
    }

    /// The facet's side on an edge.
    pub(super) fn border(&self, edge: u32) -> Option<&Border> {
        self.borders.iter().find(|b| b.edge == edge)
    }

    /// The line that goes on into this facet when one at level `at` crosses its side `border`.
    pub(super) fn entering(border: &Border, at: u32) -> Line {
        Line { along: 1 - border.along, at, from: border.at, upward: border.inside_above }
    }
}

/// The levels of sides on both axes, each once.
fn levels_of(sides: impl Iterator<Item = Border>) -> [Vec<u32>; 2] {
    let mut levels = [Vec::new(), Vec::new()];
    for side in sides {
        levels[side.along].extend(side.ends);
        levels[1 - side.along].push(side.at);
    }
    for own in &mut levels {
        own.sort_unstable();
        own.dedup();
    }
    levels
}

fn border(structure: &Structure, facet: &Facet, number: u32, axes: [usize; 3], edge: u32, forward: bool) -> Border {
    let e = &structure.edges[edge as usize];
    let along = usize::from(e.axis == axes[2]);
    let low = structure.edge_box(e).low;
    // The facet lies to the left of its sides, seen against its normal.
    let left_is_up = (along == 0) == forward;
    let inside_above = left_is_up == (facet.label.sign() > 0);
    let other = if e.facets[0] == number { e.facets[1] } else { e.facets[0] };
    let looks_up = structure.facets[other as usize].label.sign() > 0;
    let at = low[axes[2 - along]];
    Border { edge, along, at, ends: structure.ends(e), inside_above, convex: inside_above != looks_up, other }
}

/// The two lines into the facet from the corner between two sides, if that corner is reflex.
fn lines_at(first: &Border, forward: bool, next: &(Border, bool)) -> Vec<Line> {
    let (next, next_forward) = *next;
    // Behind a reflex corner the facet lies on both sides of either side's continuation.
    if first.along == next.along || forward != next.inside_above {
        return Vec::new();
    }
    debug_assert_eq!(first.ends[usize::from(forward)], next.at);
    vec![
        Line { along: first.along, at: first.at, from: next.at, upward: forward },
        Line { along: next.along, at: next.at, from: first.at, upward: !next_forward },
    ]
}
