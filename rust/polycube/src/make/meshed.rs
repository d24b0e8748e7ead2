//! From a plain shape to its meshes.

use super::{Made, MakeOptions, make};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::remesh::{self, RemeshOptions, Remeshed};

/// The part of the progress that making the polycube takes.
const MAKING: f64 = 0.1;

/// Makes a polycube of a surface, simplifies it and meshes the surface with its blocks: [`make()`], then
/// [`remesh`](remesh::remesh()) of what was made. The total of its seconds has the making, too.
///
/// ```
/// use polycube::Context;
/// use polycube::generate::{Example, example};
/// use polycube::make::{self, MakeOptions};
/// use polycube::mesh::CellKind;
/// use polycube::remesh::{RemeshOptions, Size};
///
/// let (_, shape) = example(Example::SteppedL, 1, CellKind::Triangles)?;
/// let options = RemeshOptions { size: Some(Size::Hexes(400)), ..RemeshOptions::default() };
/// let (made, meshes) = make::remesh(&shape, &MakeOptions::default(), &options, &Context::default())?;
/// assert!(made.report.folded.is_empty());
/// assert_eq!(meshes.report.inverted, 0);
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// Those of [`make()`] and [`remesh`](remesh::remesh()), of which the latter name no place: it would be one of the
/// polycube, which the caller does not have. [`ErrorKind::Option`] for faces that must not move.
pub fn remesh(
    shape: &Mesh,
    making: &MakeOptions,
    options: &RemeshOptions,
    context: &Context,
) -> Result<(Made, Remeshed)> {
    options.check()?;
    if !options.simplify.guides.fixed_faces.is_empty() {
        return Err(Error::new(ErrorKind::Option, "faces cannot be locked before there is a polycube")
            .in_option("fixed_faces")
            .remedy("make one first, and lock faces of that"));
    }
    let made = make(shape, making, &context.stage("make", 0.0, MAKING))?;
    let meshes = remesh::remesh(&made.input(), options, &context.stage("remesh", MAKING, 1.0));
    let mut meshes = meshes.map_err(|error| Error { place: None, ..error })?;
    for report in [&mut meshes.simplified.report, &mut meshes.report.simplify] {
        report.note_repairs(&made.report.repairs);
    }
    meshes.report.set_seconds(meshes.report.seconds.total + made.report.seconds.total);
    Ok((made, meshes))
}
