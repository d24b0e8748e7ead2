//! What the simplification is worth: one shape meshed without and with it (paper, tables 1 and 2).

use crate::align::Strategy;
use crate::context::Context;
use crate::error::Result;
use crate::layout::Counts;
use crate::mesh::Mesh;
use crate::remesh::{RemeshOptions, Remeshed, Size, Stages, count_hexes, remesh};
use crate::simplify::{Input, Note};

/// A shape meshed twice.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Comparison {
    /// From the polycube as it came, its levels rounded to the lattice.
    pub without: Meshing,
    /// From the simplified polycube, with about as many elements.
    pub with: Meshing,
    /// What that saves.
    pub gain: Gain,
}

/// How coarse and how good a mesh is.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Meshing {
    /// How the levels found their places.
    pub strategy: Strategy,
    /// Number of hexahedra; 0 for a surface alone.
    pub hexes: usize,
    /// Number of quadrilaterals on the surface.
    pub quads: usize,
    /// Hexahedra whose scaled Jacobian is not positive.
    pub inverted: usize,
    /// Smallest scaled Jacobian; nothing without hexahedra.
    pub min_sj: Option<f64>,
    /// Mean scaled Jacobian; nothing without hexahedra.
    pub avg_sj: Option<f64>,
    /// Largest ratio of a cell's longest to its shortest edge; nothing without hexahedra.
    pub max_edge_ratio: Option<f64>,
    /// Least determinant of a corner over the mean of all; nothing without hexahedra.
    pub min_determinant: Option<f64>,
    /// Largest non-orthogonality of a face, in degrees; nothing without hexahedra.
    pub max_non_orthogonality: Option<f64>,
    /// Largest skewness of a face; nothing without hexahedra.
    pub max_skewness: Option<f64>,
    /// Vertices of the quadrilaterals at which other than four meet.
    pub singular_vertices: usize,
    /// Patches and blocks.
    #[serde(flatten)]
    pub counts: Counts,
    /// Hausdorff distance between the quadrilaterals and the shape, in units of the shape.
    pub hausdorff: f64,
    /// The same in percent of the diagonal of the shape's bounding box.
    pub hausdorff_percent: f64,
    /// Time spent in each stage, in seconds.
    pub seconds: Stages,
    /// What was not possible or not as asked, in plain words.
    pub notes: Vec<Note>,
}

/// By how much counts went down, in percent of what they were; negative where they went up.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Gain {
    /// Patches on the surface.
    pub surface_patches: f64,
    /// Blocks without padding.
    pub blocks: f64,
    /// Blocks with padding.
    pub blocks_padded: f64,
}

/// Meshes a shape without and with simplification and compares the two (paper, section 7).
///
/// Without simplification every level is rounded to the lattice, as usual pipelines do (`Strategy::Naive`); where that
/// breaks the polycube, the levels keep the order they have and a note says so. `options.size` says how fine that mesh
/// is. The other one follows `options` but for the size: it has as many hexahedra as the first as nearly as the lattice
/// allows (see `scale_for`, so that the two compare.
///
/// ```
/// use polycube::compare::compare;
/// use polycube::generate::{Example, example};
/// use polycube::mesh::CellKind;
/// use polycube::remesh::RemeshOptions;
/// use polycube::{Context, Input};
///
/// let (cube, shape) = example(Example::CubeSpikes, 1, CellKind::Quads)?;
/// let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
/// let options = RemeshOptions { surface_only: true, ..RemeshOptions::default() };
/// let found = compare(&input, &options, &Context::default())?;
///
/// println!("{} patches instead of {}", found.with.counts.surface_patches, found.without.counts.surface_patches);
/// assert!(found.gain.surface_patches > 0.0);
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// Those of [`remesh`], from either; [`ErrorKind::Cancelled`](crate::ErrorKind::Cancelled).
pub fn compare(input: &Input, options: &RemeshOptions, context: &Context) -> Result<Comparison> {
    let mut plain = options.clone();
    plain.simplify.strategy = Strategy::Naive;
    let without = remesh(input, &plain, &context.stage("without", 0.0, 0.5))?;
    let found = &without.simplified;
    let cells = count_hexes(&found.input.structure, &found.levels, options.padding);
    let simplifying = RemeshOptions { size: Some(Size::Hexes(cells as usize)), ..options.clone() };
    let with = remesh(input, &simplifying, &context.stage("with", 0.5, 1.0))?;
    let [without, with] = [without, with].map(|r| Meshing::new(&r));
    let gain = Gain::new(&without.counts, &with.counts);
    Ok(Comparison { without, with, gain })
}

