//! More loops through regions that are invalid.

use super::NONE;
use super::cut_mesh::{Cut, CutMesh};
use super::graph::{Arc, LoopGraph};
use super::regions::Regions;
use crate::context::Context;
use crate::error::Result;

/// What is wrong with a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Why {
    /// It has a hole or a handle, or a loop around it crosses no other.
    NoDisc,
    /// It has under three sides.
    Few,
    /// Two sides look in one direction.
    Repeated,
}

/// An invalid region.
struct Fault {
    why: Why,
    region: usize,
    triangles: Vec<u32>,
    /// The arcs around it.
    arcs: Vec<Arc>,
    /// Loops around it that cross no other.
    lone: Vec<u32>,
}

/// Regions less than this share of the size are not cut.
const LEAST: f64 = 1.0 / 800.0;
/// The round from which on other heights and axes are tried, and that from which on loops are taken away at worst.
const VARIED: usize = 4;
const DESPERATE: usize = 12;

/// One round of repair.
pub(super) struct Repair<'a> {
    mesh: &'a mut CutMesh,
    alive: &'a mut Vec<bool>,
    graph: LoopGraph,
    faults: Vec<Fault>,
    round: usize,
    least: f64,
}

impl<'a> Repair<'a> {
    /// Finds all invalid regions.
    pub(super) fn new(mesh: &'a mut CutMesh, alive: &'a mut Vec<bool>, size: f64, round: usize) -> Self {
        let graph = LoopGraph::new(mesh, alive);
        let faults = find_faults(mesh, alive, &graph);
        Self { mesh, alive, graph, faults, round, least: LEAST * size }
    }

    /// A face of the shape in the first invalid region.
    pub(super) fn first_fault(&self) -> Option<u32> {
        let t = self.faults.first()?.triangles.first()?;
        Some(self.mesh.triangles[*t as usize].origin)
    }

    /// How many triangles the mesh has.
    pub(super) fn triangles(&self) -> usize {
        self.mesh.triangles.len()
    }

    /// Cuts every invalid region that was not yet cut, or takes a loop beside it away.
    ///
    /// # Errors
    /// Only that the context was cancelled.
    pub(super) fn repair(mut self, context: &Context) -> Result<()> {
        let mut touched = vec![false; self.mesh.triangles.len()];
        for fault in std::mem::take(&mut self.faults) {
            context.check()?;
            let before = fault.triangles.iter().map(|&t| t as usize);
            if before.clone().any(|t| touched[t] || self.is_cut(t)) {
                continue;
            }
            if self.cut(&fault) || self.remove(&fault) {
                before.for_each(|t| touched[t] = true);
                touched.resize(self.mesh.triangles.len(), true);
            }
        }
        Ok(())
    }

    /// Whether a triangle lies at a cut made in this round.
    fn is_cut(&self, t: usize) -> bool {
        let first = self.graph.loops.len() as u32;
        self.mesh.triangles[t].cut.iter().any(|&c| c != NONE && c >= first)
    }

    /// Cuts along the part of a level set that passes through a region.
    fn cut(&mut self, fault: &Fault) -> bool {
        let spans = [0, 1, 2].map(|axis| self.span(&fault.triangles, axis));
        let extent = spans.map(|s| s[1] - s[0]);
        let tiny =
            extent.iter().all(|&e| e < 4.0 * self.least) || (self.round > VARIED && self.round.is_multiple_of(3));
        if fault.why != Why::NoDisc && tiny {
            return false;
        }
        let Some((axis, middle)) = self.varied(fault, spans).or_else(|| self.choose(fault, spans)) else {
            return false;
        };
        let reach = (middle - spans[axis][0]).min(spans[axis][1] - middle);
        let mut values: Vec<f64> = self.values(&fault.triangles, axis).collect();
        values.sort_by(f64::total_cmp);
        let cut = Cut { axis, at: widest_gap(&values, middle - reach, middle + reach) };
        let known = self.mesh.cuts.iter().any(|c| c.axis == axis && c.at == cut.at);
        let seed = fault.triangles.iter().find(|&&t| self.mesh.crosses(t, cut));
        let (false, Some(&seed)) = (known, seed) else { return false };
        self.mesh.cut_component(cut, seed);
        self.alive.resize(self.mesh.cuts.len(), true);
        true
    }

    fn values<'b>(&'b self, triangles: &'b [u32], axis: usize) -> impl Iterator<Item = f64> + 'b {
        let vertices = triangles.iter().flat_map(|&t| self.mesh.triangles[t as usize].vertices);
        vertices.map(move |v| self.mesh.values[v as usize][axis])
    }

