//! Named polycubes for demonstrations, each with an organic shape it could have come from.

use super::deform::Deformation;
use super::mesh::VertexLattice;
use super::soften::Body;
use super::voxels::{Cuboid, Voxels};
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{CellKind, Mesh, Point};
use crate::rng::SplitMix64;
use std::fmt;
use std::str::FromStr;

/// The named polycubes: 44 to 66 units long, on integer coordinates.
///
/// Each has a part that stays and parts that a seed shifts by 1 to 3 units. With seed 0 all parts
/// are aligned; every other seed makes something to align.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Example {
    /// A cube with a smaller box on each of its six faces (Figure 1 of the paper): 56 corners, 36 facets.
    CubeSpikes,
    /// An L whose arms carry steps.
    SteppedL,
    /// A square ring on four legs, with four teeth on top: genus 1.
    Ring,
    /// A plate with two holes and bumps on all sides: genus 2.
    DoubleTorus,
}

impl Example {
    /// Every example.
    pub const ALL: [Self; 4] = [Self::CubeSpikes, Self::SteppedL, Self::Ring, Self::DoubleTorus];

    /// The solid cells of the polycube.
    ///
    /// # Errors
    /// None for the boxes of the examples; those of [`Voxels::from_difference`] in principle.
    pub fn voxels(self, seed: u64) -> Result<Voxels> {
        match self {
            Self::CubeSpikes => cube_spikes(seed),
            Self::SteppedL => stepped_l(seed),
            Self::Ring => ring(seed),
            Self::DoubleTorus => double_torus(seed),
        }
    }

    /// The maps that sculpt the polycube, applied in this order before its edges are softened.
    pub fn deformations(self) -> Vec<Deformation> {
        match self {
            Self::CubeSpikes => vec![round([true; 3], 0.9, 6.0), twist(2, 0.012)],
            Self::SteppedL => vec![twist(2, 0.012), bend(1, 0, 0.015), bend(2, 1, 0.012)],
            Self::Ring => vec![round([true, true, false], 0.95, 6.0), bend(0, 2, 0.012)],
            Self::DoubleTorus => vec![round([true, true, false], 0.8, 20.0), twist(0, 0.018), bend(0, 2, 0.016)],
        }
    }
}

impl fmt::Display for Example {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::CubeSpikes => "cube-spikes",
            Self::SteppedL => "stepped-l",
            Self::Ring => "ring",
            Self::DoubleTorus => "double-torus",
        })
    }
}

impl FromStr for Example {
    type Err = Error;

    /// Reads what [`Display`](fmt::Display) writes.
    fn from_str(name: &str) -> Result<Self> {
        let found = Self::ALL.into_iter().find(|e| e.to_string() == name);
        found.ok_or_else(|| {
            Error::new(ErrorKind::Option, format!("there is no example '{name}'"))
                .remedy("use cube-spikes, stepped-l, ring or double-torus")
        })
    }
}

fn round(axes: [bool; 3], strength: f64, core: f64) -> Deformation {
    Deformation::Round { center: [0.0; 3], axes, strength, core }
}

fn twist(axis: usize, rate: f64) -> Deformation {
    Deformation::Twist { center: [0.0; 3], axis, rate }
}

fn bend(along: usize, towards: usize, curvature: f64) -> Deformation {
    Deformation::Bend { center: [0.0; 3], along, towards, curvature }
}

/// Steps of smoothing that every shape gets.
const SOFTENING: usize = 20;

/// An example's polycube with unit steps and the shape it was deformed from: two meshes of `kind`
/// with the same cells. All tetrahedra and all corners of hexahedra are positive in both.
///
/// # Errors
/// None for the examples as they are; those of [`Voxels::mesh`] in principle.
pub fn example(example: Example, seed: u64, kind: CellKind) -> Result<(Mesh, Mesh)> {
    let voxels = example.voxels(seed)?.refined(1.0)?;
    let lattice = VertexLattice::new(&voxels)?;
    let points: Vec<Point> = (0..lattice.len()).map(|v| lattice.point(v)).collect();
    let maps = example.deformations();
    let deform = |p: &Point| maps.iter().fold(*p, |p, map| map.apply(p));
    let deformed: Vec<Point> = points.iter().map(deform).collect();
    // The volume is smoothed for surfaces, too: all kinds show one shape.
    let soft = Body::new(&voxels, &lattice).soften(&deformed, SOFTENING);
    let cells = lattice.cells(kind);
    Ok((Mesh::of_used(&points, cells.clone())?.0, Mesh::of_used(&soft, cells)?.0))
}

