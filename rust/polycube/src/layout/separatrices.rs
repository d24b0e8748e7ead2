//! The coarse quad layout of the surface: separatrices traced from irregular vertices.

use super::lattice::Lattice;
use crate::structure::Arrangement;

/// A place on the surface lattice and a way to go: from `vertex` along `axis`.
#[derive(Clone, Copy)]
struct Ray {
    vertex: usize,
    axis: usize,
    upwards: bool,
}

/// The lattice edges on the surface that separate patches.
///
/// Every corner of a polycube is an irregular vertex of the surface's quad mesh, and all other vertices are
/// regular; so polycube edges separate, and from each corner separatrices run along the flat lattice lines,
/// straight on over the edges that they cross, until they meet a corner.
pub struct Separatrices<'a> {
    lattice: &'a Lattice,
    /// For every vertex, bit `a` when the lattice edge above it along axis `a` separates.
    marked: Vec<u8>,
    is_corner: Vec<bool>,
}

impl<'a> Separatrices<'a> {
    /// Traces all separatrices. O(c) for c lattice cells at worst.
    pub fn new(lattice: &'a Lattice, arrangement: &Arrangement) -> Self {
        let mut separatrices = Self { lattice, marked: vec![0; lattice.len()], is_corner: vec![false; lattice.len()] };
        let structure = arrangement.structure();
        let corners = (0..structure.corners.len() as u32).map(|c| structure.position(c, arrangement.placement()));
        let corners: Vec<usize> =
            corners.map(|p| lattice.index(std::array::from_fn(|a| lattice.rank(a, p[a])))).collect();
        corners.iter().for_each(|&c| separatrices.is_corner[c] = true);
        for vertex in corners {
            for axis in 0..3 {
                [false, true].into_iter().for_each(|upwards| separatrices.trace(Ray { vertex, axis, upwards }));
            }
        }
        separatrices
    }

    /// Patches are rectangles inside one facet, each counted by its lattice face at the lowest corner.
    pub fn count_patches(&self) -> usize {
        let faces = (0..3).flat_map(|axis| (0..self.lattice.len()).map(move |c| (c, axis)));
        faces.filter(|&(c, axis)| self.starts_patch(c, axis)).count()
    }

    pub(super) fn lattice(&self) -> &Lattice {
        self.lattice
    }

    pub(super) fn starts_patch(&self, cell: usize, axis: usize) -> bool {
        let below = cell.wrapping_sub(self.lattice.stride(axis));
        let on_surface = below < self.lattice.len() && self.lattice.is_solid(cell) != self.lattice.is_solid(below);
        on_surface && self.separates(cell, (axis + 1) % 3) && self.separates(cell, (axis + 2) % 3)
    }

    /// Whether the lattice edge above `vertex` along `axis`, on the surface, borders patches.
    pub(super) fn separates(&self, vertex: usize, axis: usize) -> bool {
        self.is_marked(vertex, axis) || self.solid_around(vertex, axis) != 2
    }

    fn is_marked(&self, vertex: usize, axis: usize) -> bool {
        self.marked[vertex] >> axis & 1 == 1
    }

    /// How many of the four cells around the lattice edge above `vertex` along `axis` are solid.
    fn solid_around(&self, vertex: usize, axis: usize) -> usize {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3].map(|a| self.lattice.stride(a));
        let around = [vertex, vertex.wrapping_sub(u), vertex.wrapping_sub(v), vertex.wrapping_sub(u + v)];
        around.into_iter().filter(|&c| c < self.lattice.len() && self.lattice.is_solid(c)).count()
    }

    fn trace(&mut self, ray: Ray) {
        let mut next = Some(ray);
        while let Some(ray) = next {
            next = self.step(ray);
        }
    }

    /// Marks the lattice edge ahead if it lies flat on the surface, and tells how to go on behind it.
    fn step(&mut self, ray: Ray) -> Option<Ray> {
        let stride = self.lattice.stride(ray.axis);
        let edge = if ray.upwards { ray.vertex } else { ray.vertex - stride };
        if self.solid_around(edge, ray.axis) != 2 || self.is_marked(edge, ray.axis) {
            return None;
        }
        self.marked[edge] |= 1 << ray.axis;
        let vertex = if ray.upwards { ray.vertex + stride } else { edge };
        if self.is_corner[vertex] {
            return None;
        }
        let ahead = if ray.upwards { vertex } else { vertex - stride };
        if self.solid_around(ahead, ray.axis) == 2 {
            return Some(Ray { vertex, ..ray });
        }
        self.turn(vertex, ray.axis)
    }

    /// Behind a polycube edge that the separatrix crosses, it goes on along the only flat lattice edge across
    /// the line that it has not passed.
    fn turn(&self, vertex: usize, from: usize) -> Option<Ray> {
        let rays =
            (0..3).filter(|&a| a != from).flat_map(|axis| [false, true].map(|upwards| Ray { vertex, axis, upwards }));
        rays.into_iter().find(|r| {
            let edge = if r.upwards { vertex } else { vertex - self.lattice.stride(r.axis) };
            self.solid_around(edge, r.axis) == 2
        })
    }
}
