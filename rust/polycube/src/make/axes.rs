//! Turning a shape so that its surface looks along the axes.

use crate::mesh::{Face, Mesh, Point};
use crate::structure::area_vector;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Angles of each of the three turns that the search starts from.
const STARTS: [f64; 3] = [0.0, PI / 6.0, PI / 3.0];
/// Steps of the search from each start.
const STEPS: usize = 100;
/// A turn must make the surface look along the axes better by this part.
const WORTH: f64 = 1e-3;

/// Which directions of the shape become the axes of the polycube.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Axes {
    /// Those of the coordinates.
    #[default]
    Keep,
    /// Those that the surface looks along best: for a shape that lies askew, as scans do.
    Best,
}

impl Axes {
    /// The turn that takes the shape to where its polycube is made; nothing where it stays.
    pub(super) fn turn(self, shape: &Mesh) -> Option<Matrix3<f64>> {
        match self {
            Self::Keep => None,
            Self::Best => NormalMoments::new(shape).best_turn(),
        }
    }
}

/// The shape, turned.
pub(super) fn turned(shape: &Mesh, turn: &Matrix3<f64>) -> Mesh {
    let mut mesh = shape.clone();
    mesh.points_mut().iter_mut().for_each(|point| *point = Point::from(turn * point.coords));
    mesh
}

/// Brings what was made of a turned shape back to where the shape lies; its own vertices, the first, exactly.
pub(super) fn turn_back(made: &mut Mesh, shape: &Mesh, turn: &Matrix3<f64>) {
    let (own, added) = made.points_mut().split_at_mut(shape.points().len());
    own.copy_from_slice(shape.points());
    added.iter_mut().for_each(|point| *point = Point::from(turn.transpose() * point.coords));
}

/// The fourth moments of the normals over the surface: the sum, by area, of `n_a n_b n nᵀ` for all axes a and b.
struct NormalMoments([[Matrix3<f64>; 3]; 3]);

impl NormalMoments {
    fn new(shape: &Mesh) -> Self {
        let mut sum = [[Matrix3::zeros(); 3]; 3];
        let faces = shape.cells().boundary().unwrap_or_default();
        for triangle in faces.iter().flat_map(Face::triangles) {
            let normal = area_vector(shape.points(), &Face::Triangle(triangle));
            let Some(unit) = normal.try_normalize(0.0) else { continue };
            let square = unit * unit.transpose() * normal.norm();
            sum.iter_mut()
                .flatten()
                .zip(unit.iter().flat_map(|a| unit.iter().map(move |b| a * b)))
                .for_each(|(moment, ab)| *moment += square * ab);
        }
        Self(sum)
    }

    /// The sum of `(r · n)³ n`.
    fn third(&self, r: &Vector3<f64>) -> Vector3<f64> {
        let mut sum = Vector3::zeros();
        for (a, row) in self.0.iter().enumerate() {
            for (b, moment) in row.iter().enumerate() {
                sum += moment * r * (r[a] * r[b]);
            }
        }
        sum
    }

    /// How well the surface looks along the rows of a turn: the sum of the fourth powers of the normals' coordinates.
    fn value(&self, turn: &Matrix3<f64>) -> f64 {
        turn.row_iter().map(|row| self.third(&row.transpose()).dot(&row.transpose())).sum()
    }

    /// The turn under which the surface looks along the axes best, of those that differ by quarter turns the one that
    /// moves the shape least; nothing if the shape lies as well as it is.
    ///
    /// Fourth powers, and the iteration that makes them larger at every step: Zhai et al., *Complete Dictionary
    /// Learning via l4-Norm Maximization over the Orthogonal Group*, 2020.
    fn best_turn(&self) -> Option<Matrix3<f64>> {
        let starts = STARTS.iter().flat_map(|x| STARTS.iter().flat_map(move |y| STARTS.iter().map(move |z| [x, y, z])));
        let found = starts.map(|[x, y, z]| self.climb(nalgebra::Rotation3::from_euler_angles(*x, *y, *z).into_inner()));
        let best = found.max_by(|a, b| self.value(a).total_cmp(&self.value(b)))?;
        let is_worth_it = self.value(&best) > (1.0 + WORTH) * self.value(&Matrix3::identity());
        is_worth_it.then(|| least_turn(&best))
    }

    /// A maximum near a start.
    fn climb(&self, start: Matrix3<f64>) -> Matrix3<f64> {
        (0..STEPS).fold(start, |turn, _| {
            let rows = turn.row_iter().map(|row| self.third(&row.transpose()).transpose()).collect::<Vec<_>>();
            let svd = Matrix3::from_rows(&rows).svd(true, true);
            svd.u.zip(svd.v_t).map_or(turn, |(u, v)| u * v)
        })
    }
}

/// Of the turns that differ by quarter turns about the axes, the one nearest to none: that with the largest trace.
fn least_turn(turn: &Matrix3<f64>) -> Matrix3<f64> {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let signs = (0..8).map(|k| [0, 1, 2].map(|bit| if k >> bit & 1 == 0 { 1.0 } else { -1.0 }));
    let all = signs.flat_map(|s| orders.map(|order| Matrix3::from_rows(&[0, 1, 2].map(|k| turn.row(order[k]) * s[k]))));
    let turns = all.filter(|m| m.determinant() > 0.0);
    turns.max_by(|a, b| a.trace().total_cmp(&b.trace())).unwrap_or(*turn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Example, example};
    use crate::mesh::CellKind;

    fn ring() -> Mesh {
        example(Example::Ring, 1, CellKind::Triangles).unwrap().0
    }

    #[test]
    fn what_lies_along_the_axes_stays() {
        assert_eq!(Axes::Best.turn(&ring()), None);
        assert_eq!(Axes::Keep.turn(&ring()), None);
    }

    #[test]
    fn any_turn_is_undone() {
        for angles in [[0.1, 0.0, 0.0], [0.3, -0.2, 0.35], [0.7, 0.6, -0.5]] {
            let askew = nalgebra::Rotation3::from_euler_angles(angles[0], angles[1], angles[2]).into_inner();
            let shape = turned(&ring(), &askew);
            let turn = Axes::Best.turn(&shape).expect("it lies askew");
            assert!((turn.determinant() - 1.0).abs() < 1e-9 && (turn * turn.transpose()).is_identity(1e-9));
            let whole = (turn * askew).map(|x| x.abs());
            assert!(whole.iter().all(|x| x.min(1.0 - x).abs() < 1e-6), "quarter turns are left: {whole}");
            assert!(turn.trace() >= (askew.transpose()).trace() - 1e-6, "no other moves it less");
        }
    }

    #[test]
    fn vertices_of_the_shape_come_back_exactly_and_others_nearly() {
        let shape = ring();
        let askew = nalgebra::Rotation3::from_euler_angles(0.4, 0.2, 0.1).into_inner();
        let mut points = turned(&shape, &askew).points().to_vec();
        points.push(Point::from(askew * Vector3::new(1.0, 2.0, 3.0)));
        let mut made = Mesh::new(points, shape.cells().clone()).unwrap();
        turn_back(&mut made, &shape, &askew);
        assert_eq!(&made.points()[..shape.points().len()], shape.points());
        let added = made.points()[shape.points().len()];
        assert!((added - Point::new(1.0, 2.0, 3.0)).norm() < 1e-12);
    }
}
