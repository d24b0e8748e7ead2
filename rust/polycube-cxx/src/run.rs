//! Long calls: the work on a thread of its own, the caller's thread listening.

use crate::failure::{Failure, Result};
use crate::ffi::Observer;
use polycube::Context;
use polycube_host::Host;

/// The caller, on whose behalf C++ listens.
struct Caller<'a>(&'a Observer);

impl Host for Caller<'_> {
    fn wants_to_stop(&mut self) -> bool {
        self.0.is_cancelled()
    }

    fn report(&mut self, stage: &str, progress: f64) -> bool {
        self.0.report(stage, progress)
    }
}

/// Does `job` on another thread, while this one tells `observer` of its progress and asks whether to stop. A panic
/// becomes an error.
pub fn run<T>(observer: &Observer, job: impl FnOnce(&Context) -> polycube::Result<T> + Send) -> Result<T>
where
    T: Send + 'static,
{
    polycube_host::run(&mut Caller(observer), job).map_err(Failure)
}
