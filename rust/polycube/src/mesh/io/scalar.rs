//! Binary numbers of the types that PLY and VTK files name.

use crate::error::{Error, ErrorKind, Result};

/// The type of a binary number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

/// The order of the bytes of a binary number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Endian {
    Little,
    Big,
}

impl Scalar {
    /// Number of bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// The number in the first bytes. Integers beyond 2^53 are rounded: far more than a mesh can have vertices.
    pub(super) fn read(self, bytes: &[u8], endian: Endian) -> f64 {
        let mut low = [0; 8];
        let size = self.size().min(bytes.len());
        low[..size].copy_from_slice(&bytes[..size]);
        if endian == Endian::Big {
            low[..size].reverse();
        }
        let bits = u64::from_le_bytes(low);
        match self {
            Self::I8 => f64::from(bits as u8 as i8),
            Self::U8 => f64::from(bits as u8),
            Self::I16 => f64::from(bits as u16 as i16),
            Self::U16 => f64::from(bits as u16),
            Self::I32 => f64::from(bits as u32 as i32),
            Self::U32 => f64::from(bits as u32),
            Self::I64 => bits as i64 as f64,
            Self::U64 => bits as f64,
            Self::F32 => f64::from(f32::from_bits(bits as u32)),
            Self::F64 => f64::from_bits(bits),
        }
    }

    /// All the numbers in `bytes`.
    pub(super) fn read_all(self, bytes: &[u8], endian: Endian) -> Vec<f64> {
        let chunks = bytes.chunks_exact(self.size());
        chunks.map(|chunk| self.read(chunk, endian)).collect()
    }
}

/// A number that should be a vertex index or a size.
pub(super) fn whole(value: f64) -> Result<u32> {
    if value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value) {
        return Ok(value as u32);
    }
    let message = format!("{value} is no vertex index and no size");
    Err(Error::new(ErrorKind::Parse, message))
}
