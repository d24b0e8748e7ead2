//! Sets of solid cells on a grid with planes at any distance from each other.

use crate::error::{Error, ErrorKind, Result};

/// More cells than this are refused, so that every vertex index fits 32 bits.
const MAX_CELLS: usize = 1 << 31;

/// An axis-aligned box with integer corners, `min` below `max` on every axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cuboid {
    /// The corner with the smallest coordinates.
    pub min: [i64; 3],
    /// The corner with the largest coordinates.
    pub max: [i64; 3],
}

impl Cuboid {
    /// The box between two corners.
    pub const fn new(min: [i64; 3], max: [i64; 3]) -> Self {
        Self { min, max }
    }

    /// The same box, moved.
    #[must_use]
    pub fn moved(self, by: [i64; 3]) -> Self {
        let add = |p: [i64; 3]| std::array::from_fn(|a| p[a] + by[a]);
        Self::new(add(self.min), add(self.max))
    }
}

/// A set of solid cells between the planes of a grid; everything outside the grid is empty.
///
/// Cell `[i, j, k]` lies between planes `i` and `i + 1` of the X axis, and so on.
#[derive(Clone, Debug, PartialEq)]
pub struct Voxels {
    pub(super) planes: [Vec<f64>; 3],
    pub(super) solid: Vec<bool>,
}

impl Voxels {
    /// The union of `boxes`, on the planes that its surface needs.
    ///
    /// # Errors
    /// See [`from_difference`](Self::from_difference).
    pub fn from_boxes(boxes: &[Cuboid]) -> Result<Self> {
        Self::from_difference(boxes, &[])
    }

    /// The union of `boxes` without the union of `holes`, on the planes that its surface needs.
    /// Holes make rings, tunnels, pits and voids. No box at all gives no solid cell.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] when a box is empty on an axis, a coordinate is beyond ±2^53, or the
    /// boxes cut space into more than 2^31 cells.
    pub fn from_difference(boxes: &[Cuboid], holes: &[Cuboid]) -> Result<Self> {
        let all = || boxes.iter().chain(holes);
        all().try_for_each(check)?;
        let planes = [0, 1, 2].map(|axis| {
            let mut planes: Vec<i64> = all().flat_map(|b| [b.min[axis], b.max[axis]]).collect();
            planes.sort_unstable();
            planes.dedup();
            planes.into_iter().map(|p| p as f64).collect()
        });
        let mut voxels = Self::empty(planes)?;
        boxes.iter().for_each(|b| voxels.set(b, true));
        holes.iter().for_each(|b| voxels.set(b, false));
        Ok(voxels.compressed())
    }

    /// No solid cell, between sorted `planes`.
    pub(super) fn empty(planes: [Vec<f64>; 3]) -> Result<Self> {
        let cells = planes
            .iter()
            .try_fold(1_usize, |n, p| n.checked_mul(p.len().saturating_sub(1)))
            .filter(|n| *n <= MAX_CELLS)
            .ok_or_else(|| {
                Error::new(ErrorKind::Option, "the grid has more than 2^31 cells")
                    .remedy("use fewer boxes or a larger step")
            })?;
        let solid = vec![false; cells];
        Ok(Self { planes, solid })
    }

    /// Makes the cells inside `b` solid or empty. Its faces lie on planes, or outside the grid.
    pub(super) fn set(&mut self, b: &Cuboid, solid: bool) {
        let range = |axis: usize| {
            let at = |x: i64| self.planes[axis].partition_point(|p| *p < x as f64);
            let cells = self.size()[axis];
            at(b.min[axis]).min(cells)..at(b.max[axis]).min(cells)
        };
        let (xs, ys, zs) = (range(0), range(1), range(2));
        for z in zs {
            for y in ys.clone() {
                let row = self.index([0, y, z]);
                self.solid[row + xs.start..row + xs.end].fill(solid);
            }
        }
    }

