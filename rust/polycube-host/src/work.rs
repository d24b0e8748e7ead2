//! Work in the background.

use crate::board::Board;
use crate::guard::guard;
use polycube::{Context, Error, ErrorKind};
use std::io;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

/// As much as the main thread of a program has on most systems.
const STACK: usize = 8 << 20;

/// Work on a thread of its own. Dropping it cancels it.
pub struct Work<T, E = Error> {
    context: Context,
    board: Arc<Board<Result<T, E>>>,
}

impl<T, E> Drop for Work<T, E> {
    fn drop(&mut self) {
        self.context.cancel();
    }
}

impl<T: Send + 'static, E: From<Error> + Send + 'static> Work<T, E> {
    /// Starts `job`. A panic in it becomes an error of [`ErrorKind::Internal`].
    ///
    /// # Errors
    /// [`ErrorKind::Internal`] when the system gives no thread.
    pub fn start(job: impl FnOnce(&Context) -> Result<T, E> + Send + 'static) -> polycube::Result<Self> {
        let work = Self::new();
        let worker = Self { context: work.context.clone(), board: Arc::clone(&work.board) };
        worker_thread().spawn(move || worker.run(job)).map_err(no_thread)?;
        Ok(work)
    }

    /// Waits at most `time` and tells whether the work has ended, in whatever way; no time at all asks only.
    pub fn wait(&self, time: Duration) -> bool {
        self.board.wait(time)
    }

    /// Asks the work to stop.
    pub fn cancel(&self) {
        self.context.cancel();
    }

    /// The stage that the work is in and how much of all is done, in `0..=1`, which never decreases.
    pub fn progress(&self) -> (String, f64) {
        self.board.progress()
    }

    /// What the work came to, once it has ended.
    pub fn outcome(&self) -> Option<Result<T, E>>
    where
        T: Clone,
        E: Clone,
    {
        self.board.outcome()
    }

    /// Work that nobody does yet.
    pub(crate) fn new() -> Self {
        let board = Arc::new(Board::default());
        let posts = Arc::clone(&board);
        Self { context: Context::new(move |stage, progress| posts.post(stage, progress)), board }
    }

    /// Does the work on this thread.
    pub(crate) fn run(&self, job: impl FnOnce(&Context) -> Result<T, E>) {
        self.board.end(guard(|| job(&self.context)));
    }

    pub(crate) fn is_cancelled(&self) -> bool {
        self.context.is_cancelled()
    }

    pub(crate) fn take_news(&self) -> Option<(String, f64)> {
        self.board.take_news()
    }

    /// The outcome; who said stop gets none, even if it was ready at that moment.
    pub(crate) fn into_outcome(self) -> Result<T, E> {
        let lost = || Err(Error::new(ErrorKind::Internal, "the work came to nothing").into());
        let outcome = self.board.take_outcome().unwrap_or_else(lost)?;
        self.context.check()?;
        Ok(outcome)
    }
}

/// What all workers are like.
pub(crate) fn worker_thread() -> thread::Builder {
    thread::Builder::new().name("polycube".into()).stack_size(STACK)
}

pub(crate) fn no_thread(error: io::Error) -> Error {
    Error::new(ErrorKind::Internal, format!("the system gives no thread: {error}"))
}
