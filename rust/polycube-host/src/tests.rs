#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use crate::{Host, Work, run};
use polycube::{Context, Error, ErrorKind, Place, Result};
use std::sync::mpsc::{Sender, channel};
use std::thread::{self, ThreadId};
use std::time::Duration;

/// Writes down what it hears, and stops where it is told to.
#[derive(Default)]
struct Listener {
    heard: Vec<(String, f64)>,
    threads: Vec<ThreadId>,
    /// How often it is asked before it wants to stop.
    patience: Option<usize>,
    /// The progress at which it goes on no longer.
    enough: Option<f64>,
}

impl Host for Listener {
    fn wants_to_stop(&mut self) -> bool {
        self.threads.push(thread::current().id());
        self.patience.is_some_and(|times| self.threads.len() > times)
    }

    fn report(&mut self, stage: &str, progress: f64) -> bool {
        self.threads.push(thread::current().id());
        self.heard.push((stage.to_owned(), progress));
        self.enough.is_none_or(|enough| progress < enough)
    }
}

/// Steps until it is stopped.
fn endless(context: &Context) -> Result<()> {
    loop {
        context.stage("endless", 0.0, 1.0).tick(0.5)?;
        thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn the_work_is_done_elsewhere_and_may_borrow() {
    let (mut host, words) = (Listener::default(), ["from", "the", "caller"].map(String::from));
    let (text, worker) = run(&mut host, |_| Ok::<_, Error>((words.join(" "), thread::current().id()))).unwrap();
    assert_eq!(text, "from the caller");
    assert_ne!(worker, thread::current().id());
    assert!(host.threads.iter().all(|&id| id == thread::current().id()));
}

#[test]
fn errors_come_back_as_they_are() {
    let error = Error::new(ErrorKind::Mesh, "odd").at(Place::Vertex(3)).remedy("mend it");
    assert_eq!(run::<(), _>(&mut Listener::default(), |_| Err(error.clone())), Err(error));
}

#[test]
fn a_panic_is_an_error() {
    let failed = run::<(), Error>(&mut Listener::default(), |_| panic!("at {}", 7)).unwrap_err();
    assert_eq!((failed.kind, failed.message.as_str()), (ErrorKind::Internal, "a fault of the library: at 7"));
    let failed = run::<(), Error>(&mut Listener::default(), |_| std::panic::panic_any(7)).unwrap_err();
    assert_eq!(failed.message, "a fault of the library: no message");
}

/// Writes down what it hears, and says so.
struct Echo {
    heard: Vec<(String, f64)>,
    says: Sender<()>,
}

impl Host for Echo {
    fn wants_to_stop(&mut self) -> bool {
        false
    }

    fn report(&mut self, stage: &str, progress: f64) -> bool {
        self.heard.push((stage.to_owned(), progress));
        self.says.send(()).is_ok()
    }
}

#[test]
fn progress_is_heard_in_order_with_its_stages() {
    let (says, echo) = channel();
    let mut host = Echo { heard: Vec::new(), says };
    let step = move |context: &Context, part| context.tick(part).inspect(|()| echo.recv().unwrap());
    run(&mut host, move |context| {
        let (first, second) = (context.stage("first", 0.0, 0.5), context.stage("second", 0.5, 1.0));
        [0.5, 1.0].into_iter().try_for_each(|part| step(&first, part))?;
        // The name of a stage is heard though the stage is gone.
        drop(first);
        step(&second, 1.0)
    })
    .unwrap();
    let expected = [("first", 0.25), ("first", 0.5), ("second", 1.0)];
    assert_eq!(host.heard, expected.map(|(stage, progress)| (stage.to_owned(), progress)));
}

#[test]
fn the_last_step_is_heard_however_short_the_work() {
    let mut host = Listener::default();
    run(&mut host, |context| context.stage("short", 0.0, 1.0).tick(1.0)).unwrap();
    assert_eq!(host.heard, [("short".to_owned(), 1.0)]);
}

#[test]
fn a_host_stops_the_work_when_asked_and_when_told() {
    for host in [
        Listener { patience: Some(0), ..Listener::default() },
        Listener { patience: Some(3), ..Listener::default() },
        Listener { enough: Some(0.2), ..Listener::default() },
    ] {
        let mut host = host;
        assert_eq!(run(&mut host, endless).unwrap_err().kind, ErrorKind::Cancelled);
    }
}

#[test]
fn who_said_stop_gets_no_result_even_if_it_is_ready() {
    let mut host = Listener { patience: Some(0), ..Listener::default() };
    assert_eq!(run(&mut host, |_| Ok::<_, Error>(7)).unwrap_err().kind, ErrorKind::Cancelled);
}

#[test]
fn a_host_that_panics_stops_the_work() {
    struct Broken;
    impl Host for Broken {
        fn wants_to_stop(&mut self) -> bool {
            panic!("the host broke")
        }
        fn report(&mut self, _: &str, _: f64) -> bool {
            true
        }
    }
    let failed = run(&mut Broken, endless).unwrap_err();
    assert_eq!((failed.kind, failed.message.contains("the host broke")), (ErrorKind::Internal, true));
}

#[test]
fn work_in_the_background_is_looked_at_and_its_outcome_is_kept() {
    let (go, wait) = channel::<()>();
    let work: Work<i32> = Work::start(move |context| {
        context.stage("waiting", 0.0, 1.0).tick(0.5)?;
        Ok(wait.recv().map_or(0, |()| 7))
    })
    .unwrap();
    while work.progress() != ("waiting".to_owned(), 0.5) {
        thread::yield_now();
    }
    assert!(!work.wait(Duration::ZERO) && work.outcome().is_none());
    go.send(()).unwrap();
    assert!(work.wait(Duration::MAX));
    assert_eq!((work.outcome(), work.outcome()), (Some(Ok(7)), Some(Ok(7))));
}

#[test]
fn work_in_the_background_stops_when_cancelled_or_dropped() {
    let work = Work::start(endless).unwrap();
    work.cancel();
    assert!(work.wait(Duration::MAX));
    assert_eq!(work.outcome().unwrap().unwrap_err().kind, ErrorKind::Cancelled);
    let (ended, hears) = channel();
    drop(Work::start(move |context| ended.send(endless(context)).map_err(|_| unheard())).unwrap());
    assert_eq!(hears.recv().unwrap().unwrap_err().kind, ErrorKind::Cancelled);
}

fn unheard() -> Error {
    Error::new(ErrorKind::Internal, "nobody hears")
}
