//! A triangle mesh that is cut along level sets of three functions.

use super::NONE;
use crate::mesh::Point;
use nalgebra::Vector3;
use std::collections::HashMap;

/// A triangle of the cut surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    /// Its vertices, counter-clockwise seen from outside.
    pub(crate) vertices: [u32; 3],
    /// The cut along the side from vertex `k` to the next, [`NONE`] where there is none.
    pub(crate) cut: [u32; 3],
    /// Whether it lies above the cut along each side. Kept, as rounded values may lie on the level.
    above: [bool; 3],
    /// The triangle of the shape that it is part of.
    pub(crate) origin: u32,
}

/// A connected part of a level set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    /// Which of the three functions is constant on it.
    pub(crate) axis: usize,
    /// Its value there.
    pub(crate) at: f64,
}

/// A closed, oriented, manifold triangle mesh and the cuts through it.
#[derive(Clone, Debug)]
pub(crate) struct CutMesh {
    /// Vertex positions; those of the shape come first.
    pub(crate) points: Vec<Point>,
    /// The three functions at the vertices.
    pub(crate) values: Vec<[f64; 3]>,
    /// The triangles.
    pub(crate) triangles: Vec<Triangle>,
    /// The triangle behind the side from vertex `k` to the next.
    pub(crate) twins: Vec<[u32; 3]>,
    /// The cuts.
    pub(crate) cuts: Vec<Cut>,
}

/// A triangle's side: the triangle and the place of its first vertex.
type Side = (u32, usize);

/// A triangle of a walk along a level set, before it is cut.
struct Step {
    triangle: u32,
    /// The place of the vertex that is alone on its side of the level.
    lone: usize,
    /// Whether the lone vertex is above.
    above: bool,
}

impl CutMesh {
    /// The mesh without cuts. Every side must have a triangle on both sides.
    pub(crate) fn new(points: &[Point], values: &[[f64; 3]], triangles: &[[u32; 3]]) -> Self {
        let mut behind: HashMap<[u32; 2], u32> = HashMap::with_capacity(3 * triangles.len());
        for (i, t) in (0..).zip(triangles) {
            (0..3).for_each(|k| {
                behind.insert([t[(k + 1) % 3], t[k]], i);
            });
        }
        let twins = triangles.iter().map(|t| [0, 1, 2].map(|k| behind[&[t[k], t[(k + 1) % 3]]])).collect();
        let whole = |(origin, &vertices)| Triangle { vertices, cut: [NONE; 3], above: [false; 3], origin };
        let triangles = (0..).zip(triangles).map(whole).collect();
        Self { points: points.to_vec(), values: values.to_vec(), triangles, twins, cuts: Vec::new() }
    }

    /// Half the cross product of two sides of a triangle: its area, outwards.
    pub(crate) fn area_vector(&self, t: usize) -> Vector3<f64> {
        let [a, b, c] = self.triangles[t].vertices.map(|v| self.points[v as usize]);
        (b - a).cross(&(c - a)) * 0.5
    }

    /// Whether a triangle lies above the cut along its side `k`.
    pub(crate) fn is_above(&self, t: usize, k: usize) -> bool {
        self.triangles[t].above[k]
    }

    /// The side after side `k` of a triangle, counter-clockwise around its first vertex.
    pub(crate) fn turn(&self, t: usize, k: usize) -> (usize, usize) {
        let vertex = self.triangles[t].vertices[k];
        let next = self.twins[t][(k + 2) % 3] as usize;
        (next, (0..3).find(|&j| self.triangles[next].vertices[j] == vertex).unwrap_or(0))
    }

    fn ups(&self, t: u32, cut: Cut) -> [bool; 3] {
        self.triangles[t as usize].vertices.map(|v| self.values[v as usize][cut.axis] >= cut.at)
    }

    /// Whether a level set passes through a triangle.
    pub(crate) fn crosses(&self, t: u32, cut: Cut) -> bool {
        let ups = self.ups(t, cut);
        ups[0] != ups[1] || ups[1] != ups[2]
    }

    /// Cuts the connected part of a level set that passes through triangle `seed`.
    pub(crate) fn cut_component(&mut self, cut: Cut, seed: u32) {
        let walk = self.walk(cut, seed);
        self.split(&walk, cut);
    }

    /// Cuts all of a level set.
    pub(crate) fn cut_level(&mut self, cut: Cut) {
        let count = self.triangles.len() as u32;
        let mut seen = vec![false; count as usize];
        let mut walks = Vec::new();
        for seed in 0..count {
            if !seen[seed as usize] && self.crosses(seed, cut) {
                let walk = self.walk(cut, seed);
                walk.iter().for_each(|s| seen[s.triangle as usize] = true);
                walks.push(walk);
            }
        }
        walks.iter().for_each(|walk| self.split(walk, cut));
    }

    /// The triangles along a level set from `seed`, each left through the side that leads from above to below.
    fn walk(&self, cut: Cut, seed: u32) -> Vec<Step> {
        let mut walk = Vec::new();
        let mut t = seed;
        loop {
            let ups = self.ups(t, cut);
            let alone = |k: &usize| ups[*k] != ups[(k + 1) % 3] && ups[*k] != ups[(k + 2) % 3];
            let Some(lone) = (0..3).find(alone) else { return Vec::new() };
            let exit = if ups[lone] { lone } else { (lone + 2) % 3 };
            walk.push(Step { triangle: t, lone, above: ups[lone] });
            t = self.twins[t as usize][exit];
            if t == seed {
                return walk;
            }
        }
    }