/// Random shifts of 1 to 3 units to either side; none for seed 0.
struct Shifts {
    rng: Option<SplitMix64>,
}

impl Shifts {
    fn new(seed: u64) -> Self {
        let rng = (seed != 0).then(|| SplitMix64::new(seed));
        Self { rng }
    }

    /// One shift: never 0 but for seed 0, so that no part stays aligned by chance with the rest.
    fn next(&mut self) -> i64 {
        let Some(rng) = &mut self.rng else {
            return 0;
        };
        let side = if rng.one_in(2) { 1 } else { -1 };
        side * rng.between(1, 3)
    }

    /// The box shifted along every axis but `normal`.
    fn across(&mut self, b: Cuboid, normal: usize) -> Cuboid {
        let mut by = [0; 3];
        for axis in (0..3).filter(|axis| *axis != normal) {
            by[axis] = self.next();
        }
        b.moved(by)
    }
}

/// A cube with a smaller box on each of its six faces, 52 units long; see [`Example::CubeSpikes`].
///
/// # Errors
/// None; see [`Example::voxels`].
pub fn cube_spikes(seed: u64) -> Result<Voxels> {
    let mut shifts = Shifts::new(seed);
    let mut boxes = vec![Cuboid::new([-14; 3], [14; 3])];
    for axis in 0..3 {
        let mut spike = Cuboid::new([-5; 3], [5; 3]);
        (spike.min[axis], spike.max[axis]) = (14, 26);
        boxes.push(shifts.across(spike, axis));
        (spike.min[axis], spike.max[axis]) = (-26, -14);
        boxes.push(shifts.across(spike, axis));
    }
    Voxels::from_boxes(&boxes)
}

/// An L whose arms carry steps, 44 units long; see [`Example::SteppedL`].
///
/// # Errors
/// None; see [`Example::voxels`].
pub(super) fn stepped_l(seed: u64) -> Result<Voxels> {
    let mut shifts = Shifts::new(seed);
    let mut boxes = vec![Cuboid::new([-22, -9, -22], [22, 9, -8]), Cuboid::new([-22, -9, -8], [-8, 9, 22])];
    // Stairs in the nook: the lower one reaches out on the foot, the higher one up the arm.
    for (reach, height) in [(10, 0), (0, 10)] {
        let max = [reach + shifts.next(), 9, height + shifts.next()];
        boxes.push(Cuboid::new([-8, -9, -8], max));
    }
    for lug in [Cuboid::new([9, 9, -18], [17, 16, -12]), Cuboid::new([-18, 9, 8], [-12, 16, 17])] {
        boxes.push(shifts.across(lug, 1));
        boxes.push(shifts.across(lug.moved([0, -25, 0]), 1));
    }
    Voxels::from_boxes(&boxes)
}

/// A square ring on four legs with four teeth on top, 48 units wide; see [`Example::Ring`].
///
/// # Errors
/// None; see [`Example::voxels`].
pub(super) fn ring(seed: u64) -> Result<Voxels> {
    let mut shifts = Shifts::new(seed);
    let mut boxes = vec![Cuboid::new([-24, -24, -6], [24, 24, 6])];
    for [x, y] in [[-17, -17], [17, -17], [-17, 17], [17, 17]] {
        let leg = Cuboid::new([x - 3, y - 3, -18], [x + 3, y + 3, -6]);
        boxes.push(shifts.across(leg, 2));
    }
    for [x, y] in [[-17, 0], [17, 0], [0, -17], [0, 17]] {
        let tooth = Cuboid::new([x - 3, y - 3, 6], [x + 3, y + 3, 14]);
        boxes.push(shifts.across(tooth, 2));
    }
    let hole = Cuboid::new([-10, -10, -6], [10, 10, 6]);
    Voxels::from_difference(&boxes, &[hole])
}

