//! What can be tested without C++: how errors are told. Everything else is tested from there (`cpp/tests`).

use crate::failure::Failure;
use crate::ffi::MeshView;
use crate::input::mesh;
use polycube::{Error, ErrorKind, Place};

#[test]
fn a_failure_has_six_parts() {
    let error = Error::new(ErrorKind::Mismatch, "odd\x1f one\0").at(Place::Edge(3, 8)).remedy("mend it");
    let text = Failure(error).to_string();
    assert_eq!(text.split('\x1f').collect::<Vec<_>>(), ["5", "2", "3", "8", "odd  one ", "mend it"]);
    let text = Failure(Error::new(ErrorKind::Parse, "cut short").in_file("a.obj")).to_string();
    assert_eq!(text.split('\x1f').collect::<Vec<_>>(), ["1", "0", "0", "0", "a.obj: cut short", ""]);
}

#[test]
fn buffers_that_are_no_mesh_are_refused() {
    let points = [0.0; 9];
    let refused = |points, kind, cells| mesh(&MeshView { points, kind, cells }).unwrap_err();
    assert_eq!(refused(&points[..8], 0, &[0, 1, 2]).kind, ErrorKind::Mesh);
    assert_eq!(refused(&points, 0, &[0, 1]).kind, ErrorKind::Mesh);
    assert_eq!(refused(&points, 0, &[0, 1, 2, 0, 1, 3]).place, Some(Place::Cell(1)));
    assert_eq!(refused(&points, 4, &[0, 1, 2]).kind, ErrorKind::Unsupported);
}
