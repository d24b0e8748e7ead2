//! Progress and cancellation, shared by every long-running call.

use crate::error::{Error, ErrorKind, Result};
use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Receives the name of the stage and the overall progress in `0..=1`.
type Observer = dyn FnMut(&str, f64) + Send;

struct Shared {
    cancelled: AtomicBool,
    reported: AtomicU64,
    /// Locked while it is called: threads that report at once would else be heard in any order.
    observer: Mutex<Box<Observer>>,
}

/// Carries progress out of and cancellation into a call. Clones share both.
///
/// Cancellation is sticky: once [`cancel`](Self::cancel) was called every later [`check`](Self::check) and
/// [`tick`](Self::tick) fails with [`ErrorKind::Cancelled`].
///
/// ```
/// use polycube::generate::{Example, example};
/// use polycube::mesh::CellKind;
/// use polycube::simplify::simplify;
/// use polycube::{Context, ErrorKind, Input, SimplifyOptions};
///
/// let context = Context::new(|stage, progress| eprintln!("{stage}: {:.0} %", 100.0 * progress));
/// // A clone is for the button or signal handler that stops the work, on any thread.
/// let button = context.clone();
/// button.cancel();
///
/// let (cube, _) = example(Example::Ring, 1, CellKind::Quads)?;
/// let input = Input { polycube: &cube, shape: None, labels: None };
/// let stopped = simplify(&input, &SimplifyOptions::default(), &context);
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
    ///
    /// The observer is called on the thread that works, by one thread at a time, and the progress it hears never
    /// decreases. It may cancel; reporting from within it would wait for itself.
    pub fn new(observer: impl FnMut(&str, f64) + Send + 'static) -> Self {
        Self {
            shared: Arc::new(Shared {
                cancelled: AtomicBool::new(false),
                reported: AtomicU64::new(0.0_f64.to_bits()),
                observer: Mutex::new(Box::new(observer)),
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

    /// Stops a cancelled call, and reports nothing.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`] once the context was cancelled.
    pub fn check(&self) -> Result<()> {
        if self.is_cancelled() { Err(Error::new(ErrorKind::Cancelled, "cancelled")) } else { Ok(()) }
    }

    /// Reports that `fraction` (clamped to `0..=1`) of this stage is done, and stops a cancelled call.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`] once the context was cancelled.
    pub fn tick(&self, fraction: f64) -> Result<()> {
        self.check()?;
        let now = self.from + (self.to - self.from) * fraction.clamp(0.0, 1.0);
        // An observer that panicked once is called again all the same.
        let mut observer = self.shared.observer.lock().unwrap_or_else(PoisonError::into_inner);
        // Progress is never negative, so the order of the bits is the order of the numbers.
        let before = self.shared.reported.fetch_max(now.to_bits(), Ordering::Relaxed);
        observer(&self.stage, now.max(f64::from_bits(before)));
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
    fn an_observer_called_from_many_threads_never_hears_less_than_before() {
        let seen = Arc::new(Mutex::new(Vec::new()));
        let log = Arc::clone(&seen);
        let context = Context::new(move |_, p| {
            // Between what is heard and what is written down another thread has its chance.
            std::thread::yield_now();
            log.lock().unwrap().push(p);
        });
        std::thread::scope(|scope| {
            for thread in 0..4 {
                let context = context.clone();
                scope.spawn(move || {
                    (0..500).try_for_each(|i| context.tick(f64::from(4 * i + thread) / 2000.0)).unwrap()
                });
            }
        });
        let seen = seen.lock().unwrap();
        assert!(seen.len() == 2000 && seen.is_sorted());
    }

    #[test]
    fn checking_reports_nothing() {
        let context = Context::new(|stage, _| panic!("{stage}"));
        assert_eq!(context.stage("work", 0.5, 1.0).check(), Ok(()));
        assert_eq!(context.progress(), 0.0);
        context.cancel();
        assert_eq!(context.check().unwrap_err().kind, ErrorKind::Cancelled);
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
