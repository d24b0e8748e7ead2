//! The zones of the three axes and what lies above what.

use super::NONE;

/// A loop between two zones: below, above, and the loop.
pub(super) type Step = (u32, u32, u32);

/// Zones and the loops between them, as a directed graph.
#[derive(Clone, Debug, Default)]
pub(super) struct Order {
    zones: usize,
    up: Adjacency,
    down: Adjacency,
    search: Search,
}

#[derive(Clone, Debug, Default)]
struct Adjacency {
    start: Vec<u32>,
    /// The other zone, and the loop in between.
    to: Vec<(u32, u32)>,
}

impl Adjacency {
    fn new(zones: usize, mut steps: Vec<Step>) -> Self {
        steps.sort_unstable();
        let mut start = vec![0; zones + 1];
        steps.iter().for_each(|s| start[s.0 as usize + 1] += 1);
        (0..zones).for_each(|z| start[z + 1] += start[z]);
        Self { start, to: steps.iter().map(|s| (s.1, s.2)).collect() }
    }

    fn of(&self, zone: u32) -> &[(u32, u32)] {
        &self.to[self.start[zone as usize] as usize..self.start[zone as usize + 1] as usize]
    }
}

/// The state of Tarjan's search for strongly connected parts.
#[derive(Clone, Debug, Default)]
struct Search {
    /// When a zone was met, and whether its part is still open.
    met: Vec<(u32, bool)>,
    order: Vec<u32>,
    stack: Vec<u32>,
    parts: Vec<Vec<u32>>,
}

impl Order {
    /// The graph of `zones` zones with these loops between them.
    pub(super) fn new(zones: usize, steps: Vec<Step>) -> Self {
        let back = steps.iter().map(|&(low, high, l)| (high, low, l)).collect();
        let search = Search { met: vec![(NONE, false); zones], ..Search::default() };
        Self { zones, up: Adjacency::new(zones, steps), down: Adjacency::new(zones, back), search }
    }

    /// The loops with the same zones as loop `l`, which lies between `zones`, in order.
    pub(super) fn parallel(&self, zones: [u32; 2]) -> impl Iterator<Item = u32> + '_ {
        self.up.of(zones[0]).iter().filter(move |s| s.0 == zones[1]).map(|s| s.1)
    }

    /// Whether no zone lies above itself.
    pub(super) fn is_acyclic(&self) -> bool {
        let mut below: Vec<usize> = (0..self.zones).map(|z| self.down.of(z as u32).len()).collect();
        let mut free: Vec<u32> = (0..self.zones as u32).filter(|&z| below[z as usize] == 0).collect();
        let mut sorted = 0;
        while let Some(zone) = free.pop() {
            sorted += 1;
            for &(above, _) in self.up.of(zone) {
                below[above as usize] -= 1;
                if below[above as usize] == 0 {
                    free.push(above);
                }
            }
        }
        sorted == self.zones
    }

    /// All loops between zones that fall together once the `doomed` loops, of which some touch `seeds`, are gone: the
    /// zones on a cycle through doomed loops in both senses.
    pub(super) fn closure(&mut self, seeds: &[u32], doomed: &[bool]) -> Vec<u32> {
        let mut search = std::mem::take(&mut self.search);
        for &seed in seeds {
            if search.met[seed as usize].0 == NONE {
                self.visit(seed, doomed, &mut search);
            }
        }
        let mut found = Vec::new();
        for part in search.parts.drain(..).filter(|p| p.len() > 1) {
            for &zone in &part {
                let inner = self.up.of(zone).iter().filter(|s| part.binary_search(&s.0).is_ok());
                found.extend(inner.map(|s| s.1));
            }
        }
        for zone in search.order.drain(..) {
            search.met[zone as usize] = (NONE, false);
        }
        self.search = search;
        found
    }

    /// Tarjan's algorithm (1972). The depth is at most the zones of an axis: some hundreds.
    fn visit(&self, zone: u32, doomed: &[bool], search: &mut Search) -> u32 {
        let own = search.order.len() as u32;
        search.met[zone as usize] = (own, true);
        search.order.push(zone);
        search.stack.push(zone);
        let mut low = own;
        let back = self.down.of(zone).iter().filter(|s| doomed[s.1 as usize]);
        for &(next, _) in self.up.of(zone).iter().chain(back) {
            low = match search.met[next as usize] {
                (NONE, _) => low.min(self.visit(next, doomed, search)),
                (met, true) => low.min(met),
                (_, false) => low,
            };
        }
        if low == own {
            let mut part = Vec::new();
            while let Some(member) = search.stack.pop() {
                search.met[member as usize].1 = false;
                part.push(member);
                if member == zone {
                    break;
                }
            }
            part.sort_unstable();
            search.parts.push(part);
        }
        low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zones_that_fall_together_take_all_between_them() {
        // 0 - 1 - 2 and 0 - 2 directly: with loop 12 gone, 1 lies between equals.
        let mut order = Order::new(4, vec![(0, 1, 10), (1, 2, 11), (0, 2, 12), (2, 3, 13)]);
        let mut doomed = vec![false; 14];
        doomed[12] = true;
        let mut found = order.closure(&[0, 2], &doomed);
        found.sort_unstable();
        assert_eq!(found, [10, 11, 12]);
        doomed[12] = false;
        doomed[13] = true;
        assert_eq!(order.closure(&[2], &doomed), [13]);
    }

    #[test]
    fn cycles_are_seen() {
        assert!(Order::new(3, vec![(0, 1, 0), (1, 2, 1), (0, 2, 2)]).is_acyclic());
        assert!(!Order::new(3, vec![(0, 1, 0), (1, 2, 1), (2, 0, 2)]).is_acyclic());
    }
}
