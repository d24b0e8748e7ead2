//! Which corners are neighbours: those whose Voronoi cells touch (section 4 of the paper).

mod delaunay;
mod predicates;
mod sites;
#[cfg(test)]
mod tests;

use crate::context::Context;
use crate::error::Result;
use sites::Sites;

/// The pairs of points whose Voronoi cells are adjacent: the edges of a Delaunay triangulation.
///
/// Pairs are `[a, b]` with `a < b`, ascending, each once.
///
/// - Where more than four points lie on one empty sphere (nearly everywhere on a lattice) the Delaunay
///   triangulation is not unique and the touching cells share no area. One triangulation is chosen by a
///   symbolic perturbation of the points' squared lengths (Devillers and Teillaud, *Perturbations for
///   Delaunay and weighted Delaunay 3D triangulations*, 2011). No point moves, so no tetrahedron is flat
///   and no long edge skims the hull. The choice depends on positions alone: renumbering, translating
///   or scaling the points gives the same pairs, and so does every machine. Turning or mirroring them may not.
/// - Coplanar points give the edges of their 2D Delaunay triangulation, collinear points those between
///   successive ones. Fewer than two points give none.
/// - Points at one location count as one site: each is a neighbour of all the others there and of all
///   the points at neighbouring sites. Many of them give a quadratic number of pairs.
///
/// Takes about O(n log n) time on polycubes (O(n²) at worst) and memory proportional to the result.
///
/// # Errors
/// [`ErrorKind::Unsupported`](crate::ErrorKind::Unsupported) for a coordinate beyond ±2^30 or more than
/// 2^26 points; [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
///
/// ```
/// use polycube::{Context, parts::neighbours};
///
/// let line = [[0, 0, 0], [9, 9, 9], [4, 4, 4]];
/// assert_eq!(neighbours(&line, &Context::default())?, [[0, 2], [1, 2]]);
/// # Ok::<(), polycube::Error>(())
/// ```
pub fn neighbours(points: &[[i64; 3]], context: &Context) -> Result<Vec<[u32; 2]>> {
    context.check()?;
    if points.is_empty() {
        return Ok(Vec::new());
    }
    let sites = Sites::new(points)?;
    let order = sites.insertion_order();
    let cells = delaunay::tetrahedra(&sites.points, sites.frame, &order, context)?;
    let pairs = spread(&sites, &edges(&cells, sites.len()));
    context.tick(1.0)?;
    Ok(pairs)
}

/// The edges between the first `count` vertices, ascending, each once.
fn edges(cells: &[[u32; 4]], count: usize) -> Vec<[u32; 2]> {
    const CORNERS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    let all = cells.iter().flat_map(|c| CORNERS.map(|[i, j]| [c[i].min(c[j]), c[i].max(c[j])]));
    ascending(all.filter(|&[_, b]| (b as usize) < count), count)
}

/// The pairs of numbers below `count`, ascending, each once: sorting many short lists is faster than sorting all the
/// pairs.
fn ascending(pairs: impl Iterator<Item = [u32; 2]> + Clone, count: usize) -> Vec<[u32; 2]> {
    let (seconds, ends) = grouped(pairs, count);
    let mut ascending: Vec<[u32; 2]> = Vec::with_capacity(8 * count);
    let mut last_first = vec![u32::MAX; count];
    let mut start = 0;
    for (a, &end) in (0..).zip(&ends) {
        let own = ascending.len();
        for &b in &seconds[start..end] {
            if std::mem::replace(&mut last_first[b as usize], a) != a {
                ascending.push([a, b]);
            }
        }
        ascending[own..].sort_unstable_by_key(|pair| pair[1]);
        start = end;
    }
    ascending
}

/// The second members of the pairs grouped by the first, and where each group ends.
fn grouped(pairs: impl Iterator<Item = [u32; 2]> + Clone, count: usize) -> (Vec<u32>, Vec<usize>) {
    let mut ends = vec![0; count];
    pairs.clone().for_each(|[a, _]| ends[a as usize] += 1);
    let mut total = 0;
    for end in &mut ends {
        (*end, total) = (total, total + *end);
    }
    let mut seconds = vec![0; total];
    for [a, b] in pairs {
        seconds[ends[a as usize]] = b;
        ends[a as usize] += 1;
    }
    (seconds, ends)
}

/// From edges between sites to pairs of points, ascending.
fn spread(sites: &Sites, edges: &[[u32; 2]]) -> Vec<[u32; 2]> {
    let mut pairs = Vec::with_capacity(edges.len());
    for &[a, b] in edges {
        for &p in sites.members(a as usize) {
            let others = sites.members(b as usize);
            pairs.extend(others.iter().map(|&q| [p.min(q), p.max(q)]));
        }
    }
    for site in 0..sites.len() {
        let members = sites.members(site);
        for (i, &p) in members.iter().enumerate() {
            pairs.extend(members[i + 1..].iter().map(|&q| [p, q]));
        }
    }
    ascending(pairs.iter().copied(), sites.count())
}