/// A plate with two holes and bumps on all sides, 66 units long; see [`Example::DoubleTorus`].
///
/// # Errors
/// None; see [`Example::voxels`].
pub(super) fn double_torus(seed: u64) -> Result<Voxels> {
    let mut shifts = Shifts::new(seed);
    let mut boxes = vec![Cuboid::new([-33, -16, -6], [33, 16, 6])];
    for x in [-15, 15] {
        let edge = Cuboid::new([x - 4, 16, -2], [x + 4, 22, 2]);
        boxes.push(shifts.across(edge, 1));
        boxes.push(shifts.across(edge.moved([0, -38, 0]), 1));
    }
    for x in [-27, 0, 27] {
        let bump = Cuboid::new([x - 2, -4, 6], [x + 2, 4, 13]);
        boxes.push(shifts.across(bump, 2));
        boxes.push(shifts.across(bump.moved([0, 0, -19]), 2));
    }
    let hole = Cuboid::new([-18, -7, -6], [-9, 7, 6]);
    let second = shifts.across(hole.moved([27, 0, 0]), 2);
    Voxels::from_difference(&boxes, &[hole, second])
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;

    /// Corners, charts and genus.
    fn structure(e: Example) -> (usize, usize, i64) {
        match e {
            Example::CubeSpikes => (56, 36, 0),
            Example::SteppedL => (52, 32, 0),
            Example::Ring => (80, 50, 1),
            Example::DoubleTorus => (104, 64, 2),
        }
    }

    #[test]
    fn every_seed_has_the_structure_of_its_example() {
        for e in Example::ALL {
            let (corners, charts, genus) = structure(e);
            for seed in 0..50 {
                let voxels = e.voxels(seed).unwrap();
                let mesh = voxels.mesh(CellKind::Quads, 1e9).unwrap();
                check::assert_manifold(&mesh);
                assert_eq!(voxels.components(), 1);
                assert_eq!(check::euler(&mesh), 2 - 2 * genus, "{e}");
                assert_eq!((voxels.corners(), check::charts(&mesh)), (corners, charts), "{e}");
            }
        }
    }

    #[test]
    fn seed_0_needs_the_fewest_planes() {
        for e in Example::ALL {
            let planes = |seed| e.voxels(seed).unwrap().size().iter().sum::<usize>();
            assert!((1..20).all(|seed| planes(seed) > planes(0)), "{e}");
        }
    }

    #[test]
    fn the_maps_are_injective_around_the_polycube() {
        let mut rng = SplitMix64::new(3);
        for e in Example::ALL {
            for _ in 0..10_000 {
                let mut p = Point::from([0; 3].map(|_: i32| 66.0 * rng.unit() - 33.0));
                for map in e.deformations() {
                    assert!(map.determinant(p) > 0.05, "{e}: {map:?}");
                    p = map.apply(p);
                }
            }
        }
    }

    #[test]
    fn polycubes_and_shapes_are_positive_and_alike() {
        for e in Example::ALL {
            for kind in [CellKind::Tetrahedra, CellKind::Hexahedra] {
                let (polycube, shape) = example(e, 1, kind).unwrap();
                assert_eq!(polycube, e.voxels(1).unwrap().mesh(kind, 1.0).unwrap());
                assert_eq!(polycube.cells(), shape.cells());
                assert_eq!(check::smallest_determinant(&polycube), 1.0);
                let smallest = check::smallest_determinant(&shape);
                assert!(smallest > 0.02, "{e} {kind}: {smallest}");
                assert!(check::volume(&shape) > 0.5 * check::volume(&polycube));
            }
        }
    }

    #[test]
    fn all_kinds_show_one_shape() {
        let all = CellKind::ALL.map(|kind| example(Example::CubeSpikes, 2, kind).unwrap().1);
        assert_eq!(all[2].points(), all[3].points());
        assert_eq!(all[0].points(), all[1].points());
        assert_eq!(check::boundary(&all[2]).points(), all[0].points());
        for surface in &all[..2] {
            check::assert_manifold(surface);
        }
        let again = example(Example::CubeSpikes, 2, CellKind::Triangles).unwrap();
        assert_eq!(again.1, all[0]);
    }

    #[test]
    fn names_are_read_back() {
        for e in Example::ALL {
            assert_eq!(e.to_string().parse::<Example>().unwrap(), e);
        }
        assert_eq!("cube".parse::<Example>().unwrap_err().kind, ErrorKind::Option);
    }
}
