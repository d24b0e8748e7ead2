//! A facet as far as the order of its levels is known.

use super::outline::{Border, Line, Outline};
use super::relations::{ABOVE, BELOW, EQUAL, Pairs, Relations, is_decided};

/// What is known of the levels: where relations are kept, and the relations.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    /// Where relations are kept.
    pub pairs: &'a Pairs,
    /// The relations.
    pub relations: &'a Relations,
}

impl Known<'_> {
    /// What `a` can be to `b`.
    pub(super) fn get(&self, a: u32, b: u32) -> u8 {
        self.relations.get(self.pairs, a, b)
    }

    /// Whether `a` lies below `b` in every completion.
    pub(super) fn below(&self, a: u32, b: u32) -> bool {
        self.relations.below(self.pairs, a, b)
    }
}

/// Levels of one axis cut into classes, each surely above the one before; gap `i` lies between classes `i` and `i +
/// 1`.
#[derive(Clone, Debug, Default)]
pub(super) struct Classes {
    levels: Vec<u32>,
    starts: Vec<usize>,
    flat: Vec<bool>,
}

impl Classes {
    /// The finest classes that are in order whatever the completion. O(n²) for n levels.
    pub(super) fn new(known: Known, levels: &[u32]) -> Self {
        let mut sorted: Vec<(usize, u32)> =
            levels.iter().map(|&b| (levels.iter().filter(|&&a| known.below(a, b)).count(), b)).collect();
        sorted.sort_unstable();
        let levels: Vec<u32> = sorted.into_iter().map(|s| s.1).collect();
        let mut starts = Vec::new();
        let mut sure = levels.len();
        for (k, &b) in levels.iter().enumerate().rev() {
            sure = sure.min(levels.iter().take_while(|&&a| known.below(a, b)).count());
            if sure >= k {
                starts.push(k);
            }
        }
        starts.reverse();
        let mut classes = Self { levels, starts, flat: Vec::new() };
        let flat = |c: usize| {
            let own = classes.class(c);
            own.iter().all(|&l| known.get(own[0], l) == EQUAL)
        };
        classes.flat = (0..classes.starts.len()).map(flat).collect();
        classes
    }

    /// The number of classes.
    pub(super) fn len(&self) -> usize {
        self.starts.len()
    }

    /// The number of gaps.
    pub(super) fn gaps(&self) -> usize {
        self.len().saturating_sub(1)
    }

    /// The levels of a class.
    pub(super) fn class(&self, c: usize) -> &[u32] {
        let end = self.starts.get(c + 1).copied().unwrap_or(self.levels.len());
        &self.levels[self.starts[c]..end]
    }

    /// Whether all levels of a class surely coincide.
    pub(super) fn is_flat(&self, c: usize) -> bool {
        self.flat[c]
    }

    /// The class of a level.
    pub(super) fn of(&self, level: u32) -> Option<usize> {
        let place = self.levels.iter().position(|&l| l == level)?;
        Some(self.starts.partition_point(|&s| s <= place) - 1)
    }
}

/// How far a line surely goes: the gaps that it passes, and the side that it crosses at the end if that is sure.
pub(super) struct Trace {
    /// The gaps passed.
    pub gaps: Vec<usize>,
    /// The edge crossed.
    pub crosses: Option<u32>,
}

/// Follows `line` over the classes of the axis that it runs along, until it meets or may meet a side.
pub(super) fn trace(known: Known, outline: &Outline, line: &Line, classes: &Classes) -> Trace {
    let mut gaps = Vec::new();
    let beyond = if line.upward { ABOVE } else { BELOW };
    let across = |b: &&Border| b.along != line.along;
    let ahead = |b: &&Border| known.get(b.at, line.from) & beyond != 0;
    let reached = |b: &&Border| !known.below(b.ends[1], line.at) && !known.below(line.at, b.ends[0]);
    let candidates: Vec<(Option<usize>, &Border)> =
        (outline.borders.iter().filter(across).filter(ahead)).filter(reached).map(|b| (classes.of(b.at), b)).collect();
    let mut next = classes.of(line.from);
    while let Some(class) = next {
        let mut here = candidates.iter().filter(|(c, _)| *c == Some(class)).map(|(_, b)| b);
        if let Some(border) = here.next() {
            let sure = known.below(border.ends[0], line.at) && known.below(line.at, border.ends[1]);
            return Trace { gaps, crosses: (sure && here.next().is_none()).then_some(border.edge) };
        }
        next = if line.upward { Some(class + 1).filter(|c| *c < classes.len()) } else { class.checked_sub(1) };
        gaps.extend(next.map(|n| n.min(class)));
    }
    Trace { gaps, crosses: None }
}

