//! Work on a thread of its own, so that Python goes on, Ctrl-C is heard, and a panic ends in an exception.

use crate::errors;
use polycube::{Context, Error, ErrorKind};
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How often a waiting call listens to signals and reports progress.
const POLL: Duration = Duration::from_millis(30);

/// As much as the main thread has on most systems.
const STACK: usize = 8 << 20;

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
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self { error: Box::new(error), at: None }
    }
}

/// What the work came to.
type Outcome<T> = Result<T, Failure>;

struct Shared<T> {
    stage: Mutex<String>,
    outcome: Mutex<Option<Outcome<T>>>,
    finished: Condvar,
}

/// Work going on. Dropping it cancels it.
pub struct Work<T> {
    context: Context,
    shared: Arc<Shared<T>>,
}

impl<T> Drop for Work<T> {
    fn drop(&mut self) {
        self.context.cancel();
    }
}

/// Nothing panics while it holds a lock, and if it did, the value would be whole all the same.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<T: Clone + Send + 'static> Work<T> {
    /// Starts `task`.
    ///
    /// # Errors
    /// [`ErrorKind::Internal`] when the system gives no thread.
    pub fn start(task: impl FnOnce(&Context) -> Outcome<T> + Send + 'static) -> polycube::Result<Self> {
        let shared = Arc::new(Shared { stage: Mutex::default(), outcome: Mutex::new(None), finished: Condvar::new() });
        let watched = Arc::clone(&shared);
        let context = Context::new(move |stage, _| {
            let mut known = lock(&watched.stage);
            if *known != stage {
                stage.clone_into(&mut known);
            }
        });
        let work = Self { context: context.clone(), shared: Arc::clone(&shared) };
        let run = move || {
            let outcome = catch_unwind(AssertUnwindSafe(|| task(&context)));
            let outcome = outcome.unwrap_or_else(|panic| Err(Failure::from(panicked(&*panic))));
            *lock(&shared.outcome) = Some(outcome);
            shared.finished.notify_all();
        };
        let started = thread::Builder::new().name("polycube".into()).stack_size(STACK).spawn(run);
        started.map_err(|e| Error::new(ErrorKind::Internal, format!("cannot start a thread: {e}")))?;
        Ok(work)
    }

    /// Asks the work to stop.
    pub fn cancel(&self) {
        self.context.cancel();
    }

    /// The stage and the fraction done.
    pub fn progress(&self) -> (String, f64) {
        (lock(&self.shared.stage).clone(), self.context.progress())
    }

    /// Whether there is an outcome.
    pub fn is_done(&self) -> bool {
        lock(&self.shared.outcome).is_some()
    }

    /// Waits at most `time` and tells whether there is an outcome.
    fn wait(&self, time: Duration) -> bool {
        let outcome = lock(&self.shared.outcome);
        let waited = self.shared.finished.wait_timeout_while(outcome, time, |outcome| outcome.is_none());
        waited.unwrap_or_else(PoisonError::into_inner).0.is_some()
    }

    /// Waits at most `time` for an outcome, or for ever, letting other Python threads run and hearing signals.
    ///
    /// # Errors
    /// What a signal handler raised.
    pub fn wait_for(&self, py: Python<'_>, time: Option<Duration>) -> PyResult<bool> {
        let end = time.and_then(|time| Instant::now().checked_add(time));
        loop {
            let left = end.map_or(POLL, |end| POLL.min(end.saturating_duration_since(Instant::now())));
            if py.detach(|| self.wait(left)) {
                return Ok(true);
            }
            if end.is_some_and(|end| Instant::now() >= end) {
                return Ok(false);
            }
            py.check_signals()?;
        }
    }

    /// What the work came to; waits for it.
    pub fn outcome(&self, py: Python<'_>) -> PyResult<T> {
        self.wait_for(py, None)?;
        match lock(&self.shared.outcome).clone() {
            Some(Ok(product)) => Ok(product),
            Some(Err(failure)) => Err(errors::raise(py, &failure.error, failure.at)),
            None => Err(errors::raise(py, &Error::new(ErrorKind::Internal, "the work came to nothing"), None)),
        }
    }
}

fn panicked(panic: &(dyn Any + Send)) -> Error {
    let text = panic.downcast_ref::<&str>().copied().or(panic.downcast_ref::<String>().map(String::as_str));
    let message = format!("the library failed: {}", text.unwrap_or("no message"));
    Error::new(ErrorKind::Internal, message).remedy("please report it with the mesh")
}

/// What a call listens to and reports to while it works.
pub struct Listener<'py> {
    /// Called as `progress(stage, fraction)`.
    pub progress: Option<Bound<'py, PyAny>>,
    /// Has `is_set()`.
    pub cancel: Option<Bound<'py, PyAny>>,
}

impl Listener<'_> {
    /// Runs `task` and waits for it: calls `progress` on this thread, listens to `cancel` and to Ctrl-C. What these raise
    /// cancels the work and is raised once it has stopped.
    pub fn run<T: Clone + Send + 'static>(
        &self,
        py: Python<'_>,
        task: impl FnOnce(&Context) -> Outcome<T> + Send + 'static,
    ) -> PyResult<T> {
        let work = Work::start(task).map_err(|e| errors::raise(py, &e, None))?;
        if let Err(raised) = self.attend(py, &work) {
            work.cancel();
            py.detach(|| while !work.wait(POLL) {});
            return Err(raised);
        }
        work.outcome(py)
    }

    fn attend<T: Clone + Send + 'static>(&self, py: Python<'_>, work: &Work<T>) -> PyResult<()> {
        let mut reported = None;
        loop {
            if let Some(cancel) = &self.cancel
                && cancel.call_method0("is_set")?.is_truthy()?
            {
                work.cancel();
            }
            let done = py.detach(|| work.wait(POLL));
            py.check_signals()?;
            let now = work.progress();
            if let Some(progress) = &self.progress
                && reported.as_ref() != Some(&now)
            {
                progress.call1(now.clone())?;
                reported = Some(now);
            }
            if done {
                return Ok(());
            }
        }
    }
}
