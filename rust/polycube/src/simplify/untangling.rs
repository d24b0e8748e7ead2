//! Turns the right way round what the morph turned over, by moving what is near it.

use super::corner_tetrahedra::CornerTetrahedra;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Mesh;
use crate::optimise::{Elements, Scope, Settings, optimise};
use crate::structure::Polycube;

/// In a small region ε may fall fast, from the mean determinant to a hundredth of it; where that is not enough, there
/// is no room. What is right stays as it is.
const SETTINGS: Settings = Settings {
    theta: 0.1,
    scope: Scope::Near,
    untangle_rounds: 12,
    untangle_iterations: 200,
    least_gain: 0.5,
    improve_rounds: 0,
    improve_iterations: 0,
    average: 0.0,
    strength: 0.0,
    polish_rounds: 0,
};

/// Moves vertices of `mesh` inside their facets, and those inside the solid, until no element is turned over or flat,
/// as far as that goes (foldover-free maps, Garanzha et al. 2021); each element shall look as in `shape`. Vertices on
/// polycube edges stay where they are. Only what is near elements turned over moves, each place by itself, so it takes
/// next to no time where there are few.
///
/// # Errors
/// [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
pub(crate) fn untangle_morphed(polycube: &Polycube, mesh: &mut Mesh, shape: &Mesh, context: &Context) -> Result<()> {
    let mut corners = CornerTetrahedra::new(polycube, mesh, shape.points());
    if corners.turned_over().is_empty() {
        return Ok(());
    }
    let elements = Elements::tetrahedra_like(&corners.tetrahedra, &corners.rest)?;
    optimise(&mut corners.points, &elements, &corners.freedom, &[], &SETTINGS, context)?;
    corners.points.truncate(corners.vertices);
    mesh.points_mut().copy_from_slice(&corners.points);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Cuboid, Voxels};
    use crate::measure::{Flipped, flipped};
    use crate::mesh::{CellKind, Point};
    use crate::structure::Tolerance;

    const ALL: [CellKind; 4] = [CellKind::Triangles, CellKind::Quads, CellKind::Tetrahedra, CellKind::Hexahedra];

    fn cube(kind: CellKind) -> (Mesh, Polycube) {
        let mesh = Voxels::from_boxes(&[Cuboid::new([0; 3], [6; 3])]).unwrap().mesh(kind, 1.0).unwrap();
        let polycube = Polycube::new(&mesh, None, &Tolerance::default()).unwrap();
        (mesh, polycube)
    }

    fn turned_over(mesh: &Mesh, polycube: &Polycube) -> Flipped {
        let labels: Vec<i8> = polycube.labels().map(|l| l.index() as i8).collect();
        flipped(mesh, &labels).unwrap()
    }

    /// Pushes the vertex in the middle of the facet on top over the next two.
    fn fold(mesh: &mut Mesh) {
        let middle = mesh.points_mut().iter_mut().find(|p| **p == Point::new(3.0, 3.0, 6.0)).unwrap();
        middle.x += 2.2;
    }

    #[test]
    fn a_folded_facet_is_made_flat_again() {
        for kind in ALL {
            let (shape, polycube) = cube(kind);
            let mut mesh = shape.clone();
            fold(&mut mesh);
            let folded = mesh.clone();
            assert!(!turned_over(&mesh, &polycube).is_empty());
            untangle_morphed(&polycube, &mut mesh, &shape, &Context::default()).unwrap();
            assert!(turned_over(&mesh, &polycube).is_empty(), "{kind}");
            for (v, levels) in polycube.vertex_levels.iter().enumerate() {
                let known = levels.iter().flatten().count();
                let kept = (0..3).filter(|&a| known > 1 || levels[a].is_some());
                kept.for_each(|a| assert_eq!(mesh.points()[v][a], folded.points()[v][a], "{kind}, vertex {v}"));
            }
        }
    }

    #[test]
    fn what_is_right_stays_as_it_is() {
        for kind in ALL {
            let (shape, polycube) = cube(kind);
            let mut mesh = shape.clone();
            untangle_morphed(&polycube, &mut mesh, &shape, &Context::default()).unwrap();
            assert_eq!(mesh.points(), shape.points());
        }
    }
}
