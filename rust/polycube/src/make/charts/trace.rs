//! The edges of the polycube as paths on the shape: from the middle of each region to those beside it.

use super::Traced;
use super::shortest::Shortest;
use super::triangulation::{NONE, Triangle, Triangulation};
use crate::context::Context;
use crate::make::loops::LoopSet;
use crate::make::loops::along;
use crate::make::loops::cut_mesh::CutMesh;
use crate::make::loops::graph::{Arc, LoopGraph, loop_vertices};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Cuts the surface into the charts that the loops stand for; nothing if that fails or is cancelled.
pub(super) fn trace(loops: &LoopSet, context: &Context) -> Option<Traced> {
    let mut tracer = Tracer::new(&loops.mesh, &loops.graph);
    tracer.place_gates(&loops.mesh);
    tracer.trace_regions(context)?;
    tracer.flood_charts()
}

/// Where an edge of the polycube passes a loop.
#[derive(Clone, Copy)]
struct Gate {
    vertex: u32,
    /// The labels of the charts beside it.
    labels: [u8; 2],
}

struct Tracer<'a> {
    loops: &'a LoopGraph,
    mesh: Triangulation,
    /// Whether a vertex lies on a loop or a path.
    blocked: Vec<bool>,
    /// Area-weighted normals of the vertices of the cut mesh.
    normals: Vec<Vector3<f64>>,
    /// Of each region where edges of the polycube leave it.
    gates: Vec<Vec<Gate>>,
    /// The triangles of each region.
    members: Vec<Vec<u32>>,
}

impl<'a> Tracer<'a> {
    fn new(cut: &CutMesh, loops: &'a LoopGraph) -> Self {
        let alive = |c: u32| c != NONE && loops.loops[c as usize].alive;
        let mut at = vec![NONE; cut.points.len()];
        let mut blocked = vec![false; cut.points.len()];
        let mut normals = vec![Vector3::zeros(); cut.points.len()];
        let mut triangles = Vec::with_capacity(cut.triangles.len());
        for (i, (t, &neighbours)) in cut.triangles.iter().zip(&cut.twins).enumerate() {
            let (vertices, barrier) = (t.vertices, t.cut.map(alive));
            for k in 0..3 {
                at[vertices[k] as usize] = i as u32;
                normals[vertices[k] as usize] += cut.area_vector(i);
                if barrier[k] {
                    blocked[vertices[k] as usize] = true;
                    blocked[vertices[(k + 1) % 3] as usize] = true;
                }
            }
            triangles.push(Triangle {
                vertices,
                neighbours,
                barrier,
                border: [false; 3],
                origin: t.origin,
                patch: NONE,
            });
        }
        let mut mesh = Triangulation { points: cut.points.clone(), triangles, at };
        let members = mesh.flood(|t, k| t.barrier[k]);
        let gates = vec![Vec::new(); members.len()];
        Self { loops, mesh, blocked, normals, gates, members }
    }

    /// How badly the surface at a vertex suits a border between charts of two labels: 0 where it suits both alike.
    fn mismatch(&self, v: u32, [a, b]: [u8; 2]) -> f64 {
        let n = self.normals.get(v as usize).copied().unwrap_or_default();
        let size = n.norm();
        if size > 0.0 { (along(&n, a) - along(&n, b)).abs() / size } else { 1.0 }
    }

    /// The labels of the charts on both sides of the edge of the polycube across an arc.
    fn labels(&self, arc: Arc) -> [u8; 2] {
        [arc / 4, self.loops.end(arc)].map(|q| self.loops.crossings[q as usize].label)
    }

    /// Chooses where the edges of the polycube pass the loops.
    fn place_gates(&mut self, cut: &CutMesh) {
        let paths = loop_vertices(cut, |c| self.loops.loops[c as usize].alive);
        let mut crossing_at = vec![NONE; cut.points.len()];
        for (q, c) in (0..).zip(&self.loops.crossings) {
            if c.alive {
                crossing_at[c.vertex as usize] = q;
            }
        }
        for (l, path) in (0..).zip(&paths) {
            let is_crossing = |i: &usize| crossing_at[path[*i] as usize] != NONE;
            let stops: Vec<usize> = (0..path.len()).filter(is_crossing).collect();
            for (i, &from) in stops.iter().enumerate() {
                let to = stops.get(i + 1).copied().unwrap_or(stops[0] + path.len());
                let q = crossing_at[path[from] as usize];
                let arc = q * 4 + self.loops.slot(q, l) as u32 * 2 + 1;
                let labels = self.labels(arc);
                if labels[0] == labels[1] {
                    continue;
                }
                let along: Vec<u32> = (from..=to).map(|i| path[i % path.len()]).collect();
                let Some((t, k)) = self.side(along[0], along[1]) else { continue };
                let beside = [t, self.mesh.triangles[t as usize].neighbours[k]];
                let regions = beside.map(|t| self.mesh.triangles[t as usize].patch as usize);
                let vertex = self.choose_gate(&along, labels);
                regions.iter().for_each(|&r| self.gates[r].push(Gate { vertex, labels }));
            }
        }
    }

    /// The vertex inside an arc that suits both labels best; one is made where there is none.
    fn choose_gate(&mut self, along: &[u32], labels: [u8; 2]) -> u32 {
        let inner = &along[1..along.len() - 1];
        let cost = |i: usize| {
            let off = ((i + 1) as f64 / (inner.len() + 1) as f64 - 0.5).abs();
            self.mismatch(inner[i], labels) + 0.2 * off
        };
        let best = (0..inner.len()).min_by(|&i, &j| cost(i).total_cmp(&cost(j)));
        best.map(|i| inner[i]).unwrap_or_else(|| {
            let side = self.side(along[0], along[1]);
            side.map_or(NONE, |(t, k)| self.split(t, k, true))
        })
    }

