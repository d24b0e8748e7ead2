//! From corners to sites: one per location, on the smallest lattice, in general enough position to start.

use super::predicates::{Point, orient};
use crate::error::{Error, ErrorKind, Result};
use std::cmp::Reverse;

/// The largest absolute coordinate: beyond it the exact determinants could overflow.
const LIMIT: i64 = 1 << 30;
/// Bits per axis of a place on the insertion curve.
const CURVE_BITS: u32 = 21;
/// The first round of insertions takes about `2^-ROUNDS` of the sites.
const ROUNDS: u32 = 8;

/// The distinct locations of a set of points.
pub(super) struct Sites {
    /// Lexicographically ascending, moved to the origin and divided by the lattice's step; then up to
    /// three helpers that lift a flat set into space.
    pub points: Vec<Point>,
    /// The indices of the points, site by site.
    members: Vec<u32>,
    /// Where each site's members start, and the end.
    starts: Vec<usize>,
    /// Four sites or helpers of positive volume.
    pub frame: [u32; 4],
}

impl Sites {
    /// Gathers the sites of at least one point.
    pub(super) fn new(input: &[[i64; 3]]) -> Result<Self> {
        check(input)?;
        let mut members: Vec<u32> = (0..input.len() as u32).collect();
        members.sort_unstable_by_key(|&i| (input[i as usize], i));
        let at = |k: usize| input[members[k] as usize];
        let mut starts: Vec<usize> = (0..members.len()).filter(|&k| k == 0 || at(k) != at(k - 1)).collect();
        let mut points = normalized(starts.iter().map(|&k| at(k)).collect());
        starts.push(members.len());
        let frame = frame(&mut points);
        Ok(Self { points, members, starts, frame })
    }

    /// How many sites there are, helpers excluded.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// How many points there are at all sites.
    pub(super) fn count(&self) -> usize {
        self.members.len()
    }

    /// The points at a site, ascending.
    pub(super) fn members(&self, site: usize) -> &[u32] {
        &self.members[self.starts[site]..self.starts[site + 1]]
    }

    /// The sites outside the frame, in an order that makes insertion fast: rounds of about doubling
    /// size, each along a space-filling curve (Amenta, Choi and Rote 2003).
    pub(super) fn insertion_order(&self) -> Vec<u32> {
        let curve = Curve::new(&self.points);
        let mut keyed: Vec<_> = (0..self.len() as u32)
            .filter(|site| !self.frame.contains(site))
            .map(|site| (Reverse(round(site)), curve.place(self.points[site as usize]), site))
            .collect();
        keyed.sort_unstable();
        keyed.into_iter().map(|(_, _, site)| site).collect()
    }
}

fn check(input: &[[i64; 3]]) -> Result<()> {
    if input.len() >= u32::MAX as usize / 64 {
        return Err(Error::new(ErrorKind::Unsupported, "too many corners"));
    }
    let far = |p: &[i64; 3]| p.iter().any(|x| !(-LIMIT..=LIMIT).contains(x));
    match input.iter().position(far) {
        None => Ok(()),
        Some(i) => Err(Error::new(ErrorKind::Unsupported, format!("corner {i} at {:?} lies beyond ±2^30", input[i]))
            .remedy("scale the lattice down")),
    }
}

/// The same points from 0 up, in units of the lattice's step: small numbers make the predicates fast.
fn normalized(points: Vec<[i64; 3]>) -> Vec<Point> {
    let low = [0, 1, 2].map(|k| points.iter().map(|p| p[k]).min().unwrap_or(0));
    let shifted = |p: &[i64; 3]| [0, 1, 2].map(|k| p[k] - low[k]);
    let step = points.iter().flat_map(shifted).fold(0, gcd).max(1);
    let scaled = |p| shifted(p).map(|x| (x / step) as f64);
    points.iter().map(scaled).collect()
}

fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The largest coordinate, at least 1.
pub(super) fn extent(points: &[Point]) -> f64 {
    points.iter().flatten().fold(1.0, |m: f64, &x| m.max(x))
}

/// Four points of positive volume. Where the set is flat, helpers off its plane or line are appended:
/// every tetrahedron then joins a triangle (an edge) of the flat set's own triangulation to them.
fn frame(points: &mut Vec<Point>) -> [u32; 4] {
    let reach = (extent(points) / 2.0).ceil();
    let mut chosen = vec![0];
    while chosen.len() < 4 {
        let corners: Vec<Point> = chosen.iter().map(|&i| points[i as usize]).collect();
        let helpers = [0, 1, 2].map(|k| shifted(points[0], k, reach));
        let all = points.iter().chain(&helpers);
        let found = all.into_iter().position(|&p| independent(&corners, p));
        let next = found.unwrap_or_default();
        if next >= points.len() {
            points.push(helpers[next - points.len()]);
            chosen.push(points.len() as u32 - 1);
        } else {
            chosen.push(next as u32);
        }
    }
    let mut frame = [chosen[0], chosen[1], chosen[2], chosen[3]];
    if orient(frame.map(|i| points[i as usize]), extent(points)) < 0 {
        frame.swap(0, 1);
    }
    frame
}

/// `p` moved by `reach` along an axis, to the side that stays in the bounding cube.
fn shifted(mut p: Point, axis: usize, reach: f64) -> Point {
    p[axis] += if p[axis] > reach { -reach } else { reach };
    p
}

/// Whether `p` is outside the line or plane (at most) through the given one, two or three points.
fn independent(corners: &[Point], p: Point) -> bool {
    match *corners {
        [a] => a != p,
        [a, b] => [0, 1, 2].iter().any(|&k| {
            let (x, y) = (k, (k + 1) % 3);
            let [ux, uy, vx, vy] = [b[x] - a[x], b[y] - a[y], p[x] - a[x], p[y] - a[y]];
            // The products need up to 64 bits, the coordinates are whole.
            (ux as i128) * (vy as i128) != (uy as i128) * (vx as i128)
        }),
        [a, b, c] => orient([a, b, c, p], f64::INFINITY) != 0,
        _ => false,
    }
}

/// The round of a site, later rounds being smaller numbers: a geometric distribution over hashes.
fn round(site: u32) -> u32 {
    // The finalizer of SplitMix64.
    let mut z = u64::from(site).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)).trailing_zeros().min(ROUNDS)
}

/// The Morton curve through a bounding cube.
struct Curve {
    shift: u32,
}

impl Curve {
    fn new(points: &[Point]) -> Self {
        let bits = u64::BITS - (extent(points) as u64).leading_zeros();
        Self { shift: bits.saturating_sub(CURVE_BITS) }
    }

    fn place(&self, p: Point) -> u64 {
        let [x, y, z] = p.map(|c| spread(c as u64 >> self.shift));
        x << 2 | y << 1 | z
    }
}

/// Two zero bits behind each of the low 21 bits.
fn spread(x: u64) -> u64 {
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}
