//! Where the surface of a polycube touches or crosses itself, or looks inward, told by faces of its mesh.

use super::{Arrangement, Conflict, Polycube, Violation};
use crate::mesh::Point;

/// One conflict of each pair of facets that meet and, where there is none, a facet of each part that looks inward.
pub(crate) struct Overlaps<'a> {
    polycube: &'a Polycube,
    conflicts: Vec<Conflict>,
    inward: Vec<u32>,
}

impl<'a> Overlaps<'a> {
    /// Those of the polycube as its mesh comes. O(n log n) for n edges and conflicts together.
    pub(crate) fn of(polycube: &'a Polycube) -> Self {
        let arrangement = Arrangement::new(&polycube.structure, &polycube.placement);
        let conflicts = one_a_pair(arrangement.conflicts());
        let inward = if conflicts.is_empty() { arrangement.inside_out() } else { Vec::new() };
        Self { polycube, conflicts, inward }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.conflicts.len() + self.inward.len()
    }

    /// The first of [`all`](Self::all).
    pub(crate) fn first(&self, points: &[Point]) -> Option<Violation> {
        let (conflicts, inward) = (self.conflicts.iter().take(1).cloned(), self.inward.iter().take(1).copied());
        let first = Self { polycube: self.polycube, conflicts: conflicts.collect(), inward: inward.collect() };
        first.all(points).pop()
    }

    /// All of them, at the faces that are nearest to where facets meet.
    pub(crate) fn all(&self, points: &[Point]) -> Vec<Violation> {
        if self.len() == 0 {
            return Vec::new();
        }
        let faces = Faces::new(self.polycube, points);
        let meet = self.conflicts.iter().map(|conflict| {
            let [face, other] = conflict.facets.map(|facet| faces.nearest(facet, Point::from(conflict.point)));
            let is_one = conflict.facets[0] == conflict.facets[1];
            if is_one { Violation::FoldedFacet { face } } else { Violation::SelfOverlap { face, other } }
        });
        let inward = self.inward.iter().map(|&facet| Violation::InsideOut { face: faces.first(facet) });
        meet.chain(inward).collect()
    }
}

/// The first conflict of each pair of facets, in the order in which they came.
fn one_a_pair(conflicts: Vec<Conflict>) -> Vec<Conflict> {
    let pair = |conflict: &Conflict| {
        let [a, b] = conflict.facets;
        [a.min(b), a.max(b)]
    };
    let mut numbered: Vec<(usize, Conflict)> = conflicts.into_iter().enumerate().collect();
    numbered.sort_by_key(|(_, conflict)| pair(conflict));
    numbered.dedup_by_key(|(_, conflict)| pair(conflict));
    numbered.sort_unstable_by_key(|(i, _)| *i);
    numbered.into_iter().map(|(_, conflict)| conflict).collect()
}

/// The boundary faces of each facet, with their middles.
struct Faces {
    of_facet: Vec<Vec<(u32, Point)>>,
}

impl Faces {
    fn new(polycube: &Polycube, points: &[Point]) -> Self {
        let mut of_facet = vec![Vec::new(); polycube.structure.facets.len()];
        for ((i, face), &facet) in (0..).zip(polycube.surface.faces()).zip(&polycube.facet_of_face) {
            of_facet[facet as usize].push((i, face.middle(points)));
        }
        Self { of_facet }
    }

    fn first(&self, facet: u32) -> u32 {
        self.of_facet[facet as usize].first().map_or(0, |face| face.0)
    }

    /// The face of `facet` whose middle is nearest; the first of equals.
    fn nearest(&self, facet: u32, to: Point) -> u32 {
        let distance = |face: &&(u32, Point)| (face.1 - to).norm();
        let nearest = self.of_facet[facet as usize].iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.map_or(0, |face| face.0)
    }
}

impl Polycube {
    /// Where the surface touches or crosses itself, or looks inward, as the mesh comes: one place for each pair of
    /// facets that meet.
    pub fn overlaps(&self, points: &[Point]) -> Vec<Violation> {
        Overlaps::of(self).all(points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Cuboid, Voxels};
    use crate::mesh::{CellKind, Cells, Mesh};
    use crate::structure::Tolerance;
    use std::collections::BTreeSet;

    /// `count` bars along X that as many along Y cross, each of a surface of its own.
    fn crossing_bars(count: i64) -> Mesh {
        let end = 3 * count + 1;
        let along_x = (0..count).map(|i| ([0, 3 * i + 1, 0], [end, 3 * i + 2, 4]));
        let along_y = (0..count).map(|i| ([3 * i + 1, 0, 1], [3 * i + 2, end, 3]));
        let (mut points, mut cells) = (Vec::new(), Vec::new());
        for (low, high) in along_x.chain(along_y) {
            let bar = Voxels::from_boxes(&[Cuboid::new(low, high)]).unwrap().mesh(CellKind::Quads, 1e9).unwrap();
            let first = points.len() as u32;
            points.extend(bar.points());
            let Cells::Quads(own) = bar.cells() else { unreachable!() };
            cells.extend(own.iter().map(|c| c.map(|v| v + first)));
        }
        Mesh::new(points, Cells::Quads(cells)).unwrap()
    }

    #[test]
    fn each_pair_of_facets_that_meet_is_named_once() {
        let mesh = crossing_bars(4);
        let polycube = Polycube::new(&mesh, None, &Tolerance::default()).unwrap();
        let overlaps = Overlaps::of(&polycube);
        let all = overlaps.all(mesh.points());
        assert_eq!((all.len(), all.first().cloned()), (overlaps.len(), overlaps.first(mesh.points())));
        let facet = |face: u32| polycube.facet_of_face[face as usize];
        let pairs: BTreeSet<[u32; 2]> = all
            .iter()
            .map(|violation| {
                let Violation::SelfOverlap { face, other } = *violation else { panic!("{violation:?}") };
                let (a, b) = (facet(face), facet(other));
                [a.min(b), a.max(b)]
            })
            .collect();
        assert_eq!(pairs.len(), all.len());
        // The four sides of each bar along Y cross the two sides of each bar along X.
        assert!(pairs.len() >= 4 * 4 * 4, "{}", pairs.len());
    }

    #[test]
    fn a_facet_that_is_folded_is_named_by_itself() {
        // The left leg of a U, made so wide that it reaches through the right one.
        let legs = [([0, 0, 0], [1, 3, 1]), ([1, 0, 0], [2, 1, 1]), ([2, 0, 0], [3, 3, 1])];
        let boxes = legs.map(|(low, high)| Cuboid::new(low, high));
        let mesh = Voxels::from_boxes(&boxes).unwrap().mesh(CellKind::Quads, 1e9).unwrap();
        let labels: Vec<i8> =
            Polycube::new(&mesh, None, &Tolerance::default()).unwrap().labels().map(|l| l.index() as i8).collect();
        let widened = |p: &Point| if p.x == 1.0 && p.y >= 1.0 { Point::new(2.5, p.y, p.z) } else { *p };
        let mesh = mesh.clone().with_points(mesh.points().iter().map(widened).collect()).unwrap();
        let polycube = Polycube::new(&mesh, Some(&labels), &Tolerance::default()).unwrap();
        let folded = polycube.overlaps(mesh.points()).into_iter().filter_map(|violation| match violation {
            Violation::FoldedFacet { face } => Some(labels[face as usize]),
            _ => None,
        });
        // Its front, its back, and the floor between the legs, whose border now goes round the wrong way.
        assert_eq!(folded.collect::<BTreeSet<i8>>(), BTreeSet::from([2, 4, 5]));
    }
}
