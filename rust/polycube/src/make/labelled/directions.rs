//! Which way the sides of charts run: up or down their axes.
//!
//! Labels alone do not say that: where +X meets +Y, the edge goes up along Z if it is convex, and down if it is reflex.
//! The shape tells, by its dihedral angles and by where the ends of a side lie, but not reliably. What must hold is
//! that the sides around every corner leave it in directions between which the charts there fit.

use crate::mesh::{Face, Point};
use crate::structure::{Label, Labelling, area_vector};
use std::collections::BTreeMap;

/// A direction along an axis, numbered as labels are.
type Direction = Label;

/// Whether each side of the labelling goes up its axis, and how surely.
pub(super) struct Directions<'a> {
    labelling: &'a Labelling,
    up: Vec<bool>,
    /// How much of each side speaks for its direction, in units of length.
    sureness: Vec<f64>,
}

impl<'a> Directions<'a> {
    /// What the shape says of every side for itself, turned around along the least sure ones until the corners are
    /// right or nothing helps.
    pub(super) fn new(labelling: &'a Labelling, points: &[Point]) -> Self {
        let votes: Vec<f64> = (0..labelling.sides.len()).map(|side| vote(labelling, points, side)).collect();
        // Both halves of a side add up to the same, but for rounding, which must not part them.
        let own = |side: usize| side.min(labelling.sides[side].twin);
        let up = (0..votes.len()).map(|side| (votes[own(side)] > 0.0) == (own(side) == side)).collect();
        let sureness = (0..votes.len()).map(|side| votes[own(side)].abs()).collect();
        let mut directions = Self { labelling, up, sureness };
        directions.mend();
        directions
    }

    /// Whether a side goes up its axis.
    pub(super) fn is_up(&self, side: usize) -> bool {
        self.up[side]
    }

    /// The first corner between whose sides its charts do not fit.
    pub(super) fn wrong_corner(&self) -> Option<usize> {
        (0..self.labelling.corners.len()).find(|&corner| !self.fits(corner))
    }

    /// The first border loop whose chart cannot be a flat region: of each, one loop must turn once around to the left
    /// and the others, the holes, to the right.
    pub(super) fn wrong_loop(&self) -> Option<usize> {
        let turns: Vec<i32> = self.labelling.loops.iter().map(|sides| self.turns(sides)).collect();
        let mut outer = vec![0; self.labelling.labels.len()];
        let chart = |i: usize| self.labelling.sides[self.labelling.loops[i][0]].chart as usize;
        (0..turns.len()).filter(|&i| turns[i] == 4).for_each(|i| outer[chart(i)] += 1);
        (0..turns.len()).find(|&i| turns[i].abs() != 4 || outer[chart(i)] != 1)
    }

    fn direction(&self, side: usize) -> Direction {
        Label::facing(self.labelling.axis(side), self.up[side])
    }

    /// Whether the charts around a corner fit between its sides: going around, one chart after the other turns from its
    /// side to the next, and no direction is passed twice.
    fn fits(&self, corner: usize) -> bool {
        let sides = &self.labelling.leaving[corner];
        let mut passed = 0_u8;
        for (i, &side) in sides.iter().enumerate() {
            let next = self.direction(sides[(i + 1) % sides.len()]);
            let mut at = self.direction(side);
            loop {
                let bit = 1 << at.index();
                if passed & bit != 0 {
                    return false;
                }
                passed |= bit;
                at = turned(at, self.labelling.label(side));
                if at == next {
                    break;
                }
            }
        }
        true
    }

    /// By how many right angles a border loop turns to the left.
    fn turns(&self, sides: &[usize]) -> i32 {
        let turn = |i: usize| {
            let [from, to] = [sides[i], sides[(i + 1) % sides.len()]].map(|side| self.direction(side));
            let label = self.labelling.label(sides[i]);
            let left = turned(from, label);
            if to == left {
                1
            } else if to == left.opposite() {
                -1
            } else {
                // Straight on, or around a slit, which no corner allows.
                0
            }
        };
        (0..sides.len()).map(turn).sum()
    }

