//! What would happen if loops were taken away.

use super::NONE;
use super::graph::Arc;
use super::moves::{Moves, Transfer};
use petgraph::unionfind::UnionFind;
use std::collections::{BTreeMap, BTreeSet};

/// A set of loops that can be taken away.
#[derive(Clone, Debug)]
pub(super) struct Move {
    /// The loops, in order; with them all that must go as well.
    pub(super) loops: Vec<u32>,
    /// The crossings that go.
    pub(super) crossings: usize,
    /// By how much the misfit grows.
    pub(super) cost: f64,
    /// By how many the corners grow.
    pub(super) corners: i64,
    /// Whether every loop bounds a zone without faces: only what subdivides the polycube goes.
    pub(super) free: bool,
}

/// A set of loops that cannot be taken away alone.
#[derive(Clone, Debug)]
pub(super) struct Blocked {
    /// How many regions would be invalid.
    regions: usize,
    crossings: usize,
    pub(super) loops: Vec<u32>,
    /// The loops around one of these regions: one of them must go, too.
    pub(super) options: Vec<u32>,
}

/// The outcome of a trial.
#[derive(Debug)]
pub(super) enum Trial {
    /// The loops can go.
    Valid(Move),
    /// They cannot.
    Blocked(Blocked),
}

/// The least arc around a region, and whether it is a corner.
type CornerOrNot = (Arc, bool);

/// How many regions would be invalid, and the loops around the smallest.
type Invalid = (usize, Vec<u32>);

/// Invalid regions that are looked at before a trial is given up.
const MOST_INVALID: usize = 64;
/// Loops of a trial that is still extended.
const MOST_LOOPS: usize = 40;

impl Blocked {
    /// A trial of no loops yet: one of `options` must go.
    pub(super) fn start(options: Vec<u32>) -> Self {
        Self { regions: 1, crossings: 0, loops: Vec::new(), options }
    }

    /// How far it seems from valid.
    fn distance(&self) -> usize {
        20 * self.regions + self.crossings
    }
}

impl Moves {
    /// Tries to take `loops` away and puts them back.
    pub(super) fn try_loops(&mut self, loops: &[u32]) -> Trial {
        let loops = self.close(loops);
        let trial = self.evaluate(&loops);
        loops.iter().for_each(|&l| self.doomed[l as usize] = false);
        trial
    }

    /// Takes the loops of a valid trial away.
    pub(super) fn take(&mut self, loops: &[u32]) {
        let loops = self.close(loops);
        let crossings = self.crossings_of(&loops);
        if let Some((_, transfers)) = self.transfers(&crossings) {
            self.apply(&loops, &crossings, &transfers);
        }
        loops.iter().for_each(|&l| self.doomed[l as usize] = false);
    }

    /// Looks for a move of least `value` that takes at least the loops of `first` away, best first, in about `budget`
    /// trials of at most `most` crossings. `expanded` are sets whose extensions were tried.
    pub(super) fn unblock(
        &mut self,
        first: Blocked,
        budget: usize,
        most: usize,
        expanded: &mut BTreeSet<Vec<u32>>,
        value: impl Fn(&Move) -> Option<f64>,
    ) -> Option<(f64, Move)> {
        let mut open = vec![first];
        let mut seen = BTreeSet::new();
        let mut best: Option<(f64, Move)> = None;
        let mut left = budget;
        while left > 0 {
            let Some(nearest) = (0..open.len()).min_by_key(|&i| (open[i].distance(), i)) else { break };
            let blocked = open.swap_remove(nearest);
            if !expanded.insert(blocked.loops.clone()) {
                continue;
            }
            for &option in &blocked.options {
                left = left.saturating_sub(1);
                match self.try_loops(&[&blocked.loops[..], &[option]].concat()) {
                    Trial::Valid(found) => match value(&found) {
                        Some(v) if best.as_ref().is_none_or(|b| v < b.0) => best = Some((v, found)),
                        _ => {}
                    },
                    Trial::Blocked(b) => {
                        if b.loops.len() < MOST_LOOPS && b.crossings <= most && seen.insert(b.loops.clone()) {
                            open.push(b);
                        }
                    }
                }
            }
            if best.is_some() {
                left = left.min(budget / 4);
            }
        }
        best
    }

    /// Dooms loops and all that must go with them: those between zones that would fall together, and those that would
    /// cross nothing.
    fn close(&mut self, loops: &[u32]) -> Vec<u32> {
        let mut set: Vec<u32> = Vec::new();
        self.doom(loops, &mut set);
        loop {
            let before = set.len();
            let mut seeds: Vec<u32> = set.iter().map(|&l| self.graph.loops[l as usize].zones[0]).collect();
            seeds.sort_unstable();
            seeds.dedup();
            let between = self.order.closure(&seeds, &self.doomed);
            self.doom(&between, &mut set);
            let lonely = self.lonely(&set);
            self.doom(&lonely, &mut set);
            if set.len() == before {
                set.sort_unstable();
                return set;
            }
        }
    }

