//! What a remeshing did and how good its meshes are.

use crate::context::Context;
use crate::error::Result;
use crate::measure::hausdorff::{diagonal, hausdorff};
use crate::measure::{BARS, MeasureSummary, Quality, base_complex, cell_qualities, statistics};
use crate::mesh::{CellKind, Mesh};
use crate::remesh::meshed::Meshed;
use crate::remesh::mesher::Hexes;
use crate::remesh::options::RemeshOptions;
use crate::remesh::select::TriedPoint;
use crate::remesh::stages::Stages;
use crate::simplify::{self, Note, Simplified};

/// More cells than this are not advised.
const MOST_ADVISED: f64 = 1e7;
/// How many inverted hexahedra are named one by one.
pub(super) const MOST_LISTED: usize = 1000;

/// What was done, for people and programs: what [`simplify::SimplifyReport`] says and how good the meshes are.
#[derive(Clone, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct RemeshReport {
    /// What the simplification did, with the seconds of all stages of the remeshing. Scale, displacement and distortion
    /// are those on the even lattice, also where the levels were [`spaced`](Self::spaced) after that.
    #[serde(flatten)]
    pub simplify: simplify::SimplifyReport,
    /// Whether the levels were spaced by the shape: as many lattice steps between two as its edges there are long. A
    /// lattice step is then no fixed length on the polycube.
    pub spaced: bool,
    /// The points of the front that were meshed, from the fewest blocks on; nothing without a front.
    pub tried: Vec<TriedPoint>,
    /// Number of quadrilaterals.
    pub quads: usize,
    /// Quadrilaterals whose scaled Jacobian is not positive.
    pub inverted_quads: usize,
    /// For a surface alone: how many triangles of its map onto the polycube are turned over, where more than one in a
    /// thousand is; 0 otherwise. Quadrilaterals around them lie wrong.
    pub folded: usize,
    /// Number of hexahedra; 0 for a surface alone.
    pub hexes: usize,
    /// Blocks of the base complex of the hexahedra, counted on the finished mesh.
    pub hex_blocks: usize,
    /// Padding layers.
    pub padding: usize,
    /// Vertices that left corners and edges of the polycube, where hexahedra were inverted otherwise; they lie on the
    /// shape.
    pub released: usize,
    /// Hexahedra whose scaled Jacobian is not positive.
    pub inverted: usize,
    /// The first thousand of those: number and middle.
    pub inverted_cells: Vec<InvertedCell>,
    /// Smallest scaled Jacobian; nothing without hexahedra.
    pub min_sj: Option<f64>,
    /// Mean scaled Jacobian; nothing without hexahedra.
    pub avg_sj: Option<f64>,
    /// Hexahedra by scaled Jacobian, see [`Statistics`](crate::measure::Statistics).
    pub histogram: [u32; BARS],
    /// What solvers look at: `edge_ratio`, `determinant`, `non_orthogonality` and `skewness`; nothing without
    /// hexahedra.
    #[serde(flatten)]
    pub measures: Option<MeasureSummary>,
    /// Volume of the hexahedra, in cubed units of the shape.
    pub volume: f64,
    /// Hausdorff distance between the quadrilaterals and the shape, in units of the shape.
    pub hausdorff: f64,
    /// The same in percent of the diagonal of the shape's bounding box.
    pub hausdorff_percent: f64,
    /// The bound asked for, as a part of that diagonal.
    #[serde(skip)]
    pub max_hausdorff: f64,
    /// Whether that is within the bound asked for.
    pub within_hausdorff: bool,
    /// Time spent in the stages of remeshing, in seconds; files have those in [`simplify`](Self::simplify).
    #[serde(skip)]
    pub seconds: Stages,
}

/// A hexahedron that is not the right way round.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, bitcode::Encode, bitcode::Decode)]
pub struct InvertedCell {
    /// Its number, from 0.
    pub cell: usize,
    /// Its scaled Jacobian.
    pub scaled_jacobian: f64,
    /// The mean of its vertices.
    pub at: [f64; 3],
}

