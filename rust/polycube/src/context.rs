//! Progress and cancellation, shared by every long-running call.

use crate::error::{Error, ErrorKind, Result};
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Receives the name of the stage and the overall progress in `0..=1`, which never decreases.
type Observer = dyn Fn(&str, f64) + Send + Sync;

struct Shared {
    cancelled: AtomicBool,
    reported: AtomicU64,
    observer: Box<Observer>,
}

/// Carries progress out of and cancellation into a call. Clones share both.
///
/// Cancellation is sticky: once [`cancel`](Self::cancel) was called every later
/// [`tick`](Self::tick) fails with [`ErrorKind::Cancelled`].
///
/// ```
/// use polycube::generate::{Example, example};
/// use polycube::mesh::CellKind;
/// use polycube::simplify::simplify;
/// use polycube::{Context, ErrorKind, Input, Options};
///
/// let context = Context::new(|stage, progress| eprintln!("{stage}: {:.0} %", 100.0 * progress));
/// // A clone is for the button or signal handler that stops the work, on any thread.
/// let button = context.clone();
/// button.cancel();
///
/// let (cube, _) = example(Example::Ring, 1, CellKind::Quads)?;
/// let input = Input { polycube: &cube, shape: None, labels: None };
/// let stopped = simplify(&input, &Options::default(), &context);
/// assert_eq!(stopped.unwrap_err().kind, ErrorKind::Cancelled);
/// # Ok::<(), polycube::Error>(())
/// ```
#[derive(Clone)]
pub struct Context {
    shared: Arc<Shared>,
    stage: Arc<str>,
    from: f64,
    to: f64,
}

impl Default for Context {
    fn default() -> Self {
        Self::new(|_, _| {})
    }
}

impl fmt::Debug for Context {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Context")
            .field("stage", &self.stage)
            .field("progress", &self.progress())
            .field("cancelled", &self.is_cancelled())
            .finish()
    }
}

impl Context {
    /// A context that reports every step to `observer(stage, progress)`.
    pub fn new(observer: impl Fn(&str, f64) + Send + Sync + 'static) -> Self {
        Self {
            shared: Arc::new(Shared {
                cancelled: AtomicBool::new(false),
                reported: AtomicU64::new(0.0_f64.to_bits()),
                observer: Box::new(observer),
            }),
            stage: "".into(),
            from: 0.0,
            to: 1.0,
        }
    }

    /// Asks every call that shares this context to stop.
    pub fn cancel(&self) {
        self.shared.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether [`cancel`](Self::cancel) was called.
    pub fn is_cancelled(&self) -> bool {
        self.shared.cancelled.load(Ordering::Relaxed)
    }

    /// The overall progress reported last, in `0..=1`.
    pub fn progress(&self) -> f64 {
        f64::from_bits(self.shared.reported.load(Ordering::Relaxed))
    }

    /// The part of this context's range that the stage `name` fills: from `from` to `to`, both in `0..=1`.
    #[must_use]
    pub fn stage(&self, name: &str, from: f64, to: f64) -> Self {
        let width = self.to - self.from;
        Self {
            shared: Arc::clone(&self.shared),
            stage: name.into(),
            from: self.from + width * from,
            to: self.from + width * to,
        }
    }

    /// Reports that `fraction` (clamped to `0..=1`) of this stage is done, and stops a cancelled call.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`] once the context was cancelled.
    pub fn tick(&self, fraction: f64) -> Result<()> {
        if self.is_cancelled() {
            return Err(Error::new(ErrorKind::Cancelled, "cancelled"));
        }
        let now = self.from + (self.to - self.from) * fraction.clamp(0.0, 1.0);
        // Progress is never negative, so the order of the bits is the order of the numbers.
        let before = self.shared.reported.fetch_max(now.to_bits(), Ordering::Relaxed);
        (self.shared.observer)(&self.stage, now.max(f64::from_bits(before)));
        Ok(())
    }

    /// [`tick`](Self::tick) for step `i` of `count`, but only once in 1024 steps.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`] once the context was cancelled.
    pub(crate) fn tick_every(&self, i: usize, count: usize) -> Result<()> {
        if i.is_multiple_of(1024) { self.tick(i as f64 / count as f64) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn progress_never_decreases_and_stages_nest() {
        let seen = Arc::new(Mutex::new(Vec::new()));
        let log = Arc::clone(&seen);
        let context = Context::new(move |stage, p| log.lock().unwrap().push((stage.to_owned(), p)));
        let second = context.stage("second", 0.5, 1.0);
        second.tick(0.5).unwrap();
        context.stage("first", 0.0, 0.5).tick(1.0).unwrap();
        second.stage("end", 0.5, 1.0).tick(2.0).unwrap();
        let seen = seen.lock().unwrap();
        let expected = [("second", 0.75), ("first", 0.75), ("end", 1.0)];
        assert_eq!(*seen, expected.map(|(s, p)| (s.to_owned(), p)));
    }

    #[test]
    fn cancellation_is_sticky_and_shared() {
        let context = Context::default();
        let stage = context.stage("work", 0.0, 1.0);
        assert!(stage.tick(0.1).is_ok());
        context.cancel();
        assert_eq!(stage.tick(0.2).unwrap_err().kind, ErrorKind::Cancelled);
        assert_eq!(stage.tick(0.3).unwrap_err().kind, ErrorKind::Cancelled);
    }
}
