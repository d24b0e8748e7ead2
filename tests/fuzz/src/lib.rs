//! What the fuzz targets do with their bytes, and the oracles that judge it. A panic is a finding.

#[path = "../../../rust/polycube/tests/common/dense.rs"]
mod dense;
mod files;
mod polycubes;

pub use files::files;
pub use polycubes::{any_mesh, remeshing, valid_polycube};

use polycube::Simplified;
use polycube::mesh::Mesh;
use polycube::simplify::{Input, Note, read_structure};
use polycube::structure::Tolerance;

/// Checks what the library promises of every result: an integer polycube of the same topology, embedded, with no more
/// blocks, whose mesh meets its levels.
fn judge(mesh: &Mesh, result: &Simplified) {
    let report = &result.report;
    let Some(after) = report.after else { return assert!(!report.valid && result.polycube.is_none()) };
    assert!(report.valid);
    assert_eq!(dense::check(&result.input.structure, &result.levels), Ok(()));
    let naive = report.strategy == polycube::align::Strategy::Naive;
    assert!(naive || after.blocks_padded <= report.before.blocks_padded, "{:?} became {after:?}", report.before);
    let Some(polycube) = &result.polycube else { panic!("a valid result has a mesh") };
    let repaired = report.notes.iter().any(|note| matches!(note, Note::Repaired(_)));
    assert!(repaired || polycube.cells() == mesh.cells());
    assert_eq!(polycube.points().len(), mesh.points().len());
    let placement: Vec<f64> = result.levels.iter().map(|&x| x as f64).collect();
    for (p, fixed) in polycube.points().iter().zip(result.input.prescribed(&placement)) {
        assert!((0..3).all(|a| p[a].is_finite() && fixed[a].is_none_or(|x| x == p[a])), "{p} is not {fixed:?}");
    }
    let labels: Vec<i8> = result.input.labels().map(|l| l.index() as i8).collect();
    let again = Input { polycube, shape: None, labels: Some(&labels) };
    let read = read_structure(&again, &Tolerance::default());
    assert!(report.flipped_elements > 0 || read.is_ok(), "cannot be read again: {:?}", read.err());
}
