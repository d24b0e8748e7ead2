//! Turn a polycube into the coarsest good block structure there is.
//!
//! [`simplify`](simplify::simplify) is the way in. Data flows one way:
//! [`mesh`] → [`structure`] → [`align`] → [`layout`] → [`map`] → [`remesh`].

pub mod align;
pub mod compare;
pub mod context;
pub mod error;
pub mod generate;
pub mod layout;
pub mod map;
pub mod mesh;
pub mod optimise;
pub mod remesh;
pub mod simplify;
pub mod structure;
pub mod validate;

pub use context::Context;
pub use error::{Error, ErrorKind, Place, Result};
pub use simplify::{Input, Options, Report, Simplified};
