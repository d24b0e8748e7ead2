//! A set of loops from which loops are taken away.

use super::NONE;
use super::cut_mesh::CutMesh;
use super::energy::Energies;
use super::graph::{Arc, LoopGraph};
use super::order::Order;
use super::regions::Regions;
use petgraph::unionfind::UnionFind;

/// What was part of the face of one crossing becomes part of two others, half each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transfer {
    pub(super) from: u32,
    pub(super) to: [u32; 2],
}

/// The loops, their zones, and what is known of both.
#[derive(Clone, Debug)]
pub(super) struct Moves {
    pub(super) graph: LoopGraph,
    pub(super) energies: Energies,
    /// The zone of the face of each crossing, as it was at first.
    zone_of_crossing: Vec<u32>,
    zones: UnionFind<u32>,
    /// How many faces of crossings lie in each zone.
    faces: Vec<u32>,
    pub(super) order: Order,
    /// The loops of the trial under way.
    pub(super) doomed: Vec<bool>,
    /// Arcs beside regions that are no discs, which must stay as they are.
    pub(super) fixed: Vec<bool>,
    /// How many crossings each loop has left.
    pub(super) left: Vec<u32>,
    /// When a region beside each loop changed last.
    changed: Vec<u32>,
    /// How many moves were made.
    pub(super) moves: u32,
}

impl Moves {
    /// The living loops of a mesh.
    pub(super) fn new(mesh: &CutMesh, alive: &[bool], mut graph: LoopGraph, energies: Energies) -> Self {
        let regions = Regions::new(mesh, alive);
        let region_of = regions_of_arcs(mesh, alive, &graph, &regions);
        let (zone, zones) = zones(&graph, &region_of, regions.len());
        for (l, own) in (0..).zip(&mut graph.loops) {
            if let Some(&q) = own.crossings.first() {
                let slot = usize::from(graph.crossings[q as usize].loops[1] == l);
                own.zones = [0, 1].map(|f| zone[own.axis][region_of[q as usize * 4 + slot * 2 + f] as usize]);
            }
        }
        let face = |(q, label): (usize, u8)| zone[label as usize / 2][region_of[q * 4] as usize];
        let zone_of_crossing: Vec<u32> = graph.crossings.iter().map(|c| c.label).enumerate().map(face).collect();
        let mut faces = vec![0; zones];
        zone_of_crossing.iter().for_each(|&z| faces[z as usize] += 1);
        let count = graph.loops.len();
        let mut me = Self {
            left: graph.loops.iter().map(|l| l.crossings.len() as u32).collect(),
            fixed: region_of.iter().map(|&r| regions.euler[r as usize] != 1).collect(),
            graph,
            energies,
            zone_of_crossing,
            zones: UnionFind::new(zones),
            faces,
            order: Order::default(),
            doomed: vec![false; count],
            changed: vec![0; count],
            moves: 0,
        };
        me.sort_zones();
        me
    }

    /// Names the zones of all loops anew and builds the order of zones.
    fn sort_zones(&mut self) {
        let mut steps = Vec::new();
        for (l, own) in (0..).zip(&mut self.graph.loops).filter(|(_, own)| own.alive) {
            own.zones = own.zones.map(|z| self.zones.find_mut(z));
            steps.push((own.zones[0], own.zones[1], l));
        }
        self.order = Order::new(self.faces.len(), steps);
    }

    /// Whether a loop is the first of those between its zones.
    pub(super) fn is_first(&self, l: u32) -> bool {
        let own = &self.graph.loops[l as usize];
        own.alive && self.order.parallel(own.zones).next() == Some(l)
    }

    /// Whether one of the zones beside each of these loops has no face.
    pub(super) fn is_free(&self, loops: &[u32]) -> bool {
        let empty = |z: u32| self.faces[z as usize] == 0;
        loops.iter().all(|&l| self.graph.loops[l as usize].zones.into_iter().any(empty))
    }

    /// Whether nothing changed beside these loops since there were this many moves.
    pub(super) fn is_unchanged(&self, loops: &[u32], since: u32) -> bool {
        loops.iter().all(|&l| self.graph.loops[l as usize].alive && self.changed[l as usize] <= since)
    }

