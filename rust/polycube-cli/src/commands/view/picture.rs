//! A picture without a display: input above result where there is a shape, else beside it.

use super::raster::{ProjectedCorner, Raster};
use super::scene::{Layout, Scene};
use crate::output::colour::{self, Colour};
use polycube::mesh::Point;
use polycube::{Context, Error, ErrorKind, Result};
use std::array::from_fn;

/// Towards the eye.
const VIEW: [f64; 3] = [0.50, 0.42, 0.76];
/// Drawn larger by this and scaled down, for smooth lines.
const FINER: usize = 3;

/// One object of the picture.
struct Pane {
    size: usize,
    colours: Vec<Colour>,
}

/// A PNG file: polycube before and after, and the shape with the layouts of both below it.
///
/// # Errors
/// [`ErrorKind::Cancelled`]; [`ErrorKind::Internal`] if the picture cannot be encoded.
pub fn png(scene: &Scene, size: u32, context: &Context) -> Result<Vec<u8>> {
    let size = size as usize;
    let mut rows = Vec::new();
    for on in std::iter::once(None).chain(scene.shape.as_deref().map(Some)) {
        let mut row = Vec::new();
        for layout in scene.ends() {
            context.tick(rows.len() as f64 / 2.0)?;
            row.push(pane(scene, layout, on, size));
        }
        rows.push(row);
    }
    encode(&rows, size)
}

fn pane(scene: &Scene, layout: &Layout, on: Option<&[Point]>, size: usize) -> Pane {
    let fine = size * FINER;
    let points = on.unwrap_or(&layout.points);
    let screen = project(points, scene.up, fine as f64);
    let normals = if on.is_some() { Some(normals(&scene.triangles, points)) } else { None };
    let mut raster = Raster::new(fine);
    for (triangle, &facet) in scene.triangles.iter().zip(&scene.facet) {
        let corner = |v: u32| ProjectedCorner {
            screen: screen[v as usize],
            place: from_fn(|a| layout.points[v as usize][a] as f32),
            light: light(
                normals.as_ref().map_or_else(|| axis(scene.labels[facet as usize]), |n| n[v as usize]),
                scene.up,
            ),
        };
        raster.triangle(facet, &triangle.map(corner));
    }
    let planes = from_fn(|a| layout.pieces.planes[a].iter().map(|&x| x as f32).collect());
    let mut tiles = vec![Vec::new(); scene.labels.len()];
    layout.pieces.faces.iter().for_each(|tile| tiles[tile.facet as usize].push(*tile));
    Pane { size, colours: shrink(&raster.colours(&planes, &tiles), size) }
}

/// Pixels to the right, pixels down, and the distance towards the eye, of all points in a square of `size` pixels.
fn project(points: &[Point], up: usize, size: f64) -> Vec<[f32; 3]> {
    let [x, y, z] = VIEW;
    let axes = [[z, 0.0, -x], [-x * y, x * x + z * z, -y * z], VIEW].map(|axis| turned(unit(axis), up));
    let seen = |p: &Point| axes.map(|axis| (0..3).map(|a| axis[a] * p[a]).sum::<f64>());
    let seen: Vec<[f64; 3]> = points.iter().map(seen).collect();
    let end = |a: usize, pick: fn(f64, f64) -> f64| seen.iter().map(|p| p[a]).reduce(pick).unwrap_or(0.0);
    let (low, high): ([f64; 2], [f64; 2]) = (from_fn(|a| end(a, f64::min)), from_fn(|a| end(a, f64::max)));
    let scale = 0.9 * size / (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
    let place = |p: &[f64; 3]| {
        let x = size / 2.0 + (p[0] - f64::midpoint(low[0], high[0])) * scale;
        let y = size / 2.0 - (p[1] - f64::midpoint(low[1], high[1])) * scale;
        [x as f32, y as f32, (p[2] * scale) as f32]
    };
    seen.iter().map(place).collect()
}

/// The same vector where the axis `up` points up, which is Y in `v`.
fn turned(v: [f64; 3], up: usize) -> [f64; 3] {
    from_fn(|a| v[(a + 4 - up) % 3])
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

/// The direction of a label.
fn axis(label: usize) -> [f64; 3] {
    from_fn(|a| {
        if a != label / 2 {
            0.0
        } else if label.is_multiple_of(2) {
            1.0
        } else {
            -1.0
        }
    })
}

/// Brightest towards the upper left of the eye, darkest away from it.
fn light(normal: [f64; 3], up: usize) -> f32 {
    let towards = turned(unit([0.25, 0.85, 0.55]), up);
    let cosine: f64 = unit(normal).iter().zip(towards).map(|(n, t)| n * t).sum();
    if cosine.is_finite() { (0.80 + 0.24 * cosine).min(1.0) as f32 } else { 0.8 }
}

/// The mean normals at all vertices, by area.
fn normals(triangles: &[[u32; 3]], points: &[Point]) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; points.len()];
    for t in triangles {
        let [a, b, c] = t.map(|v| points[v as usize]);
        let normal = (b - a).cross(&(c - a));
        t.iter().for_each(|&v| sums[v as usize].iter_mut().zip(normal.iter()).for_each(|(s, n)| *s += n));
    }
    sums
}

/// The means of squares of pixels.
fn shrink(colours: &[Colour], size: usize) -> Vec<Colour> {
    let mean = |pixel: usize| {
        let (x, y) = (pixel % size * FINER, pixel / size * FINER);
        let inner = (0..FINER * FINER).map(|i| colours[(y + i / FINER) * size * FINER + x + i % FINER]);
        let sum = inner.fold([0.0; 3], |s: Colour, c| from_fn(|k| s[k] + c[k]));
        sum.map(|s| s / (FINER * FINER) as f32)
    };
    (0..size * size).map(mean).collect()
}

fn encode(rows: &[Vec<Pane>], size: usize) -> Result<Vec<u8>> {
    let failed = |e: png::EncodingError| Error::new(ErrorKind::Internal, format!("cannot encode the picture: {e}"));
    let mut pixels = Vec::new();
    for row in rows {
        for y in 0..size {
            let line = row.iter().flat_map(|pane| &pane.colours[y * pane.size..(y + 1) * pane.size]);
            pixels.extend(line.flat_map(|&c| colour::bytes(c)));
        }
    }
    let width = rows.first().map_or(0, Vec::len) * size;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, (rows.len() * size) as u32);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&pixels).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}
