//! Checked against definitions: empty spheres, facets that meet in twos or lie on the hull, volumes.

use super::*;
use crate::error::ErrorKind;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

type P = [i64; 3];

fn pairs(points: &[P]) -> Vec<[u32; 2]> {
    neighbours(points, &Context::default()).unwrap()
}

fn minus(a: P, b: P) -> [i128; 3] {
    [0, 1, 2].map(|k| i128::from(a[k] - b[k]))
}

fn cross(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

fn dot(a: [i128; 3], b: [i128; 3]) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Six times the signed volume.
fn volume([a, b, c, d]: [P; 4]) -> i128 {
    dot(minus(b, a), cross(minus(c, a), minus(d, a)))
}

/// Negative inside the circumsphere, 0 on it, positive outside: by way of the circumcentre.
fn outside(cell: [P; 4], p: P) -> i128 {
    let [u, v, w] = [1, 2, 3].map(|i| minus(cell[i], cell[0]));
    let parts = [(u, v, w), (v, w, u), (w, u, v)].map(|(a, b, c)| {
        let n = cross(b, c);
        n.map(|x| x * dot(a, a))
    });
    let centre = [0, 1, 2].map(|k| parts[0][k] + parts[1][k] + parts[2][k]);
    let q = minus(p, cell[0]);
    (dot(q, q) * volume(cell) - dot(q, centre)) * volume(cell).signum()
}

/// The tetrahedra of a set that is not flat, in the caller's coordinates.
fn tetrahedra(points: &[P]) -> Vec<[P; 4]> {
    let sites = Sites::new(points).unwrap();
    assert_eq!(sites.points.len(), sites.len(), "no helpers in space");
    let order = sites.insertion_order();
    let cells = delaunay::tetrahedra(&sites.points, sites.frame, &order, &Context::default()).unwrap();
    let place = |v: u32| points[sites.members(v as usize)[0] as usize];
    cells.iter().map(|c| c.map(place)).collect()
}

/// Asserts that the tetrahedra are Delaunay and fill the hull; returns six times the total volume.
fn assert_delaunay(points: &[P]) -> i128 {
    let cells = tetrahedra(points);
    let mut facets: BTreeMap<Vec<P>, Vec<P>> = BTreeMap::new();
    for &cell in &cells {
        assert_ne!(volume(cell), 0, "flat: {cell:?}");
        for &p in points {
            assert!(outside(cell, p) >= 0, "{p:?} inside the sphere of {cell:?}");
        }
        for apex in cell {
            let facet: BTreeSet<P> = cell.into_iter().filter(|&p| p != apex).collect();
            facets.entry(facet.into_iter().collect()).or_default().push(apex);
        }
    }
    for (f, apexes) in facets {
        let side = |p: P| volume([f[0], f[1], f[2], p]).signum();
        match apexes[..] {
            [a] => assert!(points.iter().all(|&p| side(p) * side(a) >= 0)),
            [a, b] => assert_eq!(side(a) * side(b), -1),
            _ => panic!("{} cells at {f:?}", apexes.len()),
        }
    }
    cells.iter().map(|&c| volume(c).abs()).sum()
}

/// Asserts what holds in every dimension: order, and that all pairs whose ball is strictly empty are there.
fn assert_pairs(points: &[P]) {
    let found = pairs(points);
    assert!(found.is_sorted_by(|a, b| a < b));
    assert!(found.iter().all(|[a, b]| a < b && (*b as usize) < points.len()));
    for (j, &b) in points.iter().enumerate() {
        for (i, &a) in points[..j].iter().enumerate() {
            let others = points.iter().filter(|&&p| p != a && p != b);
            if others.into_iter().all(|&p| dot(minus(p, a), minus(p, b)) > 0) {
                assert!(found.binary_search(&[i as u32, j as u32]).is_ok(), "{a:?} {b:?}");
            }
        }
    }
}

fn grid(x: i64, y: i64, z: i64) -> Vec<P> {
    let plane = |i| (0..y).flat_map(move |j| (0..z).map(move |k| [i, j, k]));
    (0..x).flat_map(plane).collect()
}

fn box_surface(x: i64, y: i64, z: i64) -> Vec<P> {
    let n = [x - 1, y - 1, z - 1];
    let on = |p: &P| (0..3).any(|k| p[k] == 0 || p[k] == n[k]);
    grid(x, y, z).into_iter().filter(on).collect()
}

#[test]
fn few_points() {
    let five = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 1, 1]];
    assert!(pairs(&five[..0]).is_empty());
    assert!(pairs(&five[..1]).is_empty());
    assert_eq!(pairs(&five[..2]), [[0, 1]]);
    assert_eq!(pairs(&five[..3]), [[0, 1], [0, 2], [1, 2]]);
    assert_eq!(pairs(&five[..4]).len(), 6);
    assert_eq!(pairs(&five).len(), 10);
}