    fn doom(&mut self, loops: &[u32], set: &mut Vec<u32>) {
        for &l in loops {
            if !std::mem::replace(&mut self.doomed[l as usize], true) {
                set.push(l);
            }
        }
    }

    /// The loops that are not doomed and cross only doomed ones.
    fn lonely(&self, doomed: &[u32]) -> Vec<u32> {
        let mut crossed: Vec<u32> = Vec::new();
        for &l in doomed {
            let own = self.graph.loops[l as usize].crossings.iter();
            let own = own.filter(|&&q| self.graph.crossings[q as usize].alive);
            crossed.extend(own.map(|&q| self.graph.other(q, l)).filter(|&m| !self.doomed[m as usize]));
        }
        crossed.sort_unstable();
        let all = |same: &&[u32]| same.len() as u32 == self.left[same[0] as usize];
        crossed.chunk_by(|a, b| a == b).filter(all).map(|same| same[0]).collect()
    }

    /// The living crossings of doomed loops, each once.
    fn crossings_of(&self, loops: &[u32]) -> Vec<u32> {
        let mut found = Vec::new();
        for &l in loops {
            found.extend(self.graph.loops[l as usize].crossings.iter().copied().filter(|&q| {
                let crossing = &self.graph.crossings[q as usize];
                crossing.alive && (crossing.loops[0] == l || !self.doomed[crossing.loops[0] as usize])
            }));
        }
        found
    }

    fn evaluate(&mut self, loops: &[u32]) -> Trial {
        let crossings = self.crossings_of(loops);
        let stuck = |regions, options| {
            Trial::Blocked(Blocked { regions, crossings: crossings.len(), loops: loops.to_vec(), options })
        };
        if crossings.iter().any(|&q| (0..4).any(|f| self.fixed[(q * 4 + f) as usize])) {
            return stuck(MOST_INVALID, Vec::new());
        }
        let after = match self.regions_after(&crossings) {
            Ok(after) => after,
            Err((regions, options)) => return stuck(regions, options),
        };
        let before = self.regions_before(&crossings);
        // Two loop parts and a crossing less for every region less, or some region is no disc (Euler).
        if before.len() != after.len() + crossings.len() {
            let (regions, options) = self.holes(&crossings, &after);
            return stuck(regions, options);
        }
        let Some((cost, _)) = self.transfers(&crossings) else { return stuck(MOST_INVALID, Vec::new()) };
        let corners = |regions: &[(Arc, bool)]| regions.iter().filter(|r| r.1).count() as i64;
        Trial::Valid(Move {
            cost,
            corners: corners(&after) - corners(&before),
            free: self.is_free(loops),
            crossings: crossings.len(),
            loops: loops.to_vec(),
        })
    }

    /// The regions at these crossings, and whether each is a corner.
    fn regions_before(&self, crossings: &[u32]) -> Vec<CornerOrNot> {
        let arcs = crossings.iter().flat_map(|q| (0..4).map(move |f| q * 4 + f));
        let region = |h| self.graph.region(h).unwrap_or_else(|| (self.graph.outline(h).0, false));
        let mut regions: Vec<_> = arcs.map(region).collect();
        regions.sort_unstable();
        regions.dedup();
        regions
    }

    /// The regions there would be without these crossings of doomed loops; if some are invalid, how many, and the loops
    /// around the smallest.
    fn regions_after(&mut self, crossings: &[u32]) -> Result<Vec<CornerOrNot>, Invalid> {
        let fresh = self.unlink(crossings);
        let mut regions = Vec::new();
        let mut invalid: Vec<(usize, Arc, Vec<u32>)> = Vec::new();
        for &arc in fresh.iter().filter(|&&h| self.graph.crossings[h as usize / 4].alive) {
            for side in [arc, self.graph.twin(arc)] {
                match self.graph.region(side) {
                    Some(region) => regions.push(region),
                    None => {
                        let (least, loops) = self.graph.outline(side);
                        invalid.push((loops.len(), least, loops));
                    }
                }
            }
            if invalid.len() > MOST_INVALID {
                break;
            }
        }
        self.relink(crossings);
        if invalid.is_empty() {
            regions.sort_unstable();
            regions.dedup();
            return Ok(regions);
        }
        invalid.sort_unstable();
        invalid.dedup();
        Err((invalid.len(), invalid.swap_remove(0).2))
    }

    /// Takes crossings out of the loops that stay. Returns the arcs that are new, forward.
    pub(super) fn unlink(&mut self, crossings: &[u32]) -> Vec<Arc> {
        let mut fresh = Vec::new();
        for &q in crossings {
            self.graph.crossings[q as usize].alive = false;
            for slot in 0..2 {
                let crossing = &self.graph.crossings[q as usize];
                let (l, next, prev) = (crossing.loops[slot], crossing.next[slot], crossing.prev[slot]);
                if self.doomed[l as usize] {
                    continue;
                }
                let [s, t] = [next, prev].map(|p| self.graph.slot(p, l));
                self.graph.crossings[next as usize].prev[s] = prev;
                self.graph.crossings[prev as usize].next[t] = next;
                fresh.push(prev * 4 + t as u32 * 2 + 1);
            }
        }
        fresh
    }

