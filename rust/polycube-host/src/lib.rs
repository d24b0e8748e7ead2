//! Long calls on behalf of a host, a program in another language: the work on a thread of its own, while the host hears
//! of its progress and may stop it. A panic becomes an error.
//!
//! [`run`] blocks the caller's thread and attends to the host there, as most hosts may only be called on the thread
//! that made the call; [`Work`] goes on in the background and is looked at from time to time.
//!
//! ```
//! use polycube_host::{Host, run};
//!
//! struct Impatient;
//!
//! impl Host for Impatient {
//!     fn wants_to_stop(&mut self) -> bool {
//!         false
//!     }
//!     fn report(&mut self, _stage: &str, progress: f64) -> bool {
//!         progress < 0.5
//!     }
//! }
//!
//! let stopped: polycube::Result<()> = run(&mut Impatient, |context| loop {
//!     context.stage("work", 0.0, 1.0).tick(0.7)?;
//! });
//! assert_eq!(stopped.unwrap_err().kind, polycube::ErrorKind::Cancelled);
//! ```
#![deny(missing_docs)]

mod board;
mod guard;
mod run;
#[cfg(test)]
mod tests;
mod work;

pub use guard::guard;
pub use run::{Host, run};
pub use work::Work;
