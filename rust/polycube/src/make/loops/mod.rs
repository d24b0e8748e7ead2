//! Loops: closed curves of three kinds on a surface, whose dual is a polycube.
//!
//! A loop is a closed curve on which one of three functions on the surface is constant; its kind is the axis of that
//! function. Loops of one kind never meet, loops of two kinds meet in **crossings**, and all loops cut the surface into
//! **regions**. A region stands for a vertex of a polycube with quadrilateral faces, a crossing for one of its faces,
//! and the part of a loop between two crossings for one of its edges. The **zones** of an axis are what the loops of
//! its kind leave of the surface: vertices in one zone have one coordinate, and a loop says that one zone lies below
//! another.
//!
//! A set of loops is **valid** if every region is a disc with three to six sides that look in different directions, and
//! if the zones of every axis have an order. A dense set is made valid first ([`start`]); then loops are taken away as
//! long as that pays, and only in ways that leave the set valid ([`coarsen`]). No polycube is ever repaired.
//!
//! Which sets of loops are polycubes: Snoep, Speckmann and Verbeek, *Polycubes via Dual Loops*, 2024 (arXiv
//! 2410.16865). The search, from many level sets down to few loops, is this project's own.

mod coarsen;
pub(crate) mod cut_mesh;
mod energy;
mod field;
pub(crate) mod graph;
mod mend;
mod moves;
mod order;
mod regions;
mod repair;
mod sparse;
mod start;
mod trial;

#[cfg(test)]
mod check;
#[cfg(test)]
mod tests;

use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Point;
use cut_mesh::CutMesh;
use energy::Energies;
pub(super) use energy::{along, cost};
use field::Field;
use graph::LoopGraph;
use moves::Moves;
use rayon::prelude::*;
use start::{Attempt, Start};

/// No element.
pub(crate) const NONE: u32 = u32::MAX;

/// What the user wants of a polycube.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoopOptions {
    /// How much of the shape the polycube follows, in `0..=1`.
    pub(crate) detail: f64,
    /// Stops at this many corners instead, where so few can be reached.
    pub(crate) corners: Option<usize>,
}

impl Default for LoopOptions {
    fn default() -> Self {
        Self { detail: 0.5, corners: None }
    }
}

impl LoopOptions {
    /// By how much more the labels may [`cost`], as a share of the surface, for a corner less.
    fn worth_of_corner(&self) -> f64 {
        if self.corners.is_some() { f64::INFINITY } else { self.price_of_corner() }
    }

    /// The same without regard to how many corners shall be left.
    pub(crate) fn price_of_corner(&self) -> f64 {
        0.04 * libm::pow(625.0, -self.detail)
    }
}

/// A valid set of loops.
#[derive(Clone, Debug)]
pub(crate) struct LoopSet {
    /// The surface, cut along all loops there ever were.
    pub(crate) mesh: CutMesh,
    /// The loops that are left; index `l` is cut `l` of the mesh.
    pub(crate) graph: LoopGraph,
    /// The zone that the face of each crossing lies in.
    pub(crate) zone_of_crossing: Vec<u32>,
    /// The corners of the polycube.
    pub(crate) corners: usize,
}

/// How dense starts are made. All of the first are tried, as each suits other shapes: levels far apart find the plain
/// structure of machine parts, close ones thin limbs. The others are for shapes where all of these fail.
const ATTEMPTS: [Attempt; 10] = [
    Attempt { levels: 80, reach: 2.0, smooth: 0.0 },
    Attempt { levels: 64, reach: 2.0, smooth: 0.0 },
    Attempt { levels: 48, reach: 0.5, smooth: 0.0 },
    Attempt { levels: 40, reach: 2.0, smooth: 0.0 },
    Attempt { levels: 32, reach: 2.0, smooth: 0.1 },
    Attempt { levels: 24, reach: 2.0, smooth: 0.0 },
    Attempt { levels: 24, reach: 0.5, smooth: 0.2 },
    Attempt { levels: 32, reach: 0.5, smooth: 0.4 },
    Attempt { levels: 16, reach: 0.5, smooth: 0.2 },
    Attempt { levels: 24, reach: 0.05, smooth: 0.4 },
];
/// Attempts that are compared.
const COMPARED: usize = 6;

/// A valid set of loops, what it costs, and what came of it when that was found out.
#[derive(Clone, Debug)]
pub(crate) struct Candidate<T> {
    pub(crate) cost: f64,
    pub(crate) loops: LoopSet,
    pub(crate) drawn: T,
}

/// Valid sets of few loops on a closed, oriented, manifold surface, cheapest first. `judge` says what a set costs.
///
/// # Errors
/// [`ErrorKind::Polycube`] with the face where no valid start was found, [`ErrorKind::Cancelled`]; those of `judge`.
pub(crate) fn loops<T: Send>(
    points: &[Point],
    triangles: &[[u32; 3]],
    options: &LoopOptions,
    context: &Context,
    judge: impl Fn(&LoopSet) -> Result<(f64, T)> + Sync,
) -> Result<Vec<Candidate<T>>> {
    let field = Field::new(points, triangles);
    let try_one = |&attempt: &Attempt| -> Result<std::result::Result<Candidate<T>, u32>> {
        let loops = match few_loops(points, triangles, &field, attempt, options, context)? {
            Ok(loops) => loops,
            Err(face) => return Ok(Err(face)),
        };
        let (cost, drawn) = judge(&loops)?;
        Ok(Ok(Candidate { cost, loops, drawn }))
    };
    let (first, others) = ATTEMPTS.split_at(COMPARED);
    let mut tried = first.par_iter().map(try_one).collect::<Result<Vec<_>>>()?;
    for attempt in others {
        if tried.iter().any(|one| one.is_ok()) {
            break;
        }
        tried.push(try_one(attempt)?);
    }
    let fault = tried.iter().filter_map(|one| one.as_ref().err()).next_back().copied();
    let mut found: Vec<_> = tried.into_iter().flatten().collect();
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    if found.is_empty() { Err(no_start(fault.unwrap_or(NONE))) } else { Ok(found) }
}

fn no_start(face: u32) -> Error {
    Error::new(ErrorKind::Polycube, "no set of loops around here is that of a polycube")
        .at(Place::Face(face))
        .remedy("refine or smooth the shape around this face, or turn the shape")
}

/// Few loops from one dense start, or the face where the start stays invalid.
fn few_loops(
    points: &[Point],
    triangles: &[[u32; 3]],
    field: &Field,
    attempt: Attempt,
    options: &LoopOptions,
    context: &Context,
) -> Result<std::result::Result<LoopSet, u32>> {
    let values = field.solve(attempt.reach, attempt.smooth / attempt.levels as f64, context)?;
    let Start { mesh, alive, fault } = start::start(points, &values, triangles, attempt.levels, context)?;
    if let Some(face) = fault {
        return Ok(Err(face));
    }
    let graph = LoopGraph::new(&mesh, &alive);
    let energies = Energies::new(&mesh, &alive, &graph);
    let mut moves = Moves::new(&mesh, &alive, graph, energies);
    if !moves.order.is_acyclic() {
        return Ok(Err(mesh.triangles[0].origin));
    }
    coarsen::coarsen(&mut moves, options, context)?;
    let corners = moves.corners();
    let (graph, zone_of_crossing) = moves.finish();
    Ok(Ok(LoopSet { mesh, graph, zone_of_crossing, corners }))
}
