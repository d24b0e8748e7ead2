//! Makes polycubes of shapes and says how they came out, one a line.
//!
//! ```text
//! cargo run --release --example make_shape -- FOLDER SHAPE…
//! ```

use polycube::make::{MakeOptions, make};
use polycube::mesh::{read, write, write_labels};
use polycube::{Context, Result};
use std::path::Path;

fn one(folder: &Path, path: &Path) -> Result<()> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy().replace(".shape", "");
    let made = make(&read(path)?, &MakeOptions::default(), &Context::default())?;
    let report = &made.report;
    println!(
        "{name}: corners {}, facets {}, genus {}, misfit {:.4}, added {}, folded {}, angle {:.3}, \
         {:.2} + {:.2} s",
        report.corners,
        report.facets,
        report.genus,
        report.misfit,
        report.added,
        report.folded.len(),
        report.distortion.as_ref().map_or(f64::NAN, |d| d.angle),
        report.seconds.structure,
        report.seconds.embedding
    );
    write(&folder.join(format!("{name}.shape.obj")), &made.shape, &[])?;
    write(&folder.join(format!("{name}.polycube.obj")), &made.polycube, &[])?;
    write_labels(&folder.join(format!("{name}.polycube.labels")), &made.labels)
}

fn main() -> Result<()> {
    let mut paths = std::env::args().skip(1);
    let folder = paths.next().unwrap_or_default();
    for path in paths {
        if let Err(error) = one(folder.as_ref(), path.as_ref()) {
            println!("{path}: {error}");
        }
    }
    Ok(())
}
