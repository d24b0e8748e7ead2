//! The lengths that the edges of cells should have: those they have, made even.

use crate::mesh::{Point, Stars};

/// No side of a cell shall be shorter than this part of the mean edge,
const LEAST_SIDE: f64 = 0.3;
/// nor any longer than so many times the shortest.
const LONGEST_SIDE: f64 = 4.0;

/// The length along each of the `D` directions that a cell should have: the mean over its `P` parallel edges there,
/// `smoothing` times averaged over the neighbours as well. `parallel` has the ends of those edges in a cell.
/// O(n log n).
pub(super) fn sizes<const N: usize, const P: usize, const D: usize>(
    cells: &[[u32; N]],
    parallel: &[[[usize; 2]; P]; D],
    points: &[Point],
    smoothing: usize,
) -> Vec<[f64; D]> {
    let (ids, mut lengths) = number_edges(cells, parallel, points);
    let mean = |lengths: &[f64], set: &[u32]| set.iter().map(|e| lengths[*e as usize]).sum::<f64>() / P as f64;
    let all = |lengths: &[f64]| -> Vec<f64> { ids.iter().map(|set| mean(lengths, set)).collect() };
    for _ in 0..smoothing {
        let (mut sums, mut counts) = (vec![0.0; lengths.len()], vec![0_u32; lengths.len()]);
        for (set, mean) in ids.iter().zip(all(&lengths)) {
            for e in set {
                sums[*e as usize] += mean;
                counts[*e as usize] += 1;
            }
        }
        lengths = sums.iter().zip(&counts).map(|(s, n)| s / f64::from(*n)).collect();
    }
    let floor = 1e-3 * lengths.iter().sum::<f64>() / lengths.len().max(1) as f64;
    let positive = |l: f64| if l > floor { l } else { floor.max(f64::MIN_POSITIVE.sqrt()) };
    all(&lengths).chunks_exact(D).map(|l| std::array::from_fn(|d| positive(l[d]))).collect()
}

/// The same lengths, but none below 0.3 times their mean or a quarter of the longest of the cell.
pub(super) fn fair<const D: usize>(mut sizes: Vec<[f64; D]>) -> Vec<[f64; D]> {
    let floor = LEAST_SIDE * sizes.as_flattened().iter().sum::<f64>() / (D * sizes.len()).max(1) as f64;
    for size in &mut sizes {
        let least = floor.max(size.iter().copied().fold(0.0, f64::max) / LONGEST_SIDE);
        *size = size.map(|side| side.max(least));
    }
    sizes
}

/// The edges of each set of parallel ones, `D` sets a cell; and the length of each edge. Linear time.
fn number_edges<const N: usize, const P: usize, const D: usize>(
    cells: &[[u32; N]],
    parallel: &[[[usize; 2]; P]; D],
    points: &[Point],
) -> (Vec<[u32; P]>, Vec<f64>) {
    let all = cells.iter().flat_map(|cell| parallel.as_flattened().iter().map(|end| end.map(|k| cell[k])));
    let ends: Vec<[u32; 2]> = all.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    let from = Stars::new(points.len(), ends.iter().map(|end| Some(end[0])));
    let (mut ids, mut lengths) = (vec![[0; P]; D * cells.len()], Vec::new());
    let mut own = Vec::new();
    for v in 0..points.len() {
        own.clear();
        own.extend(from.of(v).iter().map(|&i| (ends[i as usize][1], i as usize)));
        own.sort_unstable();
        for edge in own.chunk_by(|a, b| a.0 == b.0) {
            edge.iter().for_each(|&(_, i)| ids[i / P][i % P] = lengths.len() as u32);
            lengths.push((points[v] - points[edge[0].0 as usize]).norm());
        }
    }
    (ids, lengths)
}
