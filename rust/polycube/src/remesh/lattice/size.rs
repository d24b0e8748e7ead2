//! The scale of the lattice for a wanted size of the mesh.

use super::keys::too_fine;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Point;
use crate::range::Range;
use crate::simplify::{Input, Simplified};
use crate::structure::{Arrangement, Structure, area_vector, placement_of};

/// How fine a mesh shall be.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Size {
    /// Lattice steps per unit of the input polycube, above 0.
    Scale(f64),
    /// Mean length of the mesh's edges in units of the shape, above 0.
    EdgeLength(f64),
    /// How many hexahedra there shall be, padding included; 1 to 536,870,911.
    Hexes(usize),
}

/// No mesh has more hexahedra, padding included: 32-bit numbers count their corners.
pub(crate) const MOST_HEXES: usize = (u32::MAX / 8) as usize;

/// More hexahedra, padding included, are made only where their number was asked for.
const MOST_UNASKED: u64 = 1_000_000;

impl Size {
    /// Refuses what no mesh can have.
    ///
    /// # Errors
    /// [`ErrorKind::Option`].
    pub(crate) fn check(self) -> Result<()> {
        match self {
            Self::Scale(scale) => Range::Positive.check("scale", scale),
            Self::EdgeLength(length) => Range::Positive.check("edge_length", length),
            Self::Hexes(0) => {
                Err(Error::new(ErrorKind::Option, "a mesh has at least one hexahedron").in_option("size"))
            }
            Self::Hexes(count) if count > MOST_HEXES => Err(too_many(count as u64)),
            Self::Hexes(_) => Ok(()),
        }
    }
}

fn too_many(count: u64) -> Error {
    too_fine(&format!("{count} hexahedra are more than this program can index, {MOST_HEXES}"))
}

/// Refuses levels whose lattice has more hexahedra than [`MOST_HEXES`], or than [`MOST_UNASKED`] unless these were
/// `asked_for`, before anything is made of them.
///
/// # Errors
/// [`ErrorKind::Option`].
pub(crate) fn check_count(simplified: &Simplified, padding: usize, asked_for: bool) -> Result<()> {
    let count = count_hexes(&simplified.input.structure, &simplified.levels, padding);
    if count > MOST_HEXES as u64 {
        return Err(too_many(count));
    }
    if asked_for || count <= MOST_UNASKED {
        return Ok(());
    }
    let message = format!("this lattice has {count} hexahedra, which takes minutes or more");
    Err(Error::new(ErrorKind::Option, message).in_option("size").remedy(format!(
        "ask for a longer edge length or a smaller scale; or for so many by their number, hexes = {count}"
    )))
}

/// A count within this part of the wanted one ends the search.
const CLOSE: f64 = 0.005;

/// The scale at which a simplified polycube gives meshes of the wanted `size`, for [`Simplified::rescaled`] or
/// [`SimplifyOptions::scale`](crate::SimplifyOptions::scale). The block structure is the same at every scale.
///
/// For [`Size::Hexes`] the scale is searched for until the count with `padding` layers is within half a percent of the
/// wanted one, or else the closest found is taken: levels are integers, so thin polycubes have few counts to choose
/// from, and there is a least count. Takes up to 40 placements of the levels, some milliseconds each.
///
/// # Errors
/// [`ErrorKind::Option`] for a size that is not positive and finite, or for more hexahedra than [`MOST_HEXES`];
/// those of [`align::rescale`](crate::align::rescale()).
pub(crate) fn scale_for(
    input: &Input,
    simplified: &Simplified,
    size: Size,
    padding: usize,
    context: &Context,
) -> Result<f64> {
    size.check()?;
    match size {
        Size::Scale(scale) => Ok(scale),
        Size::EdgeLength(length) => {
            let shape = input.shape.unwrap_or(input.polycube);
            let stretch = (area(simplified, shape.points()) / area(simplified, input.polycube.points())).sqrt();
            Ok(stretch / length)
        }
        Size::Hexes(count) => {
            let (structure, targets) = (&simplified.input.structure, &simplified.input.placement);
            let levels_at = &|scale: f64, context: &Context| simplified.levels_at(targets, scale, context);
            ScaleSearch { structure, targets, levels_at, padding, wanted: count as f64 }.run(context)
        }
    }
}

