//! A result as bytes, to be taken up again in another process.

use super::{Input, Simplified, SimplifyOptions, SimplifyReport, read_structure};
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::repair::Repaired;

/// What of a result cannot be read off its meshes.
#[derive(bitcode::Encode, bitcode::Decode)]
struct State {
    levels: Vec<i64>,
    report: SimplifyReport,
    options: SimplifyOptions,
}

impl Simplified {
    /// All but the meshes as bytes, which only the same version of this crate understands.
    #[doc(hidden)]
    pub fn state(&self) -> Vec<u8> {
        let Self { levels, report, options, .. } = self;
        bitcode::encode(&State { levels: levels.clone(), report: report.clone(), options: options.clone() })
    }

    /// The result whose [`state`](Self::state) this is, made from `input`, with its mesh. Reads the structure of the
    /// input again, and searches for nothing.
    ///
    /// # Errors
    /// [`ErrorKind::Parse`] for other bytes; those of [`read_structure`].
    #[doc(hidden)]
    pub fn from_state(input: &Input, polycube: Option<Mesh>, state: &[u8]) -> Result<Self> {
        let wrong = |e: bitcode::Error| Error::new(ErrorKind::Parse, format!("this is no result: {e}"));
        let State { levels, report, options } = bitcode::decode(state).map_err(wrong)?;
        let repaired = options.repaired(input);
        let structure = read_structure(&repaired.as_ref().map_or(*input, Repaired::input), &options.tolerance)?;
        Ok(Self { input: structure, polycube, levels, report, options })
    }
}
