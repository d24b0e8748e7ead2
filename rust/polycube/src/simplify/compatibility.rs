//! Whether polycube, shape and labels go together: what is asked of them before anything is done with them.

use super::Input;
use crate::error::{Error, ErrorKind, Place};
use crate::mesh::{LabelOrder, Mesh, Point};
use crate::structure::{Polycube, cone, convention};

/// No coordinate may be larger: the sixth powers of lengths, which energies have, are still numbers.
pub(super) const LARGEST_COORDINATE: f64 = 1e50;

/// A volume below this part of the sum of what it is made of may as well be zero.
const NOISE: f64 = 1e-9;

/// Why an input cannot be used.
#[derive(Debug)]
pub(crate) struct Misfit {
    /// A short name of the rule broken, in `snake_case`.
    pub(crate) rule: &'static str,
    /// Whether it is the shape that is wrong.
    pub(crate) in_shape: bool,
    /// What is wrong, and what to do about it.
    pub(crate) error: Box<Error>,
}

impl From<Misfit> for Error {
    fn from(misfit: Misfit) -> Self {
        *misfit.error
    }
}

type Checked = Result<(), Misfit>;

/// Refuses labels that are not one for each boundary face, coordinates that are too large, and a shape that does not go
/// with the polycube. What else the polycube must be, [`Polycube::new`] tells.
pub(crate) fn check_compatible(input: &Input) -> Checked {
    input.labels.map_or(Ok(()), |labels| check_labels(labels, input.polycube))?;
    check_size(input.polycube.points(), false)?;
    let Some(shape) = input.shape else { return Ok(()) };
    if shape.cells() != input.polycube.cells() || shape.points().len() != input.polycube.points().len() {
        let error = Error::new(ErrorKind::Mismatch, "shape and polycube do not have the same vertices and cells")
            .remedy("give the pair that one deformation connects, with the same numbering");
        return Err(Misfit { rule: "mismatch", in_shape: true, error: Box::new(error) });
    }
    check_size(shape.points(), true)
}

fn check_labels(labels: &[i8], polycube: &Mesh) -> Checked {
    // A mesh without a boundary is none to have labels for: what is wrong with it is found when it is read.
    let Ok(faces) = polycube.cells().boundary() else { return Ok(()) };
    let misfit = |rule, error| Misfit { rule, in_shape: false, error: Box::new(error) };
    if labels.len() != faces.len() {
        let error =
            Error::new(ErrorKind::Mismatch, format!("{} labels for {} boundary faces", labels.len(), faces.len()))
                .remedy("give one label for each boundary face");
        return Err(misfit("mismatch", error));
    }
    let bad = (0..).zip(labels).find(|(_, label)| !(-1..=5).contains(*label));
    if let Some(order) = convention(polycube.points(), &faces, labels) {
        return Err(misfit("label_order", in_other_order(&order)));
    }
    let Some((face, label)) = bad else { return Ok(()) };
    let error = Error::new(ErrorKind::Option, format!("{label} is no label"))
        .at(Place::Face(face))
        .remedy("use 0 to 5 for +X -X +Y -Y +Z -Z, or -1 for \"by the normal\"");
    Err(misfit("bad_label", error))
}

/// The error of labels that count the directions in another order than ours.
fn in_other_order(order: &LabelOrder) -> Error {
    let (first, ours) = (if order.label(0).is_some() { 0 } else { 1 }, LabelOrder::default());
    let message = format!(
        "the labels look away from their faces: they count the directions from {first} on as {order}, not from 0 on as \
         {ours}"
    );
    Error::new(ErrorKind::Option, message)
        .remedy(format!("give them in our order, or say which they are in (command: --label-order={order})"))
}

fn check_size(points: &[Point], in_shape: bool) -> Checked {
    let too_large = |x: &f64| x.abs() > LARGEST_COORDINATE;
    let bad = (0..).zip(points).find(|(_, p)| p.iter().any(too_large));
    let Some((vertex, _)) = bad else { return Ok(()) };
    let which = if in_shape { "shape" } else { "polycube" };
    let message = format!("a coordinate of the {which} is beyond ±{LARGEST_COORDINATE:e}");
    let error = Error::new(ErrorKind::Mesh, message)
        .at(Place::Vertex(vertex))
        .remedy("export the mesh in smaller units, or repair the vertex");
    Err(Misfit { rule: "too_large", in_shape, error: Box::new(error) })
}

