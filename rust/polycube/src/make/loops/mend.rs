//! Making regions valid by taking few loops away.

use super::graph::Arc;
use super::moves::Moves;
use super::trial::Blocked;
use crate::context::Context;
use crate::error::Result;
use std::collections::BTreeSet;

impl Moves {
    /// Takes loops away, as few crossings as can be found, so that all regions there become valid; regions that are no
    /// discs stay as they are. Tries `budget` sets for a region, of at most `share` of all crossings. Returns the loops
    /// taken.
    ///
    /// # Errors
    /// Only that the context was cancelled.
    pub(super) fn mend(&mut self, budget: usize, share: f64, context: &Context) -> Result<Vec<u32>> {
        let most = (self.graph.crossings.len() as f64 * share) as usize;
        let mut taken = Vec::new();
        for arc in self.invalid_regions() {
            context.check()?;
            if !self.graph.crossings[arc as usize / 4].alive || self.graph.sides(arc).is_some() {
                continue;
            }
            let first = Blocked::start(self.graph.outline(arc).1);
            let size = |m: &super::trial::Move| (m.crossings <= most).then_some(m.crossings as f64);
            if let Some((_, found)) = self.unblock(first, budget, most, &mut BTreeSet::new(), size) {
                self.take(&found.loops);
                taken.extend(found.loops);
            }
        }
        Ok(taken)
    }

    /// The least arcs of discs whose sides are too few, too many or of one direction.
    fn invalid_regions(&self) -> Vec<Arc> {
        let arcs = 0..4 * self.graph.crossings.len() as Arc;
        let invalid = |&h: &Arc| !self.fixed[h as usize] && self.graph.sides(h).is_none();
        arcs.filter(invalid).filter(|&h| self.graph.outline(h).0 == h).collect()
    }
}
