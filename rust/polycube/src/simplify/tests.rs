//! Options out of their ranges, and what is said of limits that are not kept.

use super::{Cause, Input, Note, Simplified, SimplifyOptions, read_structure, simplify};
use crate::context::Context;
use crate::error::ErrorKind;
use crate::generate::{Example, example};
use crate::mesh::{CellKind, Mesh};
use crate::validate::validate;

fn ring() -> Mesh {
    example(Example::Ring, 3, CellKind::Triangles).unwrap().0
}

fn input(polycube: &Mesh) -> Input<'_> {
    Input { polycube, shape: None, labels: None }
}

#[test]
fn numbers_out_of_their_ranges_are_refused_by_the_names_of_their_fields() {
    type Set = fn(&mut SimplifyOptions, f64);
    let wrong: [(&str, Set, &[f64]); 8] = [
        ("scale", |o, x| o.scale = Some(x), &[0.0, -1.0]),
        ("lambda_min", |o, x| o.lambda_min = x, &[-7.0, 1.1]),
        ("simplicity", |o, x| o.simplicity = Some(x), &[-0.1, 1.1]),
        ("max_displacement", |o, x| o.max_displacement = Some(x), &[-0.1]),
        ("max_distortion", |o, x| o.max_distortion = Some(x), &[0.9]),
        ("tolerance.degrees", |o, x| o.tolerance.degrees = x, &[-1.0, 46.0]),
        ("tolerance.distance", |o, x| o.tolerance.distance = x, &[-0.1, 1.1]),
        ("tolerance.merge", |o, x| o.tolerance.merge = x, &[-0.1, 1.1]),
    ];
    let mesh = ring();
    let begun = Context::new(|stage, _| panic!("{stage} was begun"));
    for (name, set, bad) in wrong {
        for &x in bad.iter().chain(&[f64::NAN, f64::INFINITY]) {
            let mut options = SimplifyOptions::default();
            set(&mut options, x);
            let error = simplify(&input(&mesh), &options, &begun).unwrap_err();
            assert_eq!((error.kind, error.option), (ErrorKind::Option, Some(name)), "{x}");
            assert!(error.message.contains(name) && !error.remedy.is_empty(), "{error}");
            if options.tolerance != SimplifyOptions::default().tolerance {
                assert_eq!(read_structure(&input(&mesh), &options.tolerance).unwrap_err(), error);
                assert_eq!(validate(&input(&mesh), &options.tolerance).unwrap_err(), error);
            }
        }
    }
}

/// The ring, on a lattice that holds it.
fn kept(mesh: &Mesh, options: SimplifyOptions) -> Simplified {
    let result =
        simplify(&input(mesh), &SimplifyOptions { scale: Some(20.0), ..options }, &Context::default()).unwrap();
    assert!(result.report.notes.is_empty(), "{:?}", result.report.notes);
    result
}

#[test]
fn no_corner_moves_where_none_may_and_what_breaks_that_is_said() {
    let mesh = ring();
    let still = kept(&mesh, SimplifyOptions { max_displacement: Some(0.0), ..SimplifyOptions::default() });
    assert!(still.report.max_displacement < 1e-12);
    let cause = |result: &Simplified| result.report.cause_of_displacement();
    let (context, input) = (Context::default(), input(&mesh));
    let coarse = still.rescaled(&input, 0.37, &context).unwrap();
    let moved = coarse.report.max_displacement;
    assert!(coarse.report.notes.contains(&Note::Displacement { moved, limit: 0.0, cause: Cause::Scale }));
    assert_eq!(cause(&coarse.rescaled(&input, 20.0, &context).unwrap()), None);
    assert_eq!(cause(&still.at(&input, 1.0, &context).unwrap()), Some(Cause::Choice));
    assert_eq!(cause(&still.at(&input, 0.0, &context).unwrap()), None);
    let options = SimplifyOptions { max_displacement: Some(0.0), scale: Some(0.37), ..SimplifyOptions::default() };
    let missed = simplify(&input, &options, &context).unwrap();
    assert_eq!(cause(&missed), Some(Cause::Search));
    assert_eq!(cause(&missed.rescaled(&input, 0.41, &context).unwrap()), Some(Cause::Search));
}

#[test]
fn a_distortion_that_is_not_kept_elsewhere_is_said() {
    let mesh = ring();
    let still = kept(&mesh, SimplifyOptions { max_distortion: Some(1.0 + 1e-9), ..SimplifyOptions::default() });
    let cause = |result: &Simplified| result.report.cause_of_distortion();
    let (context, input) = (Context::default(), input(&mesh));
    assert_eq!(cause(&still.rescaled(&input, 0.37, &context).unwrap()), Some(Cause::Scale));
    assert_eq!(cause(&still.at(&input, 1.0, &context).unwrap()), Some(Cause::Choice));
    assert_eq!(cause(&still.at(&input, 0.0, &context).unwrap()), None);
}

#[test]
fn notes_are_written_as_they_are_read() {
    let note = Note::Far { percent: 1.25, enough: Some((1300.0, CellKind::Hexahedra)) };
    let text = "the Hausdorff distance is 1.250 % of the diagonal, more than asked for: 1300 hexahedra are likely to \
                be near enough";
    assert_eq!(note.to_string(), text);
    assert_eq!(serde_json::to_value(&note).unwrap(), text);
}
