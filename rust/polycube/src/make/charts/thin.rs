//! Takes out again the vertices that cutting added, as far as the charts stay what they are.

use super::Traced;
use super::triangulation::{NONE, Triangulation};
use nalgebra::Vector3;

/// Passes over the vertices; later ones find little.
const PASSES: usize = 6;
/// A triangle of less area than this part of its longest side squared is too thin to be made.
const THIN: f64 = 1e-3;

/// Removes vertices beyond the first `kept` where their triangles can be filled by those around, without leaving the
/// triangles of the shape, in which `normals` stand up.
pub(super) fn thin_out(charts: &mut Traced, kept: usize, normals: &[Vector3<f64>]) {
    let mut thinner = Thinner { mesh: &mut charts.mesh, normals };
    for _ in 0..PASSES {
        let last = thinner.mesh.points.len() as u32;
        let removed = (kept as u32..last).rev().filter(|&v| thinner.remove(v)).count();
        if removed == 0 {
            break;
        }
    }
}

struct Thinner<'a> {
    mesh: &'a mut Triangulation,
    normals: &'a [Vector3<f64>],
}

impl Thinner<'_> {
    /// Moves a vertex into the best of its neighbours, if it may go into any.
    fn remove(&mut self, v: u32) -> bool {
        if self.mesh.at[v as usize] == NONE {
            return false;
        }
        let fan: Vec<(u32, usize)> = self.mesh.fan(v).collect();
        let on_side = |&(t, k): &(u32, usize)| {
            let triangle = &self.mesh.triangles[t as usize];
            triangle.origin != self.mesh.triangles[triangle.neighbours[k] as usize].origin
        };
        let creases = fan.iter().filter(|s| on_side(s)).count();
        let borders = fan.iter().filter(|s| self.is_border(s)).count();
        let mut best = None;
        for side in &fan {
            if creases > 0 && !on_side(side) || !self.keeps_charts(side, borders) || !self.is_simple(v, side, &fan) {
                continue;
            }
            let quality = self.quality(v, side, &fan);
            if quality > THIN && best.is_none_or(|(q, _)| quality > q) {
                best = Some((quality, *side));
            }
        }
        best.map(|(_, (t, k))| self.mesh.collapse(t, k)).is_some()
    }

    fn is_border(&self, &(t, k): &(u32, usize)) -> bool {
        let triangle = &self.mesh.triangles[t as usize];
        triangle.patch != self.mesh.triangles[triangle.neighbours[k] as usize].patch
    }

    /// Whether borders of charts stay what they are when the start of a side, which `borders` of them meet, moves to
    /// its end.
    fn keeps_charts(&self, side: &(u32, usize), borders: usize) -> bool {
        let end = self.mesh.end(side.0, side.1);
        let others = self.mesh.fan(end).filter(|s| self.is_border(s)).count();
        match (borders, self.is_border(side)) {
            (0, _) => true,
            (_, false) => others == 0,
            (_, true) => borders == 2 || others == 2,
        }
    }

    /// Whether the two ends of a side have no common neighbour but the two beside it, and no border runs round a
    /// triangle that would vanish.
    fn is_simple(&self, v: u32, &(t, k): &(u32, usize), fan: &[(u32, usize)]) -> bool {
        let end = self.mesh.end(t, k);
        let (u, _) = self.mesh.opposite(t, k);
        let apex = |f: u32| self.mesh.triangles[f as usize].vertices.into_iter().find(|&x| x != v && x != end);
        let beside = [apex(t), apex(u)];
        let around = |x: u32| self.mesh.fan(x).map(|(f, i)| self.mesh.end(f, i));
        let common = around(end).filter(|x| fan.iter().any(|&(f, i)| self.mesh.end(f, i) == *x)).count();
        let border_to = |from: u32, to: Option<u32>| {
            let side = self.mesh.fan(from).find(|&(f, i)| Some(self.mesh.end(f, i)) == to);
            side.is_some_and(|s| self.is_border(&s))
        };
        common == 2 && beside.iter().all(|&b| !(border_to(v, b) && border_to(end, b)))
    }

    /// The least area over squared longest side among the triangles that would change; not positive where one would
    /// turn over.
    fn quality(&self, v: u32, &(t, k): &(u32, usize), fan: &[(u32, usize)]) -> f64 {
        let end = self.mesh.end(t, k);
        let gone = [t, self.mesh.triangles[t as usize].neighbours[k]];
        let shape = |&(f, _): &(u32, usize)| {
            let triangle = &self.mesh.triangles[f as usize];
            let corners = triangle.vertices.map(|x| self.mesh.points[if x == v { end } else { x } as usize]);
            let [a, b, c] = corners;
            let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
            0.5 * (b - a).cross(&(c - a)).dot(&self.normals[triangle.origin as usize]) / longest
        };
        fan.iter().filter(|s| !gone.contains(&s.0)).map(shape).fold(f64::INFINITY, f64::min)
    }
}
