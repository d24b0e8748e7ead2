//! What the worker and those who wait for it both see.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Where the worker puts up its progress and, in the end, the outcome.
pub(crate) struct Board<O> {
    state: Mutex<State<O>>,
    ended: Condvar,
}

struct State<O> {
    stage: String,
    progress: f64,
    /// Whether stage or progress changed since somebody asked for news.
    fresh: bool,
    outcome: Option<O>,
}

impl<O> Default for Board<O> {
    fn default() -> Self {
        let state = State { stage: String::new(), progress: 0.0, fresh: false, outcome: None };
        Self { state: Mutex::new(state), ended: Condvar::new() }
    }
}

impl<O> Board<O> {
    /// Nothing panics while it holds the lock, and if it did, the state would be whole all the same.
    fn lock(&self) -> MutexGuard<'_, State<O>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn post(&self, stage: &str, progress: f64) {
        let mut state = self.lock();
        if state.stage != stage {
            stage.clone_into(&mut state.stage);
        } else if state.progress == progress {
            return;
        }
        state.progress = progress;
        state.fresh = true;
    }

    pub(crate) fn end(&self, outcome: O) {
        self.lock().outcome = Some(outcome);
        self.ended.notify_all();
    }

    /// The stage and the progress.
    pub(crate) fn progress(&self) -> (String, f64) {
        let state = self.lock();
        (state.stage.clone(), state.progress)
    }

    /// The same, unless it was taken before.
    pub(crate) fn take_news(&self) -> Option<(String, f64)> {
        let mut state = self.lock();
        std::mem::take(&mut state.fresh).then(|| (state.stage.clone(), state.progress))
    }

    /// Waits at most `time` for the outcome and tells whether it is there.
    pub(crate) fn wait(&self, time: Duration) -> bool {
        let waited = self.ended.wait_timeout_while(self.lock(), time, |state| state.outcome.is_none());
        waited.unwrap_or_else(PoisonError::into_inner).0.outcome.is_some()
    }

    pub(crate) fn take_outcome(&self) -> Option<O> {
        self.lock().outcome.take()
    }

    pub(crate) fn outcome(&self) -> Option<O>
    where
        O: Clone,
    {
        self.lock().outcome.clone()
    }
}
