//! Which level mirrors which about a plane.

use super::Symmetry;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::structure::{Edge, Structure};
use std::collections::BTreeMap;

/// How far a mirrored corner may lie from its image, as a part of the shortest edge.
const TOLERANCE: f64 = 0.25;

/// The image of every level under reflection in a plane.
///
/// # Errors
/// [`ErrorKind::Option`] if the axis or the place of the plane is no number that makes sense, or if the input is not
/// symmetric about it, with a corner or a facet that has no image.
pub(super) fn images(structure: &Structure, input: &[f64], plane: &Symmetry) -> Result<Vec<u32>> {
    if plane.axis > 2 || !plane.at.is_finite() {
        let message = format!("axis {} at {} is no plane of symmetry", plane.axis, plane.at);
        return Err(Error::new(ErrorKind::Option, message).remedy("give the axis as 0, 1 or 2 and a finite number"));
    }
    let corner = corner_images(structure, input, plane)?;
    check_edges(structure, plane, &corner)?;
    let mut image = vec![u32::MAX; structure.levels.len()];
    for (from, &to) in structure.corners.iter().zip(&corner) {
        let to = &structure.corners[to as usize];
        for (&a, &b) in from.levels.iter().zip(&to.levels) {
            if image[a as usize] != u32::MAX && image[a as usize] != b {
                return Err(asymmetric(plane, "has no image in one plane").at(Place::Vertex(from.vertex)));
            }
            image[a as usize] = b;
        }
    }
    // Every level of a polycube has corners; one without would mirror itself.
    Ok((0..).zip(image).map(|(l, i)| if i == u32::MAX { l } else { i }).collect())
}

/// The planes through the middle of the polycube that it is symmetric about: the axis across, and the image of each
/// level.
pub(crate) fn symmetries(structure: &Structure, input: &[f64]) -> Vec<(usize, Vec<u32>)> {
    let middle = |axis: usize| {
        let along = structure.levels.iter().zip(input).filter(|(l, _)| l.axis == axis).map(|(_, &x)| x);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        Symmetry { axis, at: f64::midpoint(low, high) }
    };
    (0..3).filter_map(|axis| images(structure, input, &middle(axis)).ok().map(|image| (axis, image))).collect()
}

/// For each corner the one nearest to where the plane mirrors it. O(n²) for n corners.
fn corner_images(structure: &Structure, input: &[f64], plane: &Symmetry) -> Result<Vec<u32>> {
    let all: Vec<[f64; 3]> = (0..structure.corners.len() as u32).map(|c| structure.position(c, input)).collect();
    let most = TOLERANCE * structure.shortest_edge(input);
    let find = |(corner, at): (&crate::structure::Corner, &[f64; 3])| {
        let mut wanted = *at;
        wanted[plane.axis] = 2.0 * plane.at - wanted[plane.axis];
        let off = |p: &[f64; 3]| (0..3).map(|a| (p[a] - wanted[a]).abs()).fold(0.0, f64::max);
        let nearest = (0..).zip(all.iter().map(off)).min_by(|a: &(u32, f64), b| a.1.total_cmp(&b.1));
        nearest
            .filter(|n| n.1 <= most)
            .map(|n| n.0)
            .ok_or_else(|| asymmetric(plane, "has no mirror image at a corner").at(Place::Vertex(corner.vertex)))
    };
    structure.corners.iter().zip(&all).map(find).collect()
}

/// Whether every edge has an image between the images of its corners that bounds facets of mirrored labels.
fn check_edges(structure: &Structure, plane: &Symmetry, corner: &[u32]) -> Result<()> {
    let key = |a: u32, b: u32| (a.min(b), a.max(b));
    let by_ends: BTreeMap<(u32, u32), &Edge> =
        structure.edges.iter().map(|e| (key(e.corners[0], e.corners[1]), e)).collect();
    let labels = |e: &Edge, mirrored: bool| {
        let mut labels = e.facets.map(|f| {
            let label = structure.facets[f as usize].label;
            let turn = mirrored && label.axis() == plane.axis;
            (label.axis(), if turn { -label.sign() } else { label.sign() })
        });
        labels.sort_unstable();
        labels
    };
    for edge in &structure.edges {
        let [a, b] = edge.corners.map(|c| corner[c as usize]);
        let image = by_ends.get(&key(a, b));
        if image.is_none_or(|i| labels(i, false) != labels(edge, true)) {
            return Err(asymmetric(plane, "has an edge without a mirror image").at(Place::Facet(edge.facets[0])));
        }
    }
    Ok(())
}

fn asymmetric(plane: &Symmetry, what: &str) -> Error {
    let axis = ["X", "Y", "Z"][plane.axis.min(2)];
    Error::new(ErrorKind::Option, format!("{what} about the plane {axis} = {}", plane.at))
        .remedy("leave this plane of symmetry out, or give the one that the polycube has")
}
