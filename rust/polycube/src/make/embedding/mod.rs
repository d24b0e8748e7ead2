//! From charts to a polycube in space, and the map between the two.

mod edges;
mod levels;
mod surface_map;

use super::charts::ChartedSurface;
use super::loops::LoopSet;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Cells, Mesh};
use crate::remesh::Refined;
use crate::structure::{Arrangement, Conflict, LevelBox, Polycube, Tolerance};
use levels::{Levels, Span};

/// Most orders of two levels that are added to keep parts of the polycube apart.
const MOST_SEPARATIONS: usize = 200;

/// A polycube and the shape that goes with it, triangle by triangle.
pub(super) struct Embedded {
    pub(super) polycube: Polycube,
    pub(super) refined: Refined,
    /// Triangles whose map is turned over.
    pub(super) folded: Vec<usize>,
}

/// Puts the charts in place, apart from each other, and lays them flat.
///
/// Levels go to where edges become about as long as on the shape; where the polycube would touch itself then, to where
/// charts lie on the shape; and where it does so still, levels that keep parts apart on the shape are kept in order.
///
/// # Errors
/// [`ErrorKind::Polycube`] if parts cannot be kept apart; those of the solver and of
/// [`optimise`](crate::optimise::optimise()); [`ErrorKind::Cancelled`].
pub(super) fn embed(charts: &ChartedSurface, loops: &LoopSet, context: &Context) -> Result<Embedded> {
    let (mesh, polycube) = Embedding::new(charts, loops).place(&context.stage("embed", 0.0, 0.3))?;
    let mut refined = Refined::new(&polycube, mesh.points(), &charts.points)?;
    let folded = surface_map::unfold(&mut refined, &context.stage("map", 0.3, 1.0))?;
    Ok(Embedded { polycube, refined, folded })
}

struct Embedding<'a> {
    charts: &'a ChartedSurface,
    levels: Levels,
    labels: Vec<i8>,
}

impl<'a> Embedding<'a> {
    fn new(charts: &'a ChartedSurface, loops: &LoopSet) -> Self {
        let labels = charts.chart.iter().map(|&c| charts.labels[c as usize] as i8).collect();
        Self { charts, levels: Levels::new(charts, loops), labels }
    }

    /// The polycube without conflicts.
    fn place(&mut self, context: &Context) -> Result<(Mesh, Polycube)> {
        let first = self.levels.as_on_the_shape();
        let (mut mesh, mut polycube) = self.put(&first, context)?;
        let longer = self.levels.as_long_as(&self.spans(&polycube));
        let (long_mesh, long_polycube) = self.put(&longer, context)?;
        if conflicts(&long_polycube).is_empty() {
            return outward(long_mesh, long_polycube);
        }
        for added in 0..MOST_SEPARATIONS {
            context.tick(added as f64 / MOST_SEPARATIONS as f64)?;
            let found = conflicts(&polycube);
            let Some(first_conflict) = found.first() else { return outward(mesh, polycube) };
            if !self.separate(&polycube, &found, &first) {
                return Err(self.stuck(&polycube, first_conflict));
            }
            let again = self.put(&first, context);
            (mesh, polycube) = again.map_err(|e| match e.kind {
                ErrorKind::Infeasible => self.stuck(&polycube, first_conflict),
                _ => e,
            })?;
        }
        match conflicts(&polycube).first() {
            Some(conflict) => Err(self.stuck(&polycube, conflict)),
            None => outward(mesh, polycube),
        }
    }

