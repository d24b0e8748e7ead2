//! A structure put in place: where its facets and edges lie, what a ray meets, and where the surface touches itself.

use super::rectangles::{LevelBox, rectangles};
use super::{Edge, Structure};
use crate::spatial::BoxTree;
use rayon::prelude::*;
use std::sync::OnceLock;

/// Two parts of the surface that touch or cross although they are not neighbours there.
#[derive(Clone, Debug, PartialEq)]
pub struct Conflict {
    /// The facets concerned.
    pub facets: [u32; 2],
    /// The two boxes that meet, where the conflict is between boxes.
    pub boxes: Option<[LevelBox; 2]>,
    /// A point where they meet.
    pub point: [f64; 3],
}

/// A rectangle of a facet.
struct Tile {
    facet: u32,
    levels: LevelBox,
}

/// A [`Structure`] under a placement, indexed for spatial queries.
///
/// Built in O(n log n) for n edges; a query takes O(log n) and the number of things it meets.
pub struct Arrangement<'a> {
    structure: &'a Structure,
    placement: Vec<f64>,
    tiles: Vec<Tile>,
    /// The tiles across each axis.
    tile_index: [BoxTree; 3],
    /// The edges, made when first asked for: only looking for conflicts needs them.
    edge_index: OnceLock<BoxTree>,
    folded: Vec<u32>,
}

impl<'a> Arrangement<'a> {
    /// Puts `structure` where `placement` says.
    pub fn new(structure: &'a Structure, placement: &[f64]) -> Self {
        // Adding zero turns -0.0 into 0.0, so that equal levels have equal bits.
        let placement: Vec<f64> = placement.iter().map(|x| x + 0.0).collect();
        let mut tiles = Vec::new();
        let mut folded = Vec::new();
        for (facet, f) in (0..).zip(&structure.facets) {
            match rectangles(structure, f, &placement) {
                Some(boxes) => tiles.extend(boxes.into_iter().map(|levels| Tile { facet, levels })),
                None => folded.push(facet),
            }
        }
        let extent = |levels: &LevelBox| structure.extent(levels, &placement);
        let tile_index = [0, 1, 2].map(|axis| {
            let across = |t: &(u32, &Tile)| structure.facets[t.1.facet as usize].label.axis() == axis;
            BoxTree::new((0..).zip(&tiles).filter(across).map(|(i, t)| (i, extent(&t.levels))))
        });
        Self { structure, placement, tiles, tile_index, edge_index: OnceLock::new(), folded }
    }

