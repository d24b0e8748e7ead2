//! From charts to a polycube in space, and the map between the two.

mod edges;
mod levels;
mod spans;
mod surface_map;

use super::charts::ChartedSurface;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::{Cells, Mesh};
use crate::remesh::Refined;
use crate::structure::{Arrangement, Conflict, Polycube, Tolerance};
pub(super) use levels::Levels;
use spans::Span;

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
pub(super) fn embed(charts: &ChartedSurface, levels: Levels, context: &Context) -> Result<Embedded> {
    let (mesh, polycube) = Embedding::new(charts, levels).place(&context.stage("embed", 0.0, 0.3))?;
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
    fn new(charts: &'a ChartedSurface, levels: Levels) -> Self {
        let labels = charts.chart.iter().map(|&c| charts.labels[c as usize] as i8).collect();
        Self { charts, levels, labels }
    }

    /// The polycube without conflicts: with edges about as long as on the shape, or else with charts where they are on
    /// the shape.
    fn place(&mut self, context: &Context) -> Result<(Mesh, Polycube)> {
        let on_the_shape = self.levels.as_on_the_shape();
        let (_, polycube) = self.put(&on_the_shape, context)?;
        let mut start = vec![0.0; on_the_shape.len()];
        let numbers = self.numbers(&polycube);
        numbers.iter().zip(&polycube.placement).for_each(|(&l, &x)| start[l as usize] = x);
        let as_long = self.levels.as_long_as(&self.spans(&polycube), &start);
        let before = self.levels.clone();
        match self.apart(&as_long, &on_the_shape, &context.stage("embed", 0.0, 0.5)) {
            Err(error) if error.kind == ErrorKind::Polycube => {
                self.levels = before;
                self.apart(&on_the_shape, &on_the_shape, &context.stage("embed", 0.5, 1.0))
            }
            placed => placed,
        }
    }

    /// The polycube with its levels near to `targets`, and more of them in the order that they have on the shape until
    /// no parts meet.
    fn apart(&mut self, targets: &[f64], on_the_shape: &[f64], context: &Context) -> Result<(Mesh, Polycube)> {
        let (mut mesh, mut polycube) = self.put(targets, context)?;
        for added in 0..MOST_SEPARATIONS {
            context.tick(added as f64 / MOST_SEPARATIONS as f64)?;
            let found = conflicts(&polycube);
            let Some(first) = found.first() else { return self.outward(mesh, polycube) };
            if !self.separate(&polycube, &found, on_the_shape) {
                break;
            }
            let again = self.put(targets, context);
            (mesh, polycube) = again.map_err(|e| match e.kind {
                ErrorKind::Infeasible => self.stuck(&polycube, first),
                _ => e,
            })?;
        }
        match conflicts(&polycube).first() {
            Some(conflict) => Err(self.stuck(&polycube, conflict)),
            None => self.outward(mesh, polycube),
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

    /// How far apart levels, as the loops number them, lie on the shape.
    fn spans(&self, polycube: &Polycube) -> Vec<Span> {
        let numbers = self.numbers(polycube);
        let mut spans = spans::spans(polycube, &self.charts.points);
        spans.iter_mut().for_each(|s| [s.low, s.high] = [s.low, s.high].map(|l| numbers[l as usize]));
        spans
    }

    /// Keeps parts that meet apart along the axis where they are farthest apart on the shape, of those whose order is
    /// still free; whether that adds anything.
    fn separate(&mut self, polycube: &Polycube, found: &[Conflict], on_the_shape: &[f64]) -> bool {
        let numbers = self.numbers(polycube);
        let mut adds = false;
        for [one, two] in found.iter().filter_map(|c| c.boxes) {
            let pairs = (0..3).flat_map(|a| [[one.high[a], two.low[a]], [two.high[a], one.low[a]]]);
            let mut pairs: Vec<[u32; 2]> = pairs.map(|pair| pair.map(|l| numbers[l as usize])).collect();
            if pairs.iter().any(|&[low, high]| self.levels.is_below(low, high)) {
                continue;
            }
            let gap = |&[low, high]: &[u32; 2]| on_the_shape[high as usize] - on_the_shape[low as usize];
            pairs.sort_by(|a, b| gap(b).total_cmp(&gap(a)));
            if let Some([low, high]) = pairs.into_iter().find(|&[l, h]| l != h && !self.levels.is_below(h, l)) {
                self.levels.separate(low, high);
                adds = true;
            }
        }
        adds
    }

    /// A triangle of the shape in a facet.
    fn triangle_in(&self, polycube: &Polycube, is_meant: impl Fn(u32) -> bool) -> u32 {
        let found = polycube.facet_of_face.iter().position(|&facet| is_meant(facet));
        self.charts.origins[found.unwrap_or(0)]
    }

    /// The same if every part of it looks outward, and hollows into the solid around them.
    fn outward(&self, mesh: Mesh, polycube: Polycube) -> Result<(Mesh, Polycube)> {
        match Arrangement::new(&polycube.structure, &polycube.placement).inside_out().first() {
            Some(&inward) => Err(looks_inward(self.triangle_in(&polycube, |facet| facet == inward))),
            None => Ok((mesh, polycube)),
        }
    }

    /// The error for parts that no order of levels keeps apart, with a face of one of them.
    fn stuck(&self, polycube: &Polycube, conflict: &Conflict) -> Error {
        Error::new(ErrorKind::Polycube, "parts of the polycube would lie in one place")
            .at(Place::Face(self.triangle_in(polycube, |facet| conflict.facets.contains(&facet))))
            .remedy("ask for more detail, so that the polycube follows the shape more closely, or turn the shape")
    }
}

fn conflicts(polycube: &Polycube) -> Vec<Conflict> {
    Arrangement::new(&polycube.structure, &polycube.placement).conflicts()
}

/// The error for a part of a surface that has its outside within.
pub(super) fn looks_inward(face: u32) -> Error {
    Error::new(ErrorKind::Mesh, "this part of the surface looks inward")
        .at(Place::Face(face))
        .remedy("turn the faces of this part around")
}
