//! Triangles to pixels: a z-buffer that knows what is seen where.

use super::cells::Tile;
use crate::output::colour::{Colour, INK, pastel};

/// A corner of a triangle, seen.
#[derive(Clone, Copy)]
pub struct ProjectedCorner {
    /// Pixels to the right, pixels down, and the distance towards the eye.
    pub screen: [f32; 3],
    /// The place on the polycube.
    pub place: [f32; 3],
    /// The light on it, 0 to 1.
    pub light: f32,
}

/// What is seen in a pixel.
#[derive(Clone, Copy, PartialEq)]
struct Seen {
    depth: f32,
    facet: u32,
    place: [f32; 3],
    light: f32,
}

const NOTHING: Seen = Seen { depth: f32::NEG_INFINITY, facet: u32::MAX, place: [0.0; 3], light: 0.0 };

/// Square picture of what is nearest.
pub struct Raster {
    size: usize,
    seen: Vec<Seen>,
}

/// Facet and colour number of a pixel; the facet is `u32::MAX` where nothing is seen.
type Id = (u32, usize);

impl Raster {
    /// An empty picture of `size` by `size` pixels.
    pub fn new(size: usize) -> Self {
        Self { size, seen: vec![NOTHING; size * size] }
    }

    /// Draws a triangle of `facet` where nothing nearer is.
    pub fn triangle(&mut self, facet: u32, corners: &[ProjectedCorner; 3]) {
        let [a, b, c] = corners.map(|c| c.screen);
        let area = cross(a, b, c);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let range = |k: usize| {
            let (low, high) = (a[k].min(b[k]).min(c[k]), a[k].max(b[k]).max(c[k]));
            (low.max(0.0).floor() as usize)..((high + 1.0).clamp(0.0, self.size as f32) as usize)
        };
        let (columns, rows) = (range(0), range(1));
        for y in rows {
            for x in columns.clone() {
                let at = [x as f32 + 0.5, y as f32 + 0.5, 0.0];
                let weights = [cross(at, b, c), cross(a, at, c), cross(a, b, at)].map(|w| w / area);
                if weights.iter().all(|w| *w >= -1e-5) {
                    self.put(y * self.size + x, facet, corners, weights);
                }
            }
        }
    }

    fn put(&mut self, pixel: usize, facet: u32, corners: &[ProjectedCorner; 3], weights: [f32; 3]) {
        let mix = |f: &dyn Fn(&ProjectedCorner) -> f32| corners.iter().zip(weights).map(|(c, w)| f(c) * w).sum::<f32>();
        let depth = mix(&|c| c.screen[2]);
        if depth > self.seen[pixel].depth {
            let place = std::array::from_fn(|a| mix(&|c| c.place[a]));
            self.seen[pixel] = Seen { depth, facet, place, light: mix(&|c| c.light) };
        }
    }

    /// The colours, with lines between the tiles and heavier ones between facets. `planes` and `tiles` are those of the
    /// layout, the tiles by facet.
    pub fn colours(&self, planes: &[Vec<f32>; 3], tiles: &[Vec<Tile>]) -> Vec<Colour> {
        let ids = self.ids(planes, tiles);
        let colour = |(pixel, seen): (usize, &Seen)| {
            if self.is_line(&ids, pixel) {
                return INK;
            }
            let (facet, tile) = ids[pixel];
            let own = tiles.get(facet as usize).and_then(|t| t.get(tile));
            own.map_or([1.0; 3], |t| pastel(t.id).map(|x| x * seen.light))
        };
        self.seen.iter().enumerate().map(colour).collect()
    }

    fn ids(&self, planes: &[Vec<f32>; 3], tiles: &[Vec<Tile>]) -> Vec<Id> {
        let mut last = 0;
        let id = |seen: &Seen| {
            let Some(own) = tiles.get(seen.facet as usize) else { return (u32::MAX, 0) };
            let gap = |tile: usize| own.get(tile).map_or(f32::INFINITY, |t| gap(t, planes, seen.place));
            if gap(last) > 0.0 {
                last = (0..own.len()).min_by(|&a, &b| gap(a).total_cmp(&gap(b))).unwrap_or(0);
            }
            (seen.facet, last)
        };
        self.seen.iter().map(id).collect()
    }

    /// Whether a pixel near this one, to the right or below, shows another tile; further off, another facet.
    fn is_line(&self, ids: &[Id], pixel: usize) -> bool {
        let own = ids[pixel];
        let other = |reach: usize, step: usize| {
            let beyond = if step == 1 { pixel % self.size + reach >= self.size } else { false };
            ids.get(pixel + reach * step).filter(|_| !beyond).copied().unwrap_or(own)
        };
        let steps = [1, self.size];
        let tile = steps.iter().any(|&s| (1..=2).any(|r| other(r, s) != own));
        tile || steps.iter().any(|&s| (3..=4).any(|r| other(r, s).0 != own.0))
    }
}

/// How far a place on the polycube is from a tile of its facet.
fn gap(tile: &Tile, planes: &[Vec<f32>; 3], place: [f32; 3]) -> f32 {
    let along = |a: usize| {
        let (low, high) = (planes[a][tile.low[a]], planes[a][tile.high[a]]);
        if tile.low[a] == tile.high[a] { 0.0 } else { (low - place[a]).max(place[a] - high).max(0.0) }
    };
    along(0) + along(1) + along(2)
}

fn cross(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> f32 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
