//! `polycube inspect`.

use crate::failure::{Failure, Result};
use crate::input::meshes::MeshFiles;
use crate::options::polycube::PolycubeArgs;
use crate::output::table::{self, short};
use crate::output::terminal;
use polycube::layout::{Counts, count};
use polycube::measure::flipped;
use polycube::mesh::Mesh;
use polycube::repair::{Repair, Repaired, repair};
use polycube::simplify::{Input, read_structure};
use polycube::structure::{Arrangement, Deviation, Label, Polycube};
use serde::Serialize;
use std::collections::BTreeMap;
use std::process::ExitCode;

/// What to look at.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The mesh, its labels and its tolerances.
    #[command(flatten)]
    mesh: PolycubeArgs,

    /// Print JSON
    #[arg(long)]
    json: bool,

    /// List the facets by the numbers that `simplify --guides` and structure.json use
    #[arg(long)]
    facets: bool,
}

/// A facet.
#[derive(Debug, Serialize)]
struct FacetRow {
    facet: usize,
    label: String,
    /// Its coordinate along its axis, in units of the mesh.
    at: f64,
    corners: usize,
    /// Its first boundary face.
    face: usize,
}

/// What was found.
#[derive(Debug, Serialize)]
struct Found {
    file: String,
    cell_kind: String,
    cells: usize,
    vertices: usize,
    boundary_faces: usize,
    components: usize,
    /// Handles, over all components.
    genus: usize,
    /// How many charts have each label.
    charts: BTreeMap<String, usize>,
    corners: usize,
    /// How many corners have each valence.
    corners_by_valence: BTreeMap<u32, usize>,
    edges: usize,
    facets: usize,
    facets_with_holes: usize,
    /// The levels along X, Y and Z, in units of the mesh, ascending.
    levels: [Vec<f64>; 3],
    /// Length of the shortest polycube edge, in units of the mesh.
    shortest_edge: f64,
    /// How far the mesh is from an exact polycube.
    deviation: Deviation,
    counts: Counts,
    /// What was repaired, and what else may not be as expected.
    notes: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    facet_list: Option<Vec<FacetRow>>,
}

/// Prints what was found.
pub fn run(args: &Args) -> Result<ExitCode> {
    let file = &args.mesh.polycube;
    let meshes = MeshFiles::read(file, None, args.mesh.labels.given())?;
    let given = meshes.input();
    let repaired = if args.mesh.tolerance.repair.off { None } else { repair(&given) };
    let input = repaired.as_ref().map_or(given, Repaired::input);
    let polycube = read_structure(&input, &args.mesh.tolerance.get()).map_err(Failure::in_file(file))?;
    let mut found = Found::new(file.display().to_string(), input.polycube, &polycube);
    found.notes = notes(&input, repaired.as_ref());
    found.facet_list = args.facets.then(|| facets(&polycube));
    if args.json {
        terminal::print_json(&found)?
    } else {
        terminal::print(&found.to_text())?
    }
    Ok(ExitCode::SUCCESS)
}

impl Found {
    fn new(file: String, mesh: &Mesh, polycube: &Polycube) -> Self {
        let structure = &polycube.structure;
        Self {
            file,
            cell_kind: mesh.cells().kind().to_string(),
            cells: mesh.cells().len(),
            vertices: mesh.points().len(),
            boundary_faces: polycube.surface.faces().len(),
            components: structure.components().into_iter().max().map_or(0, |c| c as usize + 1),
            genus: structure.genus(),
            charts: charts(polycube),
            corners: structure.corners.len(),
            corners_by_valence: tally(structure.corners.iter().map(|c| c.valence)),
            edges: structure.edges.len(),
            facets: structure.facets.len(),
            facets_with_holes: structure.facets.iter().filter(|f| f.loops.len() > 1).count(),
            levels: [0, 1, 2].map(|axis| levels(polycube, axis)),
            shortest_edge: structure.shortest_edge(&polycube.placement),
            deviation: polycube.deviation,
            counts: count(&Arrangement::new(structure, &polycube.placement)),
            notes: Vec::new(),
            facet_list: None,
        }
    }