impl Meshing {
    fn new(result: &Remeshed) -> Self {
        let report = &result.report;
        let simplified = &report.simplify;
        let measures = report.measures.as_ref();
        Self {
            strategy: simplified.strategy,
            hexes: report.hexes,
            quads: report.quads,
            inverted: report.inverted,
            min_sj: report.min_sj,
            avg_sj: report.avg_sj,
            max_edge_ratio: measures.map(|m| m.edge_ratio.max),
            min_determinant: measures.map(|m| m.determinant.min),
            max_non_orthogonality: measures.map(|m| m.non_orthogonality.max),
            max_skewness: measures.map(|m| m.skewness.max),
            singular_vertices: singular_vertices(&result.quads.mesh),
            counts: simplified.after.unwrap_or(simplified.before),
            hausdorff: report.hausdorff,
            hausdorff_percent: report.hausdorff_percent,
            seconds: report.seconds,
            notes: simplified.notes.clone(),
        }
    }
}

impl Gain {
    fn new(before: &Counts, after: &Counts) -> Self {
        let percent = |b: usize, a: usize| if b == 0 { 0.0 } else { 100.0 * (b as f64 - a as f64) / b as f64 };
        Self {
            surface_patches: percent(before.surface_patches, after.surface_patches),
            blocks: percent(before.blocks, after.blocks),
            blocks_padded: percent(before.blocks_padded, after.blocks_padded),
        }
    }
}

/// Vertices of a closed quadrilateral mesh at which other than four cells meet.
fn singular_vertices(quads: &Mesh) -> usize {
    let mut valence = vec![0_u32; quads.points().len()];
    for &v in (0..quads.cells().len()).flat_map(|i| quads.cells().cell(i)) {
        valence[v as usize] += 1;
    }
    valence.iter().filter(|&&n| n != 0 && n != 4).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use crate::generate::{Example, example};
    use crate::mesh::CellKind;

    #[test]
    fn the_published_counts_of_the_cube_with_spikes() {
        let (polycube, shape) = example(Example::CubeSpikes, 1, CellKind::Triangles).unwrap();
        let input = Input { polycube: &polycube, shape: Some(&shape), labels: None };
        let options = RemeshOptions { surface_only: true, ..RemeshOptions::default() };
        let found = compare(&input, &options, &Context::default()).unwrap();
        // Paper, table 2: 56 singular vertices in both, and 78 domains, which is the optimum.
        assert_eq!((found.without.singular_vertices, found.with.singular_vertices), (56, 56));
        assert_eq!(found.with.counts, Counts { surface_patches: 78, blocks: 33, blocks_padded: 111 });
        let before = found.without.counts.surface_patches as f64;
        assert!((found.gain.surface_patches - 100.0 * (1.0 - 78.0 / before)).abs() < 1e-9);
        assert!(found.gain.surface_patches > 0.0);
        let ratio = found.with.quads as f64 / found.without.quads as f64;
        assert!((0.75..1.25).contains(&ratio), "{ratio}");
        assert_eq!((found.with.hexes, found.with.min_sj), (0, None));
    }

    #[test]
    fn both_meshes_have_about_as_many_hexahedra() {
        let (polycube, shape) = example(Example::SteppedL, 1, CellKind::Tetrahedra).unwrap();
        let input = Input { polycube: &polycube, shape: Some(&shape), labels: None };
        // So few cannot be near to the shape, and no other blocks are looked for in vain.
        let options = RemeshOptions { size: Some(Size::Hexes(300)), max_hausdorff: 1.0, ..RemeshOptions::default() };
        let Comparison { without, with, gain } = compare(&input, &options, &Context::default()).unwrap();
        let ratio = with.hexes as f64 / without.hexes as f64;
        assert!((0.75..1.25).contains(&ratio), "{} and {}", without.hexes, with.hexes);
        assert_eq!((without.strategy, with.strategy), (Strategy::Naive, Strategy::Best));
        assert!(with.min_sj > Some(0.0) && with.avg_sj >= with.min_sj && with.inverted == 0);
        let saved = without.counts.blocks_padded as f64 - with.counts.blocks_padded as f64;
        assert!((gain.blocks_padded * without.counts.blocks_padded as f64 - 100.0 * saved).abs() < 1e-9);
    }

    #[test]
    fn cancelling_stops_it() {
        let (polycube, _) = example(Example::SteppedL, 1, CellKind::Triangles).unwrap();
        let input = Input { polycube: &polycube, shape: None, labels: None };
        let context = Context::default();
        context.cancel();
        let found = compare(&input, &RemeshOptions::default(), &context);
        assert_eq!(found.unwrap_err().kind, ErrorKind::Cancelled);
    }
}
