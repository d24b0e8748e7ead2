//! Placing levels and their mirror images on the lattice.

use crate::align::chain::{Plane, chain};

/// Levels of one axis closer than this part of the whole size are one plane when mirrored positions are averaged.
const SAME: f64 = 1e-9;

/// A plane of symmetry across an axis.
pub(crate) struct Mirror {
    /// The image of each level; those of other axes have themselves.
    pub image: Vec<u32>,
    /// Where the plane cuts the axis, in lattice steps.
    at: f64,
    /// Levels across the axis that are equal to their images, so that they lie in the plane.
    pub centred: Vec<u32>,
    /// Twice its coordinate on the lattice, where fixed levels that mirror each other decide it.
    held: Option<i64>,
}

impl Mirror {
    /// The plane that cuts the axis at `at` lattice steps.
    pub(crate) fn new(image: Vec<u32>, at: f64) -> Self {
        Self { image, at, centred: Vec::new(), held: None }
    }

    /// Takes the sum of the coordinates of two fixed levels that mirror each other for twice the coordinate of the
    /// plane; `false` if others are fixed to another sum, if that is more than a lattice step away, or off the lattice
    /// where a level must lie in it.
    pub(crate) fn hold(&mut self, doubled: i64) -> bool {
        let near = (doubled as f64 - 2.0 * self.at).abs() <= 2.0;
        let on_lattice = self.centred.is_empty() || doubled % 2 == 0;
        *self.held.get_or_insert(doubled) == doubled && near && on_lattice
    }

    /// Twice the coordinate of the plane on the lattice: on a lattice plane if one of an odd number of planes lies in
    /// it. Nothing if fixed levels have it elsewhere.
    fn doubled(&self, planes: usize) -> Option<i64> {
        let centred = planes % 2 == 1;
        match self.held {
            Some(doubled) => (!centred || doubled % 2 == 0).then_some(doubled),
            None if centred => Some(2 * self.at.round() as i64),
            None => Some((2.0 * self.at).round() as i64),
        }
    }

    /// Places the lower half nearest to the targets of both halves, and mirrors it; nothing if fixed planes do not
    /// allow that.
    pub(crate) fn place(&self, planes: &[Plane]) -> Option<Vec<i64>> {
        let (n, doubled) = (planes.len(), self.doubled(planes.len())?);
        let sums = (0..n).filter_map(|i| Some(planes[i].fixed? + planes[n - 1 - i].fixed?));
        if sums.into_iter().any(|sum| sum != doubled) {
            return None;
        }
        let fold = |i: usize| planes[i].folded(&planes[n - 1 - i], doubled);
        let half: Vec<Plane> = (0..n / 2).map(fold).collect();
        let middle = (n % 2 == 1).then_some(doubled / 2);
        let lower = chain(&half, Some(middle.map_or((doubled - 1).div_euclid(2), |x| x - 1)))?;
        let upper = lower.iter().rev().map(|x| doubled - x);
        Some(lower.iter().copied().chain(middle).chain(upper).collect())
    }

    /// Makes one of each two levels that mirror each other the image of the other, of the one that is `held` if only
    /// one is.
    pub(crate) fn reflect(&self, levels: &mut [i64], held: impl Fn(u32) -> bool) {
        let doubled = self.doubled(usize::from(!self.centred.is_empty())).unwrap_or(0);
        for (l, &image) in (0..).zip(&self.image).filter(|(l, i)| l < *i) {
            let (from, to) = if held(image) && !held(l) { (image, l) } else { (l, image) };
            levels[to as usize] = doubled - levels[from as usize];
        }
        self.centred.iter().for_each(|&l| levels[l as usize] = doubled / 2);
    }

    /// Moves mirrored levels half way to their images.
    pub(crate) fn average(&self, placement: &mut [f64]) {
        let own = || (0..).zip(&self.image).filter(|(l, i)| l != *i).map(|(l, &i): (u32, &u32)| (l, i));
        // What mirrors itself is on the plane; where nothing does, the mean of all is.
        let size = own().map(|(l, i)| (placement[l as usize] - placement[i as usize]).abs()).fold(0.0, f64::max);
        let count = own().count().max(1) as f64;
        let centre = own().map(|(l, _)| placement[l as usize]).sum::<f64>() / count;
        let mut offsets: Vec<(f64, u32)> =
            own().map(|(l, i)| ((placement[l as usize] - placement[i as usize]) / 2.0, l)).collect();
        offsets.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()).then(a.1.cmp(&b.1)));
        let mut last = 0.0;
        for (offset, level) in offsets {
            if offset.abs() - last > SAME * size {
                last = offset.abs();
            }
            placement[level as usize] = centre + if offset < 0.0 { -last } else { last };
        }
    }
}
