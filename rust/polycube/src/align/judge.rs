//! The objective at a complete order.

use crate::align::guides::is_valid;
use crate::align::ranks::Ranks;
use crate::layout::{Counter, Objective, count, counter};
use crate::structure::{Arrangement, Structure};

/// Says whether a complete order is valid, and what it costs.
pub struct Judge<'a> {
    structure: &'a Structure,
    objective: Objective,
    rows: Option<Box<dyn Counter>>,
}

impl<'a> Judge<'a> {
    pub fn new(structure: &'a Structure, objective: Objective) -> Self {
        Self { structure, objective, rows: counter(structure) }
    }

    /// The objective, nothing for an order that is not valid.
    pub fn cost(&mut self, ranks: &Ranks) -> Option<usize> {
        match &mut self.rows {
            Some(rows) => rows.count(self.objective, &ranks.of_level, ranks.planes),
            None => self.count_slowly(ranks),
        }
    }

    fn count_slowly(&self, ranks: &Ranks) -> Option<usize> {
        let placement = ranks.placement();
        let arrangement = || Arrangement::new(self.structure, &placement);
        is_valid(self.structure, &placement).then(|| count(&arrangement()).of(self.objective))
    }
}
