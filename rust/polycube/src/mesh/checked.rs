//! Vertices and cells that go together, checked once and for all.

use super::{Cells, Point};
use crate::error::{Error, ErrorKind, Place, Result};

/// Vertices and cells that go together: every coordinate is a finite number and every cell names vertices that are
/// there. A polycube and the shape it was deformed from are two meshes with the same cells.
///
/// ```
/// use polycube::mesh::{Cells, Mesh, Point};
///
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Point::from);
/// let tetrahedron = Mesh::new(corners.to_vec(), Cells::Tetrahedra(vec![[0, 1, 2, 3]]))?;
/// let larger = tetrahedron.moved(|p| p * 2.0)?;
/// assert_eq!(larger.points()[1].x, 2.0);
/// assert!(Mesh::new(corners.to_vec(), Cells::Triangles(vec![[0, 1, 4]])).is_err());
/// # Ok::<(), polycube::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    points: Vec<Point>,
    cells: Cells,
}

impl Mesh {
    /// The mesh of `cells` over `points`, of which some may be unused. Linear time.
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`] naming a vertex with a coordinate that is not a finite number, or a cell with a vertex that
    /// is not there; [`ErrorKind::Unsupported`] for more vertices than 32-bit indices can name.
    pub fn new(points: Vec<Point>, cells: Cells) -> Result<Self> {
        check_points(&points)?;
        check_cells(&cells, points.len())?;
        Ok(Self { points, cells })
    }

    /// Vertex positions.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Cells over the vertices.
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// Vertex positions and cells, to be changed and made a mesh again.
    pub fn into_parts(self) -> (Vec<Point>, Cells) {
        (self.points, self.cells)
    }

    /// The mesh after `change` was made to its vertex positions and cells.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn edited(mut self, change: impl FnOnce(&mut Vec<Point>, &mut Cells)) -> Result<Self> {
        change(&mut self.points, &mut self.cells);
        Self::new(self.points, self.cells)
    }

    /// The same cells with their vertices at `points`.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] unless there are as many as before; [`ErrorKind::Mesh`] naming one that is not finite.
    pub fn with_points(self, points: Vec<Point>) -> Result<Self> {
        if points.len() != self.points.len() {
            let message = format!("{} positions for {} vertices", points.len(), self.points.len());
            return Err(Error::new(ErrorKind::Mismatch, message).remedy("give one for each vertex"));
        }
        check_points(&points)?;
        Ok(Self { points, ..self })
    }

    /// The same cells with each vertex where `place` has it.
    ///
    /// # Errors
    /// [`ErrorKind::Mesh`] naming a vertex whose place is not finite.
    pub fn moved(&self, place: impl FnMut(&Point) -> Point) -> Result<Self> {
        let points: Vec<Point> = self.points.iter().map(place).collect();
        check_points(&points)?;
        Ok(Self { points, cells: self.cells.clone() })
    }

    /// For positions that are computed in place; they must stay finite.
    pub(crate) fn points_mut(&mut self) -> &mut [Point] {
        &mut self.points
    }
}

/// Refuses coordinates that are not finite, and more points than indices can name.
pub(super) fn check_points(points: &[Point]) -> Result<()> {
    if u32::try_from(points.len()).is_err() {
        let message = "more vertices than 32-bit indices can name";
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    let bad = points.iter().position(|p| p.iter().any(|x| !x.is_finite()));
    let Some(i) = bad else { return Ok(()) };
    Err(Error::new(ErrorKind::Mesh, "a coordinate is not a finite number")
        .at(Place::Vertex(i as u32))
        .remedy("repair or remove the vertex and export the mesh again"))
}

/// Refuses cells with vertices beyond the last of `points`.
pub(super) fn check_cells(cells: &Cells, points: usize) -> Result<()> {
    for i in 0..cells.len() {
        if let Some(vertex) = cells.cell(i).iter().find(|&&v| v as usize >= points) {
            let message = format!("the cell names vertex {vertex}, counting from 0, of {points}");
            let place = Place::Cell(u32::try_from(i).unwrap_or(u32::MAX));
            return Err(Error::new(ErrorKind::Mesh, message).at(place).remedy("give every vertex that a cell names"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::testing::tet_box;

    fn refused(made: Result<Mesh>) -> (ErrorKind, Option<Place>) {
        let error = made.unwrap_err();
        (error.kind, error.place)
    }

    #[test]
    fn a_mesh_has_finite_points_and_its_vertices_are_there() {
        let good = tet_box([1, 1, 1]);
        let (mut points, cells) = good.clone().into_parts();
        assert_eq!(Mesh::new(points.clone(), cells.clone()), Ok(good.clone()));
        let few = points[..7].to_vec();
        assert_eq!(refused(good.clone().with_points(few.clone())), (ErrorKind::Mismatch, None));
        assert!(matches!(refused(Mesh::new(few, cells.clone())), (ErrorKind::Mesh, Some(Place::Cell(_)))));
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            points[5].y = bad;
            let named = (ErrorKind::Mesh, Some(Place::Vertex(5)));
            assert_eq!(refused(Mesh::new(points.clone(), cells.clone())), named);
            assert_eq!(refused(good.clone().with_points(points.clone())), named);
        }
        assert_eq!(refused(good.moved(|p| p / 0.0)), (ErrorKind::Mesh, Some(Place::Vertex(0))));
    }
}
