//! What the labels of a surface say by themselves, where it is not known yet how its facets lie.

use super::charts::Charts;
use super::extract::Skeleton;
use super::label::Label;
use super::{HalfEdge, Surface, Violation};

/// A labelled surface: its charts, the levels that they share, and the sides of charts between corners.
pub(crate) struct Labelling {
    pub(crate) surface: Surface,
    /// The chart of each face.
    pub(crate) chart_of_face: Vec<u32>,
    /// The label of each chart.
    pub(crate) labels: Vec<Label>,
    /// The level of each chart.
    pub(crate) level_of_chart: Vec<u32>,
    /// The vertices where three charts or more meet.
    pub(crate) corners: Vec<u32>,
    /// The sides of all charts.
    pub(crate) sides: Vec<ChartSide>,
    /// The sides along each border loop of a chart.
    pub(crate) loops: Vec<Vec<usize>>,
    /// The sides that leave each corner, counter-clockwise seen from outside.
    pub(crate) leaving: Vec<Vec<usize>>,
}

/// A side of a chart from one corner to the next, with the chart on its left.
pub(crate) struct ChartSide {
    /// Its half-edges in order.
    pub(crate) half_edges: Vec<HalfEdge>,
    /// The chart on its left.
    pub(crate) chart: u32,
    /// The same side as it bounds the chart on its right.
    pub(crate) twin: usize,
    /// The corner where it starts, by its place among the corners.
    pub(crate) start: usize,
}

impl Labelling {
    /// Reads the charts of a surface off the labels of its faces, or lists every violation of the first rule about
    /// labels that does not hold. O(n log n) for n faces.
    pub(crate) fn new(surface: Surface, labels: Vec<Label>) -> Result<Self, Vec<Violation>> {
        let charts = Charts::new(&surface, labels)?;
        let skeleton = Skeleton::new(&surface, &charts)?;
        let (level_of_chart, _) = skeleton.levels(&surface, &charts);
        let loops = skeleton.loops();
        let corner = |v: u32| skeleton.corners.partition_point(|&c| c < v);
        let mut sides = Vec::with_capacity(skeleton.chains.len());
        for chain in &skeleton.chains {
            let (first, last) = (chain.half_edges[0], chain.half_edges[chain.half_edges.len() - 1]);
            sides.push(ChartSide {
                half_edges: chain.half_edges.clone(),
                chart: charts.left(&surface, first),
                twin: skeleton.starts[surface.twin(last) as usize] as usize,
                start: corner(surface.start(first)),
            });
        }
        let starts = |h: HalfEdge| Some(skeleton.starts[h as usize] as usize).filter(|&s| s < sides.len());
        let leaving = skeleton.corners.iter().map(|&v| surface.fan(v).filter_map(starts).collect()).collect();
        let Charts { of_face: chart_of_face, labels, .. } = charts;
        Ok(Self { surface, chart_of_face, labels, level_of_chart, corners: skeleton.corners, sides, loops, leaving })
    }

    /// The label of the chart on the left of a side.
    pub(crate) fn label(&self, side: usize) -> Label {
        self.labels[self.sides[side].chart as usize]
    }

    /// The axis that a side runs along.
    pub(crate) fn axis(&self, side: usize) -> usize {
        3 - self.label(side).axis() - self.label(self.sides[side].twin).axis()
    }

    /// The mesh vertices at the ends of a side.
    pub(crate) fn ends(&self, side: usize) -> [u32; 2] {
        [side, self.sides[side].twin].map(|s| self.corners[self.sides[s].start])
    }

    /// The level along `axis` at a corner.
    pub(crate) fn level(&self, corner: usize, axis: usize) -> Option<u32> {
        let charts = self.leaving[corner].iter().map(|&s| self.sides[s].chart);
        let own = charts.into_iter().find(|&c| self.labels[c as usize].axis() == axis);
        own.map(|c| self.level_of_chart[c as usize])
    }
}
