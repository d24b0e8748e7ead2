//! Small changes of an order of levels: the steps of a search.

use crate::align::ranks::Ranks;
use crate::generate::SplitMix64;
use crate::structure::Structure;

/// Ranks are multiplied by this, so that levels can be put between planes.
const BETWEEN: i32 = 64;
/// The farthest that a level jumps, in planes.
const REACH: u64 = 3;

/// The neighbourhood of orders: which levels an edge keeps below which.
pub struct Moves {
    axis_of: Vec<usize>,
    by_axis: [Vec<u32>; 3],
    below: Vec<Vec<u32>>,
    above: Vec<Vec<u32>>,
}

impl Moves {
    /// The moves of a structure.
    pub fn new(structure: &Structure) -> Self {
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
        Self { by_axis: std::array::from_fn(on), axis_of, below, above }
    }

    /// A random change of `from` and the axis it is on, or nothing if the one drawn breaks an edge.
    ///
    /// One in eight merges a whole plane with the next. The others take one level a few planes up or down, onto a plane or
    /// between two; half of these push the levels ahead of it that an edge keeps there.
    pub fn draw(&self, from: &Ranks, random: &mut SplitMix64) -> Option<(Ranks, usize)> {
        let level = random.below(self.axis_of.len() as u64) as u32;
        let axis = self.axis_of[level as usize];
        let mut keys: Vec<i32> =
            self.by_axis[axis].iter().map(|&l| BETWEEN * i32::from(from.of_level[l as usize])).collect();
        let here = keys[self.slot(axis, level)];
        let kind = random.below(8);
        let direction = if random.one_in(2) { 1 } else { -1 };
        if kind == 0 {
            keys.iter_mut().filter(|k| **k == here).for_each(|k| *k += direction * BETWEEN);
        } else {
            let planes = 1 + random.below(REACH) as i32;
            let onto = if random.one_in(2) { 0 } else { BETWEEN / 2 };
            keys[self.slot(axis, level)] = here + direction * (planes * BETWEEN - onto);
            self.clear_the_way(axis, level, direction, kind < 4, &mut keys)?;
        }
        let mut next = from.clone();
        next.set_axis(axis, &self.by_axis[axis], &keys);
        (next.of_level != from.of_level).then_some((next, axis))
    }

    /// `from` with `level` on the plane of `onto`, if no edge forbids it.
    pub fn align(&self, from: &Ranks, level: u32, onto: u32) -> Option<Ranks> {
        let axis = self.axis_of[level as usize];
        let to = from.of_level[onto as usize];
        let rank = |l: &u32| from.of_level[*l as usize];
        let free = self.below[level as usize].iter().all(|l| rank(l) < to)
            && self.above[level as usize].iter().all(|l| rank(l) > to);
        if !free || rank(&level) == to {
            return None;
        }
        let levels = &self.by_axis[axis];
        let keys: Vec<u16> = levels.iter().map(|&l| if l == level { to } else { rank(&l) }).collect();
        let mut next = from.clone();
        next.set_axis(axis, levels, &keys);
        Some(next)
    }

    fn slot(&self, axis: usize, level: u32) -> usize {
        self.by_axis[axis].partition_point(|&l| l < level)
    }

    /// Moves the levels that an edge keeps ahead of `level` to just ahead of it, and so on; nothing if that is not allowed.
    fn clear_the_way(&self, axis: usize, level: u32, direction: i32, push: bool, keys: &mut [i32]) -> Option<()> {
        let mut stack = vec![level];
        while let Some(l) = stack.pop() {
            let here = keys[self.slot(axis, l)];
            let ahead = if direction > 0 { &self.above[l as usize] } else { &self.below[l as usize] };
            for &m in ahead {
                let key = &mut keys[self.slot(axis, m)];
                if direction * *key > direction * here {
                    continue;
                }
                if !push {
                    return None;
                }
                *key = here + direction;
                stack.push(m);
            }
        }
        Some(())
    }
}
