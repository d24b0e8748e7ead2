//! Makes the map between shape and polycube one to one before it is used.

use super::refine::Refined;
use crate::context::Context;
use crate::error::Result;
use crate::mesh::{Cells, Face, Mesh, Point, split_quad};
use crate::optimise::{Elements, Freedom, Settings, optimise, tetrahedron_volume};
use crate::structure::{Label, Polycube, area_vector};
use nalgebra::Vector3;

/// Untangling alone, and just enough of it.
const TETRAHEDRA: Settings = Settings {
    theta: 0.1,
    untangle_rounds: 20,
    untangle_iterations: 50,
    improve_rounds: 0,
    improve_iterations: 0,
    average: 0.0,
    strength: 0.0,
    polish_rounds: 0,
};

/// Smoothing of a valid map by two rounds of improvement.
const SMOOTH: Settings = Settings { untangle_rounds: 0, improve_rounds: 2, improve_iterations: 50, ..SURFACE };

/// Untangling of surfaces.
const SURFACE: Settings = Settings { untangle_rounds: 40, untangle_iterations: 100, ..TETRAHEDRA };

/// Turns the tetrahedra of a polycube the right way round, each to look like that of the shape; surface vertices stay on
/// their facets and edges. Other cells are left as they are. Returns how many are still turned over.
pub(super) fn volume(polycube: &Polycube, mesh: &mut Mesh, shape: &[Point], context: &Context) -> Result<usize> {
    let Cells::Tetrahedra(cells) = &mesh.cells else { return Ok(0) };
    let elements = Elements::tetrahedra_like(cells, shape)?;
    let freedom: Vec<Freedom> = freedoms(polycube);
    Ok(optimise(&mut mesh.points, &elements, &freedom, &[], &TETRAHEDRA, context)?.inverted_after)
}

fn freedoms(polycube: &Polycube) -> Vec<Freedom> {
    polycube.vertex_levels.iter().map(|levels| Freedom::Axes(levels.map(|l| l.is_some()))).collect()
}

/// How often triangles are split where they cannot be turned the right way round.
const SPLITS: usize = 2;
/// Splitting helps single triangles without room, not a facet that is folded: then more than this part of all are turned over.
const FOLDED: f64 = 0.001;

/// Moves the surface vertices of a polycube in their facets and along their edges so that no triangle is turned over
/// and each looks like that of the shape, as far as that goes; splits triangles where it does not go otherwise, as long as that
/// leaves fewer of them turned over. Whether a facet stays folded.
pub(super) fn surface(refined: &mut Refined, context: &Context) -> Result<bool> {
    spread_chains(refined);
    let mut least = usize::MAX;
    for round in 0..=SPLITS {
        let from = 0.8 * round as f64 / (SPLITS + 1) as f64;
        let bad = relax(refined, false, &context.stage("map", from, 0.8))?;
        if bad.is_empty() {
            relax(refined, true, &context.stage("map", 0.8, 1.0))?;
            break;
        }
        if bad.len() as f64 > FOLDED * refined.polycube.surface.faces().len() as f64 {
            return Ok(true);
        }
        if bad.len() >= least {
            break;
        }
        least = bad.len();
        if round < SPLITS {
            refined.split_facets_of(&bad)?;
        }
    }
    Ok(false)
}

/// Segments of an edge no shorter than this part of their mean are well enough spread.
const LEAST_STEP: f64 = 0.02;

/// Places the vertices of a polycube edge that are out of order or too close by their distances along the edge on the shape.
fn spread_chains(refined: &mut Refined) {
    let Refined { polycube, points, shape, .. } = refined;
    for (edge, chain) in polycube.structure.edges.iter().zip(&polycube.chains) {
        let steps = chain.windows(2).map(|s| (shape[s[0] as usize] - shape[s[1] as usize]).norm());
        let length: f64 = steps.clone().sum();
        let [low, high] = [chain[0], chain[chain.len() - 1]].map(|v| points[v as usize][edge.axis]);
        let at = |i: usize| points[chain[i] as usize][edge.axis];
        let least = LEAST_STEP * (high - low) / (chain.len() - 1) as f64;
        if (1..chain.len()).all(|i| at(i) - at(i - 1) >= least) {
            continue;
        }
        let mut walked = 0.0;
        for (step, &v) in steps.zip(&chain[1..chain.len() - 1]) {
            walked += step;
            points[v as usize][edge.axis] = low + (high - low) * (walked / length).min(1.0);
        }
    }
}

