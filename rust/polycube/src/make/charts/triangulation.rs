//! A closed triangle mesh that can be refined and coarsened: who is whose neighbour, and what each triangle is part of.

use crate::mesh::Point;
use nalgebra::Vector3;

/// No triangle, no vertex, no region.
pub(super) const NONE: u32 = u32::MAX;

/// A triangle and what it is part of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Its vertices, counter-clockwise seen from outside.
    pub(super) vertices: [u32; 3],
    /// The triangle behind the side from each vertex to the next.
    pub(super) neighbours: [u32; 3],
    /// Whether each side lies on a curve that paths may not cross.
    pub(super) barrier: [bool; 3],
    /// Whether each side lies on the border of a chart.
    pub(super) border: [bool; 3],
    /// The triangle of the shape that it is part of.
    pub(super) origin: u32,
    /// The region or chart that it belongs to.
    pub(super) patch: u32,
}

impl Triangle {
    /// Whether it was removed.
    pub(super) fn is_gone(&self) -> bool {
        self.vertices[0] == NONE
    }

    /// The place of a vertex among the three.
    pub(super) fn place(&self, vertex: u32) -> usize {
        (0..3).find(|&k| self.vertices[k] == vertex).unwrap_or(0)
    }
}

/// A closed, oriented, manifold mesh of triangles on the surface of a shape.
#[derive(Clone, Debug)]
pub(super) struct Triangulation {
    /// Vertex positions; those of the shape come first.
    pub(super) points: Vec<Point>,
    /// The triangles; those that were removed have [`NONE`] as their first vertex.
    pub(super) triangles: Vec<Triangle>,
    /// A triangle at each vertex, [`NONE`] for removed ones.
    pub(super) at: Vec<u32>,
}