/// How many hexahedra the lattice has with `padding` layers, when the levels of a valid polycube lie at `levels`.
pub(crate) fn count_hexes(structure: &Structure, levels: &[i64], padding: usize) -> u64 {
    let placement = placement_of(levels);
    let arrangement = Arrangement::new(structure, &placement);
    let (volume, surface) = volume_and_surface(&arrangement);
    (volume + padding as f64 * surface) as u64
}

/// Volume and surface of a polycube, by the divergence theorem along X.
fn volume_and_surface(arrangement: &Arrangement) -> (f64, f64) {
    let label = |facet: u32| arrangement.structure().facets[facet as usize].label;
    let tiles = arrangement.tiles().map(|(facet, low, high)| {
        let (u, v) = ((label(facet).axis() + 1) % 3, (label(facet).axis() + 2) % 3);
        let area = (high[u] - low[u]) * (high[v] - low[v]);
        let height = if label(facet).axis() == 0 { f64::from(label(facet).sign()) * low[0] } else { 0.0 };
        (area * height, area)
    });
    tiles.fold((0.0, 0.0), |sum, t| (sum.0 + t.0, sum.1 + t.1))
}

fn area(simplified: &Simplified, points: &[Point]) -> f64 {
    simplified.input.surface.faces().iter().map(|f| area_vector(points, f).norm() / 2.0).sum()
}

/// Looks for the scale of a wanted count.
pub(crate) struct ScaleSearch<'a> {
    pub(crate) structure: &'a Structure,
    /// Where the levels should lie, up to the scale.
    pub(crate) targets: &'a [f64],
    /// The levels at a scale.
    pub(crate) levels_at: &'a dyn Fn(f64, &Context) -> Result<Vec<i64>>,
    pub(crate) padding: usize,
    pub(crate) wanted: f64,
}

impl ScaleSearch<'_> {
    const STEPS: usize = 40;

    /// Brackets the wanted count around the scale at which it would be right for real coordinates, and bisects.
    pub(crate) fn run(&self, context: &Context) -> Result<f64> {
        let guess = self.guess();
        let (mut low, mut high) = (guess / 16.0, guess * 2.0);
        let mut scale = guess;
        let mut best = (f64::INFINITY, guess);
        for step in 0..Self::STEPS {
            context.tick(step as f64 / Self::STEPS as f64)?;
            let error = libm::log(self.count(scale, context)? / self.wanted);
            if error.abs() < best.0 {
                best = (error.abs(), scale);
            }
            if best.0 < CLOSE || high / low < 1.0 + 1e-9 {
                break;
            }
            if error > 0.0 {
                high = scale
            } else {
                low = scale
            }
            // Close to a jump of the count both ends stay; the middle of the logarithms halves the rest.
            let next = scale * libm::exp(-error / 3.0);
            let inside = step < 4 && low < next && next < high;
            scale = if inside { next } else { (low * high).sqrt() };
        }
        Ok(best.1)
    }

    fn count(&self, scale: f64, context: &Context) -> Result<f64> {
        let levels = (self.levels_at)(scale, context)?;
        Ok((count_hexes(self.structure, &levels, self.padding) as f64).max(0.5))
    }

    /// The root of `volume s³ + padding · surface s² = wanted`.
    fn guess(&self) -> f64 {
        let (volume, surface) = volume_and_surface(&Arrangement::new(self.structure, self.targets));
        let count = |s: f64| volume * s * s * s + self.padding as f64 * surface * s * s;
        let (mut low, mut high) = (0.0, libm::cbrt(self.wanted / volume));
        for _ in 0..100 {
            let middle = f64::midpoint(low, high);
            if count(middle) < self.wanted { low = middle } else { high = middle }
        }
        high
    }
}
