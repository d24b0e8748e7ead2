//! What every valid order must satisfy: edges have a length, and parts of the surface that are no neighbours lie
//! apart.
//!
//! Two boxes lie apart when some axis separates them, so each pair of boxes gives one clause: a disjunction
//! of at most three conditions on pairs of levels. When all conditions of a clause but one are
//! refuted, the last one must hold.

use super::outline::Outline;
use super::relations::{ABOVE, BELOW, Pairs, Relations, composed, flipped, is_decided};
use crate::structure::{LevelBox, Structure, rectangles};

/// More pairs of edges than this are not looked at: the clauses would fill the memory.
const MOST_PAIRS: usize = 500_000;

/// Holds when the relation of two levels is among those in the mask.
pub(super) type Condition = (u32, u32, u8);

/// At least one of its conditions holds.
type Clause = Vec<Condition>;

/// A facet whose outline is not known from the start, with the edges that it must not meet.
struct Region {
    facet: u32,
    levels: [Vec<u32>; 2],
    strangers: Vec<LevelBox>,
}

/// All clauses of a structure, by the pairs of levels that they speak of.
pub(super) struct Rules<'a> {
    structure: &'a Structure,
    /// Where relations are kept.
    pub pairs: Pairs,
    clauses: Vec<Clause>,
    watched: Vec<Vec<u32>>,
    regions: Vec<Region>,
}

/// No order satisfies the relations.
pub(super) struct Contradiction;

/// Relations that are about to be closed under the rules.
struct Closing<'a> {
    rules: &'a Rules<'a>,
    relations: &'a mut Relations,
    changed: Vec<(u32, u32)>,
}

impl<'a> Rules<'a> {
    /// The rules of a structure and the relations that follow from them.
    ///
    /// O(e² + n³) for e edges and n levels of an axis, in memory for n² pairs; a contradiction when the structure has
    /// no embedding at all.
    pub(super) fn new(structure: &'a Structure) -> Result<(Self, Relations), Contradiction> {
        let pairs = Pairs::new(structure);
        let mut relations = Relations::new(&pairs);
        let watched = vec![Vec::new(); pairs.len()];
        let mut rules = Self { structure, pairs, clauses: Vec::new(), watched, regions: Vec::new() };
        let lengths: Vec<Condition> =
            structure.edges.iter().map(|e| structure.ends(e)).map(|[low, high]| (low, high, BELOW)).collect();
        rules.restrict(&mut relations, &lengths)?;
        let few = structure.edges.len() * structure.edges.len() / 2 <= MOST_PAIRS;
        if few {
            rules.add_clauses(&relations);
            rules.restrict(&mut relations, &[])?;
            rules.check_all(&mut relations)?;
        }
        Ok((rules, relations))
    }

    /// Adds conditions that hold and all that follows.
    pub(super) fn restrict(&self, relations: &mut Relations, conditions: &[Condition]) -> Result<(), Contradiction> {
        let mut closing = Closing { rules: self, relations, changed: Vec::new() };
        conditions.iter().try_for_each(|c| closing.demand(c))?;
        closing.run()
    }

    fn check_all(&self, relations: &mut Relations) -> Result<(), Contradiction> {
        let mut closing = Closing { rules: self, relations, changed: Vec::new() };
        self.clauses.iter().try_for_each(|c| closing.check(c))?;
        closing.run()
    }

    /// The clauses not yet satisfied in which two levels occur.
    pub(super) fn open_clauses(&self, relations: &Relations, a: u32, b: u32) -> usize {
        let watching = &self.watched[self.pairs.cell(a.min(b), a.max(b))];
        watching.iter().filter(|c| !self.is_satisfied(relations, &self.clauses[**c as usize])).count()
    }

    fn is_satisfied(&self, relations: &Relations, clause: &Clause) -> bool {
        clause.iter().any(|&(a, b, mask)| relations.get(&self.pairs, a, b) & !mask == 0)
    }

    fn add_clauses(&mut self, relations: &Relations) {
        let structure = self.structure;
        let mut clauses = Vec::new();
        for (i, edge) in structure.edges.iter().enumerate() {
            let strangers =
                structure.edges[i + 1..].iter().filter(|o| !edge.corners.iter().any(|c| o.corners.contains(c)));
            let needed = strangers.map(|o| apart(&structure.edge_box(edge), &structure.edge_box(o)));
            clauses.extend(needed.filter(|c| !self.is_satisfied(relations, c)));
        }
        for facet in 0..structure.facets.len() as u32 {
            let needed = enclosures(&Outline::new(structure, facet), &self.pairs, relations);
            clauses.extend(needed.into_iter().filter(|c| !self.is_satisfied(relations, c)));
            let region = Region::new(structure, facet);
            match region.tiles(self, relations) {
                Some(Some(tiles)) => {
                    let pairs = tiles.iter().flat_map(|t| region.strangers.iter().map(move |s| apart(t, s)));
                    clauses.extend(pairs.filter(|c| !self.is_satisfied(relations, c)));
                }
                _ => self.regions.push(region),
            }
        }
        clauses.sort_unstable();
        clauses.dedup();
        for (number, clause) in (0..).zip(&clauses) {
            for &(a, b, _) in clause {
                self.watched[self.pairs.cell(a, b)].push(number);
            }
        }
        self.clauses = clauses;
    }
}

