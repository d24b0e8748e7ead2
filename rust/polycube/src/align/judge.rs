//! Whether an order of levels is a valid polycube, and what it counts: quickly where rows of bits hold it.

use super::ranks::Ranks;
use crate::layout::{Counter, Counts, Objective, count, counter};
use crate::structure::{Arrangement, Structure};

/// Up to this many words [`Counter::counts`] is faster than the exact arrangement: patches are what takes long on rows.
const FEW_WORDS: usize = 4096;

/// Says whether an order is valid, and what it costs. Makes its work space once.
pub(super) struct Judge<'a> {
    structure: &'a Structure,
    rows: Option<Box<dyn Counter>>,
}

impl<'a> Judge<'a> {
    /// A judge of the orders of `structure`.
    pub(super) fn new(structure: &'a Structure) -> Self {
        Self { structure, rows: counter(structure) }
    }

    /// What `objective` counts, nothing for an order that is not valid.
    pub(super) fn cost(&mut self, objective: Objective, ranks: &Ranks) -> Option<usize> {
        match &mut self.rows {
            Some(rows) => rows.count(objective, &ranks.of_level, ranks.planes),
            None => self.counts_slowly(ranks).map(|c| c.of(objective)),
        }
    }

    /// All three numbers, nothing for an order that is not valid.
    pub(super) fn counts(&mut self, ranks: &Ranks) -> Option<Counts> {
        match self.few_rows() {
            Some(rows) => rows.counts(&ranks.of_level, ranks.planes),
            None => self.counts_slowly(ranks),
        }
    }

    fn few_rows(&mut self) -> Option<&mut Box<dyn Counter>> {
        self.rows.as_mut().filter(|rows| rows.words() <= FEW_WORDS)
    }

    /// Whether the order is known to be valid; one that is too long for rows of bits is not.
    pub(super) fn knows_valid(&mut self, ranks: &Ranks) -> bool {
        self.rows.as_mut().is_some_and(|rows| rows.is_valid(&ranks.of_level, ranks.planes))
    }

    /// All three numbers of a placement that is known to be valid.
    pub(super) fn counts_of(&mut self, placement: &[f64]) -> Counts {
        let structure = self.structure;
        let quick = self.few_rows().and_then(|rows| {
            let ranks = Ranks::new(structure, placement);
            rows.counts(&ranks.of_level, ranks.planes)
        });
        quick.unwrap_or_else(|| count(&Arrangement::new(structure, placement)))
    }

    fn counts_slowly(&self, ranks: &Ranks) -> Option<Counts> {
        let arrangement = Arrangement::new(self.structure, &ranks.placement());
        is_valid(&arrangement).then(|| count(&arrangement))
    }
}

/// Whether the surface is embedded with its solid side inside.
pub(super) fn is_valid(arrangement: &Arrangement) -> bool {
    arrangement.conflicts().is_empty() && arrangement.inside_out().is_empty()
}
