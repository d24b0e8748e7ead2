//! A dense valid set of loops: evenly spaced level sets, and more or fewer of them where regions are invalid.

use super::cut_mesh::{Cut, CutMesh};
use super::energy::Energies;
use super::graph::LoopGraph;
use super::moves::Moves;
use super::repair::{Repair, widest_gap};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;

/// How a start is made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attempt {
    /// Levels along the longest side.
    pub(super) levels: usize,
    /// How far the functions may drift off the coordinates, as a share of the longest side.
    pub(super) reach: f64,
    /// The size of what is smoothed away, in distances of levels.
    pub(super) smooth: f64,
}

/// The outcome of an attempt.
pub(super) struct Start {
    pub(super) mesh: CutMesh,
    pub(super) alive: Vec<bool>,
    /// A face of the shape where a region stayed invalid.
    pub(super) fault: Option<u32>,
}

/// Rounds of repair before an attempt is given up.
const ROUNDS: usize = 40;
/// Triangles of the cut mesh, for each of the shape and besides, beyond which an attempt is given up.
const GROWTH: usize = 20;
const GROWTH_OFFSET: usize = 100_000;
/// Levels that are nearer than this share of a part lie equally high.
const TIE: f64 = 1e-6;
/// By which share of a part the levels of each axis move then.
const SHIFTS: [f64; 3] = [0.0, 0.21, -0.17];
/// Parts of the distance of two levels among which the best place of a level is chosen.
const PARTS: usize = 16;

/// Cuts a surface along level sets of three functions until all regions are valid.
///
/// # Errors
/// Only that the context was cancelled.
pub(super) fn start(
    points: &[Point],
    values: &[[f64; 3]],
    triangles: &[[u32; 3]],
    levels: usize,
    context: &Context,
) -> Result<Start> {
    let mut mesh = CutMesh::new(points, values, triangles);
    let spans = [0, 1, 2].map(|axis| span(values, axis));
    let size = spans.iter().map(|s| s[1] - s[0]).fold(0.0, f64::max);
    for cut in level_cuts(&mesh, spans, size / levels as f64) {
        context.check()?;
        mesh.cut_level(cut);
    }
    let mut alive = vec![true; mesh.cuts.len()];
    let most = GROWTH * triangles.len() + GROWTH_OFFSET;
    let mut fault = None;
    for round in 0..ROUNDS {
        if round > 0 {
            mend(&mesh, &mut alive, round, context)?;
        }
        context.check()?;
        let repair = Repair::new(&mut mesh, &mut alive, size, round);
        fault = repair.first_fault();
        if fault.is_none() || repair.triangles() > most {
            break;
        }
        repair.repair(context)?;
    }
    Ok(Start { mesh, alive, fault })
}

fn span(values: &[[f64; 3]], axis: usize) -> [f64; 2] {
    let all = values.iter().map(|v| v[axis]);
    [all.clone().fold(f64::INFINITY, f64::min), all.fold(f64::NEG_INFINITY, f64::max)]
}

/// Makes discs valid by taking loops away.
fn mend(mesh: &CutMesh, alive: &mut [bool], round: usize, context: &Context) -> Result<()> {
    let graph = LoopGraph::new(mesh, alive);
    let energies = Energies::none(&graph);
    let mut moves = Moves::new(mesh, alive, graph, energies);
    let (budget, share) = if round < 4 { (40, 0.05) } else { (150, 0.2) };
    for l in moves.mend(budget, share, context)? {
        alive[l as usize] = false;
    }
    Ok(())
}

/// A level in every `step` of every axis, where the least of the surface faces the axis.
fn level_cuts(mesh: &CutMesh, spans: [[f64; 2]; 3], step: f64) -> Vec<Cut> {
    let mut cuts = Vec::new();
    for (axis, [low, high]) in spans.into_iter().enumerate() {
        if high <= low {
            continue;
        }
        let count = ((high - low) / step).round().max(1.0) as usize;
        let part = (high - low) / (count * PARTS) as f64;
        let facing = facing(mesh, axis, low, part, count * PARTS);
        let mut sorted: Vec<f64> = mesh.values.iter().map(|v| v[axis]).collect();
        sorted.sort_by(f64::total_cmp);
        for slot in 0..count {
            let at = low + part * best_part(&facing, slot) as f64;
            cuts.push(Cut { axis, at: widest_gap(&sorted, at, at + part) });
        }
    }
    part_ties(&mut cuts, spans, step / PARTS as f64);
    cuts
}

/// Moves levels by less than `part` where those of two axes lie equally high: on a cube, all of them would meet on the
/// diagonals that its faces are cut along, and what is cut there would have no area.
fn part_ties(cuts: &mut [Cut], spans: [[f64; 2]; 3], part: f64) {
    let height = |cut: &Cut| cut.at - spans[cut.axis][0];
    let tied = |a: &Cut, b: &Cut| a.axis != b.axis && (height(a) - height(b)).abs() < TIE * part;
    let mut sorted: Vec<Cut> = cuts.to_vec();
    sorted.sort_by(|a, b| height(a).total_cmp(&height(b)));
    if sorted.windows(2).any(|pair| tied(&pair[0], &pair[1])) {
        cuts.iter_mut().for_each(|cut| cut.at += SHIFTS[cut.axis] * part);
    }
}

/// How much of the surface faces an axis in each of the parts of its span.
fn facing(mesh: &CutMesh, axis: usize, low: f64, part: f64, parts: usize) -> Vec<f64> {
    let mut facing = vec![0.0; parts];
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        let normal = mesh.area_vector(t);
        let share = normal[axis] * normal[axis] / normal.norm().max(f64::MIN_POSITIVE);
        let place = triangle.vertices.map(|v| (((mesh.values[v as usize][axis] - low) / part) as usize).min(parts - 1));
        let (first, last) = (place.into_iter().min().unwrap_or(0), place.into_iter().max().unwrap_or(0));
        let each = share / (last - first + 1) as f64;
        facing[first..=last].iter_mut().for_each(|f| *f += each);
    }
    facing
}

/// The part of a slot, not at its ends, where the least faces the axis; among like ones that in the middle.
fn best_part(facing: &[f64], slot: usize) -> usize {
    let parts = slot * PARTS..(slot + 1) * PARTS;
    let all: f64 = facing[parts.clone()].iter().sum();
    let middle = (slot * PARTS) as f64 + PARTS as f64 / 2.0 - 0.5;
    let near = |p: usize| facing[p.min(facing.len() - 1)];
    let cost = |p: &usize| {
        let there = 0.5 * near(p - 1) + near(*p) + 0.5 * near(p + 1);
        there + 0.02 * all * (*p as f64 - middle).abs() / PARTS as f64
    };
    let inner = parts.start + 2..parts.end - 2;
    inner.min_by(|p, q| cost(p).total_cmp(&cost(q))).unwrap_or(parts.start)
}
