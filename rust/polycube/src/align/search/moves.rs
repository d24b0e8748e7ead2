//! Small changes of an order of levels: the steps of a search.

use crate::align::guides::Guided;
use crate::align::ranks::Ranks;
use crate::rng::SplitMix64;
use crate::structure::Structure;

/// Ranks are multiplied by this, so that levels can be put between planes.
const BETWEEN: i32 = 64;
/// The farthest that a level jumps, in planes.
const REACH: u64 = 3;

/// The neighbourhood of orders: which levels an edge keeps below which, and which move as one.
pub(crate) struct Moves {
    axis_of: Vec<usize>,
    by_axis: [Vec<u32>; 3],
    below: Vec<Vec<u32>>,
    above: Vec<Vec<u32>>,
    /// For each level those that guides keep in one plane with it.
    partners: Vec<Vec<u32>>,
    /// Along each axis the mirror image of each level.
    images: [Option<Vec<u32>>; 3],
    /// Symmetries that the input has without being asked to keep them: the axis across, and the image of each level.
    symmetries: Vec<(usize, Vec<u32>)>,
}

impl Moves {
    /// The moves of a structure that keep together, and mirrored, what guides want so.
    pub(crate) fn new(structure: &Structure, guided: &Guided, symmetries: Vec<(usize, Vec<u32>)>) -> Self {
        let mut below = vec![Vec::new(); structure.levels.len()];
        let mut above = below.clone();
        for edge in &structure.edges {
            let [low, high] = structure.ends(edge);
            below[high as usize].push(low);
            above[low as usize].push(high);
        }
        for list in below.iter_mut().chain(&mut above) {
            list.sort_unstable();
            list.dedup();
        }
        let axis_of: Vec<usize> = structure.levels.iter().map(|l| l.axis).collect();
        let on = |axis| (0..axis_of.len() as u32).filter(|&l| axis_of[l as usize] == axis).collect();
        let images = std::array::from_fn(|axis| guided.mirrors[axis].as_ref().map(|m| m.image.clone()));
        Self {
            by_axis: std::array::from_fn(on),
            axis_of,
            below,
            above,
            partners: guided.partners.clone(),
            images,
            symmetries,
        }
    }

    /// A random change of `from` and the axis it is on, or nothing if the one drawn breaks an edge.
    ///
    /// One in eight merges a whole plane with the next. The others take one level a few planes up or down, onto a plane
    /// or between two; half of these push the levels ahead of it that an edge keeps there. If `paired`, every other
    /// change is one of two levels at once. Where the input is symmetric, half of the changes are made on the mirrored
    /// levels, too.
    pub(crate) fn draw(&self, from: &Ranks, paired: bool, random: &mut SplitMix64) -> Option<(Ranks, usize)> {
        let level = random.below(self.axis_of.len() as u64) as u32;
        let axis = self.axis_of[level as usize];
        let mut keys: Vec<i32> =
            self.by_axis[axis].iter().map(|&l| BETWEEN * i32::from(from.of_level[l as usize])).collect();
        let by = self.change(axis, level, &mut keys, random)?;
        if paired && random.one_in(2) {
            self.change_another(axis, (level, by), from, &mut keys, random)?;
        }
        self.repeat(axis, from, &mut keys, random);
        self.mirror(axis, from, &mut keys)?;
        let mut next = from.clone();
        next.set_axis(axis, &self.by_axis[axis], &keys);
        (next.of_level != from.of_level).then_some((next, axis))
    }

    /// Moves one level, or all on its plane, and says by how much.
    fn change(&self, axis: usize, level: u32, keys: &mut [i32], random: &mut SplitMix64) -> Option<i32> {
        let here = keys[self.slot(axis, level)];
        let kind = random.below(8);
        let direction = if random.one_in(2) { 1 } else { -1 };
        if kind == 0 {
            keys.iter_mut().filter(|k| **k == here).for_each(|k| *k += direction * BETWEEN);
            return Some(direction * BETWEEN);
        }
        let planes = 1 + random.below(REACH) as i32;
        let onto = if random.one_in(2) { 0 } else { BETWEEN / 2 };
        let by = direction * (planes * BETWEEN - onto);
        self.clear_the_way(axis, (level, here + by), direction, kind < 4, keys)?;
        Some(by)
    }