    fn to_text(&self) -> String {
        let mut text = format!("{}\n\n", self.file);
        for (name, value) in self.rows() {
            text += &format!("{name:21}{value}\n");
        }
        text += "\n";
        text += &table::table(["counts", ""], table::counts(&self.counts).map(|(n, x)| [n.into(), x.to_string()]));
        self.notes.iter().for_each(|note| text += &format!("\nnote: {note}"));
        if !self.notes.is_empty() {
            text += "\n";
        }
        if let Some(facets) = &self.facet_list {
            let row = |f: &FacetRow| {
                [f.facet.to_string(), f.label.clone(), short(f.at), f.corners.to_string(), f.face.to_string()]
            };
            text += "\n";
            text += &table::table(["facet", "label", "at", "corners", "first face"], facets.iter().map(row));
        }
        text
    }

    fn rows(&self) -> Vec<(&'static str, String)> {
        let Deviation { degrees, distance, out_of_order } = self.deviation;
        let deviation = match (degrees == 0.0 && distance == 0.0, out_of_order) {
            (true, 0) => "none, it is exact".to_owned(),
            (_, 0) => format!("{} degrees, {} units", short(degrees), short(distance)),
            (_, n) => format!("{} degrees, {} units, {n} vertices out of order", short(degrees), short(distance)),
        };
        let [x, y, z] = self.levels.each_ref().map(Vec::len);
        vec![
            ("cells", format!("{} {}", self.cells, self.cell_kind)),
            ("vertices", self.vertices.to_string()),
            ("boundary faces", self.boundary_faces.to_string()),
            ("components", self.components.to_string()),
            ("genus", self.genus.to_string()),
            ("charts", list(all_labels().map(|l| format!("{l} {}", self.charts.get(&l).unwrap_or(&0))))),
            ("corners", format!("{} ({})", self.corners, self.valences())),
            ("edges", format!("{}, the shortest {} units long", self.edges, short(self.shortest_edge))),
            ("facets", format!("{}, {} with holes", self.facets, self.facets_with_holes)),
            ("levels", format!("X {x}, Y {y}, Z {z}")),
            ("off exact by", deviation),
        ]
    }

    fn valences(&self) -> String {
        list(self.corners_by_valence.iter().map(|(valence, n)| format!("{n} of valence {valence}")))
    }
}

/// What was repaired, and how many cells are inverted.
fn notes(input: &Input, repaired: Option<&Repaired>) -> Vec<String> {
    let mut notes: Vec<String> = repaired.iter().flat_map(|r| &r.repairs).map(Repair::to_string).collect();
    let inverted = flipped(input.polycube, &[]).map_or(0, |f| f.cells.len());
    if inverted > 0 {
        notes.push(format!("{inverted} cells are inverted or flat: `simplify` and `remesh` untangle them"));
    }
    notes
}

/// The facets in the order of their numbers.
fn facets(polycube: &Polycube) -> Vec<FacetRow> {
    let mut first = vec![0; polycube.structure.facets.len()];
    for (face, &facet) in polycube.facet_of_face.iter().enumerate().rev() {
        first[facet as usize] = face;
    }
    let row = |(facet, f): (usize, &polycube::structure::Facet)| FacetRow {
        facet,
        label: f.label.to_string(),
        at: polycube.placement[f.level as usize],
        corners: f.sides().count(),
        face: first[facet],
    };
    polycube.structure.facets.iter().enumerate().map(row).collect()
}

/// The names of the labels, in their order.
fn all_labels() -> impl Iterator<Item = String> {
    (0..6).filter_map(Label::new).map(|l| l.to_string())
}

/// All six labels, those without charts too.
fn charts(polycube: &Polycube) -> BTreeMap<String, usize> {
    let mut charts: BTreeMap<String, usize> = all_labels().map(|l| (l, 0)).collect();
    for facet in &polycube.structure.facets {
        *charts.entry(facet.label.to_string()).or_default() += 1;
    }
    charts
}

fn levels(polycube: &Polycube, axis: usize) -> Vec<f64> {
    let all = polycube.structure.levels.iter().zip(&polycube.placement);
    let mut own: Vec<f64> = all.filter(|(l, _)| l.axis == axis).map(|(_, &x)| x).collect();
    own.sort_by(f64::total_cmp);
    own
}

fn tally(values: impl Iterator<Item = u32>) -> BTreeMap<u32, usize> {
    let mut counts = BTreeMap::new();
    values.for_each(|v| *counts.entry(v).or_default() += 1);
    counts
}

fn list(items: impl Iterator<Item = String>) -> String {
    items.collect::<Vec<_>>().join(", ")
}
