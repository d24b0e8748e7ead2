//! How soon cancelling is answered: a call is made again and again and cancelled at moments spread evenly over it. With
//! one thread (`RAYON_NUM_THREADS=1`), the processor time until it returns is how long it goes on, however busy the
//! machine.
//!
//! ```text
//! RAYON_NUM_THREADS=1 cargo run --release --example cancelling -- POLYCUBE [SHAPE] [HEXES] [MOMENTS]
//! ```

use polycube::mesh::{read, read_pair};
use polycube::remesh::{RemeshOptions, Size, remesh};
use polycube::simplify::{Input, SimplifyOptions, simplify};
use polycube::{Context, Result};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// Processor time of all threads, in milliseconds; 0 where the system does not tell.
fn processor_time() -> f64 {
    let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let run = |task: std::fs::DirEntry| std::fs::read_to_string(task.path().join("schedstat")).ok();
    let nanoseconds = |text: String| text.split_whitespace().next()?.parse::<f64>().ok();
    tasks.filter_map(|task| run(task).and_then(nanoseconds)).sum::<f64>() * 1e-6
}

/// The time of `work` until it was cancelled, at `moment` or at its end, and from there until it returned; the stage.
fn cancelled_at(moment: f64, work: &impl Fn(&Context) -> Result<()>) -> (f64, f64, String) {
    let stage = Arc::new(Mutex::new(String::new()));
    let (seen, start, ended) = (Arc::clone(&stage), processor_time(), AtomicBool::new(false));
    let context = Context::new(move |name, _| {
        if let Ok(mut seen) = seen.lock() {
            name.clone_into(&mut seen);
        }
    });
    std::thread::scope(|scope| {
        let watch = scope.spawn(|| {
            while processor_time() - start < moment && !ended.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(1));
            }
            context.cancel();
            (processor_time(), stage.lock().map(|s| s.clone()).unwrap_or_default())
        });
        // That it was cancelled is what it says.
        let _ = work(&context);
        let end = processor_time();
        ended.store(true, Ordering::Relaxed);
        let (cancelled, stage) = watch.join().unwrap_or_default();
        (cancelled - start, (end - cancelled).max(0.0), stage)
    })
}

fn measure(name: &str, moments: u32, work: impl Fn(&Context) -> Result<()>) {
    let (whole, ..) = cancelled_at(f64::INFINITY, &work);
    let at = |i: u32| cancelled_at(whole * f64::from(i) / f64::from(moments), &work);
    let longest = (0..moments).map(at).max_by(|a, b| a.1.total_cmp(&b.1));
    let (moment, rest, stage) = longest.unwrap_or_default();
    println!("{name}: at most {rest:.0} ms, after {moment:.0} of {whole:.0} ms, in the stage {stage}");
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [polycube, rest @ ..] = &arguments[..] else { return Err("name a polycube".into()) };
    let (polycube, shape) = match rest {
        [] => (read(Path::new(polycube))?, None),
        [shape, ..] => read_pair(Path::new(polycube), Path::new(shape)).map(|(p, s)| (p, Some(s)))?,
    };
    let hexes = rest.get(1).map_or(Ok(10_000), |n| n.parse())?;
    let moments = rest.get(2).map_or(Ok(20), |n| n.parse())?;
    let input = Input { polycube: &polycube, shape: shape.as_ref(), labels: None };
    measure("simplify", moments, |context| simplify(&input, &SimplifyOptions::default(), context).map(drop));
    let options = RemeshOptions { size: Some(Size::Hexes(hexes)), ..RemeshOptions::default() };
    measure("remesh", moments, |context| remesh(&input, &options, context).map(drop));
    Ok(())
}
