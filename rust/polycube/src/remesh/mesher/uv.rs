//! Texture coordinates: a chart for each patch of the layout.

use super::quads::Quads;
use crate::mesh::Point;
use crate::structure::Label;

/// Where a patch lies on the plane of its facet, in lattice units: least and largest coordinates.
type Bounds = [[f64; 2]; 2];

impl Quads {
    /// Texture coordinates of the corners of each quadrilateral, in its order, from 0 to 1: every patch of the layout
    /// is a rectangle of squares, all of one size and as on the polycube, counter-clockwise as seen from outside, and
    /// no two overlap or touch.
    ///
    /// Patches that meet divide the edge between them alike, and a pattern that repeats from square to square and looks
    /// the same turned by a quarter goes on over it. O(n log n) for n quadrilaterals.
    pub fn uv(&self) -> Vec<[[f64; 2]; 4]> {
        let flat: Vec<[[f64; 2]; 4]> = (0..self.label.len()).map(|i| self.flat(i)).collect();
        let patches = self.patch_id.iter().max().map_or(0, |&last| last as usize + 1);
        let mut bounds = vec![[[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]; patches];
        for (corners, &patch) in flat.iter().zip(&self.patch_id) {
            let [low, high] = &mut bounds[patch as usize];
            for corner in corners {
                *low = [0, 1].map(|a| low[a].min(corner[a]));
                *high = [0, 1].map(|a| high[a].max(corner[a]));
            }
        }
        let (places, side) = packed(&bounds);
        let place = |(corners, &patch): (&[[f64; 2]; 4], &u32)| {
            let ([low, _], at) = (bounds[patch as usize], places[patch as usize]);
            corners.map(|corner| [0, 1].map(|a| (corner[a] - low[a] + at[a]) / side))
        };
        flat.iter().zip(&self.patch_id).map(place).collect()
    }

    /// The corners of a quadrilateral on the plane of its facet, counter-clockwise as seen from outside.
    fn flat(&self, quad: usize) -> [[f64; 2]; 4] {
        let label = Label::new(self.label[quad]);
        let (axis, up) = label.map_or((2, true), |label| (label.axis(), label.sign() > 0));
        let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
        let on_plane = |p: Point| if up { [p[first], p[second]] } else { [p[second], p[first]] };
        let mut corners = [[0.0; 2]; 4];
        for (corner, &v) in corners.iter_mut().zip(self.mesh.cells().cell(quad)) {
            *corner = on_plane(self.polycube[v as usize]);
        }
        corners
    }
}

/// Where rectangles of these sizes go, the highest first, in rows one unit apart from all others and from the border of
/// a square, and how long its sides are.
fn packed(bounds: &[Bounds]) -> (Vec<[f64; 2]>, f64) {
    let size = |i: usize| -> [f64; 2] { [0, 1].map(|a| (bounds[i][1][a] - bounds[i][0][a]).max(0.0) + 1.0) };
    let mut order: Vec<usize> = (0..bounds.len()).collect();
    order.sort_by(|&i, &j| size(j)[1].total_cmp(&size(i)[1]).then(i.cmp(&j)));
    let area: f64 = order.iter().map(|&i| size(i)[0] * size(i)[1]).sum();
    let width = order.iter().map(|&i| size(i)[0]).fold(area.sqrt().ceil(), f64::max);
    let mut places = vec![[1.0; 2]; bounds.len()];
    let (mut at, mut height) = ([0.0, 0.0], 0.0_f64);
    for i in order {
        if at[0] + size(i)[0] > width {
            at = [0.0, at[1] + height];
            height = 0.0;
        }
        places[i] = at.map(|x| x + 1.0);
        at[0] += size(i)[0];
        height = height.max(size(i)[1]);
    }
    (places, width.max(at[1] + height) + 1.0)
}
