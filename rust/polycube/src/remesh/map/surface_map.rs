//! From the surface of the polycube on the lattice to the surface of the shape (paper, section 7).

use crate::mesh::Point;
use crate::remesh::lattice::Carrier;
use crate::spatial::{Barycentric, Location, SimplexIndex, bounds, in_triangle};
use crate::structure::{Label, Polycube};
use nalgebra::Vector3;

/// The piecewise linear map of the surface: corners to corners, edges along their chains, facets by their triangles.
pub(crate) struct SurfaceMap<'a> {
    polycube: &'a Polycube,
    /// The polycube's vertices on the lattice.
    from: &'a [Point],
    /// The same vertices on the shape.
    to: &'a [Point],
    triangles: Vec<[u32; 3]>,
    facets: Vec<SimplexIndex<[f64; 2]>>,
}

impl<'a> SurfaceMap<'a> {
    /// Indexes the triangles facet by facet. O(n log n).
    pub(crate) fn new(polycube: &'a Polycube, from: &'a [Point], to: &'a [Point]) -> Self {
        let mut map = Self { polycube, from, to, triangles: Vec::new(), facets: Vec::new() };
        let mut of_facet = vec![Vec::new(); polycube.structure.facets.len()];
        for (face, &facet) in polycube.surface.faces().iter().zip(&polycube.facet_of_face) {
            let first = map.triangles.len() as u32;
            map.triangles.extend(face.triangles());
            of_facet[facet as usize].extend(first..map.triangles.len() as u32);
        }
        let index = |(facet, own): (usize, Vec<u32>)| {
            let label = polycube.structure.facets[facet].label;
            SimplexIndex::new(own.into_iter().map(|t| {
                let (low, high) = bounds(&map.corners(t, label));
                (low, high, t)
            }))
        };
        map.facets = of_facet.into_iter().enumerate().map(index).collect();
        map
    }

    /// The point of the shape that belongs to the lattice point `at` on `carrier`, and whether the map holds it
    /// (if not, the nearest is returned). Nothing for a point inside, or in a facet whose triangles are all flat.
    pub(crate) fn place(&self, carrier: Carrier, at: [f64; 3]) -> Option<(Point, bool)> {
        match carrier {
            Carrier::Corner(c) => {
                let vertex = self.polycube.structure.corners[c as usize].vertex;
                Some((self.to[vertex as usize], true))
            }
            Carrier::Edge(e) => Some(self.on_edge(e, at)),
            Carrier::Facet(f) => self.on_facet(f, at),
            Carrier::Inside => None,
        }
    }

    /// The first segment of the edge's chain that reaches over the point; its nearest vertex where none does.
    fn on_edge(&self, edge: u32, at: [f64; 3]) -> (Point, bool) {
        let axis = self.polycube.structure.edges[edge as usize].axis;
        let chain = &self.polycube.chains[edge as usize];
        let x = |v: u32| self.from[v as usize][axis];
        let holds = |s: &&[u32]| x(s[0]).min(x(s[1])) <= at[axis] && at[axis] <= x(s[0]).max(x(s[1]));
        if let Some(&[a, b]) = chain.windows(2).find(holds) {
            let length = x(b) - x(a);
            let t = if length == 0.0 { 0.0 } else { (at[axis] - x(a)) / length };
            let [from, to] = [a, b].map(|v| self.to[v as usize].coords);
            return (Point::from(from * (1.0 - t) + to * t), true);
        }
        let gap = |v: &&u32| (x(**v) - at[axis]).abs();
        let nearest = chain.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)));
        (nearest.map_or_else(Point::origin, |&v| self.to[v as usize]), false)
    }

    fn on_facet(&self, facet: u32, at: [f64; 3]) -> Option<(Point, bool)> {
        let label = self.polycube.structure.facets[facet as usize].label;
        let point = flat(&at, label);
        let coordinates = |t: u32| -> Option<Barycentric<3>> { in_triangle(point, self.corners(t, label)) };
        let gap = |t: u32, w: [f64; 3]| {
            let corners = self.corners(t, label);
            (0..2).map(|k| (0..3).map(|c| w[c] * corners[c][k]).sum::<f64>() - point[k]).map(|d| d * d).sum()
        };
        let Location { simplex, weights, inside } = self.facets[facet as usize].locate(point, coordinates, gap)?;
        let corners = self.triangles[simplex as usize].map(|v| self.to[v as usize].coords);
        let sum: Vector3<f64> = corners.iter().zip(weights).map(|(p, w)| p * w).sum();
        Some((Point::from(sum), inside))
    }

    fn corners(&self, triangle: u32, label: Label) -> [[f64; 2]; 3] {
        self.triangles[triangle as usize].map(|v| flat(self.from[v as usize].coords.as_ref(), label))
    }
}

/// The coordinates in the plane of a facet, such that a triangle seen from outside keeps its orientation.
fn flat(p: &[f64; 3], label: Label) -> [f64; 2] {
    let (u, v) = ((label.axis() + 1) % 3, (label.axis() + 2) % 3);
    if label.sign() > 0 { [p[u], p[v]] } else { [p[v], p[u]] }
}
