//! Turns the right way round what the morph turned over, by moving what is near it.

use super::corners::Corners;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::{Mesh, Point};
use crate::optimise::{Elements, Freedom, Settings, optimise};
use crate::structure::Polycube;

/// Rings of vertices around what is turned over that move: few at first, more where that is not enough.
const RINGS: [usize; 2] = [4, 8];

/// Where a larger part of all is turned over, facets are folded as a whole, and moving what is near does not help.
const FOLDED: f64 = 0.01;

/// More tetrahedra than this are left alone: seconds of work.
const MOST: usize = 50_000;

/// Untangling, and a little smoothing so that nothing is left all but flat.
const SETTINGS: Settings = Settings {
    theta: 0.1,
    untangle_rounds: 60,
    untangle_iterations: 200,
    improve_rounds: 1,
    improve_iterations: 20,
    average: 0.0,
    strength: 0.0,
    polish_rounds: 0,
};

/// Moves vertices of `mesh` inside their facets, and those inside the solid, until no element is turned over or flat, as far
/// as that goes (foldover-free maps, Garanzha et al. 2021); each element shall look as in `shape`. Vertices on polycube
/// edges stay where they are. Only what is near elements turned over moves, so it takes next to no time where there are few.
///
/// # Errors
/// [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
pub(super) fn untangle(polycube: &Polycube, mesh: &mut Mesh, shape: &Mesh, context: &Context) -> Result<()> {
    let mut corners = Corners::new(polycube, mesh, &shape.points);
    for (i, rings) in RINGS.into_iter().enumerate() {
        let bad = corners.turned_over();
        if bad.is_empty() || bad.len() as f64 > FOLDED * corners.tetrahedra.len() as f64 {
            break;
        }
        let part = |i: usize| i as f64 / RINGS.len() as f64;
        corners.relax(&bad, rings, &context.stage("untangle", part(i), part(i + 1)))?;
    }
    corners.points.truncate(mesh.points.len());
    mesh.points = corners.points;
    Ok(())
}

impl Corners {
    /// Moves the vertices within some rings of the tetrahedra `bad`, if that leaves fewer of them.
    fn relax(&mut self, bad: &[usize], rings: usize, context: &Context) -> Result<()> {
        let near = self.near(bad, rings);
        let part: Vec<&[u32; 4]> = self.tetrahedra.iter().filter(|t| t.iter().any(|&v| near[v as usize])).collect();
        if part.len() > MOST {
            return Ok(());
        }
        let mut vertices: Vec<u32> = part.iter().copied().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let own = |v: &u32| vertices.binary_search(v).map_or(u32::MAX, |i| i as u32);
        let tetrahedra: Vec<[u32; 4]> = part.iter().map(|t| t.each_ref().map(own)).collect();
        let rest: Vec<Point> = vertices.iter().map(|&v| self.rest[v as usize]).collect();
        let mut moved: Vec<Point> = vertices.iter().map(|&v| self.points[v as usize]).collect();
        let freedom = |&v: &u32| if near[v as usize] { self.freedom[v as usize] } else { Freedom::Fixed };
        let freedom: Vec<Freedom> = vertices.iter().map(freedom).collect();
        let elements = Elements::tetrahedra_like(&tetrahedra, &rest)?;
        let report = optimise(&mut moved, &elements, &freedom, &[], &SETTINGS, context)?;
        if report.inverted_after < report.inverted_before {
            vertices.iter().zip(moved).for_each(|(&v, point)| self.points[v as usize] = point);
        }
        Ok(())
    }

    /// Whether each vertex is within some rings of the tetrahedra `bad`.
    fn near(&self, bad: &[usize], rings: usize) -> Vec<bool> {
        let mut near = vec![false; self.points.len()];
        bad.iter().flat_map(|&i| self.tetrahedra[i]).for_each(|v| near[v as usize] = true);
        for _ in 0..rings {
            let inner = near.clone();
            let touching = self.tetrahedra.iter().filter(|t| t.iter().any(|&v| inner[v as usize]));
            touching.flatten().for_each(|&v| near[v as usize] = true);
        }
        near
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Cuboid, Voxels};
    use crate::map::{Flipped, flipped};
    use crate::mesh::CellKind;
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
        let middle = mesh.points.iter_mut().find(|p| **p == Point::new(3.0, 3.0, 6.0)).unwrap();
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
            untangle(&polycube, &mut mesh, &shape, &Context::default()).unwrap();
            assert!(turned_over(&mesh, &polycube).is_empty(), "{kind}");
            for (v, levels) in polycube.vertex_levels.iter().enumerate() {
                let known = levels.iter().flatten().count();
                let kept = (0..3).filter(|&a| known > 1 || levels[a].is_some());
                kept.for_each(|a| assert_eq!(mesh.points[v][a], folded.points[v][a], "{kind}, vertex {v}"));
            }
        }
    }

    #[test]
    fn what_is_right_stays_as_it_is() {
        for kind in ALL {
            let (shape, polycube) = cube(kind);
            let mut mesh = shape.clone();
            untangle(&polycube, &mut mesh, &shape, &Context::default()).unwrap();
            assert_eq!(mesh.points, shape.points);
        }
    }
}