    /// Puts crossings back in the reverse order, as each still knows its neighbours.
    fn relink(&mut self, crossings: &[u32]) {
        for &q in crossings.iter().rev() {
            for slot in [1, 0] {
                let crossing = &self.graph.crossings[q as usize];
                let (l, next, prev) = (crossing.loops[slot], crossing.next[slot], crossing.prev[slot]);
                if self.doomed[l as usize] {
                    continue;
                }
                let [s, t] = [next, prev].map(|p| self.graph.slot(p, l));
                self.graph.crossings[next as usize].prev[s] = q;
                self.graph.crossings[prev as usize].next[t] = q;
            }
            self.graph.crossings[q as usize].alive = true;
        }
    }

    /// The regions that would have several borders: how many, and the loops around one.
    fn holes(&self, crossings: &[u32], after: &[(Arc, bool)]) -> (usize, Vec<u32>) {
        let mut number = BTreeMap::new();
        let mut region = |arc| {
            let next = number.len() as u32;
            *number.entry(self.graph.outline(arc).0).or_insert(next)
        };
        let mut unions = Vec::new();
        for &q in crossings {
            for slot in (0..2).filter(|&s| self.doomed[self.graph.crossings[q as usize].loops[s] as usize]) {
                for arc in [0, 1].map(|f| q * 4 + slot as u32 * 2 + f) {
                    unions.push((region(arc), region(self.graph.twin(arc))));
                }
            }
        }
        let borders: Vec<(u32, Arc)> = after.iter().map(|&(arc, _)| (region(arc), arc)).collect();
        let mut sets = UnionFind::<u32>::new(number.len());
        unions.iter().for_each(|&(a, b)| {
            sets.union(a, b);
        });
        let mut holed: BTreeMap<u32, Vec<Arc>> = BTreeMap::new();
        borders.iter().for_each(|&(r, arc)| holed.entry(sets.find(r)).or_default().push(arc));
        holed.retain(|_, borders| borders.len() > 1);
        let first = holed.values().next().into_iter().flatten();
        let mut options: Vec<u32> = first.flat_map(|&arc| self.graph.outline(arc).1).collect();
        options.retain(|&l| !self.doomed[l as usize]);
        options.sort_unstable();
        options.dedup();
        (holed.len().max(1), options)
    }

    /// Where the faces of crossings go, and by how much the misfit grows: along the loop that stays to the nearest
    /// crossing on either side that stays, to one with the same label if there is one, else to the cheaper one.
    fn transfers(&self, crossings: &[u32]) -> Option<(f64, Vec<Transfer>)> {
        let mut cost = 0.0;
        let mut transfers = Vec::with_capacity(crossings.len());
        for &from in crossings {
            let label = |q: u32| self.graph.crossings[q as usize].label;
            let energy = |q: u32| self.energies.0[from as usize][label(q) as usize];
            let heirs = self.heirs(from);
            let like = |q: &&u32| label(**q) == label(from);
            let mut alike = heirs.iter().filter(like);
            let to = match (alike.next(), alike.next_back()) {
                (Some(&first), last) => [first, *last.unwrap_or(&first)],
                _ => [*heirs.iter().min_by(|&&a, &&b| energy(a).total_cmp(&energy(b)))?; 2],
            };
            cost += energy(to[0]) - energy(from);
            transfers.push(Transfer { from, to });
        }
        Some((cost, transfers))
    }

    /// The crossings that stay next to one that goes. Where both of its loops go, those next to its neighbours that
    /// lose one.
    fn heirs(&self, q: u32) -> Vec<u32> {
        let loops = self.graph.crossings[q as usize].loops;
        let doomed = loops.map(|l| self.doomed[l as usize]);
        let near = |q: u32, l: u32| [true, false].map(|forward| self.nearest(q, l, forward)).into_iter();
        let mut found: Vec<u32> = if doomed == [true; 2] {
            let singles = loops.into_iter().flat_map(|l| near(q, l)).filter(|&p| p != NONE);
            singles.flat_map(|p| self.heirs(p)).collect()
        } else {
            near(q, loops[usize::from(doomed[0])]).collect()
        };
        found.retain(|&p| p != NONE);
        found
    }

    /// The nearest crossing along loop `l` whose other loop stays.
    fn nearest(&self, q: u32, l: u32, forward: bool) -> u32 {
        let mut at = q;
        loop {
            let slot = self.graph.slot(at, l);
            let crossing = &self.graph.crossings[at as usize];
            at = if forward { crossing.next[slot] } else { crossing.prev[slot] };
            if at == q {
                return NONE;
            }
            if !self.doomed[self.graph.other(at, l) as usize] {
                return at;
            }
        }
    }
}
