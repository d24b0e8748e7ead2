//! Rounds the edges and corners of a meshed polycube while every cell stays positive.

use super::mesh::{TETRAHEDRA, VertexLattice};
use super::voxels::Voxels;
use crate::mesh::Point;
use nalgebra::Vector3;

/// No step may bring a determinant below this share of a unit cell's.
const SMALLEST: f64 = 0.04;

/// The cells of a lattice with unit steps, as smoothing needs them.
pub(super) struct Body {
    /// Vertices `a b c d` whose determinant `(b - a, c - a, d - a)` must stay positive: every
    /// corner of every hexahedron and every tetrahedron.
    frames: Vec<[u32; 4]>,
    /// Neighbours of each vertex: those along the surface on it, all of them inside.
    neighbours: Vec<Vec<u32>>,
    on_surface: Vec<bool>,
}

impl Body {
    pub(super) fn new(voxels: &Voxels, lattice: &VertexLattice) -> Self {
        let mut on_surface = vec![false; lattice.len()];
        let quads = lattice.quads();
        for v in quads.as_flattened() {
            on_surface[*v as usize] = true;
        }
        let mut neighbours = vec![Vec::new(); lattice.len()];
        for quad in &quads {
            for (k, v) in quad.iter().enumerate() {
                neighbours[*v as usize].push(quad[(k + 1) % 4]);
            }
        }
        let mut frames = Vec::new();
        for cell in voxels.cells() {
            let octants = lattice.octants(cell);
            frames.extend((0..8).map(|o| corner(o).map(|i| octants[i])));
            frames.push(middle(cell).map(|i| octants[i]));
            for (o, v) in octants.iter().enumerate().filter(|v| !on_surface[*v.1 as usize]) {
                neighbours[*v as usize].extend([1, 2, 4].map(|axis| octants[o ^ axis]));
            }
        }
        Self { frames, neighbours, on_surface }
    }

    /// Smooths the surface of `start` by `steps` steps of averaging, and lets the inside follow.
    /// The determinants of all frames stay positive where they were.
    pub(super) fn soften(&self, start: &[Point], steps: usize) -> Vec<Point> {
        let mut points = start.to_vec();
        for _ in 0..steps {
            let mut next = self.averaged(start, &points);
            self.restrain(&points, &mut next);
            points = next;
        }
        points
    }

    /// Surface vertices halfway to the mean of their neighbours; inside, the displacement from the
    /// start becomes the mean of the neighbours' so that undisturbed parts stay as they are.
    fn averaged(&self, start: &[Point], points: &[Point]) -> Vec<Point> {
        let average = |v: usize| {
            let around = &self.neighbours[v];
            if around.is_empty() {
                return points[v];
            }
            let share = 1.0 / around.len() as f64;
            let sum =
                |f: &dyn Fn(usize) -> Vector3<f64>| around.iter().map(|n| f(*n as usize)).sum::<Vector3<f64>>() * share;
            if self.on_surface[v] {
                points[v] + 0.5 * (sum(&|n| points[n].coords) - points[v].coords)
            } else {
                start[v] + sum(&|n| points[n] - start[n])
            }
        };
        (0..points.len()).map(average).collect()
    }

    /// Takes vertices back to where they were around every frame that got too flat. Ends, since
    /// each round takes back at least one more vertex and a frame wholly taken back is as before.
    fn restrain(&self, before: &[Point], next: &mut [Point]) {
        let mut reset = vec![true; next.len()];
        loop {
            let touched = |f: &&[u32; 4]| f.iter().any(|v| reset[*v as usize]);
            let flat = |f: &&[u32; 4]| {
                let now = determinant(next, f);
                now < SMALLEST && now < determinant(before, f)
            };
            let frames = self.frames.iter().filter(touched).filter(flat);
            let flat: Vec<[u32; 4]> = frames.copied().collect();
            if flat.is_empty() {
                return;
            }
            reset.fill(false);
            for v in flat.as_flattened() {
                next[*v as usize] = before[*v as usize];
                reset[*v as usize] = true;
            }
        }
    }

    /// The smallest determinant over all frames.
    #[cfg(test)]
    fn smallest(&self, points: &[Point]) -> f64 {
        let all = self.frames.iter().map(|f| determinant(points, f));
        all.fold(f64::INFINITY, f64::min)
    }
}

/// Octant `o` of a cell with its neighbours along the axes, right-handed.
fn corner(o: usize) -> [usize; 4] {
    if o.count_ones().is_multiple_of(2) { [o, o ^ 1, o ^ 2, o ^ 4] } else { [o, o ^ 2, o ^ 1, o ^ 4] }
}

/// The octants of the tetrahedron in the middle of a cell; the others are frames of corners.
fn middle(cell: [usize; 3]) -> [usize; 4] {
    let odd = cell.iter().sum::<usize>() % 2;
    let [a, b, c, d] = TETRAHEDRA[0].map(|o| o ^ odd);
    if odd == 1 { [a, c, b, d] } else { [a, b, c, d] }
}

fn determinant(points: &[Point], frame: &[u32; 4]) -> f64 {
    let [a, b, c, d] = frame.map(|v| points[v as usize]);
    (b - a).cross(&(c - a)).dot(&(d - a))
}

#[cfg(test)]
mod tests {
    use super::super::random::random_with_corners;
    use super::*;

    #[test]
    fn softened_polycubes_stay_positive_and_get_smaller() {
        for seed in 0..3 {
            let voxels = random_with_corners(seed, 60).unwrap().refined(1.0).unwrap();
            let lattice = VertexLattice::new(&voxels).unwrap();
            let body = Body::new(&voxels, &lattice);
            let start: Vec<Point> = (0..lattice.len()).map(|v| lattice.point(v)).collect();
            assert_eq!(body.smallest(&start), 1.0);
            let soft = body.soften(&start, 20);
            assert!(body.smallest(&soft) >= SMALLEST);
            let moved = start.iter().zip(&soft).map(|(a, b)| (a - b).norm());
            assert!(moved.fold(0.0, f64::max) > 0.5);
        }
    }
}
