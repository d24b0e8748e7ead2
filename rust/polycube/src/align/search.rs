//! Fewer blocks than Algorithm 1: a search over orders of levels that counts blocks at every step.

use super::ranks::Ranks;
use crate::context::Context;
use crate::error::Result;
use crate::generate::SplitMix64;
use crate::layout::{Counts, Rows};
use crate::structure::Structure;
use num_traits::PrimInt;

/// Simulated annealing
pub struct Search<'a, R> {
    structure: &'a Structure,
    rows: Rows<R>,
    random: SplitMix64,
    below: Vec<Vec<u32>>,
    above: Vec<Vec<u32>>,
    by_axis: [Vec<u32>; 3],
    targets: &'a [f64],
    gap: f64,
    weight: f64,
}

#[derive(Clone)]
pub struct State {
    pub ranks: Ranks,
    pub counts: Counts,
    pub shape: [f64; 3],
}

const STEP: i32 = 64;

impl<'a, R: PrimInt> Search<'a, R> {
    pub fn new(structure: &'a Structure, targets: &'a [f64], gap: f64, seed: u64) -> Self {
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
        let by_axis = std::array::from_fn(|a| {
            (0..structure.levels.len() as u32).filter(|&l| structure.levels[l as usize].axis == a).collect()
        });
        Self {
            structure,
            rows: Rows::new(structure),
            random: SplitMix64::new(seed),
            below,
            above,
            by_axis,
            targets,
            gap,
            weight: 0.0,
        }
    }

    pub fn state(&mut self, ranks: Ranks) -> Option<State> {
        let counts = self.rows.count(&ranks.of_level, ranks.planes)?;
        let shape = std::array::from_fn(|a| self.shape(&ranks, a));
        Some(State { ranks, counts, shape })
    }

    fn shape(&self, ranks: &Ranks, axis: usize) -> f64 {
        ranks.shape_cost(self.structure, self.targets, self.gap, axis)
    }

    fn energy(&self, s: &State) -> f64 {
        s.counts.blocks_padded as f64 + self.weight * (s.shape[0] + s.shape[1] + s.shape[2]).sqrt()
    }

    pub fn anneal(
        &mut self,
        start: State,
        iterations: usize,
        hot: f64,
        cold: f64,
        weight: f64,
        context: &Context,
    ) -> Result<State> {
        self.weight = weight;
        let mut now = start.clone();
        let mut best = start;
        for i in 0..iterations {
            if i % 256 == 0 {
                context.tick(i as f64 / iterations as f64)?;
            }
            let t = hot * (cold / hot).powf(i as f64 / iterations as f64);
            let Some(ranks) = self.propose(&now.ranks) else { continue };
            let axis = (0..3)
                .find(|&a| {
                    self.by_axis[a].iter().any(|&l| ranks.of_level[l as usize] != now.ranks.of_level[l as usize])
                })
                .unwrap_or(0);
            let Some(counts) = self.rows.count(&ranks.of_level, ranks.planes) else { continue };
            let delta = counts.blocks_padded as f64 - now.counts.blocks_padded as f64;
            if delta > 12.0 * t {
                continue;
            }
            let mut shape = now.shape;
            shape[axis] = self.shape(&ranks, axis);
            let next = State { ranks, counts, shape };
            let de = self.energy(&next) - self.energy(&now);
            if de <= 0.0 || self.uniform() < (-de / t).exp() {
                now = next;
                if self.energy(&now) < self.energy(&best) - 1e-9 {
                    best = now.clone();
                }
            }
        }
        Ok(best)
    }

    fn uniform(&mut self) -> f64 {
        (self.random.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below_n(&mut self, n: usize) -> usize {
        (self.random.next_u64() % n as u64) as usize
    }

    fn propose(&mut self, from: &Ranks) -> Option<Ranks> {
        let n = self.structure.levels.len();
        let level = self.below_n(n) as u32;
        let axis = self.structure.levels[level as usize].axis;
        let mut keys: Vec<i32> =
            self.by_axis[axis].iter().map(|&l| i32::from(from.of_level[l as usize]) * STEP).collect();
        let kind = self.random.next_u64() % 8;
        let (reach, dir) = (1 + self.below_n(3) as i32, self.random.next_u64() % 4);
        let slot = |l: u32| self.by_axis[axis].binary_search(&l).unwrap_or(0);
        if kind == 0 {
            // merge the plane with a neighbour plane
            let k = keys[slot(level)];
            let to = if dir % 2 == 0 { k + STEP } else { k - STEP };
            keys.iter_mut().filter(|x| **x == k).for_each(|x| *x = to);
        } else {
            let k = keys[slot(level)];
            let to = match dir {
                0 => k + STEP * reach,
                1 => k - STEP * reach,
                2 => k + STEP * reach - STEP / 2,
                _ => k - STEP * reach + STEP / 2,
            };
            keys[slot(level)] = to;
            let up = to > k;
            let push = kind < 4;
            let mut stack = vec![level];
            while let Some(l) = stack.pop() {
                let here = keys[slot(l)];
                let list = if up { &self.above[l as usize] } else { &self.below[l as usize] };
                for &m in list {
                    let s = slot(m);
                    if up && keys[s] <= here {
                        if !push {
                            return None;
                        }
                        keys[s] = here + 1;
                        stack.push(m);
                    }
                    if !up && keys[s] >= here {
                        if !push {
                            return None;
                        }
                        keys[s] = here - 1;
                        stack.push(m);
                    }
                }
            }
        }
        let mut next = from.clone();
        next.set_axis(axis, &self.by_axis[axis], &keys);
        (next.of_level != from.of_level).then_some(next)
    }
}
