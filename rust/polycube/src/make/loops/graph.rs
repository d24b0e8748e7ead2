//! Loops and their crossings as a combinatorial map.

use super::NONE;
use super::cut_mesh::CutMesh;

/// Where two loops of different kinds meet.
#[derive(Clone, Debug)]
pub(crate) struct Crossing {
    /// The two loops, by growing axis.
    pub(crate) loops: [u32; 2],
    /// The next crossing along each, high side left.
    pub(crate) next: [u32; 2],
    /// The one before.
    pub(crate) prev: [u32; 2],
    /// Whether the first loop runs from the left of the second to its right.
    left_to_right: bool,
    /// The vertex of the mesh where they meet.
    pub(crate) vertex: u32,
    /// The direction of the face that it stands for: twice the axis, plus one where it looks down that axis.
    pub(crate) label: u8,
    /// Whether both loops are left.
    pub(crate) alive: bool,
}

/// A closed curve.
#[derive(Clone, Debug)]
pub(crate) struct Loop {
    /// Its kind.
    pub(crate) axis: usize,
    /// Whether it is left.
    pub(crate) alive: bool,
    /// Its crossings in order; some may be gone.
    pub(crate) crossings: Vec<u32>,
    /// The zones below and above.
    pub(crate) zones: [u32; 2],
}

/// A part of a loop between two crossings, with a sense: four times the crossing that it leaves, plus twice the place
/// of the loop there, plus one where it runs forward (high side left).
pub(crate) type Arc = u32;

/// The sides of a region: up to six arcs, counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sides {
    arcs: [Arc; 6],
    count: usize,
}

impl Sides {
    /// The arcs.
    pub(super) fn arcs(&self) -> &[Arc] {
        &self.arcs[..self.count]
    }
}

/// All crossings of a set of loops.
#[derive(Clone, Debug, Default)]
pub(crate) struct LoopGraph {
    /// The crossings.
    pub(crate) crossings: Vec<Crossing>,
    /// The loops, one for each cut of the mesh.
    pub(crate) loops: Vec<Loop>,
}

impl LoopGraph {
    /// The loops of the living cuts. Those that cross no other are not alive in it.
    pub(crate) fn new(mesh: &CutMesh, alive: &[bool]) -> Self {
        let paths = loop_vertices(mesh, |cut| alive[cut as usize]);
        let mut me = Self { crossings: find_crossings(mesh, &paths), loops: Vec::with_capacity(paths.len()) };
        let mut at = vec![NONE; mesh.points.len()];
        (0..).zip(&me.crossings).for_each(|(q, c)| at[c.vertex as usize] = q);
        for (l, path) in (0..).zip(&paths) {
            let crossings: Vec<u32> = path.iter().map(|&v| at[v as usize]).filter(|&q| q != NONE).collect();
            me.link(l, &crossings);
            let alive = !crossings.is_empty();
            me.loops.push(Loop { axis: mesh.cuts[l as usize].axis, alive, crossings, zones: [NONE; 2] });
        }
        me.orient(mesh, alive, &at);
        for q in 0..me.crossings.len() {
            me.crossings[q].label = me.label(&me.crossings[q]);
        }
        me
    }

    fn link(&mut self, l: u32, crossings: &[u32]) {
        for (i, &q) in crossings.iter().enumerate() {
            let next = crossings[(i + 1) % crossings.len()];
            let (s, t) = (self.slot(q, l), self.slot(next, l));
            self.crossings[q as usize].next[s] = next;
            self.crossings[next as usize].prev[t] = q;
        }
    }

    /// Finds on which side of the second loop the first one starts: the first wall to the left of the first leads away
    /// there.
    fn orient(&mut self, mesh: &CutMesh, alive: &[bool], at: &[u32]) {
        let is_wall = |t: usize, k: usize| {
            let cut = mesh.triangles[t].cut[k];
            cut != NONE && alive[cut as usize]
        };
        for (t, triangle) in mesh.triangles.iter().enumerate() {
            for k in 0..3 {
                let Some(crossing) = self.crossings.get_mut(at[triangle.vertices[k] as usize] as usize) else {
                    continue;
                };
                if triangle.cut[k] == crossing.loops[0] && mesh.is_above(t, k) {
                    let mut side = mesh.turn(t, k);
                    while !is_wall(side.0, side.1) {
                        side = mesh.turn(side.0, side.1);
                    }
                    crossing.left_to_right = mesh.is_above(side.0, side.1);
                }
            }
        }
    }

    /// The direction that is right-handed with those of the two loops.
    fn label(&self, crossing: &Crossing) -> u8 {
        let axes = crossing.loops.map(|l| self.loops[l as usize].axis);
        let up = crossing.left_to_right != (axes == [0, 2]);
        2 * (3 - axes[0] - axes[1]) as u8 + u8::from(!up)
    }

    /// The place of a loop at one of its crossings.
    pub(crate) fn slot(&self, q: u32, l: u32) -> usize {
        usize::from(self.crossings[q as usize].loops[1] == l)
    }

    /// The other loop at a crossing.
    pub(super) fn other(&self, q: u32, l: u32) -> u32 {
        let loops = self.crossings[q as usize].loops;
        if loops[0] == l { loops[1] } else { loops[0] }
    }