/// Refuses a shape of which some part looks inward where that part of the valid polycube looks outward, or the other
/// way round.
pub(crate) fn check_side(polycube: &Polycube, points: &[Point], shape: &[Point]) -> Checked {
    let component = polycube.structure.components();
    let volumes = |points| volumes(polycube, &component, points);
    let mirrored = |(own, other): (&Volume, &Volume)| own.is_clear() && other.is_clear() && own.sum * other.sum < 0.0;
    let bad = volumes(points).iter().zip(&volumes(shape)).position(mirrored);
    let Some(part) = bad else { return Ok(()) };
    let is_in = |&facet: &u32| component[facet as usize] as usize == part;
    let face = polycube.facet_of_face.iter().position(is_in).unwrap_or(0) as u32;
    let message = "the shape is mirrored here: its surface looks inward where that of the polycube looks outward";
    let error = Error::new(ErrorKind::Mesh, message)
        .at(Place::Face(face))
        .remedy("mirror the shape back, for example by negating one coordinate of its vertices, and keep its cells");
    Err(Misfit { rule: "mirrored", in_shape: true, error: Box::new(error) })
}

/// Six times the volume that a part of a surface encloses, and the sum of the absolute values that it is summed from.
#[derive(Clone, Copy, Default)]
struct Volume {
    sum: f64,
    scale: f64,
}

impl Volume {
    fn is_clear(&self) -> bool {
        self.sum.abs() > NOISE * self.scale
    }
}

