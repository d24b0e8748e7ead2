//! The inside of a shape that is known by its surface only: solved for on the lattice.

use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::map::{SparseRows, extend_harmonic};
use crate::mesh::Point;
use crate::remesh::lattice::{Grid, Keys, rank};
use nalgebra::Vector3;

/// Places the inner vertices of the lattice so that each is the mean of its six neighbours, with the surface held.
///
/// The Laplace problem on unit cells by central differences: about as good an inside as can be had without a
/// map of it; where the surface is strongly bent some cells may be turned over. About n^1.2 for n vertices.
///
/// # Errors
/// [`ErrorKind::Cancelled`]; [`ErrorKind::Internal`] if the solver fails.
pub(crate) fn fill_inside(grid: &Grid, points: &mut [Point], context: &Context) -> Result<()> {
    let mut rows = SparseRows::new();
    let mut row = Vec::new();
    for (&key, carrier) in grid.vertices.iter().zip(&grid.carriers) {
        if !carrier.is_surface() {
            for axis in 0..3 {
                let step = Keys::step(axis);
                let around = [key - step, key + step].map(|k| rank(&grid.vertices, k));
                row.extend(around.into_iter().flatten().map(|v| (v, 1.0)));
            }
        }
        rows.push(&mut row);
    }
    let known: Vec<[bool; 3]> = grid.carriers.iter().map(|s| [s.is_surface(); 3]).collect();
    let mut field: Vec<[f64; 3]> = points.iter().map(|p| p.coords.into()).collect();
    extend_harmonic(&rows, &known, &mut field, context)?;
    points.iter_mut().zip(field).for_each(|(p, x)| *p = Point::from(x));
    Ok(())
}

/// The point that trilinear interpolation of `points` over the unit cell around the lattice point `at` gives.
///
/// # Errors
/// [`ErrorKind::Internal`] for a point outside the polycube.
pub(crate) fn interpolate(grid: &Grid, points: &[Point], at: [f64; 3]) -> Result<Point> {
    let low: [i64; 3] = at.map(|x| x.floor() as i64);
    let aligned = |a: usize| at[a].fract() == 0.0;
    // A point on the border of cells belongs to all of them; the first that is solid is taken.
    let around = (0..8_usize).filter(|o| (0..3).all(|a| o >> a & 1 == 0 || aligned(a)));
    let cells = around.map(|o| std::array::from_fn(|a| low[a] - (o >> a & 1) as i64));
    let solid = cells.filter_map(|cell: [i64; 3]| Some((cell, grid.cell_at(cell)?))).next();
    let (cell, id) = solid.ok_or_else(|| Error::new(ErrorKind::Internal, "a padding vertex left the polycube"))?;
    let t: [f64; 3] = std::array::from_fn(|a| at[a] - cell[a] as f64);
    let weight = |o: usize| -> f64 { (0..3).map(|a| if o >> a & 1 == 1 { t[a] } else { 1.0 - t[a] }).product() };
    let corner = |o: usize| points[grid.octants(id)[o] as usize].coords;
    let sum: Vector3<f64> = (0..8).map(|o| corner(o) * weight(o)).sum();
    Ok(Point::from(sum))
}
