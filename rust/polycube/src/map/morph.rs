//! Fit a polycube mesh into a new structure by a Laplace problem.

use super::cotangent::{cotangent_weights, positive_weights};
use super::harmonic::extend_harmonic;
use super::mean_value::mean_value_weights;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::{Face, Mesh, Point, Simplices};

/// Moves the vertices of a polycube onto prescribed coordinates, the others with them, smoothly.
///
/// `fixed[v][axis]` is the coordinate vertex `v` must have: all three at a polycube corner, two on
/// an edge, one in a facet, none inside, in the units of `mesh`. The answer has one point for
/// each vertex of `mesh`; prescribed coordinates are met to the last bit.
///
/// The displacement of the free coordinates is harmonic, for each axis on its own, with weights
/// from `mesh` as it comes (paper, section 6): first on the boundary surface with cotangent weights,
/// where a coordinate that is free on both sides of a polycube edge runs across it, then, for a
/// volume, inside with mean value coordinates and the whole boundary held. Quadrilaterals and
/// hexahedra count as their [simplices](crate::mesh::Cells::simplices).
///
/// As both kinds of weights reproduce linear functions, this is the Laplace problem of the
/// positions; asking for the displacement makes the answer *exactly* the input where nothing is to
/// move, on thin or inverted elements, too:
/// - a triangle thinner than 1e-6 (doubled area over longest edge squared) counts as equilateral;
/// - negative cotangents stay, so an obtuse triangulation may overshoot its boundary a little; where triangles are so
///   thin that
///   rounding leaves nothing of the solution, the surface is solved with cotangents from 0.05 to 20;
/// - an inner vertex with an inverted or flat tetrahedron around it moves as the plain mean of its
///   neighbours;
/// - a vertex of no cell stays where it is, whatever `fixed` says.
///
/// The answer may hold flipped elements: see [`flipped`](crate::measure::flipped()). Relative residual 1e-10
/// (down to 1e-6 where rounding forbids better), by iterating or, on a surface where triangles are so thin that this
/// gets nowhere, by a factorisation. One thread, the same bits on every machine.
/// A quarter of a second and 45 MB for 236,000 tetrahedra, a little more than linear; a surface
/// with few large facets takes longer, about n^1.5: some seconds for 200,000 vertices.
///
/// # Errors
/// [`ErrorKind::Mismatch`] unless `fixed` has one entry for each vertex, [`ErrorKind::Option`] when one is not finite;
/// [`ErrorKind::Mesh`] for a face of three cells; [`ErrorKind::Polycube`] naming a vertex of a component without any
/// prescribed coordinate on some axis; [`ErrorKind::Cancelled`]; [`ErrorKind::Internal`] if the solver fails.
pub fn morph(mesh: &Mesh, fixed: &[[Option<f64>; 3]], context: &Context) -> Result<Vec<Point>> {
    check(mesh, fixed)?;
    let mut known: Vec<[bool; 3]> = fixed.iter().map(|f| f.map(|c| c.is_some())).collect();
    let mut moves: Vec<[f64; 3]> = (0..fixed.len()).map(|v| prescribed(mesh, fixed, v)).collect();
    let surface = surface(mesh)?;
    let end = if mesh.cells().is_volume() { 0.3 } else { 1.0 };
    let part = context.stage("morph", 0.0, end);
    let mut used = relax_surface(mesh, &surface, &known, &mut moves, &part)?;
    if let Simplices::Tetrahedra(tetrahedra) = mesh.cells().simplices() {
        hold(&mut known, &used);
        let part = context.stage("morph", end, 1.0);
        relax_inside(mesh, &tetrahedra, &known, &mut moves, &mut used, &part)?;
    }
    let place = |v: usize| {
        if used[v] { placed(mesh, fixed, &moves, v) } else { mesh.points()[v] }
    };
    let points = (0..used.len()).map(place).collect();
    context.tick(1.0)?;
    Ok(points)
}

/// Moves the vertices of the surface; tells which those are.
fn relax_surface(
    mesh: &Mesh,
    surface: &[[u32; 3]],
    known: &[[bool; 3]],
    moves: &mut [[f64; 3]],
    context: &Context,
) -> Result<Vec<bool>> {
    let weights = cotangent_weights(mesh.points(), surface, &context.stage("morph", 0.0, 0.25))?;
    match extend_harmonic(&weights, known, moves, &context.stage("morph", 0.25, 1.0)) {
        Err(error) if error.kind == ErrorKind::Internal => {
            let weights = positive_weights(mesh.points(), surface, &context.stage("morph", 1.0, 1.0))?;
            extend_harmonic(&weights, known, moves, &context.stage("morph", 1.0, 1.0))?;
        }
        done => done?,
    }
    Ok((0..weights.len()).map(|v| !weights.range(v).is_empty()).collect())
}

/// Moves the vertices of the volume that are not `used` by its surface, and adds them to `used`.
fn relax_inside(
    mesh: &Mesh,
    tetrahedra: &[[u32; 4]],
    known: &[[bool; 3]],
    moves: &mut [[f64; 3]],
    used: &mut [bool],
    context: &Context,
) -> Result<()> {
    let inner: Vec<bool> = used.iter().map(|&outer| !outer).collect();
    let part = context.stage("morph", 0.0, 0.5);
    let weights = mean_value_weights(mesh.points(), tetrahedra, &inner, &part)?;
    extend_harmonic(&weights, known, moves, &context.stage("morph", 0.5, 1.0))?;
    for (v, used) in used.iter_mut().enumerate() {
        *used |= !weights.range(v).is_empty();
    }
    Ok(())
}

/// By how much `fixed` moves vertex `v`; 0 where it says nothing.
fn prescribed(mesh: &Mesh, fixed: &[[Option<f64>; 3]], v: usize) -> [f64; 3] {
    std::array::from_fn(|k| fixed[v][k].map_or(0.0, |c| c - mesh.points()[v][k]))
}

/// Where vertex `v` ends.
fn placed(mesh: &Mesh, fixed: &[[Option<f64>; 3]], moves: &[[f64; 3]], v: usize) -> Point {
    let place = |k: usize| fixed[v][k].unwrap_or(mesh.points()[v][k] + moves[v][k]);
    Point::new(place(0), place(1), place(2))
}

/// Makes every coordinate of the vertices in `held` known.
fn hold(known: &mut [[bool; 3]], held: &[bool]) {
    for (known, _) in known.iter_mut().zip(held).filter(|(_, held)| **held) {
        *known = [true; 3];
    }
}

/// The boundary as triangles.
fn surface(mesh: &Mesh) -> Result<Vec<[u32; 3]>> {
    Ok(mesh.cells().boundary()?.iter().flat_map(Face::triangles).collect())
}

/// Whether the arguments can be used at all.
fn check(mesh: &Mesh, fixed: &[[Option<f64>; 3]]) -> Result<()> {
    if fixed.len() != mesh.points().len() {
        let message = format!("{} prescriptions for {} vertices", fixed.len(), mesh.points().len());
        return Err(Error::new(ErrorKind::Mismatch, message).remedy("give one for each vertex"));
    }
    let finite = |c: &Option<f64>| c.is_none_or(f64::is_finite);
    if let Some(v) = fixed.iter().position(|f| !f.iter().all(finite)) {
        return Err(
            Error::new(ErrorKind::Option, "its prescribed coordinate is not finite").at(Place::Vertex(v as u32))
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests;
