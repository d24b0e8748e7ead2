//! Turn a polycube into the coarsest good block structure there is.
//!
//! [`simplify`](simplify::simplify) is the way in, [`remesh`](remesh::remesh) goes on to quadrilaterals and hexahedra.
//! Data flows one way: [`mesh`] → [`structure`] → [`layout`] → [`align`] → `map` → `optimise` → [`mod@simplify`] →
//! [`mod@remesh`] → [`mod@compare`]. Beside it stand [`mod@validate`], which lists all that is wrong with an input, and
//! [`generate`], which makes examples.
//!
//! Words: a **chart** is a set of boundary faces with one direction that hang together on the mesh; the **facet** is
//! the same set as a plane region of the polycube. A facet has a **level**, its coordinate along its axis; facets of
//! one axis that meet at a corner share one.
//!
//! ```
//! use polycube::generate::{Example, example};
//! use polycube::mesh::{CellKind, Format, write_bytes};
//! use polycube::simplify::simplify;
//! use polycube::{Context, Input, SimplifyOptions};
//!
//! // `polycube::mesh::read` reads your own.
//! let (cube, shape) = example(Example::Ring, 1, CellKind::Quads)?;
//! let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
//! let simple = simplify(&input, &SimplifyOptions::default(), &Context::default())?;
//!
//! let after = simple.report.after.expect("only `naive` gives results without counts");
//! assert!(after.blocks_padded < simple.report.before.blocks_padded);
//! let file = write_bytes(Format::Obj, simple.polycube.as_ref().expect("so there is a mesh"), &[])?;
//! # assert!(!file.is_empty());
//! # Ok::<(), polycube::Error>(())
//! ```

pub mod align;
pub mod compare;
pub mod context;
pub mod error;
pub mod generate;
mod input;
pub mod layout;
pub mod make;
mod map;
pub mod measure;
pub mod mesh;
mod optimise;
#[doc(hidden)]
pub mod parts;
mod range;
pub mod remesh;
pub mod repair;
mod rng;
pub mod simplify;
mod spatial;
pub mod structure;
pub mod validate;

#[cfg(test)]
#[path = "../tests/common/data.rs"]
mod data;

pub use context::Context;
pub use error::{Error, ErrorKind, Place, Result};
pub use input::Input;
pub use simplify::{Simplified, SimplifyOptions, SimplifyReport};
