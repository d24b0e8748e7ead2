//! From charts to corners, edges, facets and levels.

use super::charts::Charts;
use super::order::disorder;
use super::polycube::{Deviation, Polycube, Tolerance};
use super::{Corner, Edge, Facet, HalfEdge, Level, Placement, Side, Structure, Surface, Violation};
use crate::mesh::Point;

/// A side of a chart between two corners: its half-edges in the order in which the chart's boundary passes them.
pub(super) struct Chain {
    pub(super) half_edges: Vec<HalfEdge>,
    /// The next side of the same chart.
    pub(super) next: usize,
}

/// The corners and the chains between them.
pub(super) struct Skeleton {
    pub(super) corners: Vec<u32>,
    pub(super) chains: Vec<Chain>,
    /// The chain that a half-edge starts, if it leaves a corner.
    pub(super) starts: Vec<u32>,
}

impl Skeleton {
    /// Finds corners and follows the borders between them.
    pub(super) fn new(surface: &Surface, charts: &Charts) -> Result<Self, Vec<Violation>> {
        let mut borders = vec![0_u32; surface.vertex_count()];
        charts.borders.iter().for_each(|&h| borders[surface.start(h) as usize] += 1);
        let corners: Vec<u32> = (0..).zip(borders).filter(|(_, count)| *count >= 3).map(|(v, _)| v).collect();
        let incomplete = |v: &&u32| {
            let axes = surface.fan(**v).fold(0, |m, h| m | 1 << charts.label(surface, h).axis());
            axes != 0b111
        };
        let violations: Vec<_> =
            corners.iter().filter(incomplete).map(|&vertex| Violation::IncompleteCorner { vertex }).collect();
        if !violations.is_empty() {
            return Err(violations);
        }
        let mut skeleton = Self { corners, chains: Vec::new(), starts: vec![u32::MAX; 4 * surface.faces().len()] };
        skeleton.trace(surface, charts);
        let violations = skeleton.short_loops(surface, charts);
        if violations.is_empty() { Ok(skeleton) } else { Err(violations) }
    }

    fn trace(&mut self, surface: &Surface, charts: &Charts) {
        let mut is_corner = vec![false; surface.vertex_count()];
        self.corners.iter().for_each(|&v| is_corner[v as usize] = true);
        let leaving = charts.borders.iter().copied().filter(|&h| is_corner[surface.start(h) as usize]);
        let mut following = Vec::new();
        for first in leaving {
            let mut half_edges = vec![first];
            let mut next = charts.next_border(surface, first);
            while !is_corner[surface.start(next) as usize] {
                half_edges.push(next);
                next = charts.next_border(surface, next);
            }
            self.starts[first as usize] = self.chains.len() as u32;
            self.chains.push(Chain { half_edges, next: 0 });
            following.push(next);
        }
        for (chain, next) in self.chains.iter_mut().zip(following) {
            chain.next = self.starts[next as usize] as usize;
        }
    }

    /// Boundary loops with fewer than four corners. A loop without corners is found by its half-edges.
    fn short_loops(&self, surface: &Surface, charts: &Charts) -> Vec<Violation> {
        let mut on_chain = vec![false; 4 * surface.faces().len()];
        self.chains.iter().flat_map(|c| &c.half_edges).for_each(|&h| on_chain[h as usize] = true);
        let mut violations: Vec<_> = self
            .loops()
            .into_iter()
            .filter(|l| l.len() < 4)
            .map(|l| {
                let face = surface.face(self.chains[l[0]].half_edges[0]) as u32;
                Violation::TooFewCorners { face, corners: l.len() }
            })
            .collect();
        for &first in &charts.borders {
            let mut h = first;
            let mut fresh = false;
            while !std::mem::replace(&mut on_chain[h as usize], true) {
                fresh = true;
                h = charts.next_border(surface, h);
            }
            if fresh {
                violations.push(Violation::TooFewCorners { face: surface.face(first) as u32, corners: 0 });
            }
        }
        violations
    }

    /// The chains of every boundary loop.
    pub(super) fn loops(&self) -> Vec<Vec<usize>> {
        let mut seen = vec![false; self.chains.len()];
        let mut loops = Vec::new();
        for first in 0..self.chains.len() {
            let mut chains = Vec::new();
            let mut c = first;
            while !std::mem::replace(&mut seen[c], true) {
                chains.push(c);
                c = self.chains[c].next;
            }
            if !chains.is_empty() {
                loops.push(chains);
            }
        }
        loops
    }

