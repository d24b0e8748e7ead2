//! The distances that keep a structure a polycube (paper, section 5.1), as differences of levels.

use crate::align::problem::Difference;
use crate::structure::{Arrangement, Edge};
use rayon::prelude::*;

/// Minimum length of edges (Eq. 3) and of dummy edges, and dummy vertices that stay in their facet.
///
/// A dummy edge goes on from an end of an edge, along its line, to the closest facet there; the dummy vertex
/// where it meets that facet stays between the facet's sides around it. All as seen in the present arrangement.
/// O(n log n) for n edges where few facets lie along a line.
pub(super) fn structural(arrangement: &Arrangement) -> Vec<Difference> {
    let edges = &arrangement.structure().edges;
    let mut differences: Vec<Difference> = edges.iter().map(|e| length(arrangement, e)).collect();
    let dummies =
        |edge: &Edge| [false, true].map(|upwards| dummy(arrangement, edge, upwards)).into_iter().flatten().flatten();
    // A level of a dummy vertex that is that of a side around it is below and above itself.
    let between = |d: &Difference| d.low != d.high;
    differences.par_extend(edges.par_iter().with_min_len(512).flat_map_iter(dummies).filter(between));
    differences.sort_unstable_by_key(Difference::rank);
    differences.dedup();
    differences
}

fn length(arrangement: &Arrangement, edge: &Edge) -> Difference {
    let [low, high] = arrangement.structure().ends(edge);
    Difference { low, high, gap: 1 }
}

/// The differences of the dummy edge that goes on from one end of `edge`, if a facet lies there.
fn dummy(arrangement: &Arrangement, edge: &Edge, upwards: bool) -> Option<[Difference; 5]> {
    let structure = arrangement.structure();
    let corner = &structure.corners[edge.corners[usize::from(upwards)] as usize];
    let from = structure.position(edge.corners[usize::from(upwards)], arrangement.placement());
    let (facet, sides) = arrangement.first_hit(from, edge.axis, upwards)?;
    let (end, hit) = (corner.levels[edge.axis], structure.facets[facet as usize].level);
    let (low, high) = if upwards { (end, hit) } else { (hit, end) };
    let [u, v] = [(edge.axis + 1) % 3, (edge.axis + 2) % 3];
    let below = |across: usize| Difference { low: sides.low[across], high: corner.levels[across], gap: 0 };
    let above = |across: usize| Difference { low: corner.levels[across], high: sides.high[across], gap: 0 };
    Some([Difference { low, high, gap: 1 }, below(u), above(u), below(v), above(v)])
}
