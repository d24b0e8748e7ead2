//! How many blocks and faces every completion of a partial order has at least. The proof is in the [parent](super).

use super::clauses::Rules;
use super::grid::{Classes, FacetGrid, Known, trace};
use super::outline::{Line, Outline};
use super::relations::{Pairs, Relations};
use crate::structure::Structure;

/// What every completion has at least.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Least {
    /// Faces of the layout on the surface; also patches.
    pub faces: usize,
    /// Blocks.
    pub blocks: usize,
}

/// The facets of a structure, ready to be bounded.
pub(super) struct Bound {
    outlines: Vec<Outline>,
}

/// One evaluation of the bound.
struct Sketch<'a> {
    known: Known<'a>,
    outlines: &'a [Outline],
    grids: Vec<FacetGrid>,
}

impl Bound {
    pub(super) fn new(structure: &Structure) -> Self {
        Self { outlines: (0..structure.facets.len() as u32).map(|f| Outline::new(structure, f)).collect() }
    }

    /// For every pair of levels the number of facets whose outline depends on their order.
    pub(super) fn weights(&self, pairs: &Pairs) -> Vec<u32> {
        let mut weights = vec![0; pairs.len()];
        for levels in self.outlines.iter().flat_map(|o| &o.levels) {
            for &a in levels {
                levels.iter().for_each(|&b| weights[pairs.cell(a, b)] += 1);
            }
        }
        weights
    }

    /// The least counts over all completions of `relations`. O(Σ (s + l) (s + g)) for facets with s sides, l
    /// lines and g gaps.
    pub(super) fn least(&self, rules: &Rules, relations: &Relations) -> Least {
        let known = Known { pairs: &rules.pairs, relations };
        let lines = self.lines(known);
        let grids = self.outlines.iter().zip(&lines).map(|(o, l)| FacetGrid::new(known, o, l)).collect();
        Sketch { known, outlines: &self.outlines, grids }.count()
    }

    /// For every facet the lines that cut it in every completion: those from its own reflex corners, and those that
    /// cross an edge from another facet.
    fn lines(&self, known: Known) -> Vec<Vec<Line>> {
        let classes: Vec<[Classes; 2]> =
            self.outlines.iter().map(|o| [0, 1].map(|a| Classes::new(known, &o.levels[a]))).collect();
        let mut lines: Vec<Vec<Line>> = self.outlines.iter().map(|o| o.lines.clone()).collect();
        let mut front: Vec<(u32, Line)> =
            (0..).zip(&lines).flat_map(|(f, own)| own.iter().map(move |&line| (f, line))).collect();
        while let Some((facet, line)) = front.pop() {
            let outline = &self.outlines[facet as usize];
            let end = trace(known, outline, &line, &classes[facet as usize][line.along]).crosses;
            let Some(border) = end.and_then(|e| outline.border(e)) else { continue };
            let Some(beyond) = self.outlines[border.other as usize].border(border.edge) else { continue };
            let entering = Outline::entering(beyond, line.at);
            if !lines[border.other as usize].contains(&entering) {
                lines[border.other as usize].push(entering);
                front.push((border.other, entering));
            }
        }
        lines
    }
}

impl Sketch<'_> {
    fn count(&self) -> Least {
        let mut faces = 0;
        let mut columns = [0; 6];
        for (facet, grid) in self.grids.iter().enumerate() {
            let [width, height] = grid.size();
            let cells = (0..width * height).map(|c| [c % width, c / width]);
            for at in cells.filter(|&at| grid.is_start(at)) {
                faces += 1;
                columns[self.outlines[facet].label] += 1 + self.crossings(facet, at);
            }
        }
        Least { faces, blocks: columns.into_iter().max().unwrap_or(0) }
    }

    /// How many sheets surely cross the column of blocks behind a cell of a facet: as many as cut the wall beside it.
    fn crossings(&self, facet: usize, at: [usize; 2]) -> usize {
        let (grid, outline) = (&self.grids[facet], &self.outlines[facet]);
        let mut most = 0;
        for axis in 0..2 {
            for class in [at[axis], at[axis] + 1] {
                let gap = at[1 - axis];
                let Some(border) = grid.border(outline, axis, class, gap) else { continue };
                if border.convex && border.inside_above == (class == at[axis]) {
                    let along = &grid.classes[1 - axis];
                    let span = [along.class(gap), along.class(gap + 1)];
                    most = most.max(self.wall_crossings(border.other as usize, border.edge, outline.axes[0], span));
                }
            }
        }
        most
    }

    /// The most sheets across `normal` that cut the wall `facet` behind its `edge` within `span`.
    fn wall_crossings(&self, facet: usize, edge: u32, normal: usize, span: [&[u32]; 2]) -> usize {
        let (grid, outline) = (&self.grids[facet], &self.outlines[facet]);
        let down = usize::from(outline.axes[1] != normal);
        let Some(border) = outline.border(edge) else { return 0 };
        let Some(class) = grid.classes[down].of(border.at).filter(|&c| grid.classes[down].is_flat(c)) else { return 0 };
        let meets = |gap: &usize| {
            let own = [grid.classes[1 - down].class(*gap), grid.classes[1 - down].class(*gap + 1)];
            self.all_below(span[0], own[1]) && self.all_below(own[0], span[1])
        };
        let gaps = (0..grid.size()[1 - down]).filter(meets);
        gaps.map(|gap| self.descend(facet, down, class, gap, border.inside_above)).max().unwrap_or(0)
    }

    fn all_below(&self, low: &[u32], high: &[u32]) -> bool {
        low.iter().all(|&a| high.iter().all(|&b| self.known.below(a, b)))
    }

    /// The sheets met from class `class` along `axis` as far as the facet surely goes on.
    fn descend(&self, facet: usize, axis: usize, class: usize, gap: usize, upward: bool) -> usize {
        let (grid, outline) = (&self.grids[facet], &self.outlines[facet]);
        let cell = |row: usize| if axis == 0 { [row, gap] } else { [gap, row] };
        let mut row = if upward { class } else { class.wrapping_sub(1) };
        let mut met = 0;
        while grid.is_inside(cell(row)) {
            let (end, next) = if upward { (row + 1, row + 1) } else { (row, row.wrapping_sub(1)) };
            if !grid.classes[axis].is_flat(end) {
                return met;
            }
            if !grid.is_inside(cell(next)) {
                let reflex = grid.border(outline, axis, end, gap).is_some_and(|b| !b.convex);
                return met + usize::from(reflex);
            }
            met += usize::from(grid.is_cut(axis, cell(row.max(next))));
            row = next;
        }
        met
    }
}