/// Judges the meshes.
pub(crate) fn measure(
    simplified: &Simplified,
    meshed: &Meshed,
    shape: &Mesh,
    options: &RemeshOptions,
    seconds: Stages,
    context: &Context,
) -> Result<RemeshReport> {
    let start = std::time::Instant::now();
    let distance = hausdorff(&meshed.quads.mesh, shape, &context.stage("hausdorff", 0.0, 0.8))?;
    let counting = context.stage("count", 0.8, 1.0);
    counting.tick(0.0)?;
    let diagonal = diagonal(shape);
    let none = Vec::new();
    let qualities = meshed.hexes.as_ref().map_or(Ok(none), |h| cell_qualities(&h.mesh))?;
    let found = statistics(&qualities);
    let some = meshed.hexes.is_some();
    let mut report = RemeshReport {
        simplify: simplified.report.clone(),
        spaced: meshed.spaced,
        tried: Vec::new(),
        quads: meshed.quads.mesh.cells().len(),
        inverted_quads: meshed.quads.quality().inverted,
        folded: meshed.folded,
        hexes: found.cells,
        hex_blocks: meshed.hexes.as_ref().map_or(Ok(0), |h| count_blocks(h, &counting))?,
        padding: options.padding,
        released: meshed.released,
        inverted: found.inverted,
        inverted_cells: meshed.hexes.as_ref().map_or_else(Vec::new, |h| inverted_cells(h, &meshed.quality)),
        min_sj: some.then_some(found.min),
        avg_sj: some.then_some(found.average),
        histogram: found.histogram,
        measures: meshed.hexes.as_ref().map(|h| h.measures().summary()),
        volume: if some { found.volume } else { 0.0 },
        hausdorff: distance,
        hausdorff_percent: 100.0 * distance / diagonal,
        max_hausdorff: options.max_hausdorff,
        within_hausdorff: distance <= options.distance_bound(shape),
        seconds,
    };
    if meshed.released > 0 {
        report.simplify.notes.push(Note::Released(meshed.released));
    }
    let faults = report.faults();
    report.simplify.notes.extend(faults);
    report.seconds.measure = start.elapsed().as_secs_f64();
    Ok(report)
}

impl RemeshReport {
    /// Sets the total, and copies the stages to those of the simplification.
    pub(crate) fn set_seconds(&mut self, total: f64) {
        self.seconds.total = total;
        let Stages { simplify, map, mesh, optimise, measure, total } = self.seconds;
        let old = self.simplify.seconds;
        let morph = (simplify + map - old.structure - old.align).max(0.0);
        self.simplify.seconds = simplify::Seconds { morph, mesh, optimise, measure, total, ..old };
    }

    /// Whether no hexahedron is inverted, no surface folded, and the surface as near to the shape as asked for.
    pub fn is_good(&self) -> bool {
        self.inverted == 0 && self.folded == 0 && self.within_hausdorff
    }

    /// How many cells bring the distance within the bound, if it shrinks in proportion to the length of edges: details
    /// do, smooth shapes are faster. Nothing where the distance has other causes or so many cells would be out of
    /// reach.
    fn near_enough(&self) -> Option<(f64, CellKind)> {
        let finer = self.hausdorff_percent / (100.0 * self.max_hausdorff);
        let (cells, count) = match self.hexes {
            0 => (CellKind::Quads, self.quads as f64 * finer * finer),
            n => (CellKind::Hexahedra, n as f64 * finer * finer * finer),
        };
        let helps = self.inverted == 0 && self.folded == 0 && count <= MOST_ADVISED;
        helps.then(|| (rounded(count), cells))
    }

    /// What is not as good as asked for.
    pub fn faults(&self) -> Vec<Note> {
        let mut faults = Vec::new();
        if self.inverted > 0 {
            faults.push(Note::Inverted(self.inverted));
        }
        if self.folded > 0 {
            faults.push(Note::Folded(self.inverted_quads));
        }
        if !self.within_hausdorff {
            faults.push(Note::Far { percent: self.hausdorff_percent, enough: self.near_enough() });
        }
        faults
    }
}

/// A count as people say it: two digits and zeros.
fn rounded(count: f64) -> f64 {
    let unit = libm::pow(10.0, (libm::log10(count.max(1.0)).floor() - 1.0).max(0.0));
    (count / unit).ceil() * unit
}

fn count_blocks(hexes: &Hexes, context: &Context) -> Result<usize> {
    Ok(base_complex(hexes.cells(), context)?.into_iter().max().map_or(0, |b| b as usize + 1))
}

fn inverted_cells(hexes: &Hexes, quality: &Quality) -> Vec<InvertedCell> {
    let describe = |cell: usize| {
        let vertices = hexes.mesh.cells().cell(cell);
        let sum: nalgebra::Vector3<f64> = vertices.iter().map(|&v| hexes.mesh.points()[v as usize].coords).sum();
        InvertedCell { cell, scaled_jacobian: quality.of_cell[cell], at: (sum / vertices.len() as f64).into() }
    };
    quality.inverted_cells().take(MOST_LISTED).map(describe).collect()
}
