//! How soon cancelling is answered: the longest processor time between two ticks of the context, by stage. With one thread
//! (`RAYON_NUM_THREADS=1`) that is how long a call goes on, however busy the machine.
//!
//! ```text
//! RAYON_NUM_THREADS=1 cargo run --release --example ticks -- POLYCUBE [SHAPE] [HEXES]
//! ```

use polycube::mesh::{read, read_pair};
use polycube::remesh::{RemeshOptions, Size, remesh};
use polycube::simplify::{Input, Options, simplify};
use polycube::{Context, Result};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex};

/// The time of the last tick and the longest gap before a tick of each stage, with the progress there.
struct Gaps {
    last: f64,
    longest: BTreeMap<String, (f64, f64)>,
}

/// Processor time of all threads, in milliseconds; 0 where the system does not tell.
fn processor_time() -> f64 {
    let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let run = |task: std::fs::DirEntry| std::fs::read_to_string(task.path().join("schedstat")).ok();
    let nanoseconds = |text: String| text.split_whitespace().next()?.parse::<f64>().ok();
    tasks.filter_map(|task| run(task).and_then(nanoseconds)).sum::<f64>() * 1e-6
}

fn measure(name: &str, work: impl FnOnce(&Context) -> Result<()>) -> Result<()> {
    let gaps = Arc::new(Mutex::new(Gaps { last: processor_time(), longest: BTreeMap::new() }));
    let seen = Arc::clone(&gaps);
    let context = Context::new(move |stage, progress| {
        let Ok(mut gaps) = seen.lock() else { return };
        let now = processor_time();
        let gap = now - gaps.last;
        gaps.last = now;
        let longest = gaps.longest.entry(stage.to_owned()).or_default();
        if gap > longest.0 {
            *longest = (gap, progress);
        }
    });
    work(&context)?;
    let Ok(gaps) = gaps.lock() else { return Ok(()) };
    println!("{name}: last tick {:.0} ms before the end", processor_time() - gaps.last);
    for (stage, (gap, progress)) in &gaps.longest {
        println!("  {stage:12} {:6.0} ms before {progress:.4}", gap);
    }
    Ok(())
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [polycube, rest @ ..] = &arguments[..] else { return Err("name a polycube".into()) };
    let (polycube, shape) = match rest {
        [] => (read(Path::new(polycube))?, None),
        [shape, ..] => read_pair(Path::new(polycube), Path::new(shape)).map(|(p, s)| (p, Some(s)))?,
    };
    let hexes = rest.get(1).map_or(Ok(10_000), |n| n.parse())?;
    let input = Input { polycube: &polycube, shape: shape.as_ref(), labels: None };
    measure("simplify", |context| simplify(&input, &Options::default(), context).map(drop))?;
    let options = RemeshOptions { size: Some(Size::Hexes(hexes)), ..RemeshOptions::default() };
    measure("remesh", |context| remesh(&input, &options, context).map(drop))?;
    Ok(())
}
