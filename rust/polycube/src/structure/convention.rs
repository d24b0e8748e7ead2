//! Labels that count the directions in another order than ours, recognised by how their faces look.

use super::label::{Label, area_vector};
use crate::mesh::{Face, LabelOrder, Point};
use nalgebra::Vector3;

/// A face whose normal has this cosine or more with the direction of its label goes with it: 60 degrees.
const WITH: f64 = 0.5;

/// The faces of a number go with a direction if the mean of their normals has this cosine with it.
const CLEAR: f64 = 0.8;

/// The other order that `numbers`, one for each of `faces`, count the directions in; nothing where they are labels in
/// our order, as far as half of the faces tell that have one, or go with their faces in no order.
pub(crate) fn convention(points: &[Point], faces: &[Face], numbers: &[i8]) -> Option<LabelOrder> {
    let labelled = || faces.iter().zip(numbers).filter(|(_, n)| **n >= 0);
    let with = |(face, number): &(&Face, &i8)| {
        let normal = area_vector(points, face);
        let along = |l: Label| f64::from(l.sign()) * normal[l.axis()];
        Label::new(**number).is_some_and(|label| along(label) >= WITH * normal.norm())
    };
    let (count, ours) = (labelled().count(), labelled().filter(with).count());
    let largest = labelled().map(|(_, n)| *n).max()?;
    if largest < 6 && 2 * ours >= count {
        return None;
    }
    let starts = [0, 1].into_iter().filter(|first| labelled().all(|(_, n)| (*first..first + 6).contains(n)));
    let mut orders = starts.filter_map(|first| order(points, labelled(), first));
    orders.find(|order| *order != LabelOrder::default())
}

/// The order from `first` on in which each number has the direction that its faces look at; directions without faces
/// go to the numbers that are left, as they come.
fn order<'a>(points: &[Point], labelled: impl Iterator<Item = (&'a Face, &'a i8)>, first: i8) -> Option<LabelOrder> {
    let mut sums = [Vector3::zeros(); 6];
    let mut areas = [0.0; 6];
    for (face, number) in labelled {
        let normal = area_vector(points, face);
        sums[(number - first) as usize] += normal;
        areas[(number - first) as usize] += normal.norm();
    }
    let mut found = [None; 6];
    for (i, (sum, area)) in sums.iter().zip(areas).enumerate().filter(|(_, (_, area))| *area > 0.0) {
        let (label, cosine) = Label::nearest(sum);
        if cosine < CLEAR || sum.norm() < CLEAR * area || found.contains(&Some(label.index() as i8)) {
            return None;
        }
        found[i] = Some(label.index() as i8);
    }
    let mut left = (0..6).filter(|label| !found.contains(&Some(*label)));
    Some(LabelOrder::new(first, found.map(|label| label.or_else(|| left.next()).unwrap_or(0))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Cuboid, Voxels};
    use crate::mesh::{CellKind, Mesh};

    fn step(kind: CellKind) -> (Mesh, Vec<Face>, Vec<i8>) {
        let boxes = [Cuboid::new([0; 3], [4, 2, 2]), Cuboid::new([0; 3], [2, 2, 4])];
        let mesh = Voxels::from_boxes(&boxes).unwrap().mesh(kind, 1.0).unwrap();
        let faces = mesh.cells().boundary().unwrap();
        let label = |f: &Face| Label::nearest(&area_vector(mesh.points(), f)).0.index() as i8;
        let labels = faces.iter().map(label).collect();
        (mesh, faces, labels)
    }

    #[test]
    fn other_orders_are_recognised() {
        for kind in [CellKind::Triangles, CellKind::Hexahedra] {
            let (mesh, faces, labels) = step(kind);
            assert_eq!(convention(mesh.points(), &faces, &labels), None);
            for text in ["-X+X-Y+Y-Z+Z", "+Z-Z+Y-Y+X-X", "1:+X-X+Y-Y+Z-Z", "1:-Y+Y-X+X-Z+Z", "+X+Y+Z-X-Y-Z"] {
                let order: LabelOrder = text.parse().unwrap();
                let number = |label: &i8| (0..=6).find(|&n| order.label(n) == Some(*label)).unwrap();
                let numbers: Vec<i8> = labels.iter().map(number).collect();
                let found = convention(mesh.points(), &faces, &numbers);
                assert_eq!(found, Some(order), "{kind} {text}");
                assert_eq!(order.apply(&numbers).unwrap(), labels);
            }
        }
    }

    #[test]
    fn labels_in_no_order_are_for_the_structure_to_judge() {
        let (mesh, faces, labels) = step(CellKind::Quads);
        let shuffled: Vec<i8> = (0..).take(labels.len()).map(|i: i8| i % 6).collect();
        assert_eq!(convention(mesh.points(), &faces, &shuffled), None);
        assert_eq!(convention(mesh.points(), &faces, &vec![-1; labels.len()]), None);
        let mut few = labels;
        few[..4].fill(5);
        assert_eq!(convention(mesh.points(), &faces, &few), None);
    }
}
