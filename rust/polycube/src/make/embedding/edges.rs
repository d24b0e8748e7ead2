//! Coordinates that the vertices of charts must have.

use crate::make::charts::ChartedSurface;
use crate::mesh::Point;

type Fixed = [Option<f64>; 3];

/// What every vertex must have: the levels of the charts around it, which `level` tells, and along edges a place in
/// proportion to the length on the shape.
pub(super) fn prescribed(charts: &ChartedSurface, level: impl Fn(u32) -> f64) -> Vec<Fixed> {
    let mut fixed = vec![[None; 3]; charts.points.len()];
    for (t, &chart) in charts.triangles.iter().zip(&charts.chart) {
        let axis = usize::from(charts.labels[chart as usize]) / 2;
        t.iter().for_each(|&v| fixed[v as usize][axis] = Some(level(chart)));
    }
    let borders = borders(charts);
    let is_corner: Vec<bool> = fixed.iter().map(|f: &Fixed| f.iter().all(Option::is_some)).collect();
    for corner in (0..fixed.len() as u32).filter(|&v| is_corner[v as usize]) {
        for &first in &borders[corner as usize] {
            spread(&charts.points, &chain(&borders, &is_corner, corner, first), &mut fixed);
        }
    }
    fixed
}

/// For every vertex those that sides between two charts join it to.
fn borders(charts: &ChartedSurface) -> Vec<Vec<u32>> {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * charts.triangles.len());
    for (t, &chart) in charts.triangles.iter().zip(&charts.chart) {
        sides.extend((0..3).map(|k| {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            ([a.min(b), a.max(b)], chart)
        }));
    }
    sides.sort_unstable();
    let mut borders = vec![Vec::new(); charts.points.len()];
    for pair in sides.chunks_exact(2).filter(|pair| pair[0].1 != pair[1].1) {
        let [a, b] = pair[0].0;
        borders[a as usize].push(b);
        borders[b as usize].push(a);
    }
    borders
}

/// The vertices from a corner by way of `first` to the next corner.
fn chain(borders: &[Vec<u32>], is_corner: &[bool], corner: u32, first: u32) -> Vec<u32> {
    let mut chain = vec![corner, first];
    while let [.., before, last] = chain[..]
        && !is_corner[last as usize]
        && let Some(&next) = borders[last as usize].iter().find(|&&v| v != before)
    {
        chain.push(next);
    }
    chain
}

/// Gives the vertices inside a chain the coordinate that they lack.
fn spread(points: &[Point], chain: &[u32], fixed: &mut [Fixed]) {
    let [from, to] = [chain[0], chain[chain.len() - 1]].map(|v| fixed[v as usize]);
    let steps: Vec<f64> = chain.windows(2).map(|s| (points[s[0] as usize] - points[s[1] as usize]).norm()).collect();
    let total: f64 = steps.iter().sum();
    let mut walked = 0.0;
    for (step, &v) in steps.iter().zip(&chain[1..chain.len() - 1]) {
        walked += step;
        for a in 0..3 {
            if let (None, Some(x), Some(y)) = (fixed[v as usize][a], from[a], to[a]) {
                fixed[v as usize][a] = Some(x + (y - x) * walked / total);
            }
        }
    }
}