    /// Moves a second level, by as much or by another amount: mostly one that an edge joins to the first, so that what
    /// lies between them moves as a whole.
    fn change_another(
        &self,
        axis: usize,
        (level, by): (u32, i32),
        from: &Ranks,
        keys: &mut [i32],
        random: &mut SplitMix64,
    ) -> Option<()> {
        let (below, above) = (&self.below[level as usize], &self.above[level as usize]);
        let all = &self.by_axis[axis];
        let other = match random.below(4) {
            0 => all[random.below(all.len() as u64) as usize],
            _ => {
                let joined = random.below((below.len() + above.len()).max(1) as u64) as usize;
                *below.iter().chain(above).nth(joined)?
            }
        };
        if random.one_in(2) {
            return self.change(axis, other, keys, random).map(|_| ());
        }
        let to = BETWEEN * i32::from(from.of_level[other as usize]) + by;
        self.clear_the_way(axis, (other, to), by.signum(), random.one_in(2), keys)
    }

    /// `from` with `level` on the plane of `onto`, if no edge forbids it.
    pub(crate) fn align(&self, from: &Ranks, level: u32, onto: u32) -> Option<Ranks> {
        let axis = self.axis_of[level as usize];
        let to = from.of_level[onto as usize];
        let rank = |l: &u32| from.of_level[*l as usize];
        let free = self.below[level as usize].iter().all(|l| rank(l) < to)
            && self.above[level as usize].iter().all(|l| rank(l) > to);
        if !free || rank(&level) == to {
            return None;
        }
        let levels = &self.by_axis[axis];
        let follows = |l: u32| l == level || self.partners[level as usize].contains(&l);
        let key = |l: &u32| BETWEEN * i32::from(if follows(*l) { to } else { rank(l) });
        let mut keys: Vec<i32> = levels.iter().map(key).collect();
        self.mirror(axis, from, &mut keys)?;
        let mut next = from.clone();
        next.set_axis(axis, levels, &keys);
        Some(next)
    }

    fn slot(&self, axis: usize, level: u32) -> usize {
        self.by_axis[axis].partition_point(|&l| l < level)
    }

    /// Makes the moves of levels on their images as well, for one of the symmetries, every other time.
    fn repeat(&self, axis: usize, from: &Ranks, keys: &mut [i32], random: &mut SplitMix64) {
        if self.symmetries.is_empty() || random.one_in(2) {
            return;
        }
        let (across, image) = &self.symmetries[random.below(self.symmetries.len() as u64) as usize];
        let old = |l: u32| BETWEEN * i32::from(from.of_level[l as usize]);
        let moves: Vec<(u32, i32)> =
            self.by_axis[axis].iter().zip(&*keys).map(|(&l, k)| (l, k - old(l))).filter(|m| m.1 != 0).collect();
        for (level, by) in moves {
            let its = image[level as usize];
            let slot = self.slot(axis, its);
            if keys[slot] == old(its) {
                keys[slot] += if *across == axis { -by } else { by };
            }
        }
    }

    /// Gives the images of all levels whose keys changed the mirrored keys; nothing if both changed to what does not
    /// fit.
    fn mirror(&self, axis: usize, from: &Ranks, keys: &mut [i32]) -> Option<()> {
        let Some(images) = &self.images[axis] else { return Some(()) };
        let whole = BETWEEN * (from.planes[axis] as i32 + 1);
        let old = |l: u32| BETWEEN * i32::from(from.of_level[l as usize]);
        let moved: Vec<(u32, i32)> =
            self.by_axis[axis].iter().zip(&*keys).filter(|(l, k)| old(**l) != **k).map(|(&l, &k)| (l, k)).collect();
        for (level, key) in moved {
            let image = images[level as usize];
            let its = &mut keys[self.slot(axis, image)];
            if *its != old(image) && *its != whole - key {
                return None;
            }
            *its = whole - key;
        }
        Some(())
    }

    /// Moves a level, with its partners, to a key, and the levels that an edge keeps ahead of it to just ahead of it,
    /// and so on; nothing if that is not allowed.
    fn clear_the_way(
        &self,
        axis: usize,
        (level, to): (u32, i32),
        direction: i32,
        push: bool,
        keys: &mut [i32],
    ) -> Option<()> {
        let mut stack = Vec::new();
        self.bring(axis, level, to, keys, &mut stack);
        while let Some(l) = stack.pop() {
            let here = keys[self.slot(axis, l)];
            let ahead = if direction > 0 { &self.above[l as usize] } else { &self.below[l as usize] };
            for &m in ahead {
                if direction * keys[self.slot(axis, m)] > direction * here {
                    continue;
                }
                if !push {
                    return None;
                }
                self.bring(axis, m, here + direction, keys, &mut stack);
            }
        }
        Some(())
    }

    /// Gives a level and its partners a key.
    fn bring(&self, axis: usize, level: u32, key: i32, keys: &mut [i32], moved: &mut Vec<u32>) {
        for &l in std::iter::once(&level).chain(&self.partners[level as usize]) {
            keys[self.slot(axis, l)] = key;
            moved.push(l);
        }
    }
}
