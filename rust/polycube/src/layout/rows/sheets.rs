//! The base complex on rows of bits: sheets, blocks, and the faces of the complex on the surface.

use super::Word;
use super::{Rows, spread};

impl<R: Word> Rows<R> {
    /// Inner faces beside a reflex edge, and all that their planes reach.
    pub(super) fn grow_sheets(&mut self) {
        let [nj, nk] = self.size;
        let strides = [0, 1, nj];
        let mut sheets = std::mem::take(&mut self.sheets);
        for (axis, sheet) in sheets.iter_mut().enumerate() {
            sheet.clear();
            sheet.extend((0..nj * nk).map(|row| self.seeds(row, strides[axis])));
        }
        let [first, second, third] = &mut sheets;
        self.flood(first, 0, &[1, nj]);
        self.flood(second, 1, &[nj]);
        self.flood(third, nj, &[1]);
        self.sheets = sheets;
    }

    /// Solid cells whose neighbour before them (across the rows at `stride`, along the row for 0) is solid too.
    fn inner(&self, row: usize, stride: usize) -> R {
        self.solid[row] & if stride == 0 { self.solid[row] << 1 } else { self.before(row, stride) }
    }

    /// Inner faces beside which exactly one of two cells is solid: there runs a reflex edge.
    fn seeds(&self, row: usize, stride: usize) -> R {
        let nj = self.size[0];
        let inner = self.inner(row, stride);
        if inner.is_zero() {
            return inner;
        }
        let beside = |r: R, lower: R| r ^ lower;
        let lower = |at: R, row: Option<usize>| match (stride, row) {
            (0, _) => at << 1,
            (_, Some(r)) => self.before(r, stride),
            _ => R::ZERO,
        };
        let mut one_solid = R::ZERO;
        for step in [1, nj].into_iter().filter(|s| *s != stride) {
            let (back, ahead) = (self.before(row, step), self.after(row, step));
            one_solid = one_solid | beside(back, lower(back, row.checked_sub(step)));
            one_solid = one_solid | beside(ahead, lower(ahead, Some(row + step)));
        }
        if stride != 0 {
            let across = self.solid[row] ^ self.before(row, stride);
            one_solid = one_solid | across << 1 | across >> 1;
        }
        inner & one_solid
    }

    /// Spreads a sheet over inner faces along `steps` across the rows and, where its plane holds them, along the rows.
    fn flood(&self, sheet: &mut [R], stride: usize, steps: &[usize]) {
        let within = |word: R, inner: R| if stride == 0 { word } else { spread(word, inner) };
        let reach = |sheet: &mut [R], row: usize, from: usize| {
            let inner = self.inner(row, stride);
            let come = sheet[from] & inner & !sheet[row];
            if !come.is_zero() {
                sheet[row] = within(sheet[row] | come, inner);
            }
            !come.is_zero()
        };
        let rows = sheet.len();
        (0..rows).filter(|_| stride != 0).for_each(|row| sheet[row] = spread(sheet[row], self.inner(row, stride)));
        loop {
            let mut grew = false;
            for &step in steps {
                (step..rows).for_each(|row| grew |= reach(sheet, row, row - step));
                (0..rows - step).rev().for_each(|row| grew |= reach(sheet, row, row + step));
            }
            if !grew {
                return;
            }
        }
    }

    /// Each block once, by the cell at its lowest corner.
    pub(super) fn blocks(&self) -> usize {
        let nj = self.size[0];
        let starts = |row: usize| {
            let closed = |axis: usize, below: R| self.sheets[axis][row] | !below;
            let [x, y, z] = [self.solid[row] << 1, self.before(row, 1), self.before(row, nj)];
            self.solid[row] & closed(0, x) & closed(1, y) & closed(2, z)
        };
        (0..self.solid.len()).map(|row| starts(row).count_ones() as usize).sum()
    }

    /// Each face of the complex on the surface once, by its lattice face at the lowest corner.
    pub(super) fn surface_faces(&self) -> usize {
        let nj = self.size[0];
        let mut count = 0;
        for row in nj..self.solid.len() {
            for (axis, stride) in [0, 1, nj].into_iter().enumerate() {
                for positive in [false, true] {
                    count += self.face_starts(row, axis, stride, positive).count_ones() as usize;
                }
            }
        }
        count
    }

    fn face_starts(&self, row: usize, axis: usize, stride: usize, positive: bool) -> R {
        let nj = self.size[0];
        let marks = if positive { &self.faces[axis].positive } else { &self.faces[axis].negative };
        let mut starts = marks[row];
        if starts.is_zero() {
            return starts;
        }
        // The solid cell lies above a face that looks down, and below one that looks up.
        let behind = |sheet: &[R]| match (positive, stride) {
            (false, _) => sheet[row],
            (true, 0) => sheet[row] << 1,
            (true, _) => sheet[row - stride],
        };
        for (other, step) in [0, 1, nj].into_iter().enumerate().filter(|(a, _)| *a != axis) {
            let before = if step == 0 { marks[row] << 1 } else { marks[row - step] };
            starts = starts & (!before | behind(&self.sheets[other]));
        }
        starts
    }
}