impl Region {
    fn new(structure: &Structure, facet: u32) -> Self {
        let f = &structure.facets[facet as usize];
        let own: Vec<u32> = f.sides().flat_map(|s| structure.edges[s.edge as usize].corners).collect();
        let axis = f.label.axis();
        let levels = [1, 2].map(|turn| {
            let along = own.iter().map(|&c| structure.corners[c as usize].levels[(axis + turn) % 3]);
            let mut levels: Vec<u32> = along.collect();
            levels.sort_unstable();
            levels.dedup();
            levels
        });
        let strange = structure.edges.iter().filter(|e| !e.corners.iter().any(|c| own.contains(c)));
        Self { facet, levels, strangers: strange.map(|e| structure.edge_box(e)).collect() }
    }

    /// The facet's rectangles once the order of its levels is known, `Some(None)` when that order folds it.
    fn tiles(&self, rules: &Rules, relations: &Relations) -> Option<Option<Vec<LevelBox>>> {
        let mut placement = vec![0.0; rules.structure.levels.len()];
        for levels in &self.levels {
            for &a in levels {
                let mut lower = 0;
                for &b in levels {
                    let relation = relations.get(&rules.pairs, b, a);
                    if !is_decided(relation) {
                        return None;
                    }
                    lower += usize::from(relation == BELOW);
                }
                placement[a as usize] = lower as f64;
            }
        }
        Some(rectangles(rules.structure, &rules.structure.facets[self.facet as usize], &placement))
    }
}

impl Closing<'_> {
    fn demand(&mut self, &(a, b, mask): &Condition) -> Result<(), Contradiction> {
        let pairs = &self.rules.pairs;
        if self.relations.keep(pairs, a, b, mask) {
            if self.relations.get(pairs, a, b) == 0 {
                return Err(Contradiction);
            }
            self.changed.push((a, b));
        }
        Ok(())
    }

    fn run(&mut self) -> Result<(), Contradiction> {
        loop {
            while let Some((a, b)) = self.changed.pop() {
                self.compose(a, b)?;
                for &clause in &self.rules.watched[self.rules.pairs.cell(a.min(b), a.max(b))] {
                    self.check(&self.rules.clauses[clause as usize])?;
                }
            }
            self.rules.regions.iter().try_for_each(|r| self.check_region(r))?;
            if self.changed.is_empty() {
                return Ok(());
            }
        }
    }

    /// What a relation between `a` and `b` says about either and every other level.
    fn compose(&mut self, a: u32, b: u32) -> Result<(), Contradiction> {
        let pairs = &self.rules.pairs;
        let ab = self.relations.get(pairs, a, b);
        for &c in pairs.along(a) {
            let ac = composed(ab, self.relations.get(pairs, b, c));
            self.demand(&(a, c, ac))?;
            let cb = composed(self.relations.get(pairs, c, a), ab);
            self.demand(&(c, b, cb))?;
        }
        Ok(())
    }

    fn check(&mut self, clause: &[Condition]) -> Result<(), Contradiction> {
        let mut last = None;
        for &(a, b, mask) in clause {
            let relation = self.relations.get(&self.rules.pairs, a, b);
            if relation & !mask == 0 {
                return Ok(());
            }
            if relation & mask != 0 && last.replace((a, b, mask)).is_some() {
                return Ok(());
            }
        }
        last.map_or(Err(Contradiction), |condition| self.demand(&condition))
    }

    fn check_region(&mut self, region: &Region) -> Result<(), Contradiction> {
        let Some(tiles) = region.tiles(self.rules, self.relations) else { return Ok(()) };
        for tile in tiles.ok_or(Contradiction)? {
            region.strangers.iter().try_for_each(|s| self.check(&apart(&tile, s)))?;
        }
        Ok(())
    }
}

/// Every hole of a facet lies within its outer loop: some level of that loop lies below each of the hole's, some
/// above.
fn enclosures(outline: &Outline, pairs: &Pairs, relations: &Relations) -> Vec<Clause> {
    let Some((outer, holes)) = outline.loops.split_first() else { return Vec::new() };
    let levels = holes.iter().flatten().zip([0, 1].into_iter().cycle());
    let bound = |(level, axis): (u32, usize), mask: u8| -> Clause {
        // A level beyond another of the outer loop's says nothing new.
        let is_extreme = |o: &&u32| !outer[axis].iter().any(|&p| relations.get(pairs, p, **o) == mask);
        let mut clause: Clause = outer[axis].iter().filter(is_extreme).map(|&o| condition(o, level, mask)).collect();
        clause.sort_unstable();
        clause
    };
    let inner = levels.flat_map(|(own, axis)| own.iter().map(move |&l| (l, axis)));
    // A loop that touches the outer one has levels in common with it.
    let apart = inner.filter(|(level, axis)| !outer[*axis].contains(level));
    apart.flat_map(|at| [bound(at, BELOW), bound(at, ABOVE)]).collect()
}

/// The condition that the relation of `a` to `b` is `mask`, with the lower number first.
fn condition(a: u32, b: u32, mask: u8) -> Condition {
    if a < b { (a, b, mask) } else { (b, a, flipped(mask)) }
}

/// The clause that two boxes have no point in common: one condition per pair of bounds on an axis that can separate
/// them.
fn apart(first: &LevelBox, second: &LevelBox) -> Clause {
    let mut clause: Clause = Vec::with_capacity(6);
    let mut add = |low: u32, high: u32| {
        let (a, b, mask) = condition(low, high, BELOW);
        match clause.iter_mut().find(|c| (c.0, c.1) == (a, b)) {
            Some(condition) => condition.2 |= mask,
            None if a != b => clause.push((a, b, mask)),
            None => {}
        }
    };
    for axis in 0..3 {
        add(first.high[axis], second.low[axis]);
        add(second.high[axis], first.low[axis]);
    }
    clause.sort_unstable();
    clause
}
