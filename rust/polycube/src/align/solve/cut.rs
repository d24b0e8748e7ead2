//! Minimum cuts: Dinic's algorithm on a network that is rebuilt many times in the same memory.
//!
//! Sources and sinks are not nodes: every node has a supply, negative for a demand. That saves two arcs for each node.
//! Own code because `petgraph::algo::dinics` has no reusable memory and no cut side, and clears a vector of all nodes
//! for every augmenting path; `bench/README.md` holds the measured times.

/// A capacity nothing can fill, and that can be added to another without overflow.
pub(super) const UNLIMITED: i128 = i128::MAX / 4;

const NONE: u32 = u32::MAX;

/// A flow network. Arc `e` and its reverse `e ^ 1` are neighbours.
#[derive(Default)]
pub(super) struct Network {
    first: Vec<u32>,
    next: Vec<u32>,
    head: Vec<u32>,
    room: Vec<i128>,
    supply: Vec<i128>,
    /// Number of arcs to the nearest demand, `NONE` if there is no way to one.
    distance: Vec<u32>,
    cursor: Vec<u32>,
    queue: Vec<u32>,
    path: Vec<u32>,
}

impl Network {
    /// Starts again with nodes of the given supplies and no arcs.
    pub(super) fn reset(&mut self, supply: &[i128]) {
        self.supply.clear();
        self.supply.extend_from_slice(supply);
        self.first.clear();
        self.first.resize(self.supply.len(), NONE);
        self.next.clear();
        self.head.clear();
        self.room.clear();
    }

    /// Joins `a` and `b` with capacity `there` from `a` to `b` and `back` from `b` to `a`.
    pub(super) fn join(&mut self, a: u32, b: u32, there: i128, back: i128) {
        for (from, to, room) in [(a, b, there), (b, a, back)] {
            self.next.push(self.first[from as usize]);
            self.first[from as usize] = self.head.len() as u32;
            self.head.push(to);
            self.room.push(room);
        }
    }

    /// What room is left from `b` to `a` in the `n`-th call of [`join`](Self::join).
    pub(super) fn room_back(&self, n: usize) -> i128 {
        self.room[2 * n + 1]
    }

    /// Sends as much supply to demands as there is room for. O(nodes² · arcs), far less as a rule.
    pub(super) fn saturate(&mut self) {
        while self.measure() {
            self.cursor.clone_from(&self.first);
            for v in 0..self.supply.len() {
                if self.supply[v] > 0 && self.distance[v] != NONE {
                    self.drain(v);
                }
            }
        }
    }

    /// After [`saturate`](Self::saturate): whether some supply found no demand.
    pub(super) fn has_supply(&self) -> bool {
        self.supply.iter().any(|&s| s > 0)
    }

    /// After [`saturate`](Self::saturate): whether `v` is on the source side of the minimum cut that has the largest
    /// one.
    pub(super) fn on_source_side(&self, v: usize) -> bool {
        self.distance[v] == NONE
    }

    /// Measures every node's distance to a demand; whether some supply can reach one.
    fn measure(&mut self) -> bool {
        self.distance.clear();
        self.distance.resize(self.supply.len(), NONE);
        self.queue.clear();
        for v in 0..self.supply.len() {
            if self.supply[v] < 0 {
                self.distance[v] = 0;
                self.queue.push(v as u32);
            }
        }
        let (mut found, mut read) = (false, 0);
        while let Some(&v) = self.queue.get(read) {
            read += 1;
            let mut e = self.first[v as usize];
            while e != NONE {
                let u = self.head[e as usize] as usize;
                if self.distance[u] == NONE && self.room[(e ^ 1) as usize] > 0 {
                    self.distance[u] = self.distance[v as usize] + 1;
                    found |= self.supply[u] > 0;
                    self.queue.push(u as u32);
                }
                e = self.next[e as usize];
            }
        }
        found
    }

    /// Sends the supply of `source` along shortest paths until it is used up or no such path is left.
    fn drain(&mut self, source: usize) {
        self.path.clear();
        let mut v = source;
        while self.supply[source] > 0 {
            if self.supply[v] < 0 {
                v = self.push(source, v);
            } else if let Some(e) = self.advance(v) {
                self.path.push(e);
                v = self.head[e as usize] as usize;
            } else {
                self.distance[v] = NONE;
                let Some(e) = self.path.pop() else { return };
                v = self.head[(e ^ 1) as usize] as usize;
            }
        }
    }

    /// The next arc from `v` that has room and leads one step closer to a demand.
    fn advance(&mut self, v: usize) -> Option<u32> {
        while self.cursor[v] != NONE {
            let e = self.cursor[v];
            let near = self.distance[self.head[e as usize] as usize];
            if self.room[e as usize] > 0 && near != NONE && near + 1 == self.distance[v] {
                return Some(e);
            }
            self.cursor[v] = self.next[e as usize];
        }
        None
    }

    /// Sends what fits along the path to the demand of `sink`; returns where the path is still open.
    fn push(&mut self, source: usize, sink: usize) -> usize {
        let ends = self.supply[source].min(-self.supply[sink]);
        let amount = self.path.iter().fold(ends, |m, &e| m.min(self.room[e as usize]));
        self.supply[source] -= amount;
        self.supply[sink] += amount;
        for &e in &self.path {
            self.room[e as usize] -= amount;
            self.room[(e ^ 1) as usize] += amount;
        }
        let full = self.path.iter().position(|&e| self.room[e as usize] == 0);
        self.path.truncate(full.unwrap_or(self.path.len()));
        self.path.last().map_or(source, |&e| self.head[e as usize] as usize)
    }
}