    /// The loop that an arc is part of.
    pub(crate) fn loop_of(&self, arc: Arc) -> u32 {
        self.crossings[arc as usize / 4].loops[arc as usize / 2 % 2]
    }

    /// The crossing where an arc ends.
    pub(crate) fn end(&self, arc: Arc) -> u32 {
        let crossing = &self.crossings[arc as usize / 4];
        let slot = arc as usize / 2 % 2;
        if arc % 2 == 1 { crossing.next[slot] } else { crossing.prev[slot] }
    }

    /// The same arc in the other sense.
    pub(crate) fn twin(&self, arc: Arc) -> Arc {
        let q = self.end(arc);
        q * 4 + self.slot(q, self.loop_of(arc)) as u32 * 2 + (1 - arc % 2)
    }

    /// The arc after this one around the region on its left.
    pub(crate) fn next(&self, arc: Arc) -> Arc {
        let q = self.end(arc);
        let slot = self.slot(q, self.loop_of(arc));
        let ahead = (arc % 2 == 1) == self.crossings[q as usize].left_to_right;
        let forward = if slot == 0 { ahead } else { !ahead };
        q * 4 + (1 - slot as u32) * 2 + u32::from(forward)
    }

    /// The axis and sense in which the region left of an arc is left across it.
    pub(super) fn direction(&self, arc: Arc) -> usize {
        2 * self.loops[self.loop_of(arc) as usize].axis + (arc % 2) as usize
    }

    /// The sides of the region left of an arc; nothing if it has under three or two that look in one direction.
    pub(super) fn sides(&self, arc: Arc) -> Option<Sides> {
        let mut sides = Sides { arcs: [0; 6], count: 0 };
        let mut seen = 0_u8;
        let mut at = arc;
        loop {
            let bit = 1 << self.direction(at);
            if seen & bit != 0 {
                return None;
            }
            seen |= bit;
            sides.arcs[sides.count] = at;
            sides.count += 1;
            at = self.next(at);
            if at == arc {
                return (sides.count >= 3).then_some(sides);
            }
        }
    }

    /// Whether a region is a corner of the polycube, not a vertex inside a facet or an edge.
    fn is_corner(&self, sides: &[Arc]) -> bool {
        let axis = |i: usize| self.direction(sides[i]) / 2;
        sides.len() != 4 || (axis(0) != axis(2) && axis(1) != axis(3))
    }

    /// The least arc around the valid region left of an arc, and whether it is a corner.
    pub(super) fn region(&self, arc: Arc) -> Option<(Arc, bool)> {
        let sides = self.sides(arc)?;
        let least = sides.arcs().iter().copied().min()?;
        Some((least, self.is_corner(sides.arcs())))
    }

    /// The least arc around the region left of an arc, valid or not, and the loops around it in order.
    pub(super) fn outline(&self, arc: Arc) -> (Arc, Vec<u32>) {
        let mut least = arc;
        let mut loops = Vec::new();
        let mut at = arc;
        loop {
            least = least.min(at);
            loops.push(self.loop_of(at));
            at = self.next(at);
            if at == arc {
                break;
            }
        }
        loops.sort_unstable();
        loops.dedup();
        (least, loops)
    }
}

/// The vertices where two paths meet.
fn find_crossings(mesh: &CutMesh, paths: &[Vec<u32>]) -> Vec<Crossing> {
    let mut first = vec![NONE; mesh.points.len()];
    let mut found = Vec::new();
    for (l, path) in (0..).zip(paths) {
        for &vertex in path {
            let other = std::mem::replace(&mut first[vertex as usize], l);
            if other != NONE {
                let mut loops = [other, l];
                loops.sort_by_key(|&l| mesh.cuts[l as usize].axis);
                found.push((vertex, loops));
            }
        }
    }
    found.sort_unstable();
    let crossing = |&(vertex, loops): &(u32, [u32; 2])| Crossing {
        loops,
        next: [NONE; 2],
        prev: [NONE; 2],
        left_to_right: false,
        vertex,
        label: 0,
        alive: true,
    };
    found.iter().map(crossing).collect()
}

/// The vertices along each loop, forward (high side left), from its lowest vertex; none for those that are not alive.
pub(crate) fn loop_vertices(mesh: &CutMesh, alive: impl Fn(u32) -> bool) -> Vec<Vec<u32>> {
    let mut edges: Vec<(u32, u32, u32)> = Vec::new();
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        for k in 0..3 {
            let cut = triangle.cut[k];
            if cut != NONE && alive(cut) && mesh.is_above(t, k) {
                edges.push((cut, triangle.vertices[k], triangle.vertices[(k + 1) % 3]));
            }
        }
    }
    edges.sort_unstable();
    let mut paths = vec![Vec::new(); mesh.cuts.len()];
    for own in edges.chunk_by(|a, b| a.0 == b.0) {
        let path = &mut paths[own[0].0 as usize];
        let mut vertex = own[0].1;
        while path.len() < own.len() {
            path.push(vertex);
            vertex = own[own.partition_point(|e| e.1 < vertex)].2;
        }
    }
    paths
}