/// One round, in which vertices slide along polycube edges or not; returns the triangles that are still turned over.
///
/// Each triangle becomes a tetrahedron by a vertex of its own that floats in a plane above it, so that the
/// tetrahedron is inverted just where the triangle is. While there are such, edges are held: their vertices would
/// lose their order.
fn relax(refined: &mut Refined, sliding: bool, context: &Context) -> Result<Vec<usize>> {
    let Refined { polycube, points, shape, .. } = refined;
    let lifted = Lifted::new(polycube, points, shape);
    let mut moved: Vec<Point> = points.iter().chain(&lifted.above).copied().collect();
    let rest: Vec<Point> = shape.iter().chain(&lifted.above_shape).copied().collect();
    let mut freedom = freedoms(polycube);
    for (freedom, levels) in freedom.iter_mut().zip(&polycube.vertex_levels) {
        match levels.iter().flatten().count() {
            1 => {}
            2 if sliding => {}
            _ => *freedom = Freedom::Fixed,
        }
    }
    freedom.extend(lifted.labels.iter().map(|l| Freedom::Axes(std::array::from_fn(|a| a == l.axis()))));
    let elements = Elements::tetrahedra_like(&lifted.tetrahedra, &rest)?;
    optimise(&mut moved, &elements, &freedom, &[], if sliding { &SMOOTH } else { &SURFACE }, context)?;
    let bad = |(_, t): &(usize, &[u32; 4])| tetrahedron_volume(&moved, t) <= 0.0;
    let bad: Vec<usize> = lifted.tetrahedra.iter().enumerate().filter(bad).map(|(i, _)| i).collect();
    moved.truncate(points.len());
    *points = moved;
    Ok(bad)
}

/// The triangles of a surface as tetrahedra.
struct Lifted {
    tetrahedra: Vec<[u32; 4]>,
    labels: Vec<Label>,
    /// The fourth vertex of each over the polycube.
    above: Vec<Point>,
    /// The same over the shape.
    above_shape: Vec<Point>,
}

impl Lifted {
    fn new(polycube: &Polycube, points: &[Point], shape: &[Point]) -> Self {
        let area =
            |points: &[Point]| -> f64 { polycube.surface.faces().iter().map(|f| area_vector(points, f).norm()).sum() };
        let stretch = (area(points) / area(shape)).sqrt();
        let mut lifted = Self { tetrahedra: vec![], labels: vec![], above: vec![], above_shape: vec![] };
        for (face, label) in polycube.surface.faces().iter().zip(polycube.labels()) {
            match *face {
                Face::Triangle(t) => lifted.add(t, label, points, shape, stretch),
                Face::Quad(q) => split_quad(q).into_iter().for_each(|t| lifted.add(t, label, points, shape, stretch)),
            }
        }
        lifted
    }

    fn add(&mut self, t: [u32; 3], label: Label, points: &[Point], shape: &[Point], stretch: f64) {
        let middle = |at: &[Point]| Point::from(t.iter().map(|&v| at[v as usize].coords).sum::<Vector3<f64>>() / 3.0);
        let area = area_vector(shape, &Face::Triangle(t));
        let height = area.norm().sqrt();
        let mut up = Vector3::zeros();
        up[label.axis()] = f64::from(label.sign());
        self.tetrahedra.push([t[0], t[1], t[2], (points.len() + self.above.len()) as u32]);
        self.labels.push(label);
        self.above.push(middle(points) + up * (height * stretch));
        self.above_shape.push(middle(shape) + area.try_normalize(0.0).unwrap_or(up) * height);
    }
}