    /// Plane coordinates of an axis (0 = X, 1 = Y, 2 = Z), strictly increasing.
    ///
    /// # Panics
    /// When `axis` is above 2.
    pub fn planes(&self, axis: usize) -> &[f64] {
        &self.planes[axis]
    }

    /// Number of cells along each axis.
    pub fn size(&self) -> [usize; 3] {
        [0, 1, 2].map(|axis| self.planes[axis].len().saturating_sub(1))
    }

    /// Whether the cell is solid; cells outside the grid are not.
    pub fn is_solid(&self, cell: [i64; 3]) -> bool {
        let size = self.size();
        let inside = (0..3).all(|a| (0..size[a] as i64).contains(&cell[a]));
        inside && self.solid[self.index(cell.map(|c| c as usize))]
    }

    /// Number of solid cells.
    pub fn count(&self) -> usize {
        self.solid.iter().filter(|s| **s).count()
    }

    /// Total volume of the solid cells.
    pub fn volume(&self) -> f64 {
        let width = |axis: usize, i: usize| self.planes[axis][i + 1] - self.planes[axis][i];
        self.cells().map(|c| width(0, c[0]) * width(1, c[1]) * width(2, c[2])).sum()
    }

    /// The solid cells, X running fastest, Z slowest.
    pub fn cells(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let solid = |i: &usize| self.solid[*i];
        (0..self.solid.len()).filter(solid).map(|i| self.coordinates(i))
    }

    pub(super) fn index(&self, c: [usize; 3]) -> usize {
        let size = self.size();
        c[0] + size[0] * (c[1] + size[1] * c[2])
    }

    pub(super) fn coordinates(&self, index: usize) -> [usize; 3] {
        let size = self.size();
        let row = index / size[0];
        [index % size[0], row % size[1], row / size[1]]
    }

    /// The same set on the fewest planes: those that part of its surface lies on.
    #[must_use]
    pub fn compressed(&self) -> Self {
        let mut kept: [Vec<usize>; 3] = Default::default();
        for (axis, kept) in kept.iter_mut().enumerate() {
            kept.extend((0..self.planes[axis].len()).filter(|i| self.on_surface(axis, *i)));
        }
        self.resampled(&kept)
    }

    /// The cells that start at the `kept` planes and reach to the next kept one.
    fn resampled(&self, kept: &[Vec<usize>; 3]) -> Self {
        let planes: [Vec<f64>; 3] = std::array::from_fn(|a| kept[a].iter().map(|i| self.planes[a][*i]).collect());
        let starts = [0, 1, 2].map(|a| &kept[a][..kept[a].len().saturating_sub(1)]);
        let mut solid = Vec::new();
        for z in starts[2] {
            for y in starts[1] {
                solid.extend(starts[0].iter().map(|x| self.solid[self.index([*x, *y, *z])]));
            }
        }
        Self { planes, solid }
    }

    /// Whether some cell differs from the one on the other side of the plane.
    fn on_surface(&self, axis: usize, plane: usize) -> bool {
        let size = self.size();
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        (0..size[u] * size[v]).any(|i| {
            let mut cell = [0; 3];
            cell[axis] = plane as i64;
            cell[u] = (i % size[u]) as i64;
            cell[v] = (i / size[u]) as i64;
            let after = self.is_solid(cell);
            cell[axis] -= 1;
            after != self.is_solid(cell)
        })
    }