    /// Cuts the triangles of a closed walk; the cut gets the next number.
    fn split(&mut self, walk: &[Step], cut: Cut) {
        if walk.is_empty() {
            return;
        }
        let id = self.cuts.len() as u32;
        self.cuts.push(cut);
        let first = self.points.len() as u32;
        walk.iter().for_each(|step| self.add_vertex(step, cut));
        let count = walk.len();
        let base = self.triangles.len() as u32;
        let behind: Vec<u32> = walk.iter().map(|s| self.twins[s.triangle as usize][(s.lone + 1) % 3]).collect();
        for (i, step) in walk.iter().enumerate() {
            let exit = first + i as u32;
            let entry = first + ((i + count - 1) % count) as u32;
            self.split_triangle(step, if step.above { [exit, entry] } else { [entry, exit] }, id);
        }
        for (i, step) in walk.iter().enumerate() {
            let next = (i + 1) % count;
            let from = exit_sides(step, base + 2 * i as u32);
            let to = entry_sides(&walk[next], base + 2 * next as u32);
            self.link(from[0], to[0]);
            self.link(from[1], to[1]);
        }
        self.link_uncrossed(walk, base, &behind);
    }

    /// The point where a walk leaves a triangle.
    fn add_vertex(&mut self, step: &Step, cut: Cut) {
        let t = &self.triangles[step.triangle as usize];
        let exit = if step.above { step.lone } else { (step.lone + 2) % 3 };
        let [a, b] = [exit, (exit + 1) % 3].map(|k| t.vertices[k] as usize);
        let [fa, fb] = [a, b].map(|v| self.values[v][cut.axis]);
        let s = ((fa - cut.at) / (fa - fb)).clamp(1e-9, 1.0 - 1e-9);
        let (p, q) = (self.values[a], self.values[b]);
        let mut value: [f64; 3] = std::array::from_fn(|i| p[i] + (q[i] - p[i]) * s);
        value[cut.axis] = cut.at;
        self.points.push(self.points[a] + (self.points[b] - self.points[a]) * s);
        self.values.push(value);
    }

    /// Cuts the lone vertex off a triangle: it keeps the triangle's number, and the rest becomes two new ones.
    fn split_triangle(&mut self, step: &Step, [ab, ca]: [u32; 2], id: u32) {
        let t = step.triangle;
        let Triangle { vertices, cut, above, origin } = self.triangles[t as usize];
        let [a, b, c] = [0, 1, 2].map(|k| vertices[(step.lone + k) % 3]);
        let [cut_ab, cut_bc, cut_ca] = [0, 1, 2].map(|k| cut[(step.lone + k) % 3]);
        let [up_ab, up_bc, up_ca] = [0, 1, 2].map(|k| above[(step.lone + k) % 3]);
        let n = self.triangles.len() as u32;
        let part = |vertices, cut, above| Triangle { vertices, cut, above, origin };
        self.triangles[t as usize] = part([a, ab, ca], [cut_ab, id, cut_ca], [up_ab, step.above, up_ca]);
        self.triangles.push(part([ab, b, c], [cut_ab, cut_bc, NONE], [up_ab, up_bc, false]));
        self.triangles.push(part([ab, c, ca], [NONE, cut_ca, id], [false, up_ca, !step.above]));
        self.twins[t as usize] = [NONE, n + 1, NONE];
        self.twins.push([NONE, NONE, n + 1]);
        self.twins.push([n, NONE, t]);
    }

    fn link(&mut self, a: Side, b: Side) {
        self.twins[a.0 as usize][a.1] = b.0;
        self.twins[b.0 as usize][b.1] = a.0;
    }

    /// Links the sides that the walk does not cross with the triangles behind them, which may be in the walk as well.
    fn link_uncrossed(&mut self, walk: &[Step], base: u32, behind: &[u32]) {
        let mut place: Vec<(u32, u32)> = walk.iter().map(|s| s.triangle).zip((base..).step_by(2)).collect();
        place.sort_unstable();
        for (i, &other) in behind.iter().enumerate() {
            let own = base + 2 * i as u32;
            let [_, b, c] = self.triangles[own as usize].vertices;
            let other = place.binary_search_by_key(&other, |p| p.0).map_or(other, |i| place[i].1);
            let ends = self.triangles[other as usize].vertices;
            if let Some(k) = (0..3).find(|&k| ends[k] == c && ends[(k + 1) % 3] == b) {
                self.link((own, 1), (other, k));
            }
        }
    }
}

/// The two parts, above and below, of the side through which a walk leaves a triangle whose first new part is `new`.
fn exit_sides(step: &Step, new: u32) -> [Side; 2] {
    if step.above { [(step.triangle, 0), (new, 0)] } else { [(new + 1, 1), (step.triangle, 2)] }
}

/// Those of the side through which it enters.
fn entry_sides(step: &Step, new: u32) -> [Side; 2] {
    if step.above { [(step.triangle, 2), (new + 1, 1)] } else { [(new, 0), (step.triangle, 0)] }
}