/// The gaps of a facet on both axes: which of their products lie in the facet, and between which of them a line
/// surely runs.
pub(super) struct FacetGrid {
    /// The classes on both axes.
    pub classes: [Classes; 2],
    inside: Vec<bool>,
    /// For each axis and cell: whether a line runs between it and the cell before it.
    cut: [Vec<bool>; 2],
}

impl FacetGrid {
    /// The grid of a facet cut by `lines`.
    pub(super) fn new(known: Known, outline: &Outline, lines: &[Line]) -> Self {
        let mut levels = outline.levels.clone();
        for line in lines {
            let own = &mut levels[1 - line.along];
            if !own.contains(&line.at) && own.iter().all(|&l| is_decided(known.get(l, line.at))) {
                own.push(line.at);
            }
        }
        let classes = levels.map(|l| Classes::new(known, &l));
        let cells = classes[0].gaps() * classes[1].gaps();
        let mut grid = Self { classes, inside: vec![false; cells], cut: [vec![false; cells], vec![false; cells]] };
        grid.fill(outline);
        lines.iter().for_each(|l| grid.draw(known, outline, l));
        grid
    }

    /// The numbers of gaps.
    pub(super) fn size(&self) -> [usize; 2] {
        [0, 1].map(|a| self.classes[a].gaps())
    }

    fn cell(&self, at: [usize; 2]) -> usize {
        at[1] * self.classes[0].gaps() + at[0]
    }

    /// Whether a cell lies in the facet.
    pub(super) fn is_inside(&self, at: [usize; 2]) -> bool {
        let size = self.size();
        at[0] < size[0] && at[1] < size[1] && self.inside[self.cell(at)]
    }

    /// Whether a line surely runs between a cell and the one before it along `axis`.
    pub(super) fn is_cut(&self, axis: usize, at: [usize; 2]) -> bool {
        self.cut[axis][self.cell(at)]
    }

    /// Whether a face of the layout has this as its lowest cell, in every completion.
    pub(super) fn is_start(&self, at: [usize; 2]) -> bool {
        let parted = |axis: usize| {
            let mut before = at;
            before[axis] = before[axis].wrapping_sub(1);
            self.is_cut(axis, at) || !self.is_inside(before)
        };
        self.is_inside(at) && parted(0) && parted(1)
    }

    /// The side that bounds the facet in class `class` of `axis` along the gap `gap` of the other axis, if that
    /// class is flat.
    pub(super) fn border<'o>(&self, outline: &'o Outline, axis: usize, class: usize, gap: usize) -> Option<&'o Border> {
        let lies_there = |b: &&Border| {
            let range = b.ends.map(|e| self.classes[1 - axis].of(e));
            b.along != axis
                && self.classes[axis].of(b.at) == Some(class)
                && range[0] <= Some(gap)
                && Some(gap) < range[1]
        };
        outline.borders.iter().filter(|_| self.classes[axis].is_flat(class)).find(lies_there)
    }

    /// Cells after an odd number of sides along the first axis lie inside.
    fn fill(&mut self, outline: &Outline) {
        let size = self.size();
        for border in outline.borders.iter().filter(|b| b.along == 1) {
            let [Some(low), Some(high)] = border.ends.map(|e| self.classes[1].of(e)) else { continue };
            let Some(class) = self.classes[0].of(border.at) else { continue };
            for gap in low..high {
                for i in class..size[0] {
                    let cell = self.cell([i, gap]);
                    self.inside[cell] ^= true;
                }
            }
        }
    }

    fn draw(&mut self, known: Known, outline: &Outline, line: &Line) {
        let across = 1 - line.along;
        let Some(class) = self.classes[across].of(line.at).filter(|c| *c < self.size()[across]) else { return };
        for gap in trace(known, outline, line, &self.classes[line.along]).gaps {
            let mut at = [class; 2];
            at[line.along] = gap;
            let cell = self.cell(at);
            self.cut[across][cell] = true;
        }
    }
}