    /// Gives every chart its level and every chain its direction.
    pub(super) fn into_polycube(
        self,
        points: &[Point],
        surface: Surface,
        charts: Charts,
        degrees: f64,
        tolerance: &Tolerance,
    ) -> Result<Polycube, Vec<Violation>> {
        let diagonal = diagonal(points, &surface);
        let (level_of, levels) = self.levels(&surface, &charts);
        let placement = place(points, &surface, &charts, &level_of, &levels, tolerance.merge * diagonal);
        let vertex_levels = vertex_levels(&surface, &charts, &level_of, points.len());
        let distance = off_level(points, &vertex_levels, &placement, tolerance.distance * diagonal)?;
        let corners = self.corner_list(&surface, &charts, &vertex_levels);
        let (edges, chains, sides) = self.edges(&surface, &charts, &vertex_levels, &placement)?;
        let mut facets: Vec<Facet> = charts
            .labels
            .iter()
            .zip(&level_of)
            .map(|(&label, &level)| Facet { label, level, loops: Vec::new() })
            .collect();
        for chain_loop in self.loops() {
            let chart = charts.left(&surface, self.chains[chain_loop[0]].half_edges[0]);
            facets[chart as usize].loops.push(chain_loop.into_iter().map(|c| sides[c]).collect());
        }
        let mut structure = Structure { facets, edges, corners, levels };
        structure.count_corners();
        let disorder = disorder(points, &structure, &chains, &placement, tolerance.distance * diagonal)?;
        let distance = distance.max(disorder.distance);
        Ok(Polycube {
            structure,
            placement,
            surface,
            facet_of_face: charts.of_face,
            chains,
            vertex_levels,
            deviation: Deviation { degrees, distance, out_of_order: disorder.vertices },
        })
    }

    /// The level of every chart: charts of one axis that share a corner share it.
    pub(super) fn levels(&self, surface: &Surface, charts: &Charts) -> (Vec<u32>, Vec<Level>) {
        let mut merged = petgraph::unionfind::UnionFind::<u32>::new(charts.labels.len());
        for &corner in &self.corners {
            let mut first = [None; 3];
            for h in surface.fan(corner) {
                let chart = charts.left(surface, h);
                let axis = charts.labels[chart as usize].axis();
                merged.union(*first[axis].get_or_insert(chart), chart);
            }
        }
        let mut level_of = vec![u32::MAX; charts.labels.len()];
        let mut levels = Vec::new();
        for axis in 0..3 {
            for chart in (0..charts.labels.len()).filter(|&c| charts.labels[c].axis() == axis) {
                let root = merged.find(chart as u32) as usize;
                if level_of[root] == u32::MAX {
                    level_of[root] = levels.len() as u32;
                    levels.push(Level { axis, corners: 0 });
                }
                level_of[chart] = level_of[root];
            }
        }
        (level_of, levels)
    }

    fn corner_list(&self, surface: &Surface, charts: &Charts, levels: &[[Option<u32>; 3]]) -> Vec<Corner> {
        let corner = |&vertex: &u32| Corner {
            vertex,
            valence: surface.fan(vertex).filter(|&h| charts.is_border(surface, h)).count() as u32,
            levels: levels[vertex as usize].map(|l| l.unwrap_or(0)),
        };
        self.corners.iter().map(corner).collect()
    }

    /// The edges, their vertices, and for every chain the side it is.
    #[expect(clippy::type_complexity, reason = "three parallel results of one pass")]
    fn edges(
        &self,
        surface: &Surface,
        charts: &Charts,
        vertex_levels: &[[Option<u32>; 3]],
        placement: &[f64],
    ) -> Result<(Vec<Edge>, Vec<Vec<u32>>, Vec<Side>), Vec<Violation>> {
        let mut sides = vec![Side { edge: u32::MAX, forward: true }; self.chains.len()];
        let (mut edges, mut vertices, mut violations) = (Vec::new(), Vec::new(), Vec::new());
        for (c, chain) in self.chains.iter().enumerate() {
            if sides[c].edge != u32::MAX {
                continue;
            }
            let (first, last) = (chain.half_edges[0], chain.half_edges[chain.half_edges.len() - 1]);
            let twin = self.starts[surface.twin(last) as usize] as usize;
            let axis = 3 - charts.label(surface, first).axis() - charts.label(surface, surface.twin(first)).axis();
            let ends = [surface.start(first), surface.end(last)];
            let [from, to] = ends.map(|v| vertex_levels[v as usize][axis].map_or(0.0, |l| placement[l as usize]));
            if from == to {
                violations.push(Violation::ZeroLengthEdge { ends });
            }
            let forward = from < to;
            sides[c] = Side { edge: edges.len() as u32, forward };
            sides[twin] = Side { edge: edges.len() as u32, forward: !forward };
            let mut along: Vec<u32> = chain.half_edges.iter().map(|&h| surface.start(h)).collect();
            along.push(ends[1]);
            let mut facets = [charts.left(surface, first), charts.left(surface, surface.twin(first))];
            if !forward {
                along.reverse();
                facets.reverse();
            }
            let corner = |v: u32| self.corners.partition_point(|&c| c < v) as u32;
            edges.push(Edge { axis, corners: [corner(along[0]), corner(along[along.len() - 1])], facets });
            vertices.push(along);
        }
        if violations.is_empty() { Ok((edges, vertices, sides)) } else { Err(violations) }
    }
}

