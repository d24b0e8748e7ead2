//! Long calls: the work on a thread of its own, the caller's thread listening.

use crate::failure::{Result, guard};
use crate::ffi::Observer;
use polycube::{Context, Error, ErrorKind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// How often the caller is asked whether to stop.
const PERIOD: Duration = Duration::from_millis(10);

/// As much as the main thread of a program has.
const STACK: usize = 8 << 20;

/// What the worker tells the caller's thread.
#[derive(Default)]
struct News {
    stage: String,
    progress: f64,
    fresh: bool,
    done: bool,
}

#[derive(Default)]
struct Board {
    news: Mutex<News>,
    finished: Condvar,
}

impl Board {
    fn lock(&self) -> MutexGuard<'_, News> {
        self.news.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn post(&self, stage: &str, progress: f64) {
        let mut news = self.lock();
        if news.stage != stage {
            stage.clone_into(&mut news.stage);
        } else if news.progress >= progress {
            return;
        }
        // The worker's threads may post out of order.
        news.progress = news.progress.max(progress);
        news.fresh = true;
    }

    fn finish(&self) {
        self.lock().done = true;
        self.finished.notify_one();
    }

    /// Waits for the end or the next period; whether it was the end, and the news until then.
    fn wait(&self) -> (bool, Option<(String, f64)>) {
        let waited = self.finished.wait_timeout_while(self.lock(), PERIOD, |news| !news.done);
        let (mut news, _) = waited.unwrap_or_else(PoisonError::into_inner);
        let fresh = std::mem::take(&mut news.fresh).then(|| (news.stage.clone(), news.progress));
        (news.done, fresh)
    }
}

/// Does `job` on another thread, while this one tells `observer` of its progress and asks whether to stop. A panic becomes an error.
pub fn run<T: Send>(observer: &Observer, job: impl FnOnce(&Context) -> polycube::Result<T> + Send) -> Result<T> {
    guard(|| {
        let board = Arc::new(Board::default());
        let posts = Arc::clone(&board);
        let context = Context::new(move |stage, progress| posts.post(stage, progress));
        if observer.is_cancelled() {
            context.cancel();
        }
        let result = thread::scope(|scope| {
            let work = || {
                let result = guard(|| job(&context));
                board.finish();
                result
            };
            let builder = thread::Builder::new().name("polycube".into()).stack_size(STACK);
            let worker = builder.spawn_scoped(scope, work).map_err(no_thread)?;
            listen(observer, &board, &context);
            // The work is guarded, so that joining does not fail.
            worker.join().map_err(|_| Error::new(ErrorKind::Internal, "the worker thread failed"))?.map_err(|f| f.0)
        });
        // Who said stop gets no result, even if it was ready at that moment.
        if result.is_ok() {
            context.tick(1.0)?
        }
        result
    })
}

fn listen(observer: &Observer, board: &Board, context: &Context) {
    loop {
        if observer.is_cancelled() {
            context.cancel();
        }
        let (done, news) = board.wait();
        if let Some((stage, progress)) = news
            && !context.is_cancelled()
            && !observer.report(&stage, progress)
        {
            context.cancel();
        }
        if done {
            return;
        }
    }
}

fn no_thread(error: std::io::Error) -> Error {
    Error::new(ErrorKind::Internal, format!("the system gives no thread: {error}"))
}
