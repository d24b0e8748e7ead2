//! Everything that is wrong with a polycube and its shape.

use super::finding::{Finding, Middles, Subject};
use crate::error::{Error, Result};
use crate::measure::flipped;
use crate::mesh::Mesh;
use crate::repair::{Repair, Repaired, repair};
use crate::simplify::{Input, Misfit, check_compatible, check_side, remedy};
use crate::structure::{Polycube, Tolerance, Violation};

/// Lists every violation of the first rule of [`Violation`] that does not hold, then all elements that are turned over.
/// Nothing for a valid polycube and a shape that goes with it; whatever the mesh, it can be judged.
/// O(n log n) for n cells.
///
/// ```
/// use polycube::Input;
/// use polycube::generate::{Example, example};
/// use polycube::mesh::CellKind;
/// use polycube::structure::Tolerance;
/// use polycube::validate::validate;
///
/// let (cube, shape) = example(Example::Ring, 1, CellKind::Triangles)?;
/// let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
/// assert!(validate(&input, &Tolerance::default())?.is_empty());
///
/// // The wrong way round, as files are easily given: the shape is no polycube.
/// let input = Input { polycube: &shape, shape: Some(&cube), labels: None };
/// for finding in validate(&input, &Tolerance::default())? {
///     println!("{:?} at {:?}: {} ({})", finding.element, finding.at, finding.message, finding.remedy);
/// }
/// # assert!(!validate(&input, &Tolerance::default())?.is_empty());
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Option`](crate::ErrorKind::Option) for a tolerance out of its range.
pub fn validate(input: &Input, tolerance: &Tolerance) -> Result<Vec<Finding>> {
    tolerance.check()?;
    let repaired = input.polycube.cells().is_volume().then(|| repair(input)).flatten();
    let stored =
        repaired.iter().flat_map(|r| &r.repairs).filter_map(|repair| stored_otherwise(*repair, input.polycube));
    let stored: Vec<Finding> = stored.collect();
    let input = &repaired.as_ref().map_or(*input, Repaired::input);
    let misfit = check_compatible(input).err();
    let of_polycube = misfit.as_ref().is_some_and(|m| !m.in_shape);
    let (mut findings, polycube) = if of_polycube { (Vec::new(), None) } else { polycube(input, tolerance) };
    let sides = |polycube: Polycube, shape: &Mesh| check_side(&polycube, input.polycube.points(), shape.points()).err();
    let fits = misfit.is_none();
    let mirrored = polycube.zip(input.shape).filter(|_| fits).and_then(|(polycube, shape)| sides(polycube, shape));
    // Of a mirrored volume all cells are inverted.
    let is_mirrored = mirrored.is_some();
    findings.extend(misfit.or(mirrored).map(|misfit| misplaced(misfit, input)));
    if let Some(shape) = input.shape.filter(|_| !is_mirrored) {
        let cells = flipped(shape, &[]).map(|f| f.cells).unwrap_or_default();
        findings.extend(Middles::new(shape).findings(inverted(&cells), Subject::Shape));
    }
    Ok([stored, findings].concat())
}

/// What is wrong with how the cells of a volume are stored, once for each cause.
fn stored_otherwise(repair: Repair, mesh: &Mesh) -> Option<Finding> {
    let cells = mesh.cells().len();
    let (rule, message, remedy) = match repair {
        Repair::Welded(n) => (
            "not_welded",
            format!("{n} vertices lie at the place of others, so that cells beside each other share no faces"),
            "weld vertices at one place",
        ),
        Repair::Duplicates(n) => (
            "duplicate_cells",
            format!("{n} of {cells} cells are there twice"),
            "remove the cells that are there twice",
        ),
        Repair::TurnedCells(n) => (
            "left_handed",
            format!("{n} of {cells} cells are numbered left-handed: their vertices go round the other way"),
            "swap two vertices of each such tetrahedron, or the two rings of each such hexahedron",
        ),
        Repair::InnerFaces(_) | Repair::TurnedFaces(_) | Repair::TurnedLabels(_) => return None,
    };
    let remedy = format!("{remedy}, or leave it to `simplify` and `remesh`, which repair this");
    Some(Finding { rule, mesh: Subject::Polycube, element: None, at: None, message, remedy })
}

/// What keeps the parts of `input` from going together.
fn misplaced(misfit: Misfit, input: &Input) -> Finding {
    let Misfit { rule, in_shape, error } = misfit;
    let mesh = if in_shape { Subject::Shape } else { Subject::Polycube };
    let own = if in_shape { input.shape.unwrap_or(input.polycube) } else { input.polycube };
    let Error { place: element, message, remedy, .. } = *error;
    let at = element.and_then(|place| own.middle(place));
    Finding { rule, mesh, element, at, message, remedy }
}

/// What is wrong with the polycube, and its structure if that can be read and nothing touches.
fn polycube(input: &Input, tolerance: &Tolerance) -> (Vec<Finding>, Option<Polycube>) {
    let mesh = input.polycube;
    let mut better = None;
    let (mut violations, polycube, labels, ordered) = match Polycube::new(mesh, input.labels, tolerance) {
        Ok(polycube) => {
            let labels: Vec<i8> = polycube.labels().map(|l| l.index() as i8).collect();
            let overlaps = polycube.overlaps(mesh.points());
            let ordered = polycube.in_order(mesh);
            let sound = overlaps.is_empty().then_some(polycube);
            (overlaps, sound, labels, ordered)
        }
        Err(violations) => {
            better = remedy(&violations, input, tolerance);
            (violations, None, Vec::new(), None)
        }
    };
    // What is only out of order along an edge is put in order before all else.
    let flipped = flipped(ordered.as_ref().unwrap_or(mesh), &labels).unwrap_or_default();
    violations.extend(inverted(&flipped.cells));
    let middles = Middles::new(mesh);
    let mut findings = middles.findings(violations.into_iter(), Subject::Polycube);
    if let Some(better) = better {
        findings.iter_mut().for_each(|f| better.clone_into(&mut f.remedy));
    }
    findings.extend(flipped.faces.iter().map(|&face| middles.flipped_face(face)));
    (findings, polycube)
}

fn inverted(cells: &[u32]) -> impl Iterator<Item = Violation> + '_ {
    cells.iter().map(|&cell| Violation::InvertedCell { cell })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use crate::context::Context;
    use crate::generate::{Example, example};
    use crate::mesh::{CellKind, Cells};
    use crate::simplify::{SimplifyOptions, simplify};

    #[test]
    fn a_shape_that_does_not_fit_is_named() {
        let (polycube, shape) = example(Example::CubeSpikes, 1, CellKind::Triangles).unwrap();
        let told = |shape: &Mesh| {
            let input = Input { polycube: &polycube, shape: Some(shape), labels: None };
            let error = simplify(&input, &SimplifyOptions::default(), &Context::default()).unwrap_err();
            let found = validate(&input, &Tolerance::default()).unwrap();
            assert_eq!((found[0].mesh, &found[0].message), (Subject::Shape, &error.message));
            (found[0].rule, error.kind, error.place)
        };
        let Cells::Triangles(cells) = shape.cells() else { panic!("not triangles") };
        let mut cells = cells.clone();
        cells.pop();
        let broken = Mesh::new(shape.points().to_vec(), Cells::Triangles(cells)).unwrap();
        assert_eq!(told(&broken), ("mismatch", ErrorKind::Mismatch, None));
    }
}