    /// The same set with every cell cut evenly, into parts no longer than `step` on any axis.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] when `step` is not positive and finite, or makes more than 2^31 cells.
    pub fn refined(&self, step: f64) -> Result<Self> {
        if !(step.is_finite() && step > 0.0) {
            let message = format!("the step {step} is not a positive length");
            return Err(Error::new(ErrorKind::Option, message));
        }
        let parts = |axis: usize, i: usize| ((self.planes[axis][i + 1] - self.planes[axis][i]) / step).ceil();
        let size = self.size();
        let total = |axis: usize| (0..size[axis]).map(|i| parts(axis, i)).sum::<f64>();
        if (0..3).map(total).product::<f64>() > MAX_CELLS as f64 {
            let message = format!("the step {step} makes more than 2^31 cells");
            return Err(Error::new(ErrorKind::Option, message).remedy("use a larger step"));
        }
        let mut kept: [Vec<usize>; 3] = Default::default();
        let mut planes: [Vec<f64>; 3] = Default::default();
        for axis in 0..3 {
            for i in 0..size[axis] {
                let [from, to] = [self.planes[axis][i], self.planes[axis][i + 1]];
                let n = parts(axis, i) as usize;
                planes[axis].extend((0..n).map(|k| from + (to - from) * k as f64 / n as f64));
                kept[axis].extend(std::iter::repeat_n(i, n));
            }
            planes[axis].extend(self.planes[axis].last());
            kept[axis].extend(self.planes[axis].len().checked_sub(1));
        }
        let solid = self.resampled(&kept).solid;
        Ok(Self { planes, solid })
    }
}

fn check(b: &Cuboid) -> Result<()> {
    let limit = 1_i64 << 53;
    if (0..3).any(|a| b.min[a] >= b.max[a]) {
        let message = format!("the box from {:?} to {:?} is empty", b.min, b.max);
        return Err(
            Error::new(ErrorKind::Option, message).remedy("give its smaller corner first, and a width on every axis")
        );
    }
    if b.min.iter().chain(&b.max).any(|x| x.unsigned_abs() > limit as u64) {
        return Err(Error::new(ErrorKind::Option, "a coordinate of a box is beyond ±2^53"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_union_keeps_only_the_planes_of_its_surface() {
        let a = Cuboid::new([0, 0, 0], [4, 4, 4]);
        let b = Cuboid::new([2, 0, 0], [9, 4, 4]);
        let voxels = Voxels::from_boxes(&[a, b]).unwrap();
        assert_eq!(voxels.planes(0), [0.0, 9.0]);
        assert_eq!(voxels.count(), 1);
        assert_eq!(voxels.volume(), 144.0);
    }

    #[test]
    fn a_difference_has_the_volume_left() {
        let a = Cuboid::new([-3, -3, -3], [3, 3, 3]);
        let hole = Cuboid::new([-1, -1, -5], [1, 1, 5]);
        let voxels = Voxels::from_difference(&[a], &[hole]).unwrap();
        assert_eq!(voxels.volume(), 216.0 - 24.0);
        let same = voxels.refined(1.0).unwrap();
        assert_eq!(same.size(), [6, 6, 6]);
        assert_eq!(same.volume(), voxels.volume());
        assert_eq!(same.compressed(), voxels);
    }

    #[test]
    fn nothing_stays_nothing() {
        let none = Voxels::from_boxes(&[]).unwrap();
        assert_eq!((none.count(), none.size()), (0, [0, 0, 0]));
        assert_eq!(none.refined(1.0).unwrap().count(), 0);
        let a = Cuboid::new([0; 3], [1; 3]);
        assert_eq!(Voxels::from_difference(&[a], &[a]).unwrap(), none);
    }

    #[test]
    fn bad_boxes_and_steps_are_refused() {
        let flat = Cuboid::new([0, 0, 0], [1, 1, 0]);
        let kind = |r: Result<Voxels>| r.unwrap_err().kind;
        assert_eq!(kind(Voxels::from_boxes(&[flat])), ErrorKind::Option);
        let far = Cuboid::new([0, 0, 0], [1, 1, i64::MAX]);
        assert_eq!(kind(Voxels::from_boxes(&[far])), ErrorKind::Option);
        let cube = Voxels::from_boxes(&[Cuboid::new([0; 3], [1000; 3])]).unwrap();
        for step in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-9] {
            assert_eq!(kind(cube.refined(step)), ErrorKind::Option);
        }
    }
}
