//! What finite volume solvers compute over the faces between cells, as OpenFOAM's `primitiveMeshTools` defines it.

use crate::mesh::hexahedron::FACES;
use crate::mesh::{Point, Stars};
use nalgebra::Vector3;
use rayon::prelude::*;

/// Faces or cells that a thread takes at least.
const LEAST_SHARE: usize = 1024;
/// What OpenFOAM adds to what it divides by.
const TINY: f64 = 1e-150;
/// Of the distance between the middles of two cells, the least length that skewness is measured by; at the surface
/// twice as much.
const LEAST_EXTENT: f64 = 0.2;

/// A face with its area as a vector out of the first of its cells.
struct FaceGeometry {
    points: [Point; 4],
    centre: Point,
    area: Vector3<f64>,
}

impl FaceGeometry {
    /// Four triangles around the mean of the corners.
    fn new(points: [Point; 4]) -> Self {
        let mean = Point::from(points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / 4.0);
        let (mut normal, mut weight, mut moment) = (Vector3::zeros(), 0.0, Vector3::zeros());
        for k in 0..4 {
            let [a, b] = [points[k], points[(k + 1) % 4]];
            let double = (b - a).cross(&(mean - a));
            normal += double;
            weight += double.norm();
            moment += (a.coords + b.coords + mean.coords) * double.norm();
        }
        let centre = if weight > TINY { Point::from(moment / (3.0 * weight)) } else { mean };
        Self { points, centre, area: normal / 2.0 }
    }

    /// The angle in degrees between the normal and the line from the middle `from` of one cell to `to` of the other.
    fn non_orthogonality(&self, from: &Point, to: &Point) -> f64 {
        let line = to - from;
        let cosine = line.dot(&self.area) / (line.norm() * self.area.norm() + TINY);
        libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees()
    }

    /// How far from its centre the line between the middles of two cells meets the face, by how far the face extends
    /// that way. At the surface the line is the one along the normal.
    fn skewness(&self, from: &Point, to: Option<&Point>) -> f64 {
        let arm = self.centre - from;
        let normal = self.area / (self.area.norm() + TINY);
        let line = to.map_or(normal * normal.dot(&arm), |to| to - from);
        let off = arm - line * (self.area.dot(&arm) / (self.area.dot(&line) + TINY));
        let direction = off / (off.norm() + TINY);
        let least = if to.is_some() { LEAST_EXTENT } else { 2.0 * LEAST_EXTENT };
        let extent = self.points.iter().map(|p| direction.dot(&(p - self.centre)).abs());
        off.norm() / extent.fold(least * line.norm() + TINY, f64::max)
    }
}

/// The middle of a hexahedron: that of the pyramids over its faces.
fn middle(points: &[Point], hex: &[u32; 8]) -> Point {
    let faces = FACES.map(|face| FaceGeometry::new(face.map(|k| points[hex[k] as usize])));
    let mean = Point::from(faces.iter().map(|f| f.centre.coords).sum::<Vector3<f64>>() / 6.0);
    let (mut volume, mut moment) = (0.0, Vector3::zeros());
    for face in &faces {
        let pyramid = face.area.dot(&(face.centre - mean));
        volume += pyramid;
        moment += (face.centre.coords * 0.75 + mean.coords * 0.25) * pyramid;
    }
    if f64::abs(volume) > TINY * TINY { Point::from(moment / volume) } else { mean }
}

/// For each face of each hexahedron the one on its other side; nothing at the surface. Linear time, if no vertex has
/// many faces.
fn neighbours(vertices: usize, hexes: &[[u32; 8]]) -> Vec<[Option<u32>; 6]> {
    let key = |hex: &[u32; 8], side: usize| {
        let mut key = FACES[side].map(|k| hex[k]);
        key.sort_unstable();
        key
    };
    let sides = hexes.iter().flat_map(|hex| (0..6).map(move |side| [key(hex, side)[0]]));
    let around = Stars::new(vertices, sides);
    let other = |(cell, hex): (usize, &[u32; 8])| {
        std::array::from_fn(|side| {
            let own = key(hex, side);
            let here = around.of(own[0] as usize).iter().map(|&s| (s as usize / 6, s as usize % 6));
            let mut others = here.filter(|&(c, s)| c != cell && key(&hexes[c], s) == own);
            others.next().map(|(c, _)| c as u32)
        })
    };
    hexes.par_iter().enumerate().with_min_len(LEAST_SHARE).map(other).collect()
}

/// For each hexahedron the largest non-orthogonality of its faces inside the mesh, in degrees, and the largest skewness
/// of all its faces.
pub(super) fn over_faces(points: &[Point], hexes: &[[u32; 8]]) -> Vec<[f64; 2]> {
    let middles: Vec<Point> = hexes.par_iter().with_min_len(LEAST_SHARE).map(|hex| middle(points, hex)).collect();
    let neighbours = neighbours(points.len(), hexes);
    let of_cell = |cell: usize| {
        let [mut angle, mut skewness] = [0.0_f64; 2];
        for (side, other) in neighbours[cell].iter().enumerate() {
            let face = FaceGeometry::new(FACES[side].map(|k| points[hexes[cell][k] as usize]));
            let to = other.map(|other| &middles[other as usize]);
            angle = angle.max(to.map_or(0.0, |to| face.non_orthogonality(&middles[cell], to)));
            skewness = skewness.max(face.skewness(&middles[cell], to));
        }
        [angle, skewness]
    };
    (0..hexes.len()).into_par_iter().with_min_len(LEAST_SHARE).map(of_cell).collect()
}
