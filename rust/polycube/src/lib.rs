//! Turn a polycube into the coarsest good block structure there is.
//!
//! Data flows one way: [`mesh`] → [`structure`] → [`align`] → [`layout`] → [`map`].

pub mod align;
pub mod context;
pub mod error;
pub mod generate;
pub mod layout;
pub mod map;
pub mod mesh;
pub mod optimise;
pub mod structure;

pub use context::Context;
pub use error::{Error, ErrorKind, Place, Result};
