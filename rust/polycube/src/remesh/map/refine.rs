//! Splits triangles of the surface where the map could not be one to one otherwise.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Cells, Face, Mesh, Point};
use crate::structure::{Polycube, Surface};
use std::collections::BTreeMap;

/// A polycube's surface as triangles, with its points on the lattice and on the shape. Splitting changes neither
/// surface, only the map between them.
pub(crate) struct Refined {
    pub(crate) polycube: Polycube,
    pub(crate) points: Vec<Point>,
    pub(crate) shape: Vec<Point>,
    triangles: Vec<[u32; 3]>,
}

impl Refined {
    /// The triangles of a surface. Mesh edges that cross a facet from border to border are cut in two: their ends
    /// cannot make way, and on a facet that is not convex such an edge may leave it.
    pub(crate) fn new(polycube: &Polycube, points: &[Point], shape: &[Point]) -> Result<Self> {
        let mut polycube = polycube.clone();
        let mut triangles = Vec::new();
        let mut facets = Vec::new();
        for (face, &facet) in polycube.surface.faces().iter().zip(&polycube.facet_of_face) {
            triangles.extend(face.triangles());
            facets.resize(triangles.len(), facet);
        }
        polycube.facet_of_face = facets;
        let mut refined = Self { polycube, points: points.to_vec(), shape: shape.to_vec(), triangles };
        let border: Vec<bool> = refined.polycube.vertex_levels.iter().map(|l| known(l) > 1).collect();
        let along = refined.along();
        let crossing = |e: &[u32; 2]| e.iter().all(|&v| border[v as usize]) && along.binary_search(e).is_err();
        refined.split(|_, e| crossing(&e))?;
        Ok(refined)
    }

    /// Cuts all edges inside facets that have one of the triangles listed.
    pub(crate) fn split_facets_of(&mut self, triangles: &[usize]) -> Result<()> {
        let mut marked = vec![false; self.polycube.structure.facets.len()];
        triangles.iter().for_each(|&t| marked[self.polycube.facet_of_face[t] as usize] = true);
        let along = self.along();
        self.split(|facet, e| marked[facet as usize] && along.binary_search(&e).is_err())
    }

    /// Cuts all edges inside facets at the vertices of the triangles listed.
    pub(crate) fn split_near(&mut self, triangles: &[usize]) -> Result<()> {
        let mut marked = vec![false; self.points.len()];
        triangles.iter().flat_map(|&t| self.triangles[t]).for_each(|v| marked[v as usize] = true);
        let along = self.along();
        self.split(|_, e| e.iter().any(|&v| marked[v as usize]) && along.binary_search(&e).is_err())
    }

    /// The label of each triangle, 0 to 5.
    pub(crate) fn labels(&self) -> Vec<i8> {
        self.polycube.labels().map(|l| l.index() as i8).collect()
    }

    /// The mesh edges along the edges of the polycube, sorted.
    fn along(&self) -> Vec<[u32; 2]> {
        let chains = self.polycube.chains.iter().flat_map(|c| c.windows(2).map(|s| key(s[0], s[1])));
        let mut along: Vec<[u32; 2]> = chains.collect();
        along.sort_unstable();
        along
    }

    /// The surface as a mesh on the lattice and on the shape.
    pub(crate) fn meshes(&self) -> Result<[Mesh; 2]> {
        let mesh = |points: &[Point]| Mesh::new(points.to_vec(), Cells::Triangles(self.triangles.clone()));
        Ok([mesh(&self.points)?, mesh(&self.shape)?])
    }

    /// Cuts the edges that `cut` chooses, by facet and ends, in the middle.
    fn split(&mut self, cut: impl Fn(u32, [u32; 2]) -> bool) -> Result<()> {
        let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let (mut triangles, mut facets) = (Vec::new(), Vec::new());
        for (i, t) in std::mem::take(&mut self.triangles).into_iter().enumerate() {
            let facet = self.polycube.facet_of_face[i];
            let ends = [0, 1, 2].map(|k| key(t[k], t[(k + 1) % 3]));
            let middle = ends.map(|e| cut(facet, e).then(|| *middles.entry(e).or_insert_with(|| self.add(facet, e))));
            triangles.extend(parts(t, middle));
            facets.resize(triangles.len(), facet);
        }
        let faces = triangles.iter().map(|&t| Face::Triangle(t)).collect();
        self.polycube.surface = Surface::new(faces, self.points.len()).map_err(|_| torn())?;
        (self.triangles, self.polycube.facet_of_face) = (triangles, facets);
        Ok(())
    }

    fn add(&mut self, facet: u32, [a, b]: [u32; 2]) -> u32 {
        for points in [&mut self.points, &mut self.shape] {
            let middle = nalgebra::center(&points[a as usize], &points[b as usize]);
            points.push(middle);
        }
        let facet = &self.polycube.structure.facets[facet as usize];
        let mut levels = [None; 3];
        levels[facet.label.axis()] = Some(facet.level);
        self.polycube.vertex_levels.push(levels);
        self.points.len() as u32 - 1
    }
}

fn known(levels: &[Option<u32>; 3]) -> usize {
    levels.iter().flatten().count()
}

fn key(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn torn() -> Error {
    Error::new(ErrorKind::Internal, "the surface was torn when it was refined")
}

/// A triangle cut at the middles of some of its sides; side `k` goes from vertex `k` to the next.
fn parts(t: [u32; 3], middle: [Option<u32>; 3]) -> Vec<[u32; 3]> {
    // Turned so that the sides that are cut come first.
    let cuts = middle.iter().flatten().count();
    let first = (0..3).find(|&k| (0..cuts).all(|i| middle[(k + i) % 3].is_some())).unwrap_or(0);
    let [a, b, c] = [0, 1, 2].map(|i| t[(first + i) % 3]);
    match [0, 1, 2].map(|i| middle[(first + i) % 3]) {
        [Some(ab), Some(bc), Some(ca)] => vec![[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]],
        [Some(ab), Some(bc), None] => vec![[ab, b, bc], [a, ab, bc], [a, bc, c]],
        [Some(ab), None, None] => vec![[a, ab, c], [ab, b, c]],
        _ => vec![t],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_are_cut_into_as_many_parts_as_they_need() {
        assert_eq!(parts([0, 1, 2], [None; 3]), [[0, 1, 2]]);
        assert_eq!(parts([0, 1, 2], [None, Some(3), None]), [[1, 3, 0], [3, 2, 0]]);
        assert_eq!(parts([0, 1, 2], [Some(4), None, Some(3)]), [[3, 0, 4], [2, 3, 4], [2, 4, 1]]);
        assert_eq!(parts([0, 1, 2], [Some(3), Some(4), Some(5)]).len(), 4);
    }
}