#[test]
fn collinear_points_meet_their_successors() {
    let line: Vec<P> = [7, 1, 4, 0, 9].iter().map(|&t| [t, -2 * t, 5]).collect();
    assert_eq!(pairs(&line), [[0, 2], [0, 4], [1, 2], [1, 3]]);
}

#[test]
fn coplanar_grids_give_the_flat_triangulation() {
    let directions: [[P; 2]; 4] =
        [[[1, 0, 0], [0, 1, 0]], [[0, 3, 0], [0, 0, 3]], [[0, 0, 1], [1, 0, 0]], [[1, 1, 0], [1, -1, 0]]];
    for [u, v] in directions {
        let at = |[i, j, _]: P| [0, 1, 2].map(|k| 5 + i * u[k] + j * v[k]);
        let points: Vec<P> = grid(6, 6, 1).into_iter().map(at).collect();
        assert_pairs(&points);
        assert_eq!(pairs(&points).len(), 3 * 36 - 3 - 20);
    }
}

#[test]
fn full_grids_and_surfaces_fill_the_box() {
    for [x, y, z] in [[2, 2, 2], [3, 3, 3], [5, 4, 3], [2, 7, 2]] {
        let expected = i128::from(6 * (x - 1) * (y - 1) * (z - 1));
        for points in [grid(x, y, z), box_surface(x, y, z)] {
            assert_eq!(assert_delaunay(&points), expected);
            assert_pairs(&points);
        }
    }
}

#[test]
fn a_cube_grid_gets_the_same_diagonals_everywhere() {
    // 6 tetrahedra a cube: along the axes, one diagonal in each square, one in each cube.
    assert_eq!(pairs(&grid(4, 4, 4)).len(), 3 * 48 + 3 * 36 + 27);
}

#[test]
fn points_on_one_sphere_are_delaunay() {
    // Lattice points on one sphere, then with the eight corners of a cube inside.
    let shell = |r: i64| {
        grid(53, 53, 53)
            .into_iter()
            .map(|p| p.map(|x| x - 26))
            .filter(move |p| p.iter().map(|x| x * x).sum::<i64>() == r)
    };
    for r in [14, 101, 689] {
        let points: Vec<P> = shell(r).collect();
        assert!(points.len() >= 48);
        assert_delaunay(&points);
        let both: Vec<P> = shell(r).chain(shell(3)).collect();
        assert_delaunay(&both);
        assert_pairs(&both);
    }
}

#[test]
fn duplicates_share_their_neighbours_and_know_each_other() {
    let points = [[0, 0, 0], [4, 0, 0], [0, 0, 0], [9, 0, 0], [4, 0, 0]];
    let expected = [[0, 1], [0, 2], [0, 4], [1, 2], [1, 3], [1, 4], [2, 4], [3, 4]];
    assert_eq!(pairs(&points), expected);
    assert_eq!(pairs(&[[3, 3, 3]; 3]), [[0, 1], [0, 2], [1, 2]]);
}

#[test]
fn moving_and_scaling_to_the_limit_changes_nothing() {
    let points = box_surface(5, 4, 6);
    let expected = pairs(&points);
    let step = (1 << 31) / 5;
    let far: Vec<P> = points.iter().map(|p| p.map(|x| x * step - (1 << 30))).collect();
    assert_eq!(pairs(&far), expected);
}

#[test]
fn large_numbers_make_the_same_tetrahedra() {
    let sites = Sites::new(&box_surface(5, 4, 6)).unwrap();
    let order = sites.insertion_order();
    let run =
        |points: &[predicates::Point]| delaunay::tetrahedra(points, sites.frame, &order, &Context::default()).unwrap();
    let expected = run(&sites.points);
    for step in [999.0, 65_537.0, f64::from((1 << 30) / 5)] {
        let large: Vec<_> = sites.points.iter().map(|p| p.map(|x| x * step)).collect();
        assert_eq!(run(&large), expected);
    }
}

#[test]
fn coordinates_beyond_the_limit_are_refused() {
    let error = neighbours(&[[0; 3], [0, (1 << 30) + 1, 0]], &Context::default()).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Unsupported);
    assert!(error.message.contains("corner 1"));
}

