//! What the surface vertices of a mesh slide on: the images of facets and edges on the shape.

use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use crate::optimise::{CurveGuide, Freedom, Guide, SurfaceGuide, Tangent};
use crate::remesh::lattice::Carrier;
use crate::structure::{Polycube, Structure};
use nalgebra::Vector3;

/// Which surface vertices stay where they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Hold {
    /// Those at corners.
    Corners,
    /// Those on edges, too.
    Edges,
    /// All.
    Surface,
}

/// A crease is where normals of the shape differ by more than the angle with this cosine: 40 degrees.
const CREASE: f64 = 0.766;

/// A guide for every facet and, after those, one for every edge of a polycube, and one for all of the surface.
pub(crate) struct Sliding {
    structure: Structure,
    facets: Vec<SurfaceGuide>,
    edges: Vec<CurveGuide>,
    whole: SurfaceGuide,
}

impl Sliding {
    /// Indexes the facets' triangles and the edges' segments on the shape. O(n log n).
    pub(crate) fn new(polycube: &Polycube, shape: &[Point], context: &Context) -> Result<Self> {
        let mut triangles = vec![Vec::new(); polycube.structure.facets.len()];
        for (face, &facet) in polycube.surface.faces().iter().zip(&polycube.facet_of_face) {
            triangles[facet as usize].extend(face.triangles());
        }
        let segments = |chain: &Vec<u32>| -> Vec<[u32; 2]> { chain.windows(2).map(|s| [s[0], s[1]]).collect() };
        let all: Vec<[u32; 3]> = triangles.concat();
        let whole = SurfaceGuide::new(shape, &all)?;
        let facet = |own: &Vec<[u32; 3]>| {
            context.check()?;
            SurfaceGuide::new(shape, own)
        };
        let edge = |chain: &Vec<u32>| {
            context.check()?;
            CurveGuide::new(shape, &segments(chain))
        };
        Ok(Self {
            structure: polycube.structure.clone(),
            whole,
            facets: triangles.iter().map(facet).collect::<Result<_>>()?,
            edges: polycube.chains.iter().map(edge).collect::<Result<_>>()?,
        })
    }

    /// All guides, in the order that [`freedoms`](Self::freedoms) counts them.
    pub(crate) fn guides(&self) -> Vec<&dyn Guide> {
        let facets = self.facets.iter().map(|g| g as &dyn Guide);
        let edges = self.edges.iter().map(|g| g as &dyn Guide);
        facets.chain(edges).chain([&self.whole as &dyn Guide]).collect()
    }

    /// All of the surface.
    pub(crate) fn whole(&self) -> &dyn Guide {
        &self.whole
    }

    /// The unit normal of the shape where a quadrilateral of `facet` lies: the mean at its vertices and its middle.
    pub(crate) fn normal(&self, facet: u32, quad: &[u32; 4], points: &[Point]) -> Vector3<f64> {
        let corners = quad.map(|v| points[v as usize]);
        let middle = Point::from(corners.iter().map(|p| p.coords).sum::<Vector3<f64>>() / 4.0);
        let normal = |p: &Point| match self.facets[facet as usize].contact(p).tangent {
            Tangent::Plane(n) => n,
            _ => Vector3::zeros(),
        };
        let sum: Vector3<f64> = corners.iter().chain([&middle]).map(normal).sum();
        sum.try_normalize(0.0).unwrap_or_default()
    }

    /// A vertex that may slide on all of the surface.
    pub(crate) fn released(&self) -> Freedom {
        Freedom::Guided((self.facets.len() + self.edges.len()) as u32)
    }

    /// Whether the shape has no crease at `point`, which lies on the image of `carrier`.
    pub(crate) fn is_smooth(&self, carrier: Carrier, point: &Point) -> bool {
        let edges = &self.structure.edges;
        let facets: Vec<u32> = match carrier {
            Carrier::Corner(c) => edges.iter().filter(|e| e.corners.contains(&c)).flat_map(|e| e.facets).collect(),
            Carrier::Edge(e) => edges[e as usize].facets.to_vec(),
            Carrier::Facet(_) | Carrier::Inside => return true,
        };
        let normal = |&f: &u32| match self.facets[f as usize].contact(point).tangent {
            Tangent::Plane(n) => Some(n),
            _ => None,
        };
        let normals: Vec<_> = facets.iter().filter_map(normal).collect();
        normals.len() == facets.len() && normals.iter().all(|n| normals.iter().all(|m| n.dot(m) > CREASE))
    }

    /// How vertices on these carriers may move.
    pub(crate) fn freedoms(&self, carriers: &[Carrier], hold: Hold) -> Vec<Freedom> {
        let freedom = |carrier: &Carrier| match *carrier {
            Carrier::Corner(_) => Freedom::Fixed,
            Carrier::Edge(_) if hold >= Hold::Edges => Freedom::Fixed,
            Carrier::Facet(_) if hold >= Hold::Surface => Freedom::Fixed,
            Carrier::Edge(e) => Freedom::Guided(self.facets.len() as u32 + e),
            Carrier::Facet(f) => Freedom::Guided(f),
            Carrier::Inside => Freedom::Free,
        };
        carriers.iter().map(freedom).collect()
    }
}
