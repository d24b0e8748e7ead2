//! What `simplify` writes beside the mesh: `report.json` and `structure.json`.

use super::front::Point;
use polycube::align::{Effort, Guides, SolverKind};
use polycube::layout::Objective;
use polycube::make::{MakeOptions, MakeReport};
use polycube::remesh::{RemeshOptions, RemeshReport, Size};
use polycube::simplify::{Simplified, SimplifyOptions, SimplifyReport};
use polycube::structure::{Arrangement, Edge, Facet, Tolerance, placement_of};
use serde::Serialize;

/// The files a run read, as they were named.
#[derive(Clone, Debug, Serialize)]
pub struct Files {
    /// The polycube; nothing where one was made.
    pub polycube: Option<String>,
    /// The shape it was deformed from.
    pub shape: Option<String>,
    /// The label file.
    pub labels: Option<String>,
    /// The file of groups of the boundary, where one was named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub groups: Option<String>,
}

/// `report.json` of `make`.
#[derive(Debug, Serialize)]
pub struct MakeRun<'a> {
    /// The shape, as it was named.
    pub input: &'a str,
    /// The label file of the shape.
    pub labels: Option<String>,
    /// How the polycube was made; nothing where labels said how.
    pub options: Option<MakeOptions>,
    /// What came out.
    #[serde(flatten)]
    pub report: &'a MakeReport,
}

/// `report.json`.
#[derive(Debug, Serialize)]
pub struct RunReport<'a> {
    /// What was read.
    pub input: &'a Files,
    /// How it was asked to be done; the strategy is below.
    pub options: OptionsUsed,
    /// The name of the simplified polycube in the output folder; nothing if there is no valid one.
    pub output: Option<&'a str>,
    /// What was done.
    #[serde(flatten)]
    pub report: &'a SimplifyReport,
    /// The points of the front, measured, with `--pareto`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pareto: Option<&'a [Point]>,
    /// Where a naive rounding broke the polycube.
    pub broken: &'a [Broken],
}

/// `report.json` of `remesh`.
#[derive(Debug, Serialize)]
pub struct RemeshRun<'a> {
    /// What was read.
    pub input: &'a Files,
    /// How it was asked to be done; the strategy is below.
    pub options: RemeshOptionsUsed,
    /// The name of the polycube in the output folder.
    pub output: &'a str,
    /// What was done and how good it is.
    #[serde(flatten)]
    pub report: &'a RemeshReport,
}

/// The options that the library's report of a remeshing does not repeat.
#[derive(Clone, Debug, Serialize)]
pub struct RemeshOptionsUsed {
    #[serde(flatten)]
    simplify: OptionsUsed,
    size: Option<Size>,
    surface_only: bool,
    max_hausdorff: f64,
}

impl From<&RemeshOptions> for RemeshOptionsUsed {
    fn from(options: &RemeshOptions) -> Self {
        let RemeshOptions { simplify, size, surface_only, max_hausdorff, .. } = options.clone();
        Self { simplify: simplify.into(), size, surface_only, max_hausdorff }
    }
}

/// The options as they were asked for, but for the strategy; with the default of the objective.
#[derive(Clone, Debug, Serialize)]
pub struct OptionsUsed {
    /// The scale asked for; the one used is in the library's report.
    scale: Option<f64>,
    /// Nothing: for `remesh`, the fewest blocks whose hexahedra are good.
    simplicity: Option<f64>,
    lambda_min: f64,
    solver: SolverKind,
    objective: Option<Objective>,
    effort: Effort,
    tolerance: Tolerance,
    max_displacement: Option<f64>,
    max_distortion: Option<f64>,
    guides: Guides,
}

impl From<SimplifyOptions> for OptionsUsed {
    fn from(options: SimplifyOptions) -> Self {
        let SimplifyOptions { scale, simplicity, lambda_min, solver, objective, effort, tolerance, .. } = options;
        let SimplifyOptions { max_displacement, max_distortion, guides, .. } = options;
        Self {
            scale,
            simplicity,
            lambda_min,
            solver,
            objective,
            effort,
            tolerance,
            max_displacement,
            max_distortion,
            guides,
        }
    }
}

/// A place where the rounded surface touches or crosses itself.
#[derive(Clone, Debug, Serialize)]
pub struct Broken {
    /// The two facets, numbered as in `structure.json`.
    facets: [u32; 2],
    /// Where they meet, in lattice units.
    point: [f64; 3],
}

/// `structure.json`.
#[derive(Debug, Serialize)]
pub struct StructureFile<'a> {
    /// Whether `after` is a valid polycube.
    valid: bool,
    /// Lattice steps per unit of the input.
    scale: f64,
    levels: Vec<LevelRow>,
    corners: Vec<CornerRow>,
    edges: &'a [Edge],
    facets: &'a [Facet],
    broken: &'a [Broken],
}

/// A level before, in units of the input, and after, in lattice units.
#[derive(Debug, Serialize)]
struct LevelRow {
    axis: usize,
    before: f64,
    after: i64,
}

/// A corner and its positions before, in units of the input, and after, in lattice units.
#[derive(Debug, Serialize)]
struct CornerRow {
    vertex: u32,
    valence: u32,
    levels: [u32; 3],
    before: [f64; 3],
    after: [i64; 3],
}

impl<'a> StructureFile<'a> {
    /// Collects the structure and its two placements.
    pub fn new(result: &'a Simplified, broken: &'a [Broken]) -> Self {
        let (structure, before) = (&result.input.structure, &result.input.placement);
        let levels = structure.levels.iter().zip(before).zip(&result.levels);
        let corner = |(i, c): (u32, &polycube::structure::Corner)| CornerRow {
            vertex: c.vertex,
            valence: c.valence,
            levels: c.levels,
            before: structure.position(i, before),
            after: c.levels.map(|l| result.levels[l as usize]),
        };
        Self {
            valid: result.report.valid,
            scale: result.report.scale,
            levels: levels.map(|((l, &before), &after)| LevelRow { axis: l.axis, before, after }).collect(),
            corners: (0..).zip(&structure.corners).map(corner).collect(),
            edges: &structure.edges,
            facets: &structure.facets,
            broken,
        }
    }
}

/// Everything that is wrong with a result that is not valid.
pub fn broken(result: &Simplified) -> Vec<Broken> {
    if result.report.valid {
        return Vec::new();
    }
    let levels = placement_of(&result.levels);
    let conflicts = Arrangement::new(&result.input.structure, &levels).conflicts();
    conflicts.into_iter().map(|c| Broken { facets: c.facets, point: c.point }).collect()
}
