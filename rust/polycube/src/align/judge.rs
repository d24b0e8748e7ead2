//! Whether an order of levels is a valid polycube, and what it counts: quickly where rows of bits hold it.

use super::ranks::Ranks;
use crate::layout::{Counts, Objective, Rows, count};
use crate::structure::{Arrangement, Structure};

/// Says whether an order is valid, and what it costs. Makes its work space once.
pub struct Judge<'a> {
    structure: &'a Structure,
    rows: Width,
}

/// The narrowest words that hold a row.
enum Width {
    Narrow(Box<Rows<u64>>),
    Wide(Box<Rows<u128>>),
    Unlimited,
}

impl<'a> Judge<'a> {
    /// A judge of the orders of `structure`.
    pub fn new(structure: &'a Structure) -> Self {
        let axis = Rows::<u64>::row_axis(structure);
        let planes = structure.levels.iter().filter(|l| l.axis == axis).count();
        let rows = match planes {
            p if p <= Rows::<u64>::capacity() => Width::Narrow(Box::new(Rows::new(structure))),
            p if p <= Rows::<u128>::capacity() => Width::Wide(Box::new(Rows::new(structure))),
            _ => Width::Unlimited,
        };
        Self { structure, rows }
    }

    /// What `objective` counts, nothing for an order that is not valid.
    pub fn cost(&mut self, objective: Objective, ranks: &Ranks) -> Option<usize> {
        match &mut self.rows {
            Width::Narrow(rows) => rows.count(objective, &ranks.of_level, ranks.planes),
            Width::Wide(rows) => rows.count(objective, &ranks.of_level, ranks.planes),
            Width::Unlimited => self.counts_slowly(ranks).map(|c| c.of(objective)),
        }
    }

    /// All three numbers, nothing for an order that is not valid.
    pub fn counts(&mut self, ranks: &Ranks) -> Option<Counts> {
        match &mut self.rows {
            Width::Narrow(rows) => rows.counts(&ranks.of_level, ranks.planes),
            Width::Wide(rows) => rows.counts(&ranks.of_level, ranks.planes),
            Width::Unlimited => self.counts_slowly(ranks),
        }
    }

    /// Whether the order is known to be valid; one that is too long for rows of bits is not.
    pub fn knows_valid(&mut self, ranks: &Ranks) -> bool {
        match &mut self.rows {
            Width::Narrow(rows) => rows.is_valid(&ranks.of_level, ranks.planes),
            Width::Wide(rows) => rows.is_valid(&ranks.of_level, ranks.planes),
            Width::Unlimited => false,
        }
    }

    /// All three numbers of a placement that is known to be valid.
    pub fn counts_of(&mut self, placement: &[f64]) -> Counts {
        let quick = match &self.rows {
            Width::Unlimited => None,
            _ => self.counts(&Ranks::new(self.structure, placement)),
        };
        quick.unwrap_or_else(|| count(&Arrangement::new(self.structure, placement)))
    }

    fn counts_slowly(&self, ranks: &Ranks) -> Option<Counts> {
        let arrangement = Arrangement::new(self.structure, &ranks.placement());
        arrangement.conflicts().is_empty().then(|| count(&arrangement))
    }
}
