//! Orders of levels, as one rank per level.

use crate::structure::{Placement, Structure};

/// For every level the number of its plane along its axis, counted from 1 without gaps.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Ranks {
    /// The rank of each level.
    pub of_level: Vec<u16>,
    /// The number of planes along each axis.
    pub planes: [usize; 3],
}

impl Ranks {
    /// The order of a placement.
    pub fn new(structure: &Structure, placement: &[f64]) -> Self {
        let mut ranks = Self { of_level: vec![0; placement.len()], planes: [0; 3] };
        for axis in 0..3 {
            let levels: Vec<u32> =
                (0..placement.len() as u32).filter(|&l| structure.levels[l as usize].axis == axis).collect();
            let keys: Vec<f64> = levels.iter().map(|&l| placement[l as usize]).collect();
            ranks.set_axis(axis, &levels, &keys);
        }
        ranks
    }

    /// Orders the levels of one axis by their keys.
    pub fn set_axis<K: PartialOrd + Copy>(&mut self, axis: usize, levels: &[u32], keys: &[K]) {
        let mut sorted = keys.to_vec();
        sorted.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        sorted.dedup_by(|a, b| a == b);
        for (&level, key) in levels.iter().zip(keys) {
            self.of_level[level as usize] = sorted.partition_point(|k| k < key) as u16 + 1;
        }
        self.planes[axis] = sorted.len();
    }

    /// A placement with this order.
    pub fn placement(&self) -> Placement {
        self.of_level.iter().map(|&r| f64::from(r)).collect()
    }

    /// The least Σ weight · (x − target)² along `axis` over placements with this order and planes `gap` apart.
    ///
    /// Subtracting `gap` per plane leaves an isotonic regression, solved by pooling adjacent violators in O(n).
    pub fn shape_cost(&self, structure: &Structure, weights: &[f64], targets: &[f64], gap: f64, axis: usize) -> f64 {
        let mut planes = vec![(0.0, 0.0, 0.0); self.planes[axis]];
        for (((level, &rank), target), &w) in structure.levels.iter().zip(&self.of_level).zip(targets).zip(weights) {
            if level.axis == axis {
                let plane = &mut planes[usize::from(rank) - 1];
                let t = target - gap * f64::from(rank);
                *plane = (plane.0 + w, plane.1 + w * t, plane.2 + w * t * t);
            }
        }
        let mut pools: Vec<(f64, f64, f64)> = Vec::with_capacity(planes.len());
        for plane in planes {
            let mut pool = plane;
            while let Some(last) = pools.last()
                && last.1 * pool.0 >= pool.1 * last.0
            {
                pool = (pool.0 + last.0, pool.1 + last.1, pool.2 + last.2);
                pools.pop();
            }
            pools.push(pool);
        }
        pools.iter().map(|p| p.2 - p.1 * p.1 / p.0).sum()
    }
}
