//! The distances that keep a structure a polycube (paper, section 5.1), as differences of levels.

use super::problem::Difference;
use crate::structure::{Arrangement, Edge};

/// Minimum length of edges (Eq. 3) and of dummy edges, and dummy vertices that stay in their facet.
///
/// A dummy edge goes on from an end of an edge, along its line, to the closest facet there; the dummy vertex
/// where it meets that facet stays between the facet's sides around it. All as seen in the present arrangement.
/// O(n log n) for n edges where few facets lie along a line.
pub fn structural(arrangement: &Arrangement) -> Vec<Difference> {
    let edges = &arrangement.structure().edges;
    let mut differences: Vec<Difference> = edges.iter().map(|e| length(arrangement, e)).collect();
    for edge in edges {
        dummy(arrangement, edge, false, &mut differences);
        dummy(arrangement, edge, true, &mut differences);
    }
    differences.sort_unstable_by_key(|d| (d.low, d.high, d.gap));
    differences.dedup();
    differences
}

fn length(arrangement: &Arrangement, edge: &Edge) -> Difference {
    let [low, high] = arrangement.structure().ends(edge);
    Difference { low, high, gap: 1 }
}

fn dummy(arrangement: &Arrangement, edge: &Edge, upwards: bool, differences: &mut Vec<Difference>) {
    let structure = arrangement.structure();
    let corner = &structure.corners[edge.corners[usize::from(upwards)] as usize];
    let from = structure.position(edge.corners[usize::from(upwards)], arrangement.placement());
    let Some((facet, sides)) = arrangement.first_hit(from, edge.axis, upwards) else { return };
    let (end, hit) = (corner.levels[edge.axis], structure.facets[facet as usize].level);
    let (low, high) = if upwards { (end, hit) } else { (hit, end) };
    differences.push(Difference { low, high, gap: 1 });
    for across in (0..3).filter(|&a| a != edge.axis) {
        let line = corner.levels[across];
        differences.push(Difference { low: sides.low[across], high: line, gap: 0 });
        differences.push(Difference { low: line, high: sides.high[across], gap: 0 });
    }
}