/// By the divergence theorem, for each component of the facets.
fn volumes(polycube: &Polycube, component: &[u32], points: &[Point]) -> Vec<Volume> {
    let mut volumes = vec![Volume::default(); component.iter().max().map_or(0, |&c| c as usize + 1)];
    let mut origins = vec![None; volumes.len()];
    for (face, &facet) in polycube.surface.faces().iter().zip(&polycube.facet_of_face) {
        let part = component[facet as usize] as usize;
        let origin = *origins[part].get_or_insert(points[face.vertices()[0] as usize]);
        let cone = cone(points, face, &origin);
        volumes[part].sum += cone;
        volumes[part].scale += cone.abs();
    }
    volumes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::context::Context;
    use crate::generate::{Example, example};
    use crate::mesh::{CellKind, Cells};
    use crate::simplify::{Note, Simplified, SimplifyOptions, fit, read_structure, simplify};
    use crate::structure::Tolerance;
    use crate::validate::{Subject, validate};

    fn paper() -> SimplifyOptions {
        SimplifyOptions { strategy: crate::align::Strategy::Paper, ..SimplifyOptions::default() }
    }

    fn simplified(input: &Input) -> Simplified {
        simplify(input, &paper(), &Context::default()).unwrap()
    }

    #[test]
    fn labels_in_another_order_are_told_with_it() {
        let (polycube, _) = example(Example::SteppedL, 1, CellKind::Quads).unwrap();
        let found = read_structure(&Input { polycube: &polycube, shape: None, labels: None }, &Tolerance::default());
        for text in ["-X+X-Y+Y-Z+Z", "+Z-Z+X-X+Y-Y", "1:+X-X+Y-Y+Z-Z"] {
            let order: LabelOrder = text.parse().unwrap();
            let number = |label: i8| (0..=6).find(|&n| order.label(n) == Some(label)).unwrap();
            let numbers: Vec<i8> = found.as_ref().unwrap().labels().map(|l| number(l.index() as i8)).collect();
            let input = Input { polycube: &polycube, shape: None, labels: Some(&numbers) };
            assert_eq!(refused(&input), (ErrorKind::Option, None, "label_order", Subject::Polycube));
            let error = read_structure(&input, &Tolerance::default()).unwrap_err();
            assert!(error.remedy.contains(&format!("--label-order={text})")), "{error}");
        }
    }

    /// The kind of the error that everything gives, and the rule that a check names.
    fn refused(input: &Input) -> (ErrorKind, Option<Place>, &'static str, Subject) {
        let error = simplify(input, &paper(), &Context::default()).unwrap_err();
        assert_eq!(read_structure(input, &Tolerance::default()).map(drop), Err(error.clone()));
        let found = validate(input, &Tolerance::default()).unwrap();
        assert_eq!((found.len(), &found[0].message, found[0].element), (1, &error.message, error.place), "{found:?}");
        assert!(!error.remedy.is_empty());
        (error.kind, error.place, found[0].rule, found[0].mesh)
    }

    #[test]
    fn labels_are_one_for_each_boundary_face() {
        for kind in CellKind::ALL {
            let (polycube, shape) = example(Example::Ring, 1, kind).unwrap();
            let good = vec![-1; polycube.cells().boundary().unwrap().len()];
            let refused =
                |labels: &[i8]| refused(&Input { polycube: &polycube, shape: Some(&shape), labels: Some(labels) });
            for wrong in [vec![], good[1..].to_vec(), [&good[..], &[-1; 50]].concat()] {
                assert_eq!(refused(&wrong), (ErrorKind::Mismatch, None, "mismatch", Subject::Polycube), "{kind}");
            }
            for label in [9, -2] {
                let mut wrong = good.clone();
                wrong[3] = label;
                let expected = (ErrorKind::Option, Some(Place::Face(3)), "bad_label", Subject::Polycube);
                assert_eq!(refused(&wrong), expected, "{kind}");
            }
            simplified(&Input { polycube: &polycube, shape: Some(&shape), labels: Some(&good) });
        }
    }

    #[test]
    fn a_mirrored_shape_is_blamed() {
        for kind in CellKind::ALL {
            let (polycube, shape) = example(Example::Ring, 1, kind).unwrap();
            let result = simplified(&Input { polycube: &polycube, shape: Some(&shape), labels: None });
            let mut mirrored = shape.clone();
            mirrored.points_mut().iter_mut().for_each(|p| p.x = 7.0 - p.x);
            let input = Input { polycube: &polycube, shape: Some(&mirrored), labels: None };
            assert_eq!(refused(&input), (ErrorKind::Mesh, Some(Place::Face(0)), "mirrored", Subject::Shape), "{kind}");
            let again = result.rescaled(&input, 2.0, &Context::default());
            assert_eq!(again.map(drop).unwrap_err().kind, ErrorKind::Mesh, "{kind}");
        }
    }

    #[test]
    fn coordinates_too_large_to_reckon_with_are_named() {
        let (polycube, shape) = example(Example::Ring, 1, CellKind::Triangles).unwrap();
        let mut large = shape.clone();
        large.points_mut()[5].y = -1e80;
        let expected = (ErrorKind::Mesh, Some(Place::Vertex(5)), "too_large", Subject::Shape);
        assert_eq!(refused(&Input { polycube: &polycube, shape: Some(&large), labels: None }), expected);
        large = polycube;
        large.points_mut()[5].y = 1e80;
        let expected = (ErrorKind::Mesh, Some(Place::Vertex(5)), "too_large", Subject::Polycube);
        assert_eq!(refused(&Input { polycube: &large, shape: Some(&shape), labels: None }), expected);
    }

    #[test]
    fn a_result_that_cannot_be_measured_is_kept() {
        for kind in [CellKind::Triangles, CellKind::Tetrahedra] {
            let (polycube, mut shape) = example(Example::Ring, 1, kind).unwrap();
            shape.points_mut().fill(Point::origin());
            let result = simplified(&Input { polycube: &polycube, shape: Some(&shape), labels: None });
            assert!(result.polycube.is_some() && result.report.distortion.is_none(), "{kind}");
            assert!(result.report.notes.iter().any(|n| matches!(n, Note::Unmeasured(_))), "{kind}");
        }
    }

    #[test]
    fn a_result_goes_with_the_cells_it_was_made_from() {
        let (polycube, _) = example(Example::Ring, 1, CellKind::Quads).unwrap();
        let result = simplified(&Input { polycube: &polycube, shape: None, labels: None });
        let Cells::Quads(cells) = polycube.cells() else { unreachable!() };
        let reversed = Cells::Quads(cells.iter().rev().copied().collect());
        let other = Mesh::new(polycube.points().to_vec(), reversed).unwrap();
        let input = Input { polycube: &other, shape: None, labels: None };
        let error = result.rescaled(&input, 2.0, &Context::default()).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Mismatch);
    }

    #[test]
    fn a_placement_that_turns_an_edge_round_is_refused() {
        let (polycube, _) = example(Example::Ring, 1, CellKind::Quads).unwrap();
        let found = read_structure(&Input { polycube: &polycube, shape: None, labels: None }, &Tolerance::default());
        let found = found.unwrap();
        let refused = |placement: &[f64]| fit(&found, &polycube, placement, 1.0, &Context::default()).unwrap_err();
        let turned: Vec<f64> = found.placement.iter().map(|x| -x).collect();
        let error = refused(&turned);
        assert!(error.kind == ErrorKind::Option && matches!(error.place, Some(Place::PolycubeEdge(_))), "{error}");
        assert_eq!(refused(&turned[1..]).kind, ErrorKind::Option);
    }
}
