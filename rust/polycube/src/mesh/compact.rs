//! Meshes without vertices that no cell uses.

use super::checked::check_cells;
use super::{Cells, Mesh, Point};
use crate::error::Result;

impl Mesh {
    /// The mesh of `cells` over those of `points` that they use, in their order; and which those are, ascending.
    /// Linear time.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn of_used(points: &[Point], cells: Cells) -> Result<(Self, Vec<u32>)> {
        check_cells(&cells, points.len())?;
        let mut number = vec![u32::MAX; points.len()];
        for i in 0..cells.len() {
            cells.cell(i).iter().for_each(|&v| number[v as usize] = 0);
        }
        let mut kept = Vec::new();
        for (v, number) in (0..).zip(&mut number).filter(|(_, n)| **n == 0) {
            *number = kept.len() as u32;
            kept.push(v);
        }
        let points = kept.iter().map(|&v: &u32| points[v as usize]).collect();
        Ok((Self::new(points, renumbered(cells, &number))?, kept))
    }
}

fn renumbered(cells: Cells, number: &[u32]) -> Cells {
    fn each<const N: usize>(mut cells: Vec<[u32; N]>, number: &[u32]) -> Vec<[u32; N]> {
        cells.as_flattened_mut().iter_mut().for_each(|v| *v = number[*v as usize]);
        cells
    }
    match cells {
        Cells::Triangles(c) => Cells::Triangles(each(c, number)),
        Cells::Quads(c) => Cells::Quads(each(c, number)),
        Cells::Tetrahedra(c) => Cells::Tetrahedra(each(c, number)),
        Cells::Hexahedra(c) => Cells::Hexahedra(each(c, number)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_in_use_keep_their_order() {
        let points: Vec<Point> = (0..6).map(|i| Point::new(f64::from(i), 0.0, 0.0)).collect();
        let (mesh, kept) = Mesh::of_used(&points, Cells::Triangles(vec![[4, 1, 5], [5, 1, 2]])).unwrap();
        assert_eq!(kept, [1, 2, 4, 5]);
        assert_eq!(mesh.points(), [1, 2, 4, 5].map(|v| points[v]));
        assert_eq!(*mesh.cells(), Cells::Triangles(vec![[2, 0, 3], [3, 0, 1]]));
    }
}
