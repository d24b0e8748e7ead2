//! What every function of this part needs of a mesh.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Mesh;

/// Fails unless every point is finite and every vertex index below the number of points.
pub(crate) fn check_mesh(mesh: &Mesh) -> Result<()> {
    let finite = |p: &crate::mesh::Point| p.coords.iter().all(|c| c.is_finite());
    if let Some(v) = mesh.points.iter().position(|p| !finite(p)) {
        return Err(Error::new(ErrorKind::Mesh, "its position is not finite")
            .at(Place::Vertex(v as u32))
            .remedy("remove NaN and infinite coordinates"));
    }
    let outside = |&v: &u32| v as usize >= mesh.points.len();
    match (0..mesh.cells.len()).find(|&i| mesh.cells.cell(i).iter().any(outside)) {
        None => Ok(()),
        Some(i) => {
            Err(Error::new(ErrorKind::Mesh, format!("it uses a vertex beyond the last of {}", mesh.points.len()))
                .at(Place::Cell(i as u32)))
        }
    }
}
