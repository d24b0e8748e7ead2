//! Work on a thread of its own, so that Python goes on, Ctrl-C is heard, and a panic ends in an exception.

use crate::errors;
use polycube::{Context, Error, ErrorKind};
use polycube_host::Host;
use pyo3::prelude::*;
use std::time::{Duration, Instant};

/// How often waiting for a job listens to signals.
const POLL: Duration = Duration::from_millis(30);

/// An error, and the middle of the element it is about.
#[derive(Clone)]
pub struct Failure {
    error: Box<Error>,
    at: Option<[f64; 3]>,
}

impl Failure {
    /// An error about an element of `mesh`.
    pub fn new(error: Error, mesh: &polycube::mesh::Mesh) -> Self {
        let at = error.place.and_then(|place| mesh.middle(place));
        Self { error: Box::new(error), at }
    }

    fn raise(&self, py: Python<'_>) -> PyErr {
        errors::raise(py, &self.error, self.at)
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self { error: Box::new(error), at: None }
    }
}

/// What the work came to.
pub type Outcome<T> = Result<T, Failure>;

/// Work going on in the background.
pub type Work<T> = polycube_host::Work<T, Failure>;

/// Starts `task` in the background.
///
/// # Errors
/// [`ErrorKind::Internal`] when the system gives no thread.
pub fn start<T: Send + 'static>(
    py: Python<'_>,
    task: impl FnOnce(&Context) -> Outcome<T> + Send + 'static,
) -> PyResult<Work<T>> {
    Work::start(task).map_err(|e| errors::raise(py, &e, None))
}

/// Waits at most `time` for an outcome, or for ever, letting other Python threads run and hearing signals.
///
/// # Errors
/// What a signal handler raised.
pub fn wait_for<T: Send + 'static>(work: &Work<T>, py: Python<'_>, time: Option<Duration>) -> PyResult<bool> {
    let end = time.and_then(|time| Instant::now().checked_add(time));
    loop {
        let left = end.map_or(POLL, |end| POLL.min(end.saturating_duration_since(Instant::now())));
        if py.detach(|| work.wait(left)) {
            return Ok(true);
        }
        if end.is_some_and(|end| Instant::now() >= end) {
            return Ok(false);
        }
        py.check_signals()?;
    }
}

/// What the work came to; waits for it.
///
/// # Errors
/// Those of the work, and what a signal handler raised.
pub fn outcome<T: Clone + Send + 'static>(work: &Work<T>, py: Python<'_>) -> PyResult<T> {
    wait_for(work, py, None)?;
    let nothing = || Err(Error::new(ErrorKind::Internal, "the work came to nothing").into());
    work.outcome().unwrap_or_else(nothing).map_err(|failure: Failure| failure.raise(py))
}

/// What a call listens to and reports to while it works.
pub struct Listener<'py> {
    /// Called as `progress(stage, fraction)`.
    pub progress: Option<Bound<'py, PyAny>>,
    /// Has `is_set()`.
    pub cancel: Option<Bound<'py, PyAny>>,
}

impl<'py> Listener<'py> {
    /// Runs `task` and waits for it: calls `progress` on this thread, listens to `cancel` and to Ctrl-C. What these
    /// raise cancels the work and is raised once it has stopped.
    pub fn run<T: Send + 'static>(
        &self,
        py: Python<'py>,
        task: impl FnOnce(&Context) -> Outcome<T> + Send,
    ) -> PyResult<T> {
        let mut caller = Caller { py, listener: self, raised: None };
        let outcome = polycube_host::run(&mut caller, task);
        caller.raised.map_or_else(|| outcome.map_err(|failure| failure.raise(py)), Err)
    }

    fn wants_to_stop(&self, py: Python<'py>) -> PyResult<bool> {
        py.check_signals()?;
        self.cancel.as_ref().map_or(Ok(false), |cancel| cancel.call_method0("is_set")?.is_truthy())
    }

    fn report(&self, stage: &str, fraction: f64) -> PyResult<()> {
        self.progress.as_ref().map_or(Ok(()), |progress| progress.call1((stage, fraction)).map(drop))
    }
}

/// The Python code that made a call, and what it raised meanwhile.
struct Caller<'a, 'py> {
    py: Python<'py>,
    listener: &'a Listener<'py>,
    raised: Option<PyErr>,
}

impl Host for Caller<'_, '_> {
    fn wants_to_stop(&mut self) -> bool {
        self.listener.wants_to_stop(self.py).unwrap_or_else(|raised| {
            self.raised = Some(raised);
            true
        })
    }

    fn report(&mut self, stage: &str, progress: f64) -> bool {
        self.raised = self.listener.report(stage, progress).err();
        self.raised.is_none()
    }

    fn meanwhile(&mut self, wait: impl FnOnce() -> bool + Send) -> bool {
        self.py.detach(wait)
    }
}