impl Structure {
    fn count_corners(&mut self) {
        for corner in &self.corners {
            for level in corner.levels {
                self.levels[level as usize].corners += 1;
            }
        }
    }
}

/// The diagonal of the bounding box of the surface; vertices that no face uses do not count.
fn diagonal(points: &[Point], surface: &Surface) -> f64 {
    let used = || surface.faces().iter().flat_map(|f| f.vertices()).map(|&v| points[v as usize]);
    let low = used().fold(Point::from([f64::INFINITY; 3]), |m, p| m.inf(&p));
    let high = used().fold(Point::from([f64::NEG_INFINITY; 3]), |m, p| m.sup(&p));
    (high - low).norm()
}

/// The level of every vertex along every axis: that of the charts around it.
fn vertex_levels(surface: &Surface, charts: &Charts, level_of: &[u32], vertices: usize) -> Vec<[Option<u32>; 3]> {
    let mut levels = vec![[None; 3]; vertices];
    for (face, &chart) in surface.faces().iter().zip(&charts.of_face) {
        let (axis, level) = (charts.labels[chart as usize].axis(), level_of[chart as usize]);
        face.vertices().iter().for_each(|&v| levels[v as usize][axis] = Some(level));
    }
    levels
}

/// Where each level lies: half way between the extremes of its vertices, which is exact for flat charts.
/// Levels of one axis that differ by less than `merge` become equal.
fn place(
    points: &[Point],
    surface: &Surface,
    charts: &Charts,
    level_of: &[u32],
    levels: &[Level],
    merge: f64,
) -> Placement {
    let mut range = vec![(f64::INFINITY, f64::NEG_INFINITY); levels.len()];
    for (face, &chart) in surface.faces().iter().zip(&charts.of_face) {
        let level = level_of[chart as usize] as usize;
        let along = face.vertices().iter().map(|&v| points[v as usize][levels[level].axis]);
        range[level] = along.fold(range[level], |(low, high), x| (low.min(x), high.max(x)));
    }
    let mut placement: Placement = range.iter().map(|r| f64::midpoint(r.0, r.1)).collect();
    let mut order: Vec<usize> = (0..levels.len()).collect();
    order.sort_by(|&a, &b| levels[a].axis.cmp(&levels[b].axis).then(placement[a].total_cmp(&placement[b])));
    for pair in order.windows(2) {
        if levels[pair[0]].axis == levels[pair[1]].axis && placement[pair[1]] - placement[pair[0]] <= merge {
            placement[pair[1]] = placement[pair[0]];
        }
    }
    placement
}

fn off_level(
    points: &[Point],
    vertex_levels: &[[Option<u32>; 3]],
    placement: &[f64],
    tolerance: f64,
) -> Result<f64, Vec<Violation>> {
    let off = |(p, levels): (&Point, &[Option<u32>; 3])| {
        let along = |a: usize| levels[a].map_or(0.0, |l| (p[a] - placement[l as usize]).abs());
        along(0).max(along(1)).max(along(2))
    };
    let distances: Vec<f64> = points.iter().zip(vertex_levels).map(off).collect();
    let beyond = (0..).zip(&distances).filter(|(_, d)| **d > tolerance);
    let violations: Vec<_> = beyond.map(|(vertex, &distance)| Violation::OffLevel { vertex, distance }).collect();
    if violations.is_empty() { Ok(distances.into_iter().fold(0.0, f64::max)) } else { Err(violations) }
}