    fn span(&self, triangles: &[u32], axis: usize) -> [f64; 2] {
        let all = || self.values(triangles, axis);
        [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// In later rounds an axis and a height that differ from round to round, as the best ones did not help.
    fn varied(&self, fault: &Fault, spans: [[f64; 2]; 3]) -> Option<(usize, f64)> {
        let turn = (self.round * 7 + fault.region * 3) % 5;
        if self.round < VARIED || turn == 0 {
            return None;
        }
        let wide: Vec<usize> = (0..3).filter(|&a| spans[a][1] - spans[a][0] > self.least).collect();
        let &axis = wide.get((self.round + fault.region) % wide.len().max(1))?;
        let [low, high] = spans[axis];
        Some((axis, low + (high - low) * [0.5, 0.5, 0.35, 0.65, 0.5][turn]))
    }

    /// Between two sides of one direction where they are farthest apart; else across the axis with the fewest sides.
    fn choose(&self, fault: &Fault, spans: [[f64; 2]; 3]) -> Option<(usize, f64)> {
        if fault.why == Why::Repeated {
            return self.between_sides(&fault.arcs);
        }
        let mut sides = [0; 3];
        fault.arcs.iter().for_each(|&h| sides[self.graph.direction(h) / 2] += 1);
        fault.lone.iter().for_each(|&l| sides[self.mesh.cuts[l as usize].axis] += 1);
        let extent = spans.map(|s| s[1] - s[0]);
        let mut axes = [0, 1, 2];
        axes.sort_by(|&a, &b| sides[a].cmp(&sides[b]).then(extent[b].total_cmp(&extent[a])));
        let axis = axes.into_iter().find(|&a| extent[a] > self.least)?;
        Some((axis, 0.5 * (spans[axis][0] + spans[axis][1])))
    }

    fn between_sides(&self, arcs: &[Arc]) -> Option<(usize, f64)> {
        let middle = |h: Arc| -> [f64; 3] {
            let ends = [h / 4, self.graph.end(h)];
            let [p, q] = ends.map(|q| self.mesh.values[self.graph.crossings[q as usize].vertex as usize]);
            std::array::from_fn(|a| 0.5 * (p[a] + q[a]))
        };
        let (mut widest, mut found) = (self.least, None);
        for (i, &g) in arcs.iter().enumerate() {
            let direction = self.graph.direction(g);
            for &h in arcs[..i].iter().filter(|&&h| self.graph.direction(h) == direction) {
                let (p, q) = (middle(g), middle(h));
                for axis in (0..3).filter(|&a| a != direction / 2) {
                    if (p[axis] - q[axis]).abs() > widest {
                        widest = (p[axis] - q[axis]).abs();
                        found = Some((axis, 0.5 * (p[axis] + q[axis])));
                    }
                }
            }
        }
        found
    }

    /// Takes a loop beside a region away: one that crosses no other, or, if nothing else helped for long, the shortest
    /// that is too many.
    fn remove(&mut self, fault: &Fault) -> bool {
        let loop_of = |h: &Arc| self.graph.loop_of(*h);
        let desperate = self.round >= DESPERATE && self.round.is_multiple_of(4);
        let direction = |h: &Arc| self.graph.direction(*h);
        let repeats = |h: &&Arc| fault.arcs.iter().filter(|g| direction(g) == direction(h)).count() > 1;
        let extra = fault.arcs.iter().filter(|h| fault.why != Why::Repeated || repeats(h)).map(loop_of);
        let shortest = extra.min_by_key(|&l| self.graph.loops[l as usize].crossings.len());
        let Some(l) = fault.lone.first().copied().or(shortest.filter(|_| desperate)) else { return false };
        self.alive[l as usize] = false;
        true
    }
}

fn find_faults(mesh: &CutMesh, alive: &[bool], graph: &LoopGraph) -> Vec<Fault> {
    let regions = Regions::new(mesh, alive);
    let mut at = vec![NONE; mesh.points.len()];
    (0..).zip(&graph.crossings).for_each(|(q, c)| at[c.vertex as usize] = q);
    let mut arcs: Vec<Vec<Arc>> = vec![Vec::new(); regions.len()];
    let mut lone: Vec<Vec<u32>> = vec![Vec::new(); regions.len()];
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        let region = regions.of[t] as usize;
        for k in (0..3).filter(|&k| triangle.cut[k] != NONE && alive[triangle.cut[k] as usize]) {
            let (l, q) = (triangle.cut[k], at[triangle.vertices[k] as usize]);
            if !graph.loops[l as usize].alive {
                lone[region].push(l);
            } else if q != NONE {
                arcs[region].push(q * 4 + graph.slot(q, l) as u32 * 2 + u32::from(mesh.is_above(t, k)));
            }
        }
    }
    let why = |r: usize| -> Option<Why> {
        let directions = arcs[r].iter().fold([0_u8; 6], |mut seen, &h| {
            seen[graph.direction(h)] += 1;
            seen
        });
        if regions.euler[r] != 1 || !lone[r].is_empty() {
            Some(Why::NoDisc)
        } else if arcs[r].len() < 3 {
            Some(Why::Few)
        } else {
            directions.iter().any(|&n| n > 1).then_some(Why::Repeated)
        }
    };
    let why: Vec<Option<Why>> = (0..regions.len()).map(why).collect();
    let mut triangles: Vec<Vec<u32>> = vec![Vec::new(); regions.len()];
    for (t, &r) in (0..).zip(&regions.of) {
        if why[r as usize].is_some() {
            triangles[r as usize].push(t);
        }
    }
    let fault = |(region, why): (usize, Option<Why>)| {
        let mut lone = std::mem::take(&mut lone[region]);
        lone.sort_unstable();
        lone.dedup();
        let (triangles, arcs) = (std::mem::take(&mut triangles[region]), std::mem::take(&mut arcs[region]));
        Some(Fault { why: why?, region, triangles, arcs, lone })
    };
    why.into_iter().enumerate().filter_map(fault).collect()
}

/// The middle of the widest gap between values in the middle half of a span; in the middle of the span for choice.
pub(super) fn widest_gap(sorted: &[f64], low: f64, high: f64) -> f64 {
    let (from, to) = (low + 0.25 * (high - low), high - 0.25 * (high - low));
    let middle = 0.5 * (low + high);
    let first = sorted.partition_point(|&x| x < from);
    let last = sorted.partition_point(|&x| x <= to);
    let inner = sorted[first..last.max(first)].iter().copied();
    let (mut best, mut before) = ((0.0, middle), from);
    for x in inner.chain([to]) {
        let at = 0.5 * (before + x);
        let score = (x - before) * (1.0 - 0.5 * ((at - middle) / (to - from)).abs());
        if score > best.0 {
            best = (score, at);
        }
        before = x;
    }
    best.1
}
