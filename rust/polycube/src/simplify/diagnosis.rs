//! What is said where a mesh is not a polycube.

use super::Input;
use crate::error::Error;
use crate::mesh::Face;
use crate::structure::{Label, Polycube, Tolerance, Violation, area_vector};

/// Of a shape more than one face in this many is skew, or leans if it has labels; of a polycube that is a little off,
/// few are.
const SKEW: usize = 5;

/// The cosine, of 5 degrees, below which a face leans away from its label.
const UPRIGHT: f64 = 0.9962;

/// The error of a mesh that is not a polycube.
pub(super) fn diagnose(violations: Vec<Violation>, input: &Input, tolerance: &Tolerance) -> Error {
    let remedy = remedy(&violations, input, tolerance);
    let count = violations.len();
    let error = first_of_many(violations.into_iter().next().unwrap_or(Violation::Empty), count);
    match remedy {
        Some(remedy) => error.remedy(remedy),
        None => error,
    }
}

/// The first of `count` violations.
pub(super) fn first_of_many(first: Violation, count: usize) -> Error {
    let others = count.saturating_sub(1);
    let mut error = Error::from(first);
    if others > 0 {
        error.message =
            format!("{}; {others} more like it, which a check lists (command: `polycube validate`)", error.message);
    }
    error
}

/// What helps against all violations together, where that is better than what helps against each.
pub(crate) fn remedy(violations: &[Violation], input: &Input, tolerance: &Tolerance) -> Option<&'static str> {
    if input.shape.is_some_and(|shape| Polycube::new(shape, None, tolerance).is_ok()) {
        return Some("swap the two: what was given as the shape is a polycube, this is none");
    }
    if violations.iter().any(|v| matches!(v, Violation::OffLevel { .. })) && leans(input) {
        return Some(
            "this looks like a labelled shape, not a polycube: make the polycube of its labels first (command: \
             `polycube make SHAPE --labels FILE`); if it is a polycube, raise the level tolerance, or flatten it",
        );
    }
    let skew = violations.iter().filter(|v| matches!(v, Violation::SkewFace { .. })).count();
    let faces = input.polycube.cells().boundary().map_or(0, |faces| faces.len());
    (skew * SKEW > faces).then_some(
        "this looks like a shape, not a polycube: name its polycube; if it is one, give labels in a label file, raise \
         the angle tolerance, or flatten it",
    )
}

/// Whether faces all over lean away from the labels that are given.
fn leans(input: &Input) -> bool {
    let Some(labels) = input.labels else { return false };
    let faces = input.polycube.cells().boundary().unwrap_or_default();
    let along = |&(face, &label): &(&Face, &i8)| {
        let normal = area_vector(input.polycube.points(), face);
        Label::new(label).is_some_and(|l| f64::from(l.sign()) * normal[l.axis()] < UPRIGHT * normal.norm())
    };
    faces.iter().zip(labels).filter(along).count() * SKEW > faces.len()
}
