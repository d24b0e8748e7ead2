//! The best simplex around a point, by an index over the simplices' boxes.

use super::barycentric::Barycentric;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, Point, RTree};

type Item<P> = GeomWithData<Rectangle<P>, u32>;

/// A point this far outside a simplex, in barycentric coordinates, still counts as inside.
const SLACK: f64 = 1e-9;

/// How many of the nearest boxes are looked at when no simplex holds the point.
const NEAREST: usize = 24;

/// Simplices by their boxes.
pub(crate) struct SimplexIndex<P: Point> {
    index: RTree<Item<P>>,
}

/// Where a point was found.
pub(crate) struct Location<const N: usize> {
    pub(crate) simplex: u32,
    pub(crate) weights: [f64; N],
    /// Whether the simplex holds the point; if not it is just near.
    pub(crate) inside: bool,
}

impl<P: Point<Scalar = f64>> SimplexIndex<P> {
    /// An index over the boxes from the lower to the upper corner. O(n log n).
    pub(crate) fn new(boxes: impl Iterator<Item = (P, P, u32)>) -> Self {
        let items = boxes.map(|(low, high, i)| Item::new(Rectangle::from_corners(low, high), i));
        Self { index: RTree::bulk_load(items.collect()) }
    }

    /// The simplex that holds `point` best: one that is not turned over if there is one, and then the one
    /// in which the point lies deepest. Where none holds it, the nearest by the distance that `gap` gives.
    ///
    /// O(log n + k) for k boxes around the point.
    pub(crate) fn locate<const N: usize>(
        &self,
        point: P,
        coordinates: impl Fn(u32) -> Option<Barycentric<N>>,
        gap: impl Fn(u32, [f64; N]) -> f64,
    ) -> Option<Location<N>> {
        let around = self.index.locate_in_envelope_intersecting(AABB::from_point(point.clone())).map(|i| i.data);
        let candidates = around.filter_map(|i| Some((i, coordinates(i)?)));
        let holding = candidates.filter(|(_, b)| b.depth() >= -SLACK);
        let rank = |(i, b): &(u32, Barycentric<N>)| (b.positive, b.depth(), *i);
        let better =
            |a: &(bool, f64, u32), b: &(bool, f64, u32)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(b.2.cmp(&a.2));
        let best = holding.max_by(|a, b| better(&rank(a), &rank(b)));
        match best {
            Some((simplex, b)) => Some(Location { simplex, weights: b.clamped(), inside: true }),
            None => self.nearest(point, coordinates, gap),
        }
    }

    fn nearest<const N: usize>(
        &self,
        point: P,
        coordinates: impl Fn(u32) -> Option<Barycentric<N>>,
        gap: impl Fn(u32, [f64; N]) -> f64,
    ) -> Option<Location<N>> {
        let near = self.index.nearest_neighbor_iter(point).take(NEAREST).map(|i| i.data);
        let measured = near.filter_map(|i| {
            let weights = coordinates(i)?.clamped();
            Some((gap(i, weights), i, weights))
        });
        let best = measured.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        Some(Location { simplex: best.1, weights: best.2, inside: false })
    }
}

/// The smallest box around some points.
pub(crate) fn bounds<const D: usize>(points: &[[f64; D]]) -> ([f64; D], [f64; D]) {
    let fold = |a: usize, start: f64, f: fn(f64, f64) -> f64| points.iter().map(|p| p[a]).fold(start, f);
    let low = std::array::from_fn(|a| fold(a, f64::INFINITY, f64::min));
    let high = std::array::from_fn(|a| fold(a, f64::NEG_INFINITY, f64::max));
    (low, high)
}
