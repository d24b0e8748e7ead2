//! What the user wants to stay: facets that must not move, that must or must not align, and planes of symmetry.

mod mirror;
mod reflect;
mod resolved;

pub(super) use mirror::symmetries;
pub(super) use resolved::Guided;

use crate::error::{Error, ErrorKind, Place, Result};
use crate::structure::{Label, Polycube};
use std::collections::BTreeSet;

/// What the alignment must respect: facets as [`Structure::facets`](crate::structure::Structure::facets) and
/// `structure.json` number them, or faces and labels that say which facets are meant. By default nothing.
///
/// Every strategy respects all of it, or says with an error why it cannot.
///
/// ```
/// use polycube::generate::{Example, example};
/// use polycube::align::{Guides, Symmetry};
/// use polycube::mesh::CellKind;
/// use polycube::simplify::simplify;
/// use polycube::{Context, Input, SimplifyOptions};
///
/// // Seed 0: every part of the example is where symmetry has it.
/// let (cube, shape) = example(Example::CubeSpikes, 0, CellKind::Quads)?;
/// let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
/// // The facet that holds the first boundary face must not move: what a host has as a selection.
/// let guides = Guides { fixed_faces: vec![0], symmetry: vec![Symmetry { axis: 0, at: 0.0 }], ..Guides::default() };
///
/// let guided = simplify(&input, &SimplifyOptions { guides, ..SimplifyOptions::default() }, &Context::default())?;
/// assert!(guided.report.valid);
/// # Ok::<(), polycube::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize, bitcode::Encode, bitcode::Decode)]
#[serde(default, deny_unknown_fields)]
pub struct Guides {
    /// Facets that must not move: the plane of each lies where the input has it, times the scale, rounded to the
    /// lattice. All other facets find their places around them. Two that mirror each other about a plane of
    /// [`Guides::symmetry`] are an error ([`ErrorKind::Infeasible`]) where rounding leaves no such plane
    /// on the lattice.
    pub fixed: Vec<usize>,
    /// Boundary faces whose facets must not move, numbered as [`Cells::boundary`](crate::mesh::Cells::boundary) has
    /// them (for a surface these are its cells).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fixed_faces: Vec<usize>,
    /// Labels, 0 to 5 for +X −X +Y −Y +Z −Z, all of whose facets must not move.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fixed_labels: Vec<i8>,
    /// Groups of facets of one axis that must lie in one plane.
    pub together: Vec<Vec<usize>>,
    /// Pairs of facets that must not lie in one plane.
    pub apart: Vec<[usize; 2]>,
    /// Planes of symmetry to keep.
    pub symmetry: Vec<Symmetry>,
}

/// A plane that the input is symmetric about. Facets that mirror each other in the input do so in the result, about a
/// plane within one lattice step of this one.
///
/// The input need not be exact: every corner must have a mirror image within a quarter of the shortest edge, and edges
/// and facets must correspond.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize, bitcode::Encode, bitcode::Decode)]
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
        *self == Self::default()
    }

    /// The same with the facets of faces and labels among those that must not move.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for a face that does not exist and a number that is no label.
    pub(crate) fn by_facets(&self, polycube: &Polycube) -> Result<Self> {
        let of_faces: BTreeSet<usize> =
            self.fixed_faces.iter().map(|&f| facet_of(polycube, f)).collect::<Result<_>>()?;
        let labels: Vec<Label> = self.fixed_labels.iter().map(|&l| label(l)).collect::<Result<_>>()?;
        let facets = polycube.structure.facets.iter().enumerate();
        let of_labels = facets.filter(|(_, f)| labels.contains(&f.label)).map(|(i, _)| i);
        let fixed = self.fixed.iter().copied().chain(of_faces).chain(of_labels).collect();
        Ok(Self { fixed, fixed_faces: Vec::new(), fixed_labels: Vec::new(), ..self.clone() })
    }
}

fn facet_of(polycube: &Polycube, face: usize) -> Result<usize> {
    let facets = &polycube.facet_of_face;
    facets.get(face).map(|&facet| facet as usize).ok_or_else(|| {
        let message = format!("the guides name this face, but there are only {} boundary faces", facets.len());
        Error::new(ErrorKind::Option, message)
            .at(Place::Face(u32::try_from(face).unwrap_or(u32::MAX)))
            .in_option("guides")
            .remedy("give boundary faces from 0 on")
    })
}

fn label(number: i8) -> Result<Label> {
    Label::new(number).ok_or_else(|| {
        Error::new(ErrorKind::Option, format!("there is no label {number}"))
            .in_option("guides")
            .remedy("give numbers from 0 to 5, for +X -X +Y -Y +Z -Z")
    })
}