    /// The polycube with its levels as near to `targets` as their order allows.
    fn put(&self, targets: &[f64], context: &Context) -> Result<(Mesh, Polycube)> {
        let levels = self.levels.solve(targets, context)?;
        let fixed =
            edges::prescribed(self.charts, |chart| levels[self.levels.of_chart[chart as usize] as usize] as f64);
        let mut points = self.charts.points.clone();
        for (point, fixed) in points.iter_mut().zip(&fixed) {
            (0..3).for_each(|a| point[a] = fixed[a].unwrap_or(point[a] * self.levels.scale));
        }
        let mesh = Mesh::new(points, Cells::Triangles(self.charts.triangles.clone()))?;
        let tolerance = Tolerance { merge: 0.0, ..Tolerance::default() };
        let polycube = Polycube::new(&mesh, Some(&self.labels), &tolerance)
            .map_err(|v| Error::new(ErrorKind::Internal, format!("the charts are no polycube: {}", v[0])))?;
        Ok((mesh, polycube))
    }

    /// The level, as the loops number them, of each level of the structure.
    fn numbers(&self, polycube: &Polycube) -> Vec<u32> {
        let mut numbers = vec![0; polycube.structure.levels.len()];
        for (&facet, &chart) in polycube.facet_of_face.iter().zip(&self.charts.chart) {
            let level = polycube.structure.facets[facet as usize].level;
            numbers[level as usize] = self.levels.of_chart[chart as usize];
        }
        numbers
    }

    /// The edges of the polycube with their lengths on the shape.
    fn spans(&self, polycube: &Polycube) -> Vec<Span> {
        let numbers = self.numbers(polycube);
        let step = |s: &[u32]| (self.charts.points[s[0] as usize] - self.charts.points[s[1] as usize]).norm();
        let edges = polycube.structure.edges.iter().zip(&polycube.chains);
        let span = |(edge, chain): (_, &Vec<u32>)| {
            let [low, high] = polycube.structure.ends(edge).map(|l| numbers[l as usize]);
            Span { low, high, length: chain.windows(2).map(step).sum() }
        };
        edges.map(span).collect()
    }

    /// Keeps parts that meet apart along the axis where they are farthest apart on the shape; whether that adds
    /// anything.
    fn separate(&mut self, polycube: &Polycube, found: &[Conflict], on_the_shape: &[f64]) -> bool {
        let numbers = self.numbers(polycube);
        let at = |level: u32| on_the_shape[numbers[level as usize] as usize];
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        for [one, two] in found.iter().filter_map(|c| c.boxes) {
            let gap = |low: &LevelBox, high: &LevelBox, a: usize| {
                (at(high.low[a]) - at(low.high[a]), [low.high[a], high.low[a]])
            };
            let gaps = (0..3).flat_map(|a| [gap(&one, &two, a), gap(&two, &one, a)]);
            let apart = gaps.filter(|(_, [l, h])| l != h).max_by(|a, b| a.0.total_cmp(&b.0));
            pairs.extend(apart.map(|(_, pair)| pair.map(|l| numbers[l as usize])));
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs.iter().for_each(|&[low, high]| self.levels.separate(low, high));
        !pairs.is_empty()
    }

    /// The error for parts that no order of levels keeps apart, with a face of one of them.
    fn stuck(&self, polycube: &Polycube, conflict: &Conflict) -> Error {
        let face = polycube.facet_of_face.iter().position(|f| conflict.facets.contains(f)).unwrap_or(0);
        Error::new(ErrorKind::Polycube, "parts of the polycube would lie in one place")
            .at(crate::Place::Face(face as u32))
            .remedy("ask for more detail, so that the polycube follows the shape more closely, or turn the shape")
    }
}

fn conflicts(polycube: &Polycube) -> Vec<Conflict> {
    Arrangement::new(&polycube.structure, &polycube.placement).conflicts()
}

/// The same if every part of it looks outward, and hollows into the solid around them.
fn outward(mesh: Mesh, polycube: Polycube) -> Result<(Mesh, Polycube)> {
    let Some(&facet) = Arrangement::new(&polycube.structure, &polycube.placement).inside_out().first() else {
        return Ok((mesh, polycube));
    };
    let face = polycube.facet_of_face.iter().position(|&f| f == facet).unwrap_or(0);
    Err(Error::new(ErrorKind::Mesh, "this part of the surface looks inward")
        .at(crate::Place::Face(face as u32))
        .remedy("turn the faces of this part around"))
}
