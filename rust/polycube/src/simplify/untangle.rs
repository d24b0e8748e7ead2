//! Turns the right way round what the morph turned over, by moving what is near it.

use super::corners::Corners;
use super::regions::{Region, Room, regions};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::{Mesh, Point};
use crate::optimise::{Elements, Freedom, Settings, optimise};
use crate::structure::Polycube;
use rayon::prelude::*;

/// How much around what is turned over moves: little at first, more where that is not enough.
const ROOMS: [Room; 2] = [Room { rings: 2, elements: 50 }, Room { rings: 3, elements: 200 }];

/// Where a larger part of all is turned over, facets are folded as a whole, and moving what is near does not help.
const FOLDED: f64 = 0.01;

/// Regions that have more elements than this all together are left alone, the largest first: seconds of work.
const MOST: usize = 50_000;

/// Untangling, and a little smoothing so that nothing is left all but flat. In a small region ε may fall fast, from the mean
/// determinant to a hundredth of it; where that is not enough, there is no room.
const SETTINGS: Settings = Settings {
    theta: 0.1,
    untangle_rounds: 12,
    untangle_iterations: 200,
    near_first: false,
    least_gain: 0.5,
    improve_rounds: 1,
    improve_iterations: 20,
    average: 0.0,
    strength: 0.0,
    polish_rounds: 0,
};

/// Moves vertices of `mesh` inside their facets, and those inside the solid, until no element is turned over or flat, as far
/// as that goes (foldover-free maps, Garanzha et al. 2021); each element shall look as in `shape`. Vertices on polycube
/// edges stay where they are. Only what is near elements turned over moves, each place by itself, so it takes next to no time
/// where there are few.
///
/// # Errors
/// [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
pub(super) fn untangle(polycube: &Polycube, mesh: &mut Mesh, shape: &Mesh, context: &Context) -> Result<()> {
    let mut corners = Corners::new(polycube, mesh, &shape.points);
    for (i, room) in ROOMS.into_iter().enumerate() {
        let bad = corners.turned_over();
        if bad.is_empty() || bad.len() as f64 > FOLDED * corners.tetrahedra.len() as f64 {
            break;
        }
        let part = |i: usize| i as f64 / ROOMS.len() as f64;
        corners.relax(&bad, room, &context.stage("untangle", part(i), part(i + 1)))?;
    }
    corners.points.truncate(corners.vertices);
    mesh.points = corners.points;
    Ok(())
}

impl Corners {
    /// Moves the vertices around the tetrahedra `bad`, region by region, where that leaves fewer of them.
    fn relax(&mut self, bad: &[usize], room: Room, context: &Context) -> Result<()> {
        let mut regions = regions(self, bad, room);
        regions.sort_by_key(|region| region.elements.len());
        let mut sum = 0;
        regions.retain(|region| {
            sum += region.elements.len();
            sum <= MOST
        });
        // No region sees what moves in another, so all may be done at once.
        let count = regions.len() as f64;
        let part = |i: usize| context.stage("untangle", i as f64 / count, (i + 1) as f64 / count);
        let moves = regions.par_iter().enumerate().map(|(i, region)| self.relaxed(region, &part(i)));
        for (vertex, point) in moves.collect::<Result<Vec<_>>>()?.into_iter().flatten() {
            self.points[vertex as usize] = point;
        }
        Ok(())
    }

    /// Where the vertices of a region go; nowhere if that leaves no fewer of its elements turned over.
    fn relaxed(&self, region: &Region, context: &Context) -> Result<Vec<(u32, Point)>> {
        let part = region.elements.iter().map(|&e| self.tetrahedra[e as usize]);
        let mut vertices: Vec<u32> = part.clone().flatten().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let own = |v: u32| vertices.binary_search(&v).map_or(u32::MAX, |i| i as u32);
        let tetrahedra: Vec<[u32; 4]> = part.map(|t| t.map(own)).collect();
        let rest: Vec<Point> = vertices.iter().map(|&v| self.rest[v as usize]).collect();
        let mut points: Vec<Point> = vertices.iter().map(|&v| self.points[v as usize]).collect();
        let moves = |v: &u32| region.moving.binary_search(v).is_ok();
        let freedom = |v: &u32| if moves(v) { self.freedom[*v as usize] } else { Freedom::Fixed };
        let freedom: Vec<Freedom> = vertices.iter().map(freedom).collect();
        let elements = Elements::tetrahedra_like(&tetrahedra, &rest)?;
        let report = optimise(&mut points, &elements, &freedom, &[], &SETTINGS, context)?;
        let better = report.inverted_after < report.inverted_before;
        Ok(vertices.into_iter().zip(points).filter(|(v, _)| better && moves(v)).collect())
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
