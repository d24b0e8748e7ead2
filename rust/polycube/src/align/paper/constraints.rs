//! The distances that keep a structure a polycube (paper, section 5.1), as differences of levels.

use crate::align::problem::Difference;
use crate::structure::{Arrangement, Edge};
use rayon::prelude::*;

/// Minimum length of edges (Eq. 3) and of dummy edges, and dummy vertices that stay in their facet.
///
/// A dummy edge goes on from an end of an edge, along its line, to the closest facet there; the dummy vertex
/// where it meets that facet stays between the facet's sides around it. All as seen in the present arrangement.
/// O(n log n) for n edges where few facets lie along a line.
pub fn structural(arrangement: &Arrangement) -> Vec<Difference> {
    let edges = &arrangement.structure().edges;
    let mut differences: Vec<Difference> = edges.iter().map(|e| length(arrangement, e)).collect();
    let dummies = |edge: &Edge| [false, true].map(|upwards| dummy(arrangement, edge, upwards)).concat();
    differences.par_extend(edges.par_iter().with_min_len(512).flat_map_iter(dummies));
    differences.sort_unstable_by_key(|d| (d.low, d.high, d.gap));
    differences.dedup();
    differences
}

fn length(arrangement: &Arrangement, edge: &Edge) -> Difference {
    let [low, high] = arrangement.structure().ends(edge);
    Difference { low, high, gap: 1 }
}

/// The differences of the dummy edge that goes on from one end of `edge`, if a facet lies there.
fn dummy(arrangement: &Arrangement, edge: &Edge, upwards: bool) -> Vec<Difference> {
    let structure = arrangement.structure();
    let corner = &structure.corners[edge.corners[usize::from(upwards)] as usize];
    let from = structure.position(edge.corners[usize::from(upwards)], arrangement.placement());
    let Some((facet, sides)) = arrangement.first_hit(from, edge.axis, upwards) else { return Vec::new() };
    let (end, hit) = (corner.levels[edge.axis], structure.facets[facet as usize].level);
    let (low, high) = if upwards { (end, hit) } else { (hit, end) };
    let mut differences = vec![Difference { low, high, gap: 1 }];
    for across in (0..3).filter(|&a| a != edge.axis) {
        let line = corner.levels[across];
        differences.push(Difference { low: sides.low[across], high: line, gap: 0 });
        differences.push(Difference { low: line, high: sides.high[across], gap: 0 });
    }
    differences
}
