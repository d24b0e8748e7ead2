//! The polycube of a labelled shape: its charts are those of the labels, and only their places are looked for.

mod directions;

use super::charts::ChartedSurface;
use super::embedding::Levels;
use crate::align::problem::Difference;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::Mesh;
use crate::structure::{HalfEdge, Label, Labelling, Surface, Violation, area_vector};
use directions::Directions;
use nalgebra::Vector3;

/// The largest cosine between the normals of two faces on a sharp crease.
const CREASE: f64 = 0.5;

/// The charts of a labelled surface, in which order their levels must lie, and how many corners there are.
pub(super) struct Labelled {
    pub(super) charts: ChartedSurface,
    pub(super) levels: Levels,
    pub(super) corners: usize,
}

/// Reads what the labels of a surface stand for.
///
/// # Errors
/// [`ErrorKind::Mismatch`] where labels are missing or are none; [`ErrorKind::Polycube`] with the element around which
/// the labels are not those of a polycube.
pub(super) fn read(shape: &Mesh, surface: &Surface, labels: &[i8]) -> Result<Labelled> {
    of_checked(shape, surface, check(labels, surface.faces().len())?)
}

/// What the nearest axes of its normals stand for on a surface where these change at sharp creases alone, if that is a
/// polycube. O(n log n) for n faces.
pub(super) fn creased(shape: &Mesh, surface: &Surface) -> Option<Labelled> {
    let normals: Vec<Vector3<f64>> = surface.faces().iter().map(|face| area_vector(shape.points(), face)).collect();
    let labels: Vec<Label> = normals.iter().map(|normal| Label::nearest(normal).0).collect();
    let is_sharp = |h: HalfEdge| {
        let [a, b] = [h, surface.twin(h)].map(|side| surface.face(side));
        labels[a] == labels[b] || normals[a].dot(&normals[b]) <= CREASE * normals[a].norm() * normals[b].norm()
    };
    if !surface.half_edges().all(is_sharp) {
        return None;
    }
    of_checked(shape, surface, labels).ok()
}

fn of_checked(shape: &Mesh, surface: &Surface, labels: Vec<Label>) -> Result<Labelled> {
    let labelling = Labelling::new(surface.clone(), labels).map_err(first_of)?;
    let directions = Directions::new(&labelling, shape.points());
    if let Some(error) = first_fault(&labelling, &directions) {
        return Err(error);
    }
    let differences = differences(&labelling, &directions)?;
    let (charts, corners) = (charts(shape, &labelling), labelling.corners.len());
    let levels = Levels::ordered(&charts, labelling.level_of_chart, differences);
    Ok(Labelled { charts, levels, corners })
}

fn check(labels: &[i8], faces: usize) -> Result<Vec<Label>> {
    if labels.len() != faces {
        let message = format!("there are {} labels for {faces} faces", labels.len());
        return Err(Error::new(ErrorKind::Mismatch, message).remedy("give one label for each face of the shape"));
    }
    let known = |(face, &l): (u32, &i8)| {
        Label::new(l).ok_or_else(|| {
            Error::new(ErrorKind::Mismatch, format!("{l} is no label"))
                .at(Place::Face(face))
                .remedy("give each face a label from 0 to 5, for +X -X +Y -Y +Z -Z")
        })
    };
    (0..).zip(labels).map(known).collect()
}

fn first_of(violations: Vec<Violation>) -> Error {
    let others = violations.len() - 1;
    let mut error = violations.into_iter().next().map_or_else(|| Error::from(Violation::Empty), Error::from);
    if others > 0 {
        error.message = format!("{}; and so in {others} other places", error.message);
    }
    error
}

fn first_fault(labelling: &Labelling, directions: &Directions) -> Option<Error> {
    let corner = directions.wrong_corner().map(|corner| {
        Error::new(ErrorKind::Polycube, "the labels around this corner are not those around a corner of a polycube")
            .at(Place::Vertex(labelling.corners[corner]))
            .remedy("relabel the faces around it")
    });
    corner.or_else(|| {
        let side = &labelling.sides[labelling.loops[directions.wrong_loop()?][0]];
        let message = "the corners around this face's chart do not turn as those around a flat region do";
        let face = labelling.surface.face(side.half_edges[0]) as u32;
        let remedy = "relabel the faces along its border, so that borders which run to and fro end at corners";
        Some(Error::new(ErrorKind::Polycube, message).at(Place::Face(face)).remedy(remedy))
    })
}

/// Of the levels at the ends of every side, which one lies below the other.
fn differences(labelling: &Labelling, directions: &Directions) -> Result<Vec<Difference>> {
    let mut order: Vec<([u32; 2], usize)> = Vec::new();
    for side in (0..labelling.sides.len()).filter(|&side| directions.is_up(side)) {
        let ends = [side, labelling.sides[side].twin].map(|s| labelling.sides[s].start);
        let [low, high] = ends.map(|corner| labelling.level(corner, labelling.axis(side)).unwrap_or(0));
        order.push(([low, high], side));
    }
    order.sort_unstable();
    order.dedup_by_key(|(levels, _)| *levels);
    if let Some(side) = on_a_circle(&order) {
        let [a, b] = labelling.ends(side);
        let message = "the planes at the two ends of this polycube edge would each have to lie below the other";
        return Err(Error::new(ErrorKind::Polycube, message)
            .at(Place::Edge(a, b))
            .remedy("relabel the faces along the charts that connect its two ends"));
    }
    Ok(order.into_iter().map(|([low, high], _)| Levels::below(low, high)).collect())
}

/// A side whose levels lie on a circle of levels that each lie below the next.
fn on_a_circle(order: &[([u32; 2], usize)]) -> Option<usize> {
    let graph =
        petgraph::graphmap::DiGraphMap::<u32, ()>::from_edges(order.iter().map(|&([low, high], _)| (low, high)));
    let mut component = std::collections::BTreeMap::new();
    for (i, levels) in petgraph::algo::kosaraju_scc(&graph).into_iter().enumerate() {
        component.extend(levels.into_iter().map(|level| (level, i)));
    }
    order.iter().find(|([low, high], _)| component[low] == component[high]).map(|(_, side)| *side)
}

fn charts(shape: &Mesh, labelling: &Labelling) -> ChartedSurface {
    let faces = labelling.surface.faces().iter().zip(&labelling.chart_of_face);
    let parts = faces.flat_map(|(face, &chart)| face.triangles().map(move |t| (t, chart)));
    let (triangles, chart): (Vec<_>, _) = parts.unzip();
    ChartedSurface {
        points: shape.points().to_vec(),
        origins: (0..triangles.len() as u32).collect(),
        triangles,
        chart,
        labels: labelling.labels.iter().map(|l| l.index() as u8).collect(),
        crossings: Vec::new(),
    }
}
