//! What keeps a polycube from being made of a shape, or hexahedra from filling it.

use super::finding::{Finding, Middles, Subject};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::measure::crossings;
use crate::mesh::{Face, Mesh, Point};
use crate::structure::{Surface, Violation};

/// Lists what is wrong with a shape that has no polycube yet; of a volume, with its surface. First come violations of
/// the first rule for closed, oriented, manifold surfaces that does not hold or, where they all hold, `inside_out` if
/// the surface looks inward; then `crossing_faces` for every two faces that cross. [`make`](crate::make::make()) does
/// not mind the latter, but no hexahedra can fill such a shape. Nothing for a shape that is fit to be meshed.
/// O(n log n) for n faces, and for the pairs that cross.
///
/// ```
/// use polycube::Context;
/// use polycube::generate::{Example, example};
/// use polycube::mesh::CellKind;
/// use polycube::validate::validate_shape;
///
/// let (_, shape) = example(Example::Ring, 1, CellKind::Triangles)?;
/// assert!(validate_shape(&shape, &Context::default())?.is_empty());
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
pub fn validate_shape(shape: &Mesh, context: &Context) -> Result<Vec<Finding>> {
    let faces = match shape.cells().boundary() {
        Ok(faces) => faces,
        Err(error) => return Ok(vec![Finding::of(error, Subject::Shape)?]),
    };
    let middles = Middles::new(shape);
    let crossing = crossing_faces(shape.points(), &faces, context)?;
    let violations = match Surface::new(faces, shape.points().len()) {
        Ok(surface) if surface.volume(shape.points()) < 0.0 => vec![Violation::InsideOut { face: 0 }],
        Ok(_) => Vec::new(),
        Err(violations) => violations,
    };
    let mut findings = middles.findings(violations.into_iter(), Subject::Shape);
    for [face, other] in crossing {
        let error = Error::new(ErrorKind::Mesh, format!("this face and face {other} cross"))
            .at(Place::Face(face))
            .remedy("move the surface apart there, or unite the parts that overlap");
        findings.push(middles.finding("crossing_faces", error, Subject::Shape));
    }
    Ok(findings)
}

/// Every two faces that cross, each pair once.
fn crossing_faces(points: &[Point], faces: &[Face], context: &Context) -> Result<Vec<[u32; 2]>> {
    let parts = (0..).zip(faces).flat_map(|(i, face)| face.triangles().map(move |t| (i, t)));
    let (face_of, triangles): (Vec<u32>, Vec<[u32; 3]>) = parts.unzip();
    let pairs = crossings(points, &triangles, context)?;
    let mut pairs: Vec<[u32; 2]> = pairs.into_iter().map(|pair| pair.map(|t| face_of[t as usize])).collect();
    pairs.iter_mut().for_each(|pair| pair.sort_unstable());
    pairs.retain(|[a, b]| a != b);
    pairs.sort_unstable();
    pairs.dedup();
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Cuboid, Voxels};
    use crate::mesh::{CellKind, Cells};

    fn quads(mesh: &Mesh) -> Vec<[u32; 4]> {
        let Cells::Quads(quads) = mesh.cells() else { panic!("not quadrilaterals") };
        quads.clone()
    }

    /// Two cubes as one surface, the second moved by `by`, of four faces a side.
    fn two_cubes(by: [f64; 3]) -> Mesh {
        two_cubes_of(2, by)
    }

    /// The same of sides as long as told, with faces of side 1.
    fn two_cubes_of(side: i64, by: [f64; 3]) -> Mesh {
        let cube = Voxels::from_boxes(&[Cuboid::new([0; 3], [side; 3])]).unwrap().mesh(CellKind::Quads, 1.0).unwrap();
        let count = cube.points().len() as u32;
        let moved = cube.points().iter().map(|p| p + nalgebra::Vector3::from(by));
        let points = cube.points().iter().copied().chain(moved).collect();
        let cells = quads(&cube).into_iter().flat_map(|q| [q, q.map(|v| v + count)]).collect();
        Mesh::new(points, Cells::Quads(cells)).unwrap()
    }

    fn rules(mesh: &Mesh) -> Vec<&'static str> {
        validate_shape(mesh, &Context::default()).unwrap().iter().map(|f| f.rule).collect()
    }

    #[test]
    fn faces_that_cross_are_named_with_their_place() {
        assert_eq!(rules(&two_cubes([2.5, 0.25, 0.25])), [""; 0], "apart");
        let found = validate_shape(&two_cubes([1.5, 0.25, 0.25]), &Context::default()).unwrap();
        assert!(!found.is_empty() && found.iter().all(|f| f.rule == "crossing_faces"), "{found:?}");
        // Of the part that both have in common, all edges lie in the faces named.
        let beside = |f: &Finding| f.at.is_some_and(|[x, ..]| (1.0..=2.5).contains(&x));
        assert!(found.iter().all(beside), "{found:?}");
    }

    /// Three faces at a corner of each go through two of the other, all but that which looks the opposite way. Half a
    /// side away, edges of each pass just where the two triangles of a face of the other meet.
    #[test]
    fn every_two_faces_that_cross_are_named() {
        for by in [[0.625, 0.5, 0.375], [0.5, 0.5, 0.5]] {
            assert_eq!(rules(&two_cubes_of(1, by)), ["crossing_faces"; 6], "{by:?}");
        }
        assert_eq!(rules(&two_cubes([2.0, 0.5, 0.5])), [""; 0], "side by side");
    }

    #[test]
    fn open_and_inward_surfaces_are_told() {
        let sound = two_cubes([5.0, 0.0, 0.0]);
        let turned = quads(&sound).into_iter().map(|[a, b, c, d]| [d, c, b, a]).collect();
        let turned = Mesh::new(sound.points().to_vec(), Cells::Quads(turned)).unwrap();
        assert_eq!(rules(&turned), ["inside_out"]);
        let without_last = |mesh: &Mesh| {
            let mut open = quads(mesh);
            open.pop();
            Mesh::new(mesh.points().to_vec(), Cells::Quads(open)).unwrap()
        };
        assert_eq!(rules(&without_last(&sound)), ["open_edge"; 4]);
        // What crosses is told of open surfaces, too.
        let both = rules(&without_last(&two_cubes([1.5, 0.25, 0.25])));
        assert_eq!(both[..4], ["open_edge"; 4]);
        assert!(both.len() > 4 && both[4..].iter().all(|rule| *rule == "crossing_faces"), "{both:?}");
    }

    /// Three edges of a triangle, each in one face alone: whichever way around it is given, they pierce the others.
    #[test]
    fn edges_of_open_surfaces_are_looked_at_whichever_way_they_run() {
        let points =
            [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, -1.0], [1.0, 1.5, 1.0], [1.5, 1.0, 1.0]];
        let points: Vec<Point> = points.into_iter().map(Point::from).collect();
        for tip in [[3, 4, 5], [5, 4, 3], [4, 3, 5]] {
            let mesh = Mesh::new(points.clone(), Cells::Triangles(vec![[0, 1, 2], tip])).unwrap();
            assert_eq!(rules(&mesh).iter().filter(|rule| **rule == "crossing_faces").count(), 1, "{tip:?}");
        }
    }
}
