//! The objective at a complete order.

use crate::align::ranks::Ranks;
use crate::layout::{Objective, Rows, count};
use crate::structure::{Arrangement, Structure};

/// Says whether a complete order is valid, and what it costs.
pub struct Judge<'a> {
    structure: &'a Structure,
    objective: Objective,
    rows: Width,
}

/// The narrowest words that hold a row.
enum Width {
    Narrow(Box<Rows<u64>>),
    Wide(Box<Rows<u128>>),
    Unlimited,
}

impl<'a> Judge<'a> {
    pub fn new(structure: &'a Structure, objective: Objective) -> Self {
        let axis = Rows::<u64>::row_axis(structure);
        let planes = structure.levels.iter().filter(|l| l.axis == axis).count();
        let rows = match planes {
            p if p <= Rows::<u64>::capacity() => Width::Narrow(Box::new(Rows::new(structure))),
            p if p <= Rows::<u128>::capacity() => Width::Wide(Box::new(Rows::new(structure))),
            _ => Width::Unlimited,
        };
        Self { structure, objective, rows }
    }

    /// The objective, nothing for an order that is not valid.
    pub fn cost(&mut self, ranks: &Ranks) -> Option<usize> {
        match &mut self.rows {
            Width::Narrow(rows) => rows.count(self.objective, &ranks.of_level, ranks.planes),
            Width::Wide(rows) => rows.count(self.objective, &ranks.of_level, ranks.planes),
            Width::Unlimited => self.count_slowly(ranks),
        }
    }

    fn count_slowly(&self, ranks: &Ranks) -> Option<usize> {
        let arrangement = Arrangement::new(self.structure, &ranks.placement());
        arrangement.conflicts().is_empty().then(|| count(&arrangement).of(self.objective))
    }
}