    fn split(&mut self, t: u32, k: usize, blocked: bool) -> u32 {
        let other = self.mesh.triangles[t as usize].neighbours[k];
        let count = self.mesh.triangles.len() as u32;
        for (own, new) in [(t, count), (other, count + 1)] {
            self.members[self.mesh.triangles[own as usize].patch as usize].push(new);
        }
        self.blocked.push(blocked);
        self.mesh.split_side(t, k)
    }

    /// The triangle left of the side between two vertices, and the place of that side.
    fn side(&self, from: u32, to: u32) -> Option<(u32, usize)> {
        self.mesh.fan(from).find(|&(t, k)| self.mesh.end(t, k) == to)
    }

    /// Draws the paths inside every region.
    fn trace_regions(&mut self, context: &Context) -> Option<()> {
        let mut shortest = Shortest::default();
        for region in 0..self.gates.len() {
            if region.is_multiple_of(64) {
                context.check().ok()?;
            }
            match std::mem::take(&mut self.gates[region])[..] {
                [] => {}
                [from, to] => {
                    self.open(region);
                    self.draw(&mut shortest, region, from.vertex, to)?;
                }
                ref gates => self.trace_corner(&mut shortest, region, gates)?,
            }
        }
        Some(())
    }

    /// Puts the corner of a region where it is near to all gates, and draws the paths from there.
    fn trace_corner(&mut self, shortest: &mut Shortest, region: usize, gates: &[Gate]) -> Option<()> {
        self.open(region);
        let mut sums = BTreeMap::<u32, f64>::new();
        for gate in gates {
            self.search(shortest, region, gate.vertex, NONE, gate.labels);
            for &v in shortest.reached().iter().filter(|&&v| !self.blocked[v as usize]) {
                *sums.entry(v).or_insert(0.0) += shortest.distance(v);
            }
        }
        let corner = sums.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))?.0;
        self.blocked[corner as usize] = true;
        for &gate in gates {
            self.open(region);
            self.draw(shortest, region, corner, gate)?;
        }
        Some(())
    }

    /// Draws the best path between two blocked vertices.
    fn draw(&mut self, shortest: &mut Shortest, region: usize, from: u32, to: Gate) -> Option<()> {
        self.search(shortest, region, from, to.vertex, to.labels);
        let path = shortest.path(to.vertex)?;
        for step in path.windows(2) {
            let (t, k) = self.side(step[0], step[1])?;
            let (u, j) = self.mesh.opposite(t, k);
            self.mesh.triangles[t as usize].border[k] = true;
            self.mesh.triangles[u as usize].border[j] = true;
        }
        path.iter().for_each(|&v| self.blocked[v as usize] = true);
        Some(())
    }

    /// Distances inside a region from a vertex to all that are not blocked, and to `goal`.
    fn search(&self, shortest: &mut Shortest, region: usize, from: u32, goal: u32, labels: [u8; 2]) {
        let cost = |v: u32, w: u32| {
            let length = (self.mesh.points[v as usize] - self.mesh.points[w as usize]).norm();
            length * (0.05 + 0.5 * (self.mismatch(v, labels) + self.mismatch(w, labels)))
        };
        shortest.run(self.mesh.points.len(), from, |v, visit| {
            if v != from && self.blocked[v as usize] {
                return;
            }
            for (t, k) in self.mesh.fan(v) {
                let triangle = &self.mesh.triangles[t as usize];
                // A side is seen from the triangle on its left; one of the two is in the region.
                let inside = triangle.patch as usize == region && !triangle.barrier[k];
                let w = triangle.vertices[(k + 1) % 3];
                if inside && (w == goal || !self.blocked[w as usize]) {
                    visit(w, cost(v, w));
                }
            }
        });
    }

    /// Cuts all sides inside a region whose ends are both blocked, so that its other vertices hang together and every
    /// blocked one has one of them as neighbour.
    fn open(&mut self, region: usize) {
        let mut i = 0;
        while i < self.members[region].len() {
            let t = self.members[region][i];
            let triangle = self.mesh.triangles[t as usize];
            let shut = |k: usize| {
                let ends = [triangle.vertices[k], triangle.vertices[(k + 1) % 3]];
                !triangle.barrier[k] && !triangle.border[k] && ends.iter().all(|&v| self.blocked[v as usize])
            };
            if let Some(k) = (0..3).find(|&k| shut(k)) {
                self.split(t, k, false);
            } else {
                let walled = (0..3).all(|k| triangle.barrier[k] || triangle.border[k]);
                if walled {
                    self.pierce(t);
                }
                i += 1;
            }
        }
    }

    /// Cuts a triangle that has walls on all sides in three.
    fn pierce(&mut self, t: u32) {
        let region = self.mesh.triangles[t as usize].patch as usize;
        let count = self.mesh.triangles.len() as u32;
        self.members[region].extend([count, count + 1]);
        self.blocked.push(false);
        self.mesh.split_triangle(t);
    }

    fn flood_charts(mut self) -> Option<Traced> {
        let charts = self.mesh.flood(|t, k| t.border[k]);
        let (mut labels, mut crossings) = (vec![u8::MAX; charts.len()], vec![NONE; charts.len()]);
        for (q, c) in (0..).zip(&self.loops.crossings).filter(|(_, c)| c.alive) {
            let chart = self.mesh.triangles[self.mesh.at[c.vertex as usize] as usize].patch as usize;
            if labels[chart] != u8::MAX && labels[chart] != c.label {
                return None;
            }
            (labels[chart], crossings[chart]) = (c.label, q);
        }
        labels.iter().all(|&l| l != u8::MAX).then_some(Traced { mesh: self.mesh, labels, crossings })
    }
}
