//! What is wrong with a polycube, or the structure of one that is right.

use crate::failure::{Failure, Result, guard, numbers};
use crate::ffi::*;
use crate::input::Owned;
use crate::options::tolerance;
use crate::run::run;
use polycube::layout::{Pieces, count};
use polycube::mesh::Mesh;
use polycube::simplify::{Input, read_structure};
use polycube::structure::{Arrangement, Corner, Edge, Polycube};
use polycube::validate::{Finding, Subject, validate};
use polycube::{Error, Place};

/// Lists the violations of `polycube validate`, or describes the structure.
pub fn check(input: &InputView, data: &ToleranceData, observer: &Observer) -> Result<CheckedData> {
    let (owned, tolerance) = match guard(|| Ok((Owned::new(input)?, tolerance(data)))) {
        Ok(both) => both,
        Err(Failure(error)) => return not_finite(error, input),
    };
    run(observer, |context| {
        context.stage("structure", 0.0, 1.0).tick(0.0)?;
        let input = owned.input();
        let findings = validate(&input, &tolerance)?;
        let mut checked = CheckedData { violations: violations(findings, &input), structure: StructureData::default() };
        if checked.violations.is_empty() {
            let polycube = read_structure(&input, &tolerance)?;
            checked.structure = structure(&polycube, input.polycube);
        }
        context.tick(1.0)?;
        Ok(checked)
    })
}

/// What is found of a mesh with a coordinate that is no number; other errors stay errors.
fn not_finite(error: Error, input: &InputView) -> Result<CheckedData> {
    if !matches!(error.place, Some(Place::Vertex(_))) {
        return Err(error.into());
    }
    let of_shape = crate::input::mesh(&input.polycube).is_ok();
    let finding = Finding::of(error, if of_shape { Subject::Shape } else { Subject::Polycube })?;
    let violations = vec![violation(finding, Vec::new())];
    Ok(CheckedData { violations, structure: StructureData::default() })
}

fn violations(findings: Vec<Finding>, input: &Input) -> Vec<ViolationData> {
    if findings.is_empty() {
        return Vec::new();
    }
    let around = Around::new(input.polycube);
    let faces = |finding: &Finding| finding.element.map_or_else(Vec::new, |place| around.faces(place));
    let with_faces = |finding: Finding| {
        let faces = faces(&finding);
        violation(finding, faces)
    };
    findings.into_iter().map(with_faces).collect()
}

fn violation(finding: Finding, faces: Vec<u32>) -> ViolationData {
    ViolationData {
        rule: finding.rule.into(),
        in_shape: finding.mesh == Subject::Shape,
        message: finding.message,
        remedy: finding.remedy,
        place: place(finding.element),
        at: finding.at.map_or_else(Vec::new, Vec::from),
        faces,
    }
}

fn place(place: Option<Place>) -> PlaceData {
    let (element, index, second) = place.map_or((0, 0, 0), numbers);
    PlaceData { element, index, second }
}

/// The boundary faces around each vertex, ascending.
struct Around(Vec<Vec<u32>>);

impl Around {
    fn new(mesh: &Mesh) -> Self {
        let mut around = vec![Vec::new(); mesh.points().len()];
        for (i, face) in (0..).zip(mesh.cells().boundary().unwrap_or_default()) {
            for &v in face.vertices() {
                // A face may name a vertex twice.
                if let Some(faces) = around.get_mut(v as usize).filter(|faces| faces.last() != Some(&i)) {
                    faces.push(i);
                }
            }
        }
        Self(around)
    }

    /// The boundary faces that have all vertices of an element.
    fn faces(&self, place: Place) -> Vec<u32> {
        let at = |v: u32| self.0.get(v as usize).map_or(&[][..], Vec::as_slice);
        match place {
            Place::Vertex(v) => at(v).to_vec(),
            Place::Edge(a, b) => at(a).iter().copied().filter(|i| at(b).binary_search(i).is_ok()).collect(),
            Place::Face(i) => vec![i],
            Place::Cell(_) | Place::PolycubeEdge(_) | Place::Facet(_) | Place::Line(_) => Vec::new(),
        }
    }
}

fn structure(polycube: &Polycube, mesh: &Mesh) -> StructureData {
    let Polycube { structure, placement, chains, deviation, .. } = polycube;
    let Pieces { patch_of_face, block_of_face } = Pieces::of_faces(polycube, mesh.points(), placement);
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

#[cfg(test)]
mod tests {
    use super::*;
    use polycube::mesh::{Cells, Point};

    #[test]
    fn the_faces_around_vertices_and_edges_are_found() {
        let cells = Cells::Quads(vec![[0, 1, 2, 3], [1, 4, 5, 2], [0, 0, 3, 5]]);
        let mesh = Mesh::new(vec![Point::origin(); 6], cells).unwrap();
        let around = Around::new(&mesh);
        let faces = |place| around.faces(place);
        assert_eq!(faces(Place::Vertex(0)), [0, 2]);
        assert_eq!(faces(Place::Edge(2, 1)), [0, 1]);
        assert_eq!(faces(Place::Edge(0, 3)), [0, 2]);
        assert_eq!(faces(Place::Face(7)), [7]);
        assert!(faces(Place::Vertex(9)).is_empty() && faces(Place::Edge(0, 9)).is_empty());
    }
}