    /// The structure put in place.
    pub fn structure(&self) -> &'a Structure {
        self.structure
    }

    /// The coordinate of every level.
    pub fn placement(&self) -> &[f64] {
        &self.placement
    }

    /// Rectangles that tile the facets: facet, lower and higher corner.
    pub fn tiles(&self) -> impl Iterator<Item = (u32, [f64; 3], [f64; 3])> + '_ {
        self.tiles.iter().map(|t| {
            let (low, high) = self.structure.extent(&t.levels, &self.placement);
            (t.facet, low, high)
        })
    }

    /// Every place where the surface touches or crosses itself, in a fixed order; empty for an embedded surface.
    ///
    /// Two facets that meet do so on the border of one of them, so it is enough to look at each edge: it may
    /// meet another edge only in a common corner, and a facet only along that facet's border.
    pub fn conflicts(&self) -> Vec<Conflict> {
        let mut conflicts: Vec<Conflict> = self.folded.iter().map(|&f| self.folded_facet(f)).collect();
        let edges = self.structure.edges.par_iter().with_min_len(512).enumerate();
        conflicts.par_extend(edges.flat_map_iter(|(i, edge)| self.edge_conflicts(i as u32, edge)));
        conflicts
    }

    /// Components of the surface that look the wrong way: solid inside solid, or hollow in the open. By facet.
    pub fn inside_out(&self) -> Vec<u32> {
        let component = self.structure.components();
        let count = component.iter().max().map_or(0, |c| c + 1);
        (0..count).filter_map(|c| self.misplaced(c, &component)).collect()
    }

    /// Whether `point` lies inside or on the polycube.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        let mut on_surface = false;
        self.tile_index.iter().for_each(|tiles| tiles.meeting(point, point, |_| on_surface = true));
        on_surface || self.winding(point, |_| true) != 0
    }

    /// The closest facet that the ray from `point` along `axis` (upwards or downwards) meets beyond `point`:
    /// the facet, and the levels that bound it around the place where it is hit.
    pub fn first_hit(&self, point: [f64; 3], axis: usize, upwards: bool) -> Option<(u32, LevelBox)> {
        let (low, high) = ray(point, axis, upwards);
        let mut nearest: Option<(f64, u32)> = None;
        self.tile_index[axis].visit(low, high, |tile, wanted| {
            let tile = &self.tiles[tile as usize];
            let at = self.placement[tile.levels.low[axis] as usize];
            let found = ((at - point[axis]).abs(), tile.facet);
            if found.0 > 0.0 && nearest.is_none_or(|n| found < n) {
                nearest = Some(found);
                (if upwards { &mut wanted.high } else { &mut wanted.low })[axis] = at;
            }
        });
        nearest.map(|(_, facet)| (facet, self.clearance(facet, point)))
    }

    /// The levels of the sides of `facet` nearest to `point` in the four directions of its plane.
    fn clearance(&self, facet: u32, point: [f64; 3]) -> LevelBox {
        let f = &self.structure.facets[facet as usize];
        let axis = f.label.axis();
        let (mut low, mut high) = ([f.level; 3], [f.level; 3]);
        let mut nearest = [[f64::INFINITY; 2]; 3];
        for side in f.sides() {
            let edge = &self.structure.edges[side.edge as usize];
            let [from, to] = self.structure.ends(edge).map(|l| self.placement[l as usize]);
            if point[edge.axis] < from || point[edge.axis] > to {
                continue;
            }
            let across = 3 - axis - edge.axis;
            let level = self.structure.corners[edge.corners[0] as usize].levels[across];
            let offset = self.placement[level as usize] - point[across];
            if offset >= 0.0 && offset < nearest[across][1] {
                nearest[across][1] = offset;
                high[across] = level;
            }
            if offset <= 0.0 && -offset < nearest[across][0] {
                nearest[across][0] = -offset;
                low[across] = level;
            }
        }
        LevelBox { low, high }
    }

    /// How often the surface of the facets `chosen` winds around `point`, which must not lie on it. Where the ray
    /// runs along a tile's border the point counts as a little further up along Y and Z.
    fn winding(&self, point: [f64; 3], chosen: impl Fn(u32) -> bool) -> i32 {
        let (from, to) = ray(point, 0, true);
        let mut winding = 0;
        self.tile_index[0].meeting(from, to, |tile| {
            let tile = &self.tiles[tile as usize];
            let (low, high) = self.structure.extent(&tile.levels, &self.placement);
            if (1..3).all(|a| low[a] <= point[a] && point[a] < high[a]) && chosen(tile.facet) {
                winding += i32::from(self.structure.facets[tile.facet as usize].label.sign());
            }
        });
        winding
    }

    /// A facet of component `c` if that component's solid side and its surroundings do not fit.
    fn misplaced(&self, c: u32, component: &[u32]) -> Option<u32> {
        let tiles = || self.tiles.iter().filter(|t| component[t.facet as usize] == c);
        let volume: f64 = tiles().map(|t| self.signed_volume(t)).sum();
        let tile = tiles().next()?;
        let (low, high) = self.structure.extent(&tile.levels, &self.placement);
        let centre = std::array::from_fn(|a| f64::midpoint(low[a], high[a]));
        let around = self.winding(centre, |f| component[f as usize] != c);
        (around != i32::from(volume < 0.0)).then_some(tile.facet)
    }

    /// The tile's part of the volume by the divergence theorem, along X.
    fn signed_volume(&self, tile: &Tile) -> f64 {
        let label = self.structure.facets[tile.facet as usize].label;
        let (low, high) = self.structure.extent(&tile.levels, &self.placement);
        if label.axis() == 0 { f64::from(label.sign()) * low[0] * (high[1] - low[1]) * (high[2] - low[2]) } else { 0.0 }
    }

    fn edge_index(&self) -> &BoxTree {
        let extent = |e: &Edge| self.structure.extent(&self.structure.edge_box(e), &self.placement);
        let edges = || (0..).zip(&self.structure.edges).map(|(i, e)| (i, extent(e)));
        self.edge_index.get_or_init(|| BoxTree::new(edges()))
    }

    fn folded_facet(&self, facet: u32) -> Conflict {
        let side = self.structure.facets[facet as usize].loops[0][0];
        let corner = self.structure.edges[side.edge as usize].corners[0];
        Conflict { facets: [facet; 2], boxes: None, point: self.structure.position(corner, &self.placement) }
    }

    fn edge_conflicts(&self, i: u32, edge: &Edge) -> impl Iterator<Item = Conflict> {
        let (low, high) = self.structure.extent(&self.structure.edge_box(edge), &self.placement);
        let (mut edges, mut tiles) = (Vec::new(), Vec::new());
        self.edge_index().meeting(low, high, |j| {
            let conflict = if j > i { self.edge_meets_edge(edge, j) } else { None };
            edges.extend(conflict.map(|c| (j, c)));
        });
        for index in &self.tile_index {
            index.meeting(low, high, |t| tiles.extend(self.edge_meets_tile(edge, t).map(|c| (t, c))));
        }
        edges.sort_unstable_by_key(|e| e.0);
        tiles.sort_unstable_by_key(|t| t.0);
        edges.into_iter().chain(tiles).map(|(_, conflict)| conflict)
    }

    /// Edges may meet in a common corner only.
    fn edge_meets_edge(&self, edge: &Edge, other: u32) -> Option<Conflict> {
        let other = &self.structure.edges[other as usize];
        let boxes = [self.structure.edge_box(edge), self.structure.edge_box(other)];
        let (low, high) = self.intersection(&boxes)?;
        let common = edge.corners.iter().find(|c| other.corners.contains(c));
        let at_corner = common.is_some_and(|&c| self.structure.position(c, &self.placement) == low);
        (low != high || !at_corner).then(|| Conflict {
            facets: [edge.facets[0], other.facets[0]],
            boxes: Some(boxes),
            point: low,
        })
    }

    /// An edge may meet a facet along their common border, or in a corner that the facet has too.
    fn edge_meets_tile(&self, edge: &Edge, tile: u32) -> Option<Conflict> {
        let tile = &self.tiles[tile as usize];
        let boxes = [self.structure.edge_box(edge), tile.levels];
        let (low, high) = self.intersection(&boxes)?;
        let allowed = if low == high { self.is_shared_corner(edge, tile, low) } else { self.is_border(edge, tile) };
        (!allowed).then(|| Conflict { facets: [edge.facets[0], tile.facet], boxes: Some(boxes), point: low })
    }

    fn is_shared_corner(&self, edge: &Edge, tile: &Tile, point: [f64; 3]) -> bool {
        let facet = &self.structure.facets[tile.facet as usize];
        let end = edge.corners.into_iter().find(|&c| self.structure.position(c, &self.placement) == point);
        end.is_some_and(|c| facet.sides().any(|s| self.structure.edges[s.edge as usize].corners.contains(&c)))
    }

    /// Whether the tile lies on its facet's side of the edge, which bounds that facet.
    fn is_border(&self, edge: &Edge, tile: &Tile) -> bool {
        let label = self.structure.facets[tile.facet as usize].label;
        let Some(side) = edge.facets.iter().position(|&f| f == tile.facet) else { return false };
        let across = 3 - label.axis() - edge.axis;
        // The facet is left of an upward edge if it is the edge's first.
        let upward = (label.left(edge.axis) > 0) == (side == 0);
        let levels = &tile.levels;
        let at = |l: u32| self.placement[l as usize];
        let line = at(self.structure.edge_box(edge).low[across]);
        if upward { at(levels.low[across]) == line } else { at(levels.high[across]) == line }
    }

    fn intersection(&self, boxes: &[LevelBox; 2]) -> Option<([f64; 3], [f64; 3])> {
        let [(a, b), (c, d)] = boxes.map(|levels| self.structure.extent(&levels, &self.placement));
        let low: [f64; 3] = std::array::from_fn(|k| a[k].max(c[k]));
        let high: [f64; 3] = std::array::from_fn(|k| b[k].min(d[k]));
        (0..3).all(|k| low[k] <= high[k]).then_some((low, high))
    }
}

/// The box that the ray from `point` along `axis` fills.
fn ray(point: [f64; 3], axis: usize, upwards: bool) -> ([f64; 3], [f64; 3]) {
    let (mut low, mut high) = (point, point);
    if upwards {
        high[axis] = f64::MAX;
    } else {
        low[axis] = f64::MIN;
    }
    (low, high)
}
