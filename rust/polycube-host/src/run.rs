//! Calls that block: the work on another thread, the caller's attending to the host.

use crate::guard::guard;
use crate::work::{Work, no_thread, worker_thread};
use polycube::{Context, Error};
use std::thread;
use std::time::Duration;

/// How often the host is asked whether to stop.
const PERIOD: Duration = Duration::from_millis(10);

/// Who made a call. It is called on the thread that made it, and on no other.
pub trait Host {
    /// Whether the call shall stop; asked all the time.
    fn wants_to_stop(&mut self) -> bool;

    /// Hears of the stage and of how much of all is done, in `0..=1`, which never decreases; whether to go on. What was
    /// not heard before something new came is left out.
    fn report(&mut self, stage: &str, progress: f64) -> bool;

    /// Calls `wait`, which takes some milliseconds: a host that lets others work only when told so tells it here.
    fn meanwhile(&mut self, wait: impl FnOnce() -> bool + Send) -> bool {
        wait()
    }
}

/// Does `job` on a worker thread, while this one attends to `host`. It returns only when the job has ended.
///
/// # Errors
/// Those of `job`; [`ErrorKind::Cancelled`](polycube::ErrorKind::Cancelled) when the host stopped it, even at the last
/// moment; [`ErrorKind::Internal`](polycube::ErrorKind::Internal) when it or the host panicked, or when the system
/// gives no thread.
pub fn run<T, E>(host: &mut impl Host, job: impl FnOnce(&Context) -> Result<T, E> + Send) -> Result<T, E>
where
    T: Send + 'static,
    E: From<Error> + Send + 'static,
{
    let work = Work::new();
    thread::scope(|scope| {
        worker_thread().spawn_scoped(scope, || work.run(job)).map_err(no_thread)?;
        // The scope waits for the worker, which need not go on when nobody attends.
        let attended = guard(|| {
            attend(host, &work);
            Ok(())
        });
        attended.inspect_err(|_: &E| work.cancel())
    })?;
    work.into_outcome()
}

/// Listens to the host and reports to it until the work has ended.
fn attend<T, E>(host: &mut impl Host, work: &Work<T, E>)
where
    T: Send + 'static,
    E: From<Error> + Send + 'static,
{
    let mut ended = false;
    while !ended {
        if !work.is_cancelled() && host.wants_to_stop() {
            work.cancel();
        }
        ended = host.meanwhile(|| work.wait(PERIOD));
        if let Some((stage, progress)) = work.take_news()
            && !work.is_cancelled()
            && !host.report(&stage, progress)
        {
            work.cancel();
        }
    }
}
