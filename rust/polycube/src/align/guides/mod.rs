//! What the user wants to stay: facets that must not move, that must or must not align, and planes of symmetry.

mod mirror;
mod reflect;
mod resolved;
mod start;

pub(super) use mirror::symmetries;
pub(super) use resolved::Guided;
pub(super) use start::{guided_start, is_valid};

use crate::structure::Polycube;

/// What the alignment must respect, by facets as [`Structure::facets`](crate::structure::Structure::facets) and
/// `structure.json` number them. By default nothing.
///
/// Every strategy respects all of it, or says with an error why it cannot.
///
/// ```
/// use polycube::generate::{Example, example};
/// use polycube::align::{Guides, Symmetry};
/// use polycube::mesh::CellKind;
/// use polycube::simplify::simplify;
/// use polycube::{Context, Input, Options};
///
/// // Seed 0: every part of the example is where symmetry has it.
/// let (cube, shape) = example(Example::CubeSpikes, 0, CellKind::Quads)?;
/// let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
/// let mut guides = Guides { symmetry: vec![Symmetry { axis: 0, at: 0.0 }], ..Guides::default() };
/// let plain = simplify(&input, &Options::default(), &Context::default())?;
/// // The facet that holds the first boundary face must not move: what a host has as a selection.
/// guides.fix_faces(&plain.input, &[0]);
///
/// let guided = simplify(&input, &Options { guides, ..Options::default() }, &Context::default())?;
/// assert!(guided.report.valid);
/// # Ok::<(), polycube::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Guides {
    /// Facets that must not move: the plane of each lies where the input has it, times the scale, rounded to the lattice. All
    /// other facets find their places around them. Two that mirror each other about a plane of [`Guides::symmetry`] are an error
    /// ([`ErrorKind::Infeasible`](crate::ErrorKind::Infeasible)) where rounding leaves no such plane on the lattice.
    pub fixed: Vec<usize>,
    /// Groups of facets of one axis that must lie in one plane.
    pub together: Vec<Vec<usize>>,
    /// Pairs of facets that must not lie in one plane.
    pub apart: Vec<[usize; 2]>,
    /// Planes of symmetry to keep.
    pub symmetry: Vec<Symmetry>,
}

/// A plane that the input is symmetric about. Facets that mirror each other in the input do so in the result, about a plane
/// within one lattice step of this one.
///
/// The input need not be exact: every corner must have a mirror image within a quarter of the shortest edge, and edges
/// and facets must correspond.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Symmetry {
    /// The axis that the plane is perpendicular to: 0, 1 or 2 for X, Y or Z.
    pub axis: usize,
    /// Where it cuts this axis, in units of the input.
    pub at: f64,
}

impl Guides {
    /// Whether nothing is asked for.
    pub fn is_empty(&self) -> bool {
        self.fixed.is_empty() && self.together.is_empty() && self.apart.is_empty() && self.symmetry.is_empty()
    }

    /// Locks the facets that hold these boundary faces, numbered as [`Cells::boundary`](crate::mesh::Cells::boundary) has
    /// them (for a surface these are its cells). Faces that do not exist are passed over.
    pub fn fix_faces(&mut self, polycube: &Polycube, faces: &[usize]) {
        self.fixed.extend(faces.iter().filter_map(|&f| polycube.facet_of_face.get(f)).map(|&f| f as usize));
        self.fixed.sort_unstable();
        self.fixed.dedup();
    }
}
