//! Energy, constraints and minimiser put together.

use super::assembly::Assembly;
use super::elements::Elements;
use super::energy::Law;
use super::freedom::Constraints;
use super::lbfgs::{Limits, minimise};
use crate::context::Context;
use crate::error::Result;
use crate::mesh::Point;
use nalgebra::Vector3;
use rayon::prelude::*;

/// Halvings of a step that spoils an element before its vertices go back all the way.
const HALVINGS: usize = 6;
/// Rounds in which vertices go back.
const RETREATS: usize = 40;

/// One optimisation.
pub(super) struct Optimisation<'a> {
    pub(super) elements: &'a Elements,
    pub(super) assembly: Assembly<'a>,
    pub(super) constraints: Constraints<'a>,
    /// Inverse of the Laplacian's diagonal at each vertex: squared lengths.
    scales: Vec<f64>,
    /// Iterations of the minimiser so far.
    pub(super) iterations: usize,
}

impl<'a> Optimisation<'a> {
    pub(super) fn new(elements: &'a Elements, constraints: Constraints<'a>, count: usize) -> Self {
        let assembly = Assembly::new(elements, count);
        Self { elements, assembly, constraints, scales: scales(elements, count), iterations: 0 }
    }

    /// Goes down the energy from `points` along the tangents of the guides; returns by which share it fell.
    pub(super) fn descend(
        &mut self,
        points: &mut Vec<Point>,
        law: &Law,
        limits: Limits,
        context: &Context,
    ) -> Result<f64> {
        let (assembly, constraints) = (&mut self.assembly, &self.constraints);
        let mut evaluate = |points: &[Point], gradient: &mut [Vector3<f64>]| {
            let energy = assembly.evaluate(points, law, gradient, context)?;
            constraints.restrict(gradient);
            Ok(energy)
        };
        let outcome = minimise(points, &self.scales, limits, &mut evaluate)?;
        let energies = &outcome.energies;
        self.iterations += energies.len() - 1;
        Ok(1.0 - energies[energies.len() - 1] / energies[0])
    }

    /// Puts the sliding vertices of `to` on their guides. Where that gives an element no more than the quality `bar`,
    /// its vertices go back towards `from`, which is on the guides and above the bar, until all is well: `from` at
    /// worst.
    pub(super) fn settle(&mut self, from: &[Point], to: &mut [Point], bar: f64, context: &Context) -> Result<()> {
        let mut blend = vec![1.0_f64; to.len()];
        let target = to.to_vec();
        self.constraints.project(to);
        for retreat in 0..RETREATS {
            context.check()?;
            let bad = self.spoiled(to, bar);
            if bad.is_empty() {
                return Ok(());
            }
            let mut touched: Vec<u32> = bad.into_iter().flat_map(|e| self.elements.corners[e]).collect();
            touched.sort_unstable();
            touched.dedup();
            for v in touched.into_iter().map(|v| v as usize) {
                blend[v] = if retreat < HALVINGS { 0.5 * blend[v] } else { 0.0 };
                let back = if blend[v] == 0.0 { from[v] } else { from[v] + (target[v] - from[v]) * blend[v] };
                to[v] = self.constraints.place(v, back);
            }
        }
        to.copy_from_slice(from);
        self.constraints.project(to);
        Ok(())
    }

    /// The elements of no more quality than `bar`.
    fn spoiled(&self, points: &[Point], bar: f64) -> Vec<usize> {
        let bad = |e: &usize| {
            let quality = self.elements.quality(*e, points);
            quality.is_nan() || quality <= bar
        };
        (0..self.elements.len()).into_par_iter().with_min_len(4096).filter(bad).collect()
    }
}

fn scales(elements: &Elements, count: usize) -> Vec<f64> {
    let mut diagonal = vec![0.0; count];
    for ((corner, reference), weight) in elements.corners.iter().zip(&elements.references).zip(&elements.weights) {
        let [xx, yy, zz, yz, xz, xy] = reference.metric;
        let squares = [xx + yy + zz + 2.0 * (yz + xz + xy), xx, yy, zz];
        corner.iter().zip(squares).for_each(|(v, square)| diagonal[*v as usize] += weight * square);
    }
    diagonal.into_iter().map(|d: f64| if d > 0.0 { 1.0 / d } else { 0.0 }).collect()
}
