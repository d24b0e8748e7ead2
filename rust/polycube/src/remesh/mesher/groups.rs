//! The names that parts of a hexahedral mesh have in files for solvers.

use super::carried::carry_groups;
use super::hexes::Hexes;
use crate::error::Result;
use crate::mesh::{GroupedHexes, GroupedSurface, Groups, Mesh};
use crate::remesh::lattice::BoundaryFace;
use crate::structure::Label;

impl Hexes {
    /// The mesh with the names of its parts; see [`grouped`].
    ///
    /// # Errors
    /// Those of [`grouped`], where the fields were changed.
    pub fn grouped(&self) -> Result<GroupedHexes<'_>> {
        grouped(&self.mesh, &self.block_id, &self.boundary)
    }

    /// The mesh with the groups of a `surface` that it lies on, most often its shape, in place of facets and
    /// directions; see [`grouped_by`].
    ///
    /// # Errors
    /// Those of [`grouped_by`], where the fields were changed.
    pub fn grouped_by(&self, surface: &GroupedSurface) -> Result<GroupedHexes<'_>> {
        let patches = carry_groups(surface, &self.mesh, &self.boundary)?;
        grouped_by(&self.mesh, &self.block_id, &self.boundary, patches)
    }
}

/// Hexahedra with names for what solvers ask for: `block_0`, `block_1` … for the blocks that `block_id` tells of each;
/// on the outside `facet_0`, `facet_1` … for the facets of the polycube, and `minus_x`, `plus_x`, `minus_y`, `plus_y`,
/// `minus_z` and `plus_z` for all facets that look that way on the polycube. O(n log n) for n hexahedra.
///
/// ```
/// use polycube::generate::{Example, example};
/// use polycube::mesh::{CellKind, SolverFormat, write_solver_bytes};
/// use polycube::remesh::{RemeshOptions, Size, remesh};
/// use polycube::{Context, Input};
///
/// let (cube, shape) = example(Example::SteppedL, 1, CellKind::Quads)?;
/// let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
/// let options = RemeshOptions { size: Some(Size::Hexes(400)), ..RemeshOptions::default() };
/// let hexes = remesh(&input, &options, &Context::default())?.hexes.expect("not of the surface alone");
///
/// let files = write_solver_bytes(SolverFormat::Msh, "hexes", &hexes.grouped()?)?;
/// assert_eq!(files[0].0, "hexes.msh");
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// Those of [`GroupedHexes::new`].
pub fn grouped<'a>(mesh: &'a Mesh, block_id: &[u32], boundary: &[BoundaryFace]) -> Result<GroupedHexes<'a>> {
    let faces = boundary.iter().map(|side| side.face).collect();
    let facets = boundary.iter().map(|side| side.facet).collect();
    let sides = boundary.iter().map(|side| number(side.label)).collect();
    let names = ["minus_x", "plus_x", "minus_y", "plus_y", "minus_z", "plus_z"].map(str::to_owned);
    let blocks = Groups::numbered("block", block_id.to_vec())?;
    let sides = Groups::new(names.to_vec(), sides)?;
    GroupedHexes::new(mesh, blocks, faces, Groups::numbered("facet", facets)?, sides)
}

/// Hexahedra with blocks named as by [`grouped`], whose faces on the outside, in the order of `boundary`, are in
/// `patches`, as [`carry_groups`] gives them. Block structures, as JSON and blockMesh have them, want every
/// face of a block in one patch: for those take [`grouped`]. O(n log n) for n hexahedra.
///
/// # Errors
/// Those of [`GroupedHexes::new`].
pub fn grouped_by<'a>(
    mesh: &'a Mesh,
    block_id: &[u32],
    boundary: &[BoundaryFace],
    patches: Groups,
) -> Result<GroupedHexes<'a>> {
    let faces = boundary.iter().map(|side| side.face).collect();
    GroupedHexes::new(mesh, Groups::numbered("block", block_id.to_vec())?, faces, patches.clone(), patches)
}

/// The number of a direction's name.
fn number(label: Label) -> u32 {
    2 * label.axis() as u32 + u32::from(label.sign() > 0)
}
