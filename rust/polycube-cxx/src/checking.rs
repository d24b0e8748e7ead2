//! What is wrong with a polycube, or the structure of one that is right.

use crate::failure::{Result, guard, numbers};
use crate::ffi::*;
use crate::input::Owned;
use crate::options::tolerance;
use crate::run::run;
use polycube::layout::{Pieces, count};
use polycube::map::flipped;
use polycube::mesh::{Face, Mesh, Point};
use polycube::simplify::Input;
use polycube::structure::{Arrangement, Corner, Edge, Polycube, Violation};
use polycube::{Error, ErrorKind, Place};

/// Lists the violations of `polycube validate`, or describes the structure.
pub fn check(input: &InputView, data: &ToleranceData, observer: &Observer) -> Result<CheckedData> {
    let (owned, tolerance) = guard(|| Ok((Owned::new(input)?, tolerance(data)?)))?;
    run(observer, |context| {
        context.stage("structure", 0.0, 1.0).tick(0.0)?;
        let input = owned.input();
        check_fit(&input)?;
        let checked = match Polycube::new(input.polycube, input.labels, &tolerance) {
            Err(violations) => broken(&violations, input.polycube),
            Ok(polycube) => read(&polycube, input.polycube),
        };
        context.tick(1.0)?;
        Ok(checked)
    })
}

fn check_fit(input: &Input) -> polycube::Result<()> {
    let Some(shape) = input.shape else { return Ok(()) };
    if shape.cells == input.polycube.cells && shape.points.len() == input.polycube.points.len() {
        return Ok(());
    }
    Err(Error::new(ErrorKind::Mismatch, "shape and polycube do not have the same vertices and cells")
        .remedy("give the pair that one deformation connects, with the same numbering"))
}

fn read(polycube: &Polycube, mesh: &Mesh) -> CheckedData {
    let mut violations = polycube.overlaps(&mesh.points);
    let labels: Vec<i8> = polycube.labels().map(|l| l.index() as i8).collect();
    let turned = flipped(mesh, &labels).unwrap_or_default();
    violations.extend(turned.cells.iter().map(|&cell| Violation::InvertedCell { cell }));
    let mut checked = broken(&violations, mesh);
    checked.violations.extend(turned.faces.iter().map(|&face| flipped_face(face, mesh)));
    if checked.violations.is_empty() {
        checked.structure = structure(polycube, mesh);
    }
    checked
}

fn broken(violations: &[Violation], mesh: &Mesh) -> CheckedData {
    let faces = mesh.cells.boundary().unwrap_or_default();
    let violations = violations.iter().map(|v| violation(v, mesh, &faces)).collect();
    CheckedData { violations, structure: StructureData::default() }
}

fn violation(violation: &Violation, mesh: &Mesh, faces: &[Face]) -> ViolationData {
    let error = Error::from(violation.clone());
    let mut around = error.place.map_or_else(Vec::new, |place| faces_at(place, faces));
    if let Violation::SelfOverlap { other, .. } = violation {
        around.push(*other);
    }
    ViolationData {
        rule: violation.rule().into(),
        message: error.message,
        remedy: error.remedy,
        place: place(error.place),
        at: error.place.and_then(|p| middle(p, mesh, faces)).map_or_else(Vec::new, Vec::from),
        faces: around,
    }
}

fn flipped_face(face: u32, mesh: &Mesh) -> ViolationData {
    let faces = mesh.cells.boundary().unwrap_or_default();
    ViolationData {
        rule: "flipped_face".into(),
        message: "the face looks away from the side of its label".into(),
        remedy: "untangle the polycube map, or correct the label".into(),
        place: place(Some(Place::Face(face))),
        at: middle(Place::Face(face), mesh, &faces).map_or_else(Vec::new, Vec::from),
        faces: vec![face],
    }
}

fn place(place: Option<Place>) -> PlaceData {
    let (element, index, second) = place.map_or((0, 0, 0), numbers);
    PlaceData { element, index, second }
}

/// The boundary faces that have all vertices of an element.
fn faces_at(place: Place, faces: &[Face]) -> Vec<u32> {
    let with = |vertices: &[u32]| {
        let has = |f: &Face| vertices.iter().all(|v| f.vertices().contains(v));
        (0..).zip(faces).filter(|(_, f)| has(f)).map(|(i, _)| i).collect()
    };
    match place {
        Place::Vertex(v) => with(&[v]),
        Place::Edge(a, b) => with(&[a, b]),
        Place::Face(i) => vec![i],
        Place::Cell(_) | Place::PolycubeEdge(_) | Place::Facet(_) | Place::Line(_) => Vec::new(),
    }
}

/// The mean of an element's vertices.
fn middle(place: Place, mesh: &Mesh, faces: &[Face]) -> Option<[f64; 3]> {
    let vertices = match place {
        Place::Vertex(v) => vec![v],
        Place::Edge(a, b) => vec![a, b],
        Place::Face(i) => faces.get(i as usize)?.vertices().to_vec(),
        Place::Cell(i) if (i as usize) < mesh.cells.len() => mesh.cells.cell(i as usize).to_vec(),
        Place::Cell(_) | Place::PolycubeEdge(_) | Place::Facet(_) | Place::Line(_) => return None,
    };
    let points: Vec<&Point> = vertices.iter().map(|&v| mesh.points.get(v as usize)).collect::<Option<_>>()?;
    Some([0, 1, 2].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64))
}

fn structure(polycube: &Polycube, mesh: &Mesh) -> StructureData {
    let Polycube { structure, placement, chains, deviation, .. } = polycube;
    let Pieces { patch_of_face, block_of_face } = Pieces::of_faces(polycube, &mesh.points, placement);
    let levels = structure.levels.iter().zip(placement);
    let facet = |f: &polycube::structure::Facet| FacetData {
        label: f.label.index() as i8,
        level: f.level,
        loops: f.loops.len() as u32,
    };
    StructureData {
        levels: levels.map(|(l, &coordinate)| LevelData { axis: l.axis as u32, coordinate }).collect(),
        facets: structure.facets.iter().map(facet).collect(),
        corners: structure.corners.iter().map(corner).collect(),
        edges: structure.edges.iter().zip(chains).map(edge).collect(),
        counts: (&count(&Arrangement::new(structure, placement))).into(),
        components: structure.components().into_iter().max().map_or(0, |c| c + 1),
        genus: structure.genus() as u32,
        deviation_degrees: deviation.degrees,
        deviation_distance: deviation.distance,
        label_of_face: polycube.labels().map(|l| l.index() as i8).collect(),
        facet_of_face: polycube.facet_of_face.clone(),
        patch_of_face,
        block_of_face,
    }
}

fn corner(&Corner { vertex, valence, levels }: &Corner) -> CornerData {
    CornerData { vertex, valence, levels }
}

fn edge((&Edge { axis, corners, facets }, vertices): (&Edge, &Vec<u32>)) -> EdgeData {
    EdgeData { axis: axis as u32, corners, facets, vertices: vertices.clone() }
}