    /// Takes closed `loops` with all their crossings away.
    pub(super) fn apply(&mut self, loops: &[u32], crossings: &[u32], transfers: &[Transfer]) {
        let fresh = self.unlink(crossings);
        self.moves += 1;
        transfers.iter().for_each(|t| self.energies.give(t.from, t.to));
        for &q in crossings {
            for l in self.graph.crossings[q as usize].loops {
                self.left[l as usize] -= 1;
                self.changed[l as usize] = self.moves;
            }
            let zone = self.zones.find_mut(self.zone_of_crossing[q as usize]);
            self.faces[zone as usize] -= 1;
        }
        self.mark_changed(&fresh);
        loops.iter().for_each(|&l| self.merge(l));
        self.forget_crossings();
        self.sort_zones();
    }

    fn mark_changed(&mut self, fresh: &[Arc]) {
        for &arc in fresh.iter().filter(|&&h| self.graph.crossings[h as usize / 4].alive) {
            for side in [arc, self.graph.twin(arc)] {
                let loops = self.graph.outline(side).1;
                loops.iter().for_each(|&l| self.changed[l as usize] = self.moves);
            }
        }
    }

    /// Makes one zone of those beside a loop.
    fn merge(&mut self, l: u32) {
        let own = &mut self.graph.loops[l as usize];
        own.alive = false;
        let [low, high] = own.zones.map(|z| self.zones.find_mut(z));
        if self.zones.union(low, high) {
            let faces = self.faces[low as usize] + self.faces[high as usize];
            let zone = self.zones.find_mut(low);
            self.faces[zone as usize] = faces;
        }
    }

    /// Drops crossings that are gone from the lists of loops that are mostly gone.
    fn forget_crossings(&mut self) {
        let crossings = &self.graph.crossings;
        for (own, &left) in self.graph.loops.iter_mut().zip(&self.left) {
            if own.crossings.len() as u32 > 2 * left {
                own.crossings.retain(|&q| crossings[q as usize].alive);
            }
        }
    }

    /// How many corners the polycube has.
    pub(super) fn corners(&self) -> usize {
        let arcs = self.living().flat_map(|q| (0..4).map(move |f| q * 4 + f));
        arcs.filter(|&h| self.graph.region(h) == Some((h, true))).count()
    }

    /// The crossings that are left.
    pub(super) fn living(&self) -> impl Iterator<Item = u32> + '_ {
        (0..).zip(&self.graph.crossings).filter(|(_, c)| c.alive).map(|(q, _)| q)
    }

    /// The loops that are left and the zones of the faces of all crossings.
    pub(super) fn finish(mut self) -> (LoopGraph, Vec<u32>) {
        let zones = self.zone_of_crossing.iter().map(|&z| self.zones.find_mut(z)).collect();
        let crossings = &self.graph.crossings;
        self.graph.loops.iter_mut().for_each(|l| l.crossings.retain(|&q| crossings[q as usize].alive));
        (self.graph, zones)
    }
}

/// The region left of each arc.
fn regions_of_arcs(mesh: &CutMesh, alive: &[bool], graph: &LoopGraph, regions: &Regions) -> Vec<u32> {
    let mut at = vec![NONE; mesh.points.len()];
    (0..).zip(&graph.crossings).for_each(|(q, c)| at[c.vertex as usize] = q);
    let mut region_of = vec![0; 4 * graph.crossings.len()];
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        for k in 0..3 {
            let (cut, q) = (triangle.cut[k], at[triangle.vertices[k] as usize]);
            if cut != NONE && q != NONE && alive[cut as usize] {
                // A side leaves its first end forward if what is high lies on its left.
                let arc = q as usize * 4 + graph.slot(q, cut) * 2 + usize::from(mesh.is_above(t, k));
                region_of[arc] = regions.of[t];
            }
        }
    }
    region_of
}

/// For each axis the zone of each region, and how many zones there are.
fn zones(graph: &LoopGraph, region_of: &[u32], regions: usize) -> ([Vec<u32>; 3], usize) {
    let mut sets: [UnionFind<u32>; 3] = std::array::from_fn(|_| UnionFind::new(regions));
    for arc in 0..region_of.len() as u32 {
        let axis = graph.direction(arc) / 2;
        let [r, s] = [arc, graph.twin(arc)].map(|h| region_of[h as usize]);
        (0..3).filter(|&a| a != axis).for_each(|a| {
            sets[a].union(r, s);
        });
    }
    let mut count = 0;
    let zone = sets.map(|set| {
        let mut name = vec![NONE; regions];
        let mut of = |root: u32| {
            if name[root as usize] == NONE {
                name[root as usize] = count;
                count += 1;
            }
            name[root as usize]
        };
        set.into_labeling().into_iter().map(&mut of).collect()
    });
    (zone, count as usize)
}
