//! What labels cost: how far normals are from the directions of the faces that stand for them.

use super::NONE;
use super::cut_mesh::CutMesh;
use super::graph::LoopGraph;
use super::regions::Regions;
use nalgebra::Vector3;

/// What the surface around every crossing would cost with each of the six labels, as a share of the whole surface.
#[derive(Clone, Debug)]
pub(super) struct Energies(pub(super) Vec<[f64; 6]>);

/// The part of a vector along the direction of a label.
pub(in crate::make) fn along(n: &Vector3<f64>, label: u8) -> f64 {
    let x = n[usize::from(label) / 2];
    if label.is_multiple_of(2) { x } else { -x }
}

/// The least cosine between normal and direction for which areas are taken as a projection has them.
const STEEP: f64 = 0.3;

/// What it costs to lay an area flat whose part along the direction of its face is `along`: by how much a projection
/// would shrink it, `area / along`, as the lattice is as much too coarse there to follow the shape. Where that is no
/// measure, as the surface looks away, it grows as fast as where it still is one.
pub(in crate::make) fn cost(area: f64, along: f64) -> f64 {
    let least = STEEP * area;
    if along > least { area * (area / along - 1.0) } else { area / STEEP - area + (least - along) / (STEEP * STEEP) }
}

impl Energies {
    /// All nothing.
    pub(super) fn none(graph: &LoopGraph) -> Self {
        Self(vec![[0.0; 6]; graph.crossings.len()])
    }

    /// Every triangle counts for the nearest crossing at its region.
    pub(super) fn new(mesh: &CutMesh, alive: &[bool], graph: &LoopGraph) -> Self {
        let regions = Regions::new(mesh, alive);
        let near = crossings_of_regions(mesh, &regions, graph);
        let mut energies = vec![[0.0; 6]; graph.crossings.len()];
        let mut total = 0.0;
        for (t, triangle) in mesh.triangles.iter().enumerate() {
            let corners = triangle.vertices.map(|v| mesh.points[v as usize].coords);
            let middle = corners.iter().sum::<Vector3<f64>>() / 3.0;
            let distance = |q: u32| {
                let vertex = graph.crossings[q as usize].vertex as usize;
                (mesh.points[vertex].coords - middle).norm_squared()
            };
            let own = near[regions.of[t] as usize].iter();
            let Some(&q) = own.min_by(|&&a, &&b| distance(a).total_cmp(&distance(b))) else { continue };
            let normal = mesh.area_vector(t);
            let area = normal.norm();
            total += area;
            (0..6).for_each(|l| energies[q as usize][usize::from(l)] += cost(area, along(&normal, l)));
        }
        let share = 1.0 / f64::max(total, f64::MIN_POSITIVE);
        energies.iter_mut().flatten().for_each(|e| *e *= share);
        Self(energies)
    }

    /// Moves what belongs to crossing `q` to two others, half each.
    pub(super) fn give(&mut self, q: u32, to: [u32; 2]) {
        let energy = self.0[q as usize];
        for to in to {
            self.0[to as usize].iter_mut().zip(energy).for_each(|(x, e)| *x += 0.5 * e);
        }
    }
}

fn crossings_of_regions(mesh: &CutMesh, regions: &Regions, graph: &LoopGraph) -> Vec<Vec<u32>> {
    let mut at = vec![NONE; mesh.points.len()];
    (0..).zip(&graph.crossings).for_each(|(q, c)| at[c.vertex as usize] = q);
    let mut near: Vec<Vec<u32>> = vec![Vec::new(); regions.len()];
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        let own = &mut near[regions.of[t] as usize];
        for q in triangle.vertices.map(|v| at[v as usize]) {
            if q != NONE && !own.contains(&q) {
                own.push(q);
            }
        }
    }
    near
}
