//! How far apart levels lie on the shape: along the edges of the polycube, and across its facets.

use crate::mesh::{Face, Point};
use crate::structure::{Facet, Polycube, Structure, area_vector};
use std::collections::BTreeSet;

/// Two levels and how far one is from the other on the shape.
pub(super) struct Span {
    pub(super) low: u32,
    pub(super) high: u32,
    pub(super) length: f64,
    /// What of the surface is squashed if that is too short in the polycube.
    pub(super) area: f64,
}

/// Points of an edge from which the way across is measured.
const SAMPLES: usize = 8;

/// The spans of a polycube; `shape` has its vertices, on the shape.
pub(super) fn spans(polycube: &Polycube, shape: &[Point]) -> Vec<Span> {
    let measured = Measured::new(polycube, shape);
    let mut spans: Vec<Span> = (0..polycube.chains.len()).map(|e| measured.along(e)).collect();
    for facet in 0..polycube.structure.facets.len() {
        spans.extend(measured.facing(facet).into_iter().map(|pair| measured.across(pair)));
    }
    spans
}

struct Measured<'a> {
    polycube: &'a Polycube,
    shape: &'a [Point],
    /// The length of each edge.
    lengths: Vec<f64>,
    /// The area of each facet.
    areas: Vec<f64>,
    /// The lengths of the edges of each facet together, axis by axis.
    along: Vec<[f64; 3]>,
}

impl<'a> Measured<'a> {
    fn new(polycube: &'a Polycube, shape: &'a [Point]) -> Self {
        let step = |s: &[u32]| (shape[s[0] as usize] - shape[s[1] as usize]).norm();
        let lengths: Vec<f64> = polycube.chains.iter().map(|chain| chain.windows(2).map(step).sum()).collect();
        let mut areas = vec![0.0; polycube.structure.facets.len()];
        for (face, &facet) in polycube.surface.faces().iter().zip(&polycube.facet_of_face) {
            areas[facet as usize] += face_area(shape, face);
        }
        let mut along = vec![[0.0; 3]; areas.len()];
        for (edge, length) in polycube.structure.edges.iter().zip(&lengths) {
            edge.facets.iter().for_each(|&f| along[f as usize][edge.axis] += length);
        }
        Self { polycube, shape, lengths, areas, along }
    }

    fn structure(&self) -> &Structure {
        &self.polycube.structure
    }

    /// The span of an edge, with its part of the facets beside it.
    fn along(&self, edge: usize) -> Span {
        let own = &self.structure().edges[edge];
        let ([low, high], length) = (self.structure().ends(own), self.lengths[edge]);
        let part = |&f: &u32| self.areas[f as usize] * length / self.along[f as usize][own.axis].max(f64::MIN_POSITIVE);
        Span { low, high, length, area: own.facets.iter().map(part).sum() }
    }

    /// The pairs of edges that face each other across a facet, the lower one first, with nothing between them.
    fn facing(&self, facet: usize) -> BTreeSet<[u32; 2]> {
        let own: &Facet = &self.structure().facets[facet];
        let sides: Vec<u32> = own.sides().map(|s| s.edge).collect();
        let (lower, upper): (Vec<u32>, Vec<u32>) = sides.iter().partition(|&&e| self.is_below(facet, e));
        let gap = |pair: [u32; 2]| {
            let [low, high] = pair.map(|e| self.level(facet, e));
            self.overlap(pair).then_some(high - low).filter(|&gap| gap > 0.0)
        };
        let nearest = |pairs: &mut dyn Iterator<Item = [u32; 2]>| {
            let gaps = pairs.filter_map(|pair| Some((gap(pair)?, pair)));
            gaps.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, pair)| pair)
        };
        let above = lower.iter().filter_map(|&l| nearest(&mut upper.iter().map(|&u| [l, u])));
        let below = upper.iter().filter_map(|&u| nearest(&mut lower.iter().map(|&l| [l, u])));
        above.chain(below).collect()
    }

    /// Whether a facet lies above an edge of it.
    fn is_below(&self, facet: usize, edge: u32) -> bool {
        let own = &self.structure().edges[edge as usize];
        let left = self.structure().facets[facet].label.left(own.axis);
        (own.facets[0] as usize == facet) == (left > 0)
    }

    /// The level of an edge across a facet.
    fn level_of(&self, facet: usize, edge: u32) -> u32 {
        let own = &self.structure().edges[edge as usize];
        let across = 3 - own.axis - self.structure().facets[facet].label.axis();
        self.structure().corners[own.corners[0] as usize].levels[across]
    }

    fn level(&self, facet: usize, edge: u32) -> f64 {
        self.polycube.placement[self.level_of(facet, edge) as usize]
    }

    /// Whether two edges of one axis pass the same coordinates.
    fn overlap(&self, pair: [u32; 2]) -> bool {
        let [one, two] = pair.map(|e| &self.structure().edges[e as usize]);
        let at = |l: u32| self.polycube.placement[l as usize];
        let [a, b] = [one, two].map(|e| self.structure().ends(e).map(at));
        one.axis == two.axis && a[0].max(b[0]) < a[1].min(b[1])
    }

    /// The span between two edges that face each other: the mean way from points of the one to the nearest of the
    /// other.
    fn across(&self, pair: [u32; 2]) -> Span {
        let facets = pair.map(|e| self.structure().edges[e as usize].facets);
        let common = facets[0].into_iter().find(|f| facets[1].contains(f)).unwrap_or(facets[0][0]) as usize;
        let [low, high] = pair.map(|e| self.level_of(common, e));
        let samples = pair.map(|e| self.samples(e as usize));
        let mean = |from: &[Point], to: &[Point]| {
            let nearest = |p: &Point| to.iter().map(|q| (p - q).norm()).fold(f64::INFINITY, f64::min);
            from.iter().map(nearest).sum::<f64>() / from.len() as f64
        };
        let length = 0.5 * (mean(&samples[0], &samples[1]) + mean(&samples[1], &samples[0]));
        let width = pair.map(|e| self.lengths[e as usize]);
        Span { low, high, length, area: length * width[0].min(width[1]) }
    }

    /// Points of an edge at about equal distances.
    fn samples(&self, edge: usize) -> Vec<Point> {
        let chain = &self.polycube.chains[edge];
        let at = |i: usize| self.shape[chain[i * (chain.len() - 1) / SAMPLES] as usize];
        (0..=SAMPLES).map(at).collect()
    }
}

fn face_area(points: &[Point], face: &Face) -> f64 {
    0.5 * area_vector(points, face).norm()
}
