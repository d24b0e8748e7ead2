//! Extend values known at some vertices over the others so that each is the weighted mean of its neighbours.

use super::solve::solve;
use super::sparse::{SparseRows, Values, add_scaled};
use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};

/// Marks a vertex that is no unknown.
const KNOWN: u32 = u32::MAX;

/// Replaces `field[v][axis]` wherever `known[v][axis]` is false and row `v` of `weights` is not
/// empty by the solution of `Σ_j w_vj (field_v − field_j) = 0`.
///
/// # Errors
/// [`ErrorKind::Polycube`] naming a vertex no chain of unknowns joins to a known one; those of the solver.
pub(crate) fn extend_harmonic(
    weights: &SparseRows,
    known: &[[bool; 3]],
    field: &mut [Values<3>],
    context: &Context,
) -> Result<()> {
    let alike = |v: usize| known[v] == [known[v][0]; 3] || weights.range(v).is_empty();
    if (0..weights.len()).all(alike) {
        return extend(weights, known, [0, 1, 2], field, context);
    }
    for axis in 0..3 {
        let part = context.stage("morph", axis as f64 / 3.0, (axis + 1) as f64 / 3.0);
        extend(weights, known, [axis], field, &part)?;
    }
    Ok(())
}

/// The same for the axes listed, all with the same unknowns.
fn extend<const N: usize>(
    weights: &SparseRows,
    known: &[[bool; 3]],
    axes: [usize; N],
    field: &mut [Values<3>],
    context: &Context,
) -> Result<()> {
    let system = System::new(weights, known, axes, field)?;
    let solution = solve(&system.matrix, &system.sides, context)?;
    for (&v, values) in system.unknowns.iter().zip(solution) {
        for (axis, value) in axes.into_iter().zip(values) {
            field[v as usize][axis] = value;
        }
    }
    Ok(())
}

/// The linear system of the vertices where a field is not known.
pub(super) struct System<const N: usize> {
    /// The vertex of each row.
    unknowns: Vec<u32>,
    /// The Laplacian between the unknowns.
    pub(super) matrix: SparseRows,
    /// What the known neighbours pull each unknown by.
    pub(super) sides: Vec<Values<N>>,
}

impl<const N: usize> System<N> {
    /// For the axes listed, all with the same unknowns.
    ///
    /// # Errors
    /// [`ErrorKind::Polycube`] naming a vertex no chain of unknowns joins to a known one.
    pub(super) fn new(
        weights: &SparseRows,
        known: &[[bool; 3]],
        axes: [usize; N],
        field: &[Values<3>],
    ) -> Result<Self> {
        let unknown = |v: usize| !known[v][axes[0]] && !weights.range(v).is_empty();
        let unknowns: Vec<u32> = (0..weights.len()).filter(|&v| unknown(v)).map(|v| v as u32).collect();
        let mut index = vec![KNOWN; weights.len()];
        for (i, &v) in unknowns.iter().enumerate() {
            index[v as usize] = i as u32;
        }
        anchored(weights, &unknowns, &index, axes[0])?;
        let matrix = reduced(weights, &unknowns, &index);
        let sides = right_hand_sides(weights, &unknowns, &index, axes, field);
        Ok(Self { unknowns, matrix, sides })
    }
}

/// The Laplacian between the unknowns.
fn reduced(weights: &SparseRows, unknowns: &[u32], index: &[u32]) -> SparseRows {
    let mut matrix = SparseRows::new();
    let mut row = Vec::new();
    for (i, &v) in unknowns.iter().enumerate() {
        let entries = weights.row(v as usize);
        row.push((i as u32, entries.map(|(_, w)| w).sum()));
        let entries = weights.row(v as usize).map(|(j, w)| (index[j], -w));
        row.extend(entries.filter(|&(j, _)| j != KNOWN));
        matrix.push(&mut row);
    }
    matrix
}

/// What the known neighbours pull each unknown by.
fn right_hand_sides<const N: usize>(
    weights: &SparseRows,
    unknowns: &[u32],
    index: &[u32],
    axes: [usize; N],
    field: &[Values<3>],
) -> Vec<Values<N>> {
    let pull = |&v: &u32| {
        let mut sum = [0.0; N];
        for (j, w) in weights.row(v as usize).filter(|&(j, _)| index[j] == KNOWN) {
            add_scaled(&mut sum, w, &axes.map(|axis| field[j][axis]));
        }
        sum
    };
    unknowns.iter().map(pull).collect()
}

/// Fails unless every connected set of unknowns has a known neighbour.
fn anchored(weights: &SparseRows, unknowns: &[u32], index: &[u32], axis: usize) -> Result<()> {
    let mut seen = vec![false; unknowns.len()];
    for (i, &v) in unknowns.iter().enumerate() {
        if !seen[i] && !spread(weights, i, unknowns, index, &mut seen) {
            return Err(adrift(v, axis));
        }
    }
    Ok(())
}

/// Marks the unknowns connected to unknown `first`; tells whether a known neighbour was met.
fn spread(weights: &SparseRows, first: usize, unknowns: &[u32], index: &[u32], seen: &mut [bool]) -> bool {
    let mut met = false;
    let mut stack = vec![first];
    seen[first] = true;
    while let Some(i) = stack.pop() {
        for (j, _) in weights.row(unknowns[i] as usize) {
            let next = index[j];
            if next == KNOWN {
                met = true;
            } else if !std::mem::replace(&mut seen[next as usize], true) {
                stack.push(next as usize);
            }
        }
    }
    met
}

fn adrift(v: u32, axis: usize) -> Error {
    let name = ["x", "y", "z"][axis];
    let message = format!("no vertex of its component has a prescribed {name} coordinate");
    Error::new(ErrorKind::Polycube, message)
        .at(Place::Vertex(v))
        .remedy(format!("every closed component needs at least one facet across the {name} axis"))
}
