//! A progress bar for long work, and Ctrl-C.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use polycube::{Context, Error, ErrorKind, Result};
use std::io::{self, IsTerminal};

/// Steps of the bar.
const STEPS: f64 = 1000.0;

/// A context that shows its progress and stops on Ctrl-C, and the bar that goes with it.
pub struct Progress {
    /// To hand to the library.
    pub context: Context,
    bar: ProgressBar,
}

impl Progress {
    /// Starts listening to Ctrl-C and shows a bar on standard error, if that is a terminal and `quiet` is not set.
    ///
    /// # Errors
    /// [`ErrorKind::Internal`] when the system refuses to tell about Ctrl-C.
    pub fn start(quiet: bool) -> Result<Self> {
        let bar = bar(!quiet && io::stderr().is_terminal());
        let (shown, mut stage) = (bar.clone(), String::new());
        let context = Context::new(move |name, progress| {
            if stage != name {
                name.clone_into(&mut stage);
                shown.set_message(stage.clone());
            }
            shown.set_position((progress * STEPS) as u64);
        });
        let cancelled = context.clone();
        ctrlc::set_handler(move || cancelled.cancel())
            .map_err(|e| Error::new(ErrorKind::Internal, format!("cannot listen to Ctrl-C: {e}")))?;
        Ok(Self { context, bar })
    }
}

impl Drop for Progress {
    /// Takes the bar away, so that a message or table starts on a clean line.
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

fn bar(visible: bool) -> ProgressBar {
    let target = if visible { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(Some(STEPS as u64), target);
    match ProgressStyle::with_template("{msg:10} {wide_bar} {percent:>3} %") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