    /// Turns the least sure sides around along paths between corners that are wrong, as long as fewer are wrong then.
    fn mend(&mut self) {
        let mut wrong: Vec<usize> = (0..self.labelling.corners.len()).filter(|&c| !self.fits(c)).collect();
        while let Some(path) = wrong.iter().find_map(|&corner| self.mending_path(corner)) {
            self.turn_around(&path);
            wrong.retain(|&corner| !self.fits(corner));
        }
    }

    fn turn_around(&mut self, path: &[usize]) {
        for &side in path {
            for half in [side, self.labelling.sides[side].twin] {
                self.up[half] = !self.up[half];
            }
        }
    }

    /// The least sure path from a wrong corner to another that is right afterwards on all of its way.
    fn mending_path(&mut self, from: usize) -> Option<Vec<usize>> {
        let reached = self.paths(from);
        let mut ends: Vec<(f64, usize)> = reached.iter().map(|(&corner, &(length, _))| (length, corner)).collect();
        ends.retain(|&(_, corner)| corner != from && !self.fits(corner));
        ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        ends.into_iter().find_map(|(_, end)| {
            let mut path = Vec::new();
            let mut at = end;
            while let Some(side) = reached[&at].1 {
                path.push(side);
                at = self.labelling.sides[side].start;
            }
            self.turn_around(&path);
            let start = |side: usize| self.labelling.sides[side].start;
            let good = self.fits(end) && path.iter().all(|&side| self.fits(start(side)));
            self.turn_around(&path);
            good.then_some(path)
        })
    }

    /// For every corner how sure the least sure path to it is, and the last side of that.
    fn paths(&self, from: usize) -> BTreeMap<usize, (f64, Option<usize>)> {
        let mut done = BTreeMap::new();
        let mut open = BTreeMap::from([(from, (0.0_f64, None))]);
        while let Some((&corner, &(length, last))) = open.iter().min_by(|a, b| a.1.0.total_cmp(&b.1.0)) {
            open.remove(&corner);
            done.insert(corner, (length, last));
            for &side in &self.labelling.leaving[corner] {
                let end = self.labelling.sides[self.labelling.sides[side].twin].start;
                let longer = length + self.sureness[side];
                if !done.contains_key(&end) && open.get(&end).is_none_or(|known| longer < known.0) {
                    open.insert(end, (longer, Some(side)));
                }
            }
        }
        done
    }
}

/// A direction turned left by a right angle, on a face of this label seen from outside.
fn turned(direction: Direction, label: Label) -> Direction {
    let axis = 3 - direction.axis() - label.axis();
    Label::facing(axis, label.left(direction.axis()) == direction.sign())
}

/// What the shape says of a side: how far it leads up its axis, and how far its dihedral angles say that it should.
fn vote(labelling: &Labelling, points: &[Point], side: usize) -> f64 {
    let axis = labelling.axis(side);
    let [left, right] = [side, labelling.sides[side].twin].map(|s| labelling.label(s));
    let up_if_convex = if left.left(axis) == right.sign() { -1.0 } else { 1.0 };
    let step = |&h: &u32| {
        let surface = &labelling.surface;
        let normal = |h: u32| normal(points, &surface.faces()[surface.face(h)]);
        let along = points[surface.end(h) as usize] - points[surface.start(h) as usize];
        let convex = normal(h).cross(&normal(surface.twin(h))).dot(&along);
        along[axis] + up_if_convex * convex
    };
    labelling.sides[side].half_edges.iter().map(step).sum()
}

fn normal(points: &[Point], face: &Face) -> nalgebra::Vector3<f64> {
    area_vector(points, face).try_normalize(0.0).unwrap_or_default()
}
