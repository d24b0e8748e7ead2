//! Prints how long the neighbours of polycube-like corners take: `cargo run --release --example neighbours_time`.

use polycube::{Context, align::neighbours::neighbours};
use std::collections::{BTreeMap, BTreeSet};
use std::hint::black_box;
use std::time::Instant;

type Point = [i64; 3];

/// A small generator of pseudo-random numbers (Knuth's MMIX constants), the same on any machine.
struct Random(u64);

impl Random {
    fn below(&mut self, n: i64) -> i64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % n as u64) as i64
    }
}

/// `count` corners of a union of boxes on a lattice of `size` steps: where an odd number or an
/// unsymmetric set of the eight cells around is filled.
fn polycube(size: i64, count: usize) -> Vec<Point> {
    let mut random = Random(1);
    let mut filled = BTreeSet::new();
    let mut corners = Vec::new();
    while corners.len() < count {
        let low = [0; 3].map(|_| random.below(size - 1));
        let high = low.map(|x| (x + 1 + random.below(4)).min(size));
        for x in low[0]..high[0] {
            for y in low[1]..high[1] {
                filled.extend((low[2]..high[2]).map(|z| [x, y, z]));
            }
        }
        if corners.len() < 100 || filled.len() % 16 == 0 {
            corners = corners_of(&filled);
        }
    }
    let step = corners.len() as f64 / count as f64;
    (0..count).map(|i| corners[(i as f64 * step) as usize]).collect()
}

fn corners_of(filled: &BTreeSet<Point>) -> Vec<Point> {
    let mut around: BTreeMap<Point, u8> = BTreeMap::new();
    for &cell in filled {
        for i in 0..8 {
            let corner = [0, 1, 2].map(|k| cell[k] + (i >> k & 1));
            *around.entry(corner).or_default() |= 1 << i;
        }
    }
    // A corner has an edge along every axis: its pattern is not the same on both sides of any axis.
    let low = [0b0101_0101, 0b0011_0011, 0b0000_1111];
    let is_corner = |pattern: u8| (0..3).all(|k| pattern & low[k] != pattern >> (1 << k) & low[k]);
    let kept = around.into_iter().filter(|&(_, pattern)| is_corner(pattern));
    kept.map(|(corner, _)| corner).collect()
}

fn random(size: i64, count: usize) -> Vec<Point> {
    let mut random = Random(2);
    (0..count).map(|_| [0; 3].map(|_| random.below(size))).collect()
}

fn grid(n: i64) -> Vec<Point> {
    (0..n * n * n).map(|i| [i / n / n, i / n % n, i % n]).collect()
}

fn surface(n: i64) -> Vec<Point> {
    let on = |p: &Point| p.iter().any(|&x| x == 0 || x == n - 1);
    grid(n).into_iter().filter(on).collect()
}

/// The same set with a step of 2^18, and one point that keeps it from being divided away.
fn large(points: &[Point]) -> Vec<Point> {
    let scaled = points.iter().map(|p| p.map(|x| x << 18));
    scaled.chain([[-1; 3]]).collect()
}

fn report(name: &str, points: &[Point]) -> polycube::Result<()> {
    let repeats = (20_000 / points.len()).clamp(3, 100);
    let mut best = f64::INFINITY;
    let mut found = 0;
    for _ in 0..repeats {
        let start = Instant::now();
        found = black_box(neighbours(black_box(points), &Context::default())?).len();
        best = best.min(start.elapsed().as_secs_f64());
    }
    println!("{name:<28} {:>6} points {found:>7} pairs {:>9.3} ms", points.len(), best * 1e3);
    Ok(())
}

fn main() -> polycube::Result<()> {
    for count in [60, 230, 1000, 10_000] {
        report("polycube on 60^3", &polycube(60, count))?;
    }
    report("the same, step 2^18", &large(&polycube(60, 10_000)))?;
    report("random below 2^24", &random(1 << 24, 10_000))?;
    report("grid 20^3", &grid(20))?;
    report("box surface 30^3", &surface(30))?;
    report("coplanar 100^2", &grid(100)[..10_000])?;
    let line: Vec<Point> = (0..1000).map(|i| [0, i, 0]).collect();
    report("collinear", &line)
}