#[test]
fn cancelling_stops() {
    let context = Context::default();
    context.cancel();
    let error = neighbours(&grid(3, 3, 3), &context).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Cancelled);
}

/// The edges of all four-point subsets with nothing else in or on their circumsphere; none if not generic.
fn brute_force(points: &[P]) -> Option<BTreeSet<[u32; 2]>> {
    let n = points.len() as u32;
    let mut edges = BTreeSet::new();
    for mask in (0_u32..1 << n).filter(|m| m.count_ones() == 4) {
        let on: Vec<u32> = (0..n).filter(|i| mask >> i & 1 == 1).collect();
        let cell = [0, 1, 2, 3].map(|k| points[on[k] as usize]);
        let others = || (0..n).filter(|i| mask >> i & 1 == 0);
        let signs = || others().map(|i| outside(cell, points[i as usize]).signum());
        if volume(cell) == 0 || signs().any(|s| s == 0) {
            return None;
        }
        if signs().all(|s| s > 0) {
            let pair = |i: usize| on[i + 1..].iter().map(move |&b| (i, b));
            edges.extend((0..3).flat_map(pair).map(|(i, b)| [on[i], b]));
        }
    }
    Some(edges)
}

fn coordinate(range: std::ops::Range<i64>) -> impl Strategy<Value = P> {
    prop::array::uniform3(range)
}

fn spans(points: &[P]) -> bool {
    Sites::new(points).is_ok_and(|s| s.points.len() == s.len())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 192, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn generic_points_match_brute_force(
        points in prop::collection::vec(coordinate(-(1 << 19)..1 << 19), 4..12)
    ) {
        if let Some(expected) = brute_force(&points) {
            prop_assert_eq!(pairs(&points), expected.into_iter().collect::<Vec<_>>());
        }
    }

    #[test]
    fn tiny_lattices_are_delaunay(points in prop::collection::vec(coordinate(0..4), 1..64)) {
        assert_pairs(&points);
        if spans(&points) {
            assert_delaunay(&points);
        }
    }

    #[test]
    fn stretched_lattices_are_delaunay(
        points in prop::collection::vec(coordinate(0..4), 4..40),
        steps in coordinate(1..1 << 16),
    ) {
        let points: Vec<P> = points.iter().map(|p| [0, 1, 2].map(|k| p[k] * steps[k])).collect();
        assert_pairs(&points);
        if spans(&points) {
            assert_delaunay(&points);
        }
    }

    #[test]
    fn flat_sets_are_triangulated(
        points in prop::collection::hash_set(coordinate(0..5), 3..25),
        tilt in coordinate(-2..3),
    ) {
        let flat: BTreeSet<P> = points.iter().map(|&[x, y, _]| [x, y, tilt[0] * x + tilt[1] * y]).collect();
        let flat: Vec<P> = flat.into_iter().collect();
        assert_pairs(&flat);
        let lines = |a: P, b: P| {
            // On the hull's outline nothing lies left of the line, seen along z.
            let left = |p: P| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
            (flat.iter().all(|&p| left(p) <= 0), flat.iter().all(|&p| left(p) == 0))
        };
        let hull: BTreeSet<P> = flat.iter().flat_map(|&a| flat.iter().map(move |&b| (a, b)))
            .filter(|&(a, b)| a != b && lines(a, b).0)
            .flat_map(|(a, b)| [a, b]).collect();
        let collinear = flat.len() < 3 || flat.iter().all(|&p| lines(flat[0], flat[1]).1 || p == flat[0]);
        let is_on_hull = |p: &P| hull.iter().any(|&a| *p != a && (lines(a, *p).0 || lines(*p, a).0));
        let on_hull = flat.iter().filter(|p| is_on_hull(p)).count();
        let expected = if collinear { flat.len() - 1 } else { 3 * flat.len() - 3 - on_hull };
        prop_assert_eq!(pairs(&flat).len(), expected);
    }

    #[test]
    fn renumbering_renumbers_the_pairs(
        shuffled in prop::collection::vec(coordinate(0..4), 1..50)
            .prop_flat_map(|points| {
                let numbers: Vec<u32> = (0..points.len() as u32).collect();
                (Just(points), Just(numbers).prop_shuffle())
            })
    ) {
        let (points, numbers) = shuffled;
        let moved: Vec<P> = numbers.iter().map(|&i| points[i as usize]).collect();
        let mut back: Vec<[u32; 2]> = pairs(&moved)
            .iter()
            .map(|p| p.map(|i| numbers[i as usize]))
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        back.sort_unstable();
        prop_assert_eq!(back, pairs(&points));
    }
}
