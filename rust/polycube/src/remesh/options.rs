//! How a shape is meshed.

use crate::align::Strategy;
use crate::error::Result;
use crate::measure::hausdorff::diagonal;
use crate::mesh::{CellKind, Mesh};
use crate::range::Range;
use crate::remesh::lattice::Size;
use crate::remesh::mesher::check_padding;
use crate::simplify;

/// How a shape is meshed.
#[derive(Clone, Debug, PartialEq)]
pub struct RemeshOptions {
    /// How the polycube is simplified; [`Strategy::Naive`](crate::align::Strategy::Naive) meshes it as it is. Of
    /// `scale` only [`size`](Self::size) is used where that is given. Without an objective it is padded blocks that
    /// count, unless only the surface is meshed. Unless the options say where on the front, how far corners may move,
    /// or how distorted the map may be, more blocks than the fewest are taken where those make poor hexahedra, and a
    /// note says so.
    pub simplify: simplify::SimplifyOptions,
    /// How fine the mesh shall be; by default as [`simplify::SimplifyOptions::scale`] says. More than a million
    /// hexahedra are made only where their number is given.
    pub size: Option<Size>,
    /// Layers of hexahedra between the polycube and the surface, 0 to 16; 1 by default.
    pub padding: usize,
    /// Leave the hexahedra out.
    pub surface_only: bool,
    /// The largest Hausdorff distance to accept, as a **fraction** of the bounding box's diagonal; 0.005 by default,
    /// half a percent. (The command and Python take percent.)
    pub max_hausdorff: f64,
}

impl Default for RemeshOptions {
    fn default() -> Self {
        Self {
            simplify: simplify::SimplifyOptions::default(),
            size: None,
            padding: 1,
            surface_only: false,
            max_hausdorff: 0.005,
        }
    }
}

impl RemeshOptions {
    /// Refuses what is out of its range. [`remesh`](super::remesh()) does so before anything else.
    ///
    /// # Errors
    /// [`ErrorKind::Option`](crate::ErrorKind::Option), which names the field.
    pub fn check(&self) -> Result<()> {
        Range::Positive.check("max_hausdorff", self.max_hausdorff)?;
        self.size.map_or(Ok(()), Size::check)?;
        check_padding(self.padding)?;
        self.simplify.check()
    }

    /// What is made: quadrilaterals for a surface alone, else hexahedra.
    pub(crate) fn cells(&self) -> CellKind {
        if self.surface_only { CellKind::Quads } else { CellKind::Hexahedra }
    }

    /// The largest distance to `shape` to accept, in its units.
    pub(crate) fn distance_bound(&self, shape: &Mesh) -> f64 {
        self.max_hausdorff * diagonal(shape)
    }

    /// Whether levels may lie where the shape wants them: not if the scale was given, the polycube is meshed as it is,
    /// or some facets have their places.
    pub(crate) fn has_flexible_levels(&self) -> bool {
        let sized = matches!(self.size, Some(Size::Hexes(_) | Size::EdgeLength(_)));
        sized && self.simplify.strategy != Strategy::Naive && self.simplify.guides.is_empty()
    }
}
