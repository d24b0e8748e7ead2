//! What is known of the order of two levels: a set of the relations `<`, `=` and `>` for every pair, closed under
//! composition (`a < b` and `b ≤ c` give `a < c`).

use crate::structure::Structure;

/// The first level lies below the second.
pub(super) const BELOW: u8 = 1;
/// Both lie on one plane.
pub(super) const EQUAL: u8 = 2;
/// The first level lies above the second.
pub(super) const ABOVE: u8 = 4;
/// Nothing is known.
pub(super) const ANY: u8 = 7;

/// Where the pairs of levels are kept: one square table per axis.
#[derive(Clone, Debug)]
pub(super) struct Pairs {
    row: Vec<u32>,
    column: Vec<u32>,
    axis: Vec<usize>,
    /// The levels of each axis.
    pub of_axis: [Vec<u32>; 3],
    len: usize,
}

impl Pairs {
    pub(super) fn new(structure: &Structure) -> Self {
        let axis: Vec<usize> = structure.levels.iter().map(|l| l.axis).collect();
        let of_axis: [Vec<u32>; 3] =
            std::array::from_fn(|a| (0..axis.len() as u32).filter(|&l| axis[l as usize] == a).collect());
        let mut pairs = Self { row: vec![0; axis.len()], column: vec![0; axis.len()], axis, of_axis, len: 0 };
        for levels in &pairs.of_axis {
            for (i, &level) in levels.iter().enumerate() {
                pairs.row[level as usize] = (pairs.len + i * levels.len()) as u32;
                pairs.column[level as usize] = i as u32;
            }
            pairs.len += levels.len() * levels.len();
        }
        pairs
    }

    /// How many ordered pairs there are.
    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// Where the pair of two levels of one axis is kept.
    pub(super) fn cell(&self, a: u32, b: u32) -> usize {
        (self.row[a as usize] + self.column[b as usize]) as usize
    }

    /// The levels on the axis of `level`.
    pub(super) fn along(&self, level: u32) -> &[u32] {
        &self.of_axis[self.axis[level as usize]]
    }
}

/// The relations that each pair of levels can still have.
#[derive(Clone, Debug)]
pub(super) struct Relations(Vec<u8>);

impl Relations {
    /// Nothing is known but that a level equals itself.
    pub(super) fn new(pairs: &Pairs) -> Self {
        let mut relations = Self(vec![ANY; pairs.len()]);
        for &level in pairs.of_axis.iter().flatten() {
            relations.0[pairs.cell(level, level)] = EQUAL;
        }
        relations
    }

    /// What `a` can be to `b`, two levels of one axis.
    pub(super) fn get(&self, pairs: &Pairs, a: u32, b: u32) -> u8 {
        self.0[pairs.cell(a, b)]
    }

    /// Whether `a` lies below `b` in every completion.
    pub(super) fn below(&self, pairs: &Pairs, a: u32, b: u32) -> bool {
        self.get(pairs, a, b) == BELOW
    }

    /// Keeps only the relations in `mask`; whether that changed anything.
    pub(super) fn keep(&mut self, pairs: &Pairs, a: u32, b: u32, mask: u8) -> bool {
        let cell = pairs.cell(a, b);
        let kept = self.0[cell] & mask;
        let changed = kept != self.0[cell];
        self.0[cell] = kept;
        self.0[pairs.cell(b, a)] = flipped(kept);
        changed
    }

    /// The number of bytes that it fills.
    pub(super) fn size(&self) -> usize {
        self.0.len()
    }
}

/// Whether a set holds one relation only.
pub(super) fn is_decided(relation: u8) -> bool {
    relation.count_ones() == 1
}

/// The relations of `b` to `a` when those of `a` to `b` are given.
pub(super) fn flipped(relation: u8) -> u8 {
    (relation & EQUAL) | (relation & BELOW) << 2 | (relation & ABOVE) >> 2
}

/// The relations that `a` can have to `c` when those of `a` to `b` and of `b` to `c` are given.
pub(super) fn composed(ab: u8, bc: u8) -> u8 {
    const fn single(x: u8, y: u8) -> u8 {
        match (x, y) {
            (EQUAL, y) => y,
            (x, EQUAL) => x,
            (x, y) if x == y => x,
            _ => ANY,
        }
    }
    const fn table() -> [u8; 64] {
        let mut table = [0; 64];
        let mut i = 0;
        while i < 64 * 9 {
            let (cell, x, y) = (i / 9, 1 << (i % 3), 1 << (i / 3 % 3));
            if (cell as u8 / 8) & x != 0 && (cell as u8 % 8) & y != 0 {
                table[cell] |= single(x, y);
            }
            i += 1;
        }
        table
    }
    const TABLE: [u8; 64] = table();
    TABLE[usize::from(ab) * 8 + usize::from(bc)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relations_compose_and_flip() {
        assert_eq!(composed(BELOW, BELOW), BELOW);
        assert_eq!(composed(BELOW | EQUAL, BELOW), BELOW);
        assert_eq!(composed(BELOW | EQUAL, EQUAL | BELOW), BELOW | EQUAL);
        assert_eq!(composed(BELOW, ABOVE), ANY);
        assert_eq!(composed(EQUAL, ABOVE | EQUAL), ABOVE | EQUAL);
        assert_eq!([BELOW, EQUAL, ABOVE].map(flipped), [ABOVE, EQUAL, BELOW]);
    }
}