impl Triangulation {
    /// The sides that leave a vertex, counter-clockwise: the triangle on the left and the place of the vertex in it.
    pub(super) fn fan(&self, vertex: u32) -> impl Iterator<Item = (u32, usize)> + '_ {
        let first = self.at[vertex as usize];
        let turn = move |&(t, k): &(u32, usize)| {
            let next = self.triangles[t as usize].neighbours[(k + 2) % 3];
            (next != first).then(|| (next, self.triangles[next as usize].place(vertex)))
        };
        std::iter::successors(Some((first, self.triangles[first as usize].place(vertex))), turn)
    }

    /// Half the cross product of two sides of a triangle: its area, outwards.
    pub(super) fn area_vector(&self, t: u32) -> Vector3<f64> {
        let [a, b, c] = self.triangles[t as usize].vertices.map(|v| self.points[v as usize]);
        (b - a).cross(&(c - a)) * 0.5
    }

    /// The end of the side that starts at place `k` of triangle `t`.
    pub(super) fn end(&self, t: u32, k: usize) -> u32 {
        self.triangles[t as usize].vertices[(k + 1) % 3]
    }

    /// The place of the side of `neighbour` that is the other half of side `k` of `t`.
    pub(super) fn opposite(&self, t: u32, k: usize) -> (u32, usize) {
        let u = self.triangles[t as usize].neighbours[k];
        let place = self.triangles[u as usize].place(self.end(t, k));
        (u, place)
    }

    /// Gives the triangles that hang together across sides without `wall` one patch; the triangles of each.
    pub(super) fn flood(&mut self, wall: impl Fn(&Triangle, usize) -> bool) -> Vec<Vec<u32>> {
        self.triangles.iter_mut().for_each(|t| t.patch = NONE);
        let mut patches: Vec<Vec<u32>> = Vec::new();
        for seed in 0..self.triangles.len() as u32 {
            if self.triangles[seed as usize].patch != NONE {
                continue;
            }
            let patch = patches.len() as u32;
            self.triangles[seed as usize].patch = patch;
            let mut own = vec![seed];
            let mut next = 0;
            while let Some(&t) = own.get(next) {
                next += 1;
                for k in 0..3 {
                    let triangle = self.triangles[t as usize];
                    let u = triangle.neighbours[k];
                    if !wall(&triangle, k) && self.triangles[u as usize].patch == NONE {
                        self.triangles[u as usize].patch = patch;
                        own.push(u);
                    }
                }
            }
            patches.push(own);
        }
        patches
    }

    fn link(&mut self, t: u32, k: usize, u: u32, j: usize) {
        self.triangles[t as usize].neighbours[k] = u;
        self.triangles[u as usize].neighbours[j] = t;
    }

    /// Adds the middle of side `k` of triangle `t` and cuts the two triangles there in two.
    pub(super) fn split_side(&mut self, t: u32, k: usize) -> u32 {
        let (u, j) = self.opposite(t, k);
        let (one, two) = (self.triangles[t as usize], self.triangles[u as usize]);
        let [a, b, c] = [0, 1, 2].map(|i| one.vertices[(k + i) % 3]);
        let d = two.vertices[(j + 2) % 3];
        let middle = self.points.len() as u32;
        self.points.push(nalgebra::center(&self.points[a as usize], &self.points[b as usize]));
        self.at.push(t);
        let (behind_bc, behind_ad) = (self.opposite(t, (k + 1) % 3), self.opposite(u, (j + 1) % 3));
        let (t2, u2) = (self.triangles.len() as u32, self.triangles.len() as u32 + 1);
        self.triangles.extend([one, two]);
        self.set(t, [a, middle, c], &one, [Some(k), None, Some((k + 2) % 3)]);
        self.set(t2, [middle, b, c], &one, [Some(k), Some((k + 1) % 3), None]);
        self.set(u, [b, middle, d], &two, [Some(j), None, Some((j + 2) % 3)]);
        self.set(u2, [middle, a, d], &two, [Some(j), Some((j + 1) % 3), None]);
        self.link(t, 0, u2, 0);
        self.link(t2, 0, u, 0);
        self.link(t, 1, t2, 2);
        self.link(u, 1, u2, 2);
        self.link(t2, 1, behind_bc.0, behind_bc.1);
        self.link(u2, 1, behind_ad.0, behind_ad.1);
        (self.at[a as usize], self.at[b as usize]) = (t, u);
        middle
    }

    /// Gives triangle `t` its vertices; side `i` keeps what side `from[i]` of `old` was, and is inside a patch without.
    fn set(&mut self, t: u32, vertices: [u32; 3], old: &Triangle, from: [Option<usize>; 3]) {
        self.triangles[t as usize] = Triangle {
            vertices,
            neighbours: from.map(|k| k.map_or(NONE, |k| old.neighbours[k])),
            barrier: from.map(|k| k.is_some_and(|k| old.barrier[k])),
            border: from.map(|k| k.is_some_and(|k| old.border[k])),
            ..*old
        };
    }

    /// Adds the centre of triangle `t` and cuts it in three.
    pub(super) fn split_triangle(&mut self, t: u32) -> u32 {
        let one = self.triangles[t as usize];
        let [a, b, c] = one.vertices;
        let behind = [0, 1, 2].map(|k| self.opposite(t, k));
        let middle = self.points.len() as u32;
        let [p, q, r] = one.vertices.map(|v| self.points[v as usize].coords);
        self.points.push(Point::from((p + q + r) / 3.0));
        self.at.push(t);
        let parts = [t, self.triangles.len() as u32, self.triangles.len() as u32 + 1];
        self.triangles.extend([one, one]);
        for (k, ends) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
            self.set(parts[k], [ends[0], ends[1], middle], &one, [Some(k), None, None]);
            self.at[ends[0] as usize] = parts[k];
        }
        for k in 0..3 {
            self.link(parts[k], 0, behind[k].0, behind[k].1);
            self.link(parts[k], 1, parts[(k + 1) % 3], 2);
        }
        middle
    }

    /// Moves the vertex at place `k` of `t` into the end of that side; the two triangles at the side vanish. The
    /// condition on the neighbours must hold.
    pub(super) fn collapse(&mut self, t: u32, k: usize) {
        let (u, j) = self.opposite(t, k);
        let (gone, stays) = (self.triangles[t as usize].vertices[k], self.end(t, k));
        let fan: Vec<(u32, usize)> = self.fan(gone).collect();
        fan.iter().for_each(|&(f, place)| self.triangles[f as usize].vertices[place] = stays);
        // Of each vanishing triangle the two other sides become one.
        for (f, first) in [(t, k), (u, j)] {
            let triangle = self.triangles[f as usize];
            let [one, two] = [1, 2].map(|i| (first + i) % 3);
            let sides = [one, two].map(|s| {
                let v = triangle.neighbours[s];
                let other = &self.triangles[v as usize];
                (v, (0..3).find(|&i| other.neighbours[i] == f).unwrap_or(0))
            });
            let border = triangle.border[one] || triangle.border[two];
            let [(v, i), (w, l)] = sides;
            self.link(v, i, w, l);
            self.triangles[v as usize].border[i] = border;
            self.triangles[w as usize].border[l] = border;
            self.triangles[f as usize].vertices = [NONE; 3];
            self.at[triangle.vertices[(first + 2) % 3] as usize] = v;
            self.at[stays as usize] = v;
        }
        // `stays` may have been given a triangle that only touches the far end: look for one that has it.
        let alive = fan.iter().map(|f| f.0).find(|&f| self.triangles[f as usize].vertices[0] != NONE);
        if let Some(f) = alive {
            self.at[stays as usize] = f;
        }
        self.at[gone as usize] = NONE;
    }
}
