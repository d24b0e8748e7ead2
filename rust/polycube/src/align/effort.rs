//! How long the search may take.

use std::time::Duration;

/// How long the search may take.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct Effort {
    /// Moves tried per level in each of the eight chains; the result is the same for the same number.
    pub steps_per_level: u32,
    /// Partial orders that the proof of a lower bound looks at; 0 for a quick bound.
    pub proof_nodes: u64,
    /// Stop after this time, with the best found; the result then depends on the machine. Written as seconds.
    #[serde(serialize_with = "in_seconds")]
    pub time_limit: Option<Duration>,
}

impl Default for Effort {
    fn default() -> Self {
        Self { steps_per_level: 400, proof_nodes: 200, time_limit: None }
    }
}

#[allow(clippy::ref_option, reason = "serde passes a reference")]
fn in_seconds<S: serde::Serializer>(limit: &Option<Duration>, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serde::Serialize::serialize(&limit.map(|l| l.as_secs_f64()), serializer)
}
