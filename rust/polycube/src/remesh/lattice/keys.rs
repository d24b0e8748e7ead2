//! Lattice vertices packed into one number each, ordered by z, then y, then x.

use crate::error::{Error, ErrorKind, Result};

/// Bits of one coordinate.
const BITS: u32 = 21;
const MASK: u64 = (1 << BITS) - 1;

/// How vertices of one lattice are numbered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Keys {
    origin: [i64; 3],
}

impl Keys {
    /// Keys for the lattice vertices between `low` and `high`.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] when the box is 2²¹ steps long or longer.
    pub(crate) fn new(low: [i64; 3], high: [i64; 3]) -> Result<Self> {
        if (0..3).all(|a| high[a] - low[a] < 1 << BITS) {
            return Ok(Self { origin: low });
        }
        Err(too_fine("the lattice is more than two million steps long"))
    }

    /// The number of vertex `at`.
    pub(crate) fn key(&self, at: [i64; 3]) -> u64 {
        let [x, y, z] = std::array::from_fn(|a| (at[a] - self.origin[a]) as u64);
        z << (2 * BITS) | y << BITS | x
    }

    /// The number of vertex `at`, if it has one.
    pub(crate) fn checked_key(&self, at: [i64; 3]) -> Option<u64> {
        (0..3).all(|a| (0..1 << BITS).contains(&(at[a] - self.origin[a]))).then(|| self.key(at))
    }

    /// The vertex numbered `key`.
    pub(crate) fn vertex(&self, key: u64) -> [i64; 3] {
        std::array::from_fn(|a| (key >> (a as u32 * BITS) & MASK) as i64 + self.origin[a])
    }

    /// How much the number grows by a step along `axis`.
    pub(crate) fn step(axis: usize) -> u64 {
        1 << (axis as u32 * BITS)
    }

    /// How much the number grows from a cell's lowest vertex to its vertex `c`: bit `a` of `c` for a step along `a`.
    pub(crate) fn octant(c: usize) -> u64 {
        (0..3).filter(|a| c >> a & 1 == 1).map(Self::step).sum()
    }
}

/// The error for a lattice that is finer than indices can count.
pub(crate) fn too_fine(message: &str) -> Error {
    Error::new(ErrorKind::Option, message).remedy("ask for fewer hexahedra, a longer edge length or a smaller scale")
}

/// The position of `key` among the ascending `keys`.
pub(crate) fn rank(keys: &[u64], key: u64) -> Option<u32> {
    keys.binary_search(&key).ok().map(|i| i as u32)
}

/// The positions of the ascending `queries` among the ascending `keys`, in one walk; `None` where one is missing.
pub(crate) fn ranks(keys: &[u64], queries: impl Iterator<Item = u64>) -> Option<Vec<u32>> {
    let mut at = 0;
    let find = |q: u64| {
        while keys.get(at).is_some_and(|&k| k < q) {
            at += 1;
        }
        (keys.get(at) == Some(&q)).then_some(at as u32)
    };
    queries.map(find).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_go_both_ways_and_ascend() {
        let keys = Keys::new([-3, 5, -7], [9, 9, 9]).unwrap();
        for at in [[-3, 5, -7], [9, 9, 9], [0, 6, -1]] {
            assert_eq!(keys.vertex(keys.key(at)), at);
        }
        assert!(keys.key([9, 9, 0]) < keys.key([-3, 5, 1]));
        assert_eq!(keys.key([1, 7, 1]) - keys.key([0, 6, 0]), Keys::octant(7));
        assert_eq!(Keys::new([0; 3], [1 << 21, 1, 1]).unwrap_err().kind, ErrorKind::Option);
    }

    #[test]
    fn ranks_walk_once() {
        assert_eq!(ranks(&[1, 4, 6], [1, 6].into_iter()), Some(vec![0, 2]));
        assert_eq!(ranks(&[1, 4, 6], [1, 5].into_iter()), None);
        assert_eq!(rank(&[1, 4, 6], 4), Some(1));
    }
}
