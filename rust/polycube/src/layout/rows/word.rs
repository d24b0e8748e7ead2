//! Words of bits, as wide as a row needs.

use std::ops::{BitAnd, BitOr, BitXor, Not, Shl, Shr};

/// A row of bits; bit 0 is the lowest. Shifts by the width or more give zero bits for [`Wide`] only, so rows never
/// shift that far.
pub trait Word:
    Copy
    + PartialEq
    + Send
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
    + Not<Output = Self>
    + Shl<usize, Output = Self>
    + Shr<usize, Output = Self>
{
    /// The number of bits.
    const BITS: usize;
    /// No bit set.
    const ZERO: Self;
    /// The lowest bit set.
    const ONE: Self;
    /// How many bits are set.
    fn count_ones(self) -> u32;

    /// Whether no bit is set.
    fn is_zero(self) -> bool {
        self == Self::ZERO
    }
}

macro_rules! primitive {
    ($($word:ty),*) => {$(
        impl Word for $word {
            const BITS: usize = <$word>::BITS as usize;
            const ZERO: Self = 0;
            const ONE: Self = 1;

            fn count_ones(self) -> u32 {
                self.count_ones()
            }
        }
    )*};
}

primitive!(u64, u128);

/// A word of `64 N` bits, the lowest 64 first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Wide<const N: usize>([u64; N]);

impl<const N: usize> Wide<N> {
    /// Plain loops, which compilers unroll and inline where closures over arrays are called.
    #[inline]
    fn zip(mut self, other: Self, operation: impl Fn(u64, u64) -> u64) -> Self {
        for (own, its) in self.0.iter_mut().zip(other.0) {
            *own = operation(*own, its);
        }
        self
    }
}

impl<const N: usize> BitAnd for Wide<N> {
    type Output = Self;
    #[inline]
    fn bitand(self, other: Self) -> Self {
        self.zip(other, |a, b| a & b)
    }
}

impl<const N: usize> BitOr for Wide<N> {
    type Output = Self;
    #[inline]
    fn bitor(self, other: Self) -> Self {
        self.zip(other, |a, b| a | b)
    }
}

impl<const N: usize> BitXor for Wide<N> {
    type Output = Self;
    #[inline]
    fn bitxor(self, other: Self) -> Self {
        self.zip(other, |a, b| a ^ b)
    }
}

impl<const N: usize> Not for Wide<N> {
    type Output = Self;
    #[inline]
    fn not(self) -> Self {
        Self(self.0.map(|word| !word))
    }
}

impl<const N: usize> Shl<usize> for Wide<N> {
    type Output = Self;
    #[inline]
    fn shl(self, by: usize) -> Self {
        let (words, bits) = (by / 64, by % 64);
        let mut shifted = [0; N];
        for (i, word) in shifted.iter_mut().enumerate().skip(words) {
            *word = self.0[i - words] << bits;
            if bits > 0 && i > words {
                *word |= self.0[i - words - 1] >> (64 - bits);
            }
        }
        Self(shifted)
    }
}

impl<const N: usize> Shr<usize> for Wide<N> {
    type Output = Self;
    #[inline]
    fn shr(self, by: usize) -> Self {
        let (words, bits) = (by / 64, by % 64);
        let mut shifted = [0; N];
        for i in words..N {
            shifted[i - words] = self.0[i] >> bits;
            if bits > 0 && i + 1 < N {
                shifted[i - words] |= self.0[i + 1] << (64 - bits);
            }
        }
        Self(shifted)
    }
}

impl<const N: usize> Word for Wide<N> {
    const BITS: usize = 64 * N;
    const ZERO: Self = Self([0; N]);
    const ONE: Self = Self({
        let mut words = [0; N];
        words[0] = 1;
        words
    });

    fn count_ones(self) -> u32 {
        self.0.iter().map(|word| word.count_ones()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn wide(x: u128) -> Wide<2> {
        Wide([x as u64, (x >> 64) as u64])
    }

    proptest! {
        #[test]
        fn two_words_are_one_of_twice_the_width(a: u128, b: u128, by in 0..128_usize) {
            prop_assert_eq!(wide(a) & wide(b), wide(a & b));
            prop_assert_eq!(wide(a) | wide(b), wide(a | b));
            prop_assert_eq!(wide(a) ^ wide(b), wide(a ^ b));
            prop_assert_eq!(!wide(a), wide(!a));
            prop_assert_eq!(wide(a) << by, wide(a << by));
            prop_assert_eq!(wide(a) >> by, wide(a >> by));
            prop_assert_eq!(Word::count_ones(wide(a)), a.count_ones());
        }
    }
}
