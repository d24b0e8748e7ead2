//! Moves the borders of charts to where the surface suits them, one triangle at a time, keeping how the charts meet.

use super::Traced;
use super::triangulation::Triangulation;
use crate::make::loops::along;
use std::collections::BTreeSet;

/// Most triangles that change chart, as a multiple of all.
const MOST: usize = 20;

/// Gives triangles beside a border to the chart behind it as long as that makes `Σ area (1 − normal · label) +
/// stiffness · length of borders` smaller. What meets what stays: charts are what they were, up to a deformation.
pub(super) fn relabel(charts: &mut Traced, stiffness: f64) {
    let Traced { mesh, labels, .. } = charts;
    let mut waiting: BTreeSet<u32> = (0..mesh.triangles.len() as u32).filter(|&t| is_at_border(mesh, t)).collect();
    let mut left = MOST * mesh.triangles.len();
    while let Some(t) = waiting.pop_first() {
        let Some(chart) = best_chart(mesh, labels, t, stiffness) else { continue };
        mesh.triangles[t as usize].patch = chart;
        left -= 1;
        if left == 0 {
            break;
        }
        for v in mesh.triangles[t as usize].vertices {
            waiting.extend(mesh.fan(v).map(|(f, _)| f).filter(|&f| is_at_border(mesh, f)));
        }
    }
}

fn patch(mesh: &Triangulation, t: u32) -> u32 {
    mesh.triangles[t as usize].patch
}

fn is_at_border(mesh: &Triangulation, t: u32) -> bool {
    let triangle = &mesh.triangles[t as usize];
    !triangle.is_gone() && triangle.neighbours.iter().any(|&u| patch(mesh, u) != triangle.patch)
}

/// The chart that a triangle should rather belong to, if it may.
fn best_chart(mesh: &Triangulation, labels: &[u8], t: u32, stiffness: f64) -> Option<u32> {
    let triangle = &mesh.triangles[t as usize];
    let own = triangle.patch;
    let normal = mesh.area_vector(t);
    let length = |k: usize| {
        let [a, b] = [k, (k + 1) % 3].map(|i| mesh.points[triangle.vertices[i] as usize]);
        (b - a).norm()
    };
    let border = |chart: u32| (0..3).filter(|&k| patch(mesh, triangle.neighbours[k]) != chart).map(length).sum::<f64>();
    let cost = |chart: u32| stiffness * border(chart) - along(&normal, labels[chart as usize]);
    let now = cost(own);
    let others = triangle.neighbours.iter().map(|&u| patch(mesh, u)).filter(|&c| c != own);
    let best = others
        .filter(|&c| may_move(mesh, t, c))
        .map(|c| (cost(c), c))
        .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
    (best.0 < now - 1e-12 * normal.norm()).then_some(best.1)
}

/// Whether all charts stay what they are and meet as they do if triangle `t` goes to `chart`.
fn may_move(mesh: &Triangulation, t: u32, chart: u32) -> bool {
    let triangle = &mesh.triangles[t as usize];
    let own = triangle.patch;
    let behind = triangle.neighbours.map(|u| patch(mesh, u));
    let count = |c: u32| behind.iter().filter(|&&b| b == c).count();
    let at = |c: u32| (0..3).find(|&k| behind[k] == c).unwrap_or(0);
    let around = |place: usize, allowed: &[u32]| {
        mesh.fan(triangle.vertices[place % 3]).filter(|s| s.0 != t).all(|(f, _)| allowed.contains(&patch(mesh, f)))
    };
    match (count(own), count(chart)) {
        (2, 1) => around(at(chart) + 2, &[own]),
        (1, 2) => around(at(own) + 2, &[chart]),
        (1, 1) => {
            // A corner of three charts slides along the side to the third.
            let k = (0..3).find(|&k| behind[k] != own && behind[k] != chart).unwrap_or(0);
            let third = behind[k];
            // The ends of that side: one lies between it and the side to `chart`, the other beside the own one.
            let (with_chart, with_own) = if behind[(k + 1) % 3] == chart { (k + 1, k) } else { (k, k + 1) };
            around(with_chart, &[chart, third]) && around(with_own, &[own, third])
        }
        _ => false,
    }
}
