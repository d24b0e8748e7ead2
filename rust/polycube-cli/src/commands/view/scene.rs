//! What there is to see: the layout of the input, after each round, and of the result, on the surface of the polycube.

use super::cells::Pieces;
use crate::input::meshes::MeshFiles;
use polycube::align::Round;
use polycube::layout::Counts;
use polycube::mesh::{Cells, Face, Mesh, Point, Simplices};
use polycube::simplify::{Input, Simplified, SimplifyOptions, fit, simplify};
use polycube::structure::{Arrangement, Polycube, placement_of};
use polycube::{Context, Error, ErrorKind, Result};

/// A step of the simplification.
pub struct Step {
    /// The round of Algorithm 1 that led here; nothing for input and result.
    pub round: Option<Round>,
    /// How coarse the layout is.
    pub counts: Counts,
    /// Its number in [`Scene::layouts`].
    pub layout: usize,
}

/// A layout, in units of the input.
pub struct Layout {
    /// The vertices of the surface.
    pub points: Vec<Point>,
    /// Blocks, faces and patches.
    pub pieces: Pieces,
}

/// A polycube edge.
pub struct Chain {
    /// The vertices along it.
    pub vertices: Vec<u32>,
    /// Whether the solid has one block around it and not three.
    pub convex: bool,
}

/// The surface and all its layouts.
pub struct Scene {
    /// The axis that points up: 0, 1 or 2 for X, Y or Z.
    pub up: usize,
    /// The triangles.
    pub triangles: Vec<[u32; 3]>,
    /// The facet of each triangle.
    pub facet: Vec<u32>,
    /// The label of each facet, 0 to 5.
    pub labels: Vec<usize>,
    /// The polycube edges, which are the singular edges.
    pub chains: Vec<Chain>,
    /// The vertices on the shape, if there is one.
    pub shape: Option<Vec<Point>>,
    /// Input, rounds, result.
    pub steps: Vec<Step>,
    /// The layouts of the steps.
    pub layouts: Vec<Layout>,
}

impl Scene {
    /// Simplifies the surface of a polycube and puts it where each step has it.
    ///
    /// # Errors
    /// Those of [`simplify`]; [`ErrorKind::Polycube`] when there is no valid result.
    pub fn new(meshes: &MeshFiles, options: &SimplifyOptions, up: usize, context: &Context) -> Result<Self> {
        let (surface, kept) = surface_of(&meshes.polycube)?;
        let input = Input { polycube: &surface, shape: None, labels: meshes.labels.as_deref() };
        let result = simplify(&input, options, &context.stage("simplify", 0.0, 0.5))?;
        let Some(after) = result.report.after else {
            let message = "there is no valid result to show: rounding to the lattice made it touch itself";
            return Err(Error::new(ErrorKind::Polycube, message).remedy("use the strategy `paper` or `best`"));
        };
        let shape = meshes.shape.as_ref();
        let polycube = &result.input;
        let (triangles, facet) = triangles(surface.cells(), polycube);
        let mut scene = Self {
            up,
            triangles,
            facet,
            labels: polycube.structure.facets.iter().map(|f| f.label.index()).collect(),
            chains: chains(polycube),
            shape: shape.map(|s| kept.iter().map(|&v| s.points()[v as usize]).collect()),
            steps: Vec::new(),
            layouts: Vec::new(),
        };
        scene.add_steps(&result, &surface, after, &context.stage("layouts", 0.5, 1.0))?;
        Ok(scene)
    }

    /// The layouts of the input and of the result.
    pub fn ends(&self) -> Vec<&Layout> {
        let ends = [self.steps.first(), self.steps.last()];
        ends.into_iter().flatten().map(|step| &self.layouts[step.layout]).collect()
    }

    fn add_steps(&mut self, result: &Simplified, mesh: &Mesh, after: Counts, context: &Context) -> Result<()> {
        let (polycube, scale) = (&result.input, result.report.scale);
        let start = polycube.placement.iter().map(|x| x * scale).collect();
        let mut steps: Vec<(Option<Round>, Counts, Vec<f64>)> = vec![(None, result.report.before, start)];
        for round in &result.report.rounds {
            let levels = result.levels_after(round, &context.stage("layouts", 0.0, 0.1))?;
            steps.push((Some(round.clone()), round.counts, placement_of(&levels)));
        }
        steps.push((None, after, placement_of(&result.levels)));
        let (mut last, total) = (None, steps.len());
        for (done, (round, counts, placement)) in steps.into_iter().enumerate() {
            context.tick(0.1 + 0.9 * done as f64 / total as f64)?;
            if last.as_ref() != Some(&placement) {
                let part = |done: usize| 0.1 + 0.9 * done as f64 / total as f64;
                let fitting = context.stage("layouts", part(done), part(done + 1));
                self.layouts.push(layout(polycube, mesh, &placement, scale, &fitting)?);
            }
            self.steps.push(Step { round, counts, layout: self.layouts.len() - 1 });
            last = Some(placement);
        }
        Ok(())
    }
}

fn layout(polycube: &Polycube, mesh: &Mesh, placement: &[f64], scale: f64, context: &Context) -> Result<Layout> {
    let fitted = fit(polycube, mesh, placement, scale, context)?;
    let mut pieces = Pieces::new(&Arrangement::new(&polycube.structure, placement));
    pieces.planes.iter_mut().flatten().for_each(|x| *x /= scale);
    Ok(Layout { points: fitted.points().iter().map(|p| p / scale).collect(), pieces })
}

/// The boundary of a mesh as a mesh of its own, and which vertices it kept.
fn surface_of(mesh: &Mesh) -> Result<(Mesh, Vec<u32>)> {
    let (mut triangles, mut quads) = (Vec::new(), Vec::new());
    for face in mesh.cells().boundary()? {
        match face {
            Face::Triangle(t) => triangles.push(t),
            Face::Quad(q) => quads.push(q),
        }
    }
    let cells = if quads.is_empty() { Cells::Triangles(triangles) } else { Cells::Quads(quads) };
    Mesh::of_used(mesh.points(), cells)
}

/// The triangles of a surface and their facets.
fn triangles(cells: &Cells, polycube: &Polycube) -> (Vec<[u32; 3]>, Vec<u32>) {
    let Simplices::Triangles(triangles) = cells.simplices() else { return (Vec::new(), Vec::new()) };
    let each = triangles.len() / cells.len().max(1);
    let facet = (0..triangles.len()).map(|t| polycube.facet_of_face[t / each]).collect();
    (triangles.into_owned(), facet)
}

fn chains(polycube: &Polycube) -> Vec<Chain> {
    let edges = polycube.structure.edges.iter().zip(&polycube.chains);
    edges.map(|(e, v)| Chain { vertices: v.clone(), convex: polycube.structure.is_convex(e) }).collect()
}
