//! The page: a template, the viewer, the data.

use super::cells::{Pieces, Tile};
use super::hexes::Hexes;
use super::scene::{Layout, Scene, Step};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use polycube::layout::Counts;
use polycube::measure::{Statistics, statistics};
use polycube::mesh::Point;
use polycube::{Error, ErrorKind, Result};
use serde::Serialize;

const PAGE: &str = include_str!("../../../assets/page.html");
const STYLE: &str = include_str!("../../../assets/page.css");
const VIEWER: &str = include_str!("../../../assets/viewer.js");
const CUTS: &str = include_str!("../../../assets/cuts.js");
const THREE: &str = include_str!("../../../assets/three.min.js");
const LICENCE: &str = include_str!("../../../assets/three.LICENSE");

/// The data of a page. Arrays of numbers are base64 of little-endian bytes.
#[derive(Serialize)]
struct Data<'a> {
    title: &'a str,
    up: usize,
    /// u32, three per triangle.
    triangles: String,
    /// u32, one per triangle.
    facets: String,
    labels: &'a [usize],
    chains: Vec<&'a [u32]>,
    convex: Vec<bool>,
    /// f32, three per vertex.
    shape: Option<String>,
    steps: Vec<StepData>,
    layouts: Vec<LayoutData>,
    hexes: Option<HexData>,
}

#[derive(Serialize)]
struct StepData {
    lambda: Option<f64>,
    pairs: Option<usize>,
    alignments: Option<usize>,
    counts: Counts,
    layout: usize,
}

#[derive(Serialize)]
struct LayoutData {
    /// f32, three per vertex.
    points: String,
    planes: [Vec<f32>; 3],
    /// u16, six per block: the planes of the lower and the upper corner.
    blocks: String,
    faces: TileData,
    patches: TileData,
}

#[derive(Serialize)]
struct TileData {
    /// u16, six per tile.
    corners: String,
    /// u32, one per tile.
    facets: String,
    /// u32, one per tile.
    ids: String,
}

#[derive(Serialize)]
struct HexData {
    /// f32, three per vertex.
    points: String,
    /// u32, eight per hexahedron.
    cells: String,
    /// f32, one per hexahedron.
    quality: String,
    statistics: Statistics,
}

/// The whole page.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a polycube with more planes than 16 bits can count; [`ErrorKind::Internal`] if the
/// data cannot be written as JSON.
pub fn html(title: &str, scene: &Scene, hexes: Option<&Hexes>) -> Result<String> {
    let data = Data {
        title,
        up: scene.up,
        triangles: bytes(scene.triangles.as_flattened().iter().map(|v| v.to_le_bytes())),
        facets: bytes(scene.facet.iter().map(|f| f.to_le_bytes())),
        labels: &scene.labels,
        chains: scene.chains.iter().map(|c| c.vertices.as_slice()).collect(),
        convex: scene.chains.iter().map(|c| c.convex).collect(),
        shape: scene.shape.as_deref().map(points),
        steps: scene.steps.iter().map(step).collect(),
        layouts: scene.layouts.iter().map(layout).collect::<Result<_>>()?,
        hexes: hexes.map(hex_data),
    };
    let json = serde_json::to_string(&data)
        .map_err(|e| Error::new(ErrorKind::Internal, format!("no JSON for the page: {e}")))?;
    // Within a script element only `<` could end the data early.
    Ok(fill(&[("title", &escaped(title)), ("data", &json.replace('<', "\\u003c"))]))
}

/// The template with its parts; a part is filled in once and not searched for further parts.
fn fill(parts: &[(&str, &str)]) -> String {
    let fixed = [("style", STYLE), ("licence", LICENCE), ("three", THREE), ("cuts", CUTS), ("viewer", VIEWER)];
    let mut pieces = PAGE.split("@@");
    let mut page = pieces.next().unwrap_or_default().to_owned();
    while let (Some(name), Some(text)) = (pieces.next(), pieces.next()) {
        let part = parts.iter().chain(&fixed).find(|(n, _)| *n == name);
        page += part.map_or("", |p| p.1);
        page += text;
    }
    page
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

fn step(step: &Step) -> StepData {
    let round = step.round.as_ref();
    StepData {
        lambda: round.map(|r| r.lambda),
        pairs: round.map(|r| r.pairs),
        alignments: round.map(|r| r.alignments),
        counts: step.counts,
        layout: step.layout,
    }
}

fn layout(layout: &Layout) -> Result<LayoutData> {
    let Pieces { planes, blocks, faces, patches } = &layout.pieces;
    if planes.iter().any(|p| p.len() > usize::from(u16::MAX)) {
        return Err(Error::new(ErrorKind::Unsupported, "the polycube has too many levels for a page"));
    }
    Ok(LayoutData {
        points: points(&layout.points),
        planes: std::array::from_fn(|a| planes[a].iter().map(|&x| x as f32).collect()),
        blocks: ranks(blocks.iter().copied()),
        faces: tiles(faces),
        patches: tiles(patches),
    })
}

fn tiles(tiles: &[Tile]) -> TileData {
    TileData {
        corners: ranks(tiles.iter().map(|t| [t.low, t.high])),
        facets: bytes(tiles.iter().map(|t| t.facet.to_le_bytes())),
        ids: bytes(tiles.iter().map(|t| t.id.to_le_bytes())),
    }
}

fn hex_data(hexes: &Hexes) -> HexData {
    let qualities: Vec<(f64, f64)> = hexes.quality.iter().map(|&q| (q, 0.0)).collect();
    HexData {
        points: points(&hexes.points),
        cells: bytes(hexes.cells.as_flattened().iter().map(|v| v.to_le_bytes())),
        quality: bytes(hexes.quality.iter().map(|&q| (q as f32).to_le_bytes())),
        statistics: statistics(&qualities),
    }
}

fn points(points: &[Point]) -> String {
    bytes(points.iter().flat_map(|p| [p.x, p.y, p.z]).map(|x| (x as f32).to_le_bytes()))
}

fn ranks(boxes: impl Iterator<Item = [[usize; 3]; 2]>) -> String {
    bytes(boxes.flat_map(|b| b.into_iter().flatten()).map(|r| (r as u16).to_le_bytes()))
}

fn bytes<const N: usize>(numbers: impl Iterator<Item = [u8; N]>) -> String {
    STANDARD.encode(numbers.flatten().collect::<Vec<u8>>())
}
