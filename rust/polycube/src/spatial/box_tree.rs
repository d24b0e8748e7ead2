//! BoxTree in a tree, for the question which of them meet a given one.

/// Leaves hold up to this many boxes.
const LEAF: usize = 6;

/// A box by its lower and higher corner.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    pub(crate) low: [f64; 3],
    pub(crate) high: [f64; 3],
}

impl Extent {
    /// Looks at all axes, as a guess where to stop would often be wrong.
    fn meets(&self, other: &Self) -> bool {
        (0..3).fold(true, |meet, a| meet & (self.low[a] <= other.high[a]) & (other.low[a] <= self.high[a]))
    }

    fn around(items: &[Item]) -> Self {
        let mut all = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };
        for item in items {
            for a in 0..3 {
                all.low[a] = all.low[a].min(item.extent.low[a]);
                all.high[a] = all.high[a].max(item.extent.high[a]);
            }
        }
        all
    }

    /// The axis along which it is longest.
    fn axis(&self) -> usize {
        let length = |a: usize| self.high[a] - self.low[a];
        (1..3).fold(0, |best, a| if length(a) > length(best) { a } else { best })
    }
}

struct Item {
    extent: Extent,
    number: u32,
}

struct Node {
    extent: Extent,
    /// The node to go on with when this one is passed over: that after its last descendant.
    skip: u32,
    /// Its own items; none for an inner node.
    items: [u32; 2],
}

/// A fixed set of closed boxes, each with a number, in a binary tree without pointers: nodes in depth-first order.
///
/// Built in O(n log n); a query visits O(log n) nodes and those around the boxes that it finds.
pub(crate) struct BoxTree {
    nodes: Vec<Node>,
    items: Vec<Item>,
}

impl BoxTree {
    /// The tree of boxes given by a number, the lower and the higher corner.
    pub(crate) fn new(boxes: impl Iterator<Item = (u32, ([f64; 3], [f64; 3]))>) -> Self {
        let item = |(number, (low, high))| Item { extent: Extent { low, high }, number };
        let mut items: Vec<Item> = boxes.map(item).collect();
        let mut nodes = Vec::with_capacity(items.len() / 2 + 1);
        split(&mut items, 0, &mut nodes);
        Self { nodes, items }
    }

    /// Calls `found` with the number of every box that meets the box from `low` to `high`, in a fixed order.
    pub(crate) fn meeting(&self, low: [f64; 3], high: [f64; 3], mut found: impl FnMut(u32)) {
        self.visit(low, high, |number, _| found(number));
    }

    /// As [`meeting`](Self::meeting), but `found` may shrink the box, so that the rest of the search is shorter.
    pub(crate) fn visit(&self, low: [f64; 3], high: [f64; 3], mut found: impl FnMut(u32, &mut Extent)) {
        let mut wanted = Extent { low, high };
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if !node.extent.meets(&wanted) {
                at = node.skip as usize;
                continue;
            }
            let [first, end] = node.items.map(|i| i as usize);
            for item in &self.items[first..end] {
                if item.extent.meets(&wanted) {
                    found(item.number, &mut wanted);
                }
            }
            at += 1;
        }
    }
}

/// Adds the tree of `items`, whose first has the index `offset`.
fn split(items: &mut [Item], offset: usize, nodes: &mut Vec<Node>) {
    let extent = Extent::around(items);
    let node = nodes.len();
    nodes.push(Node { extent, skip: 0, items: [offset as u32; 2] });
    if items.len() <= LEAF {
        nodes[node].items[1] += items.len() as u32;
    } else {
        let (axis, middle) = (extent.axis(), items.len() / 2);
        let key = |i: &Item| i.extent.low[axis] + i.extent.high[axis];
        items.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.number.cmp(&b.number)));
        let (left, right) = items.split_at_mut(middle);
        split(left, offset, nodes);
        split(right, offset + middle, nodes);
    }
    nodes[node].skip = nodes.len() as u32;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::SplitMix64;

    fn random(rng: &mut SplitMix64) -> ([f64; 3], [f64; 3]) {
        let low = [0; 3].map(|_: i32| rng.below(20) as f64);
        (low, low.map(|x| x + rng.below(4) as f64))
    }

    #[test]
    fn exactly_the_meeting_boxes_are_found() {
        let mut rng = SplitMix64::new(1);
        for count in [0, 1, 6, 7, 100, 1000] {
            let boxes: Vec<_> = (0..count).map(|_| random(&mut rng)).collect();
            let tree = BoxTree::new((0..).zip(boxes.iter().copied()));
            for _ in 0..50 {
                let (low, high) = random(&mut rng);
                let meets = |b: &([f64; 3], [f64; 3])| (0..3).all(|a| b.0[a] <= high[a] && low[a] <= b.1[a]);
                let expected: Vec<u32> = (0..).zip(&boxes).filter(|(_, b)| meets(b)).map(|(i, _)| i).collect();
                let mut found = Vec::new();
                tree.meeting(low, high, |i| found.push(i));
                found.sort_unstable();
                assert_eq!(found, expected);
            }
        }
    }
}
