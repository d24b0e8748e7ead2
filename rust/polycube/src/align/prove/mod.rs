//! Proof of how few blocks there can be: an exact search over orders of levels with a lower bound.
//!
//! What blocks a polycube has depends only on which levels coincide and how the others are ordered: on the relation
//! `<`, `=` or `>` of every two levels of one axis. A *partial order* leaves some pairs several relations; its
//! *completions* are the valid polycubes that have, for every pair, one of them. [`prove`] starts from the partial
//! order that holds what every valid polycube satisfies, and splits: one pair, three relations. What follows is
//! propagated, and a part whose lower bound is not below the best count known is dropped.
//!
//! # What every valid order satisfies
//!
//! 1. *Lengths.* The lower end of an edge lies below its higher end.
//! 2. *Composition.* `a < b` and `b ≤ c` give `a < c`, and so on for every three levels.
//! 3. *Separation.* Two edges without a common corner have no point in common, and neither have an edge and a
//!    rectangle of a facet that shares no corner with it. Boxes are disjoint exactly if their ranges along some
//!    axis are, so `high₁ < low₂` or `high₂ < low₁` on one of three axes. The rectangles of a facet are known as
//!    soon as the relations of its own levels are.
//! 4. *Outlines.* The loops of a facet bound a plane region; a hole lies within the range of the outer loop.
//!
//! Only necessary conditions are propagated, and every complete order is checked exactly, so no
//! optimum is missed and no invalid order accepted.
//!
//! # The lower bound
//!
//! Faces are the rectangles of the layout on the surface: those of the base complex, or the patches.
//!
//! *Lines.* Where the outline of a facet F turns by 270° at a corner, both of its sides have a continuation with F on
//! either side. In the base complex, one of the three edges there is reflex or two are, and the planes of both
//! sides hold a sheet that starts there; on the surface, a separatrix leaves the corner along each. Either goes on
//! as long as F lies on both sides of it: a sheet fills its connected part of a plane, and a separatrix ends in
//! corners only. When such a line meets the inside of an edge, it goes on in the facet behind that edge, for the
//! same two reasons. So a line is sure to pass a stretch of F if every side of F that could stop it within this
//! stretch surely ends before or begins after it; and it surely crosses an edge if that is the only one that it can
//! meet next and the line lies strictly between its ends.
//!
//! *Grid.* Take levels of F's sides, and of sure lines that are comparable to all of these, and cut each of F's
//! two axes wherever all levels on one side of the cut are surely below all on the other. The gap between two such
//! classes of levels exists in every completion, hence so does each product of two gaps, a *cell*; and whether it
//! lies in F is known, for the ends of a side relative to the gap are. Count the cells inside F that are *parted*
//! on both axes from the cell before: by a sure line, or because that one is not inside F. Faces are rectangles. If
//! the face that holds a parted cell c held another cell before c on an axis, it would hold c's neighbour on this
//! axis, but a line or the outside lies in between. So c is the lowest cell of its face: parted cells are in
//! different faces, and
//!
//! > faces ≥ Σ over facets of the number of parted cells.
//!
//! *Columns.* Blocks stack face to face, so going inward from a face that looks along +x through one block after the
//! other ends at a face that looks along −x, and every block is passed from exactly one face that looks along +x.
//! Where a face has a convex edge to a wall, each sure line in the wall that runs across this way is a sheet that
//! cuts the column behind the face, and so is the plane of the facet below if the wall ends at a reflex edge. With
//! s(c) such lines at the wall next to c, as far down as the wall surely goes on,
//!
//! > blocks ≥ max over the six labels of Σ over parted cells c of facets with this label of (1 + s(c)).
//!
//! The bound of `blocks_padded` is the sum of both.
//!
//! # What to expect
//!
//! A partial order takes 50 to 400 µs at up to 14 levels an axis. Connected polycubes of up to 12 levels an axis
//! are often certified in less than a second; at 20 and more the bound stays far from the count, and so it can
//! where parts are free to pass each other. The search takes the partial order with the least bound first, so the
//! bound rises as long as it runs. Half a gigabyte of open partial orders ends it too.

mod bound;
mod clauses;
mod grid;
mod outline;
mod relations;
mod tree;

use super::guides::Guided;
use super::judge::Judge;
use super::ranks::Ranks;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};
use crate::layout::Objective;
use crate::structure::Structure;
use bound::Bound;
use clauses::{Condition, Rules};
use relations::{ABOVE, BELOW, EQUAL};
use std::time::Duration;
use tree::{Limits, Tree};

/// What is known of the optimum of one structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// No valid order has a lower count; at most [`count`](Self::count).
    pub bound: usize,
    /// The best order known.
    pub best: Ranks,
    /// The count of [`best`](Self::best).
    pub count: usize,
    /// Whether `best` is certified to be optimal: `bound == count`.
    pub proven: bool,
    /// How many partial orders were looked at.
    pub nodes: u64,
}

/// Bounds the objective over all valid orders of the levels of `structure` from below, and finds a better order than
/// `incumbent` where the search comes past one.
///
/// `budget` is the most partial orders looked at, give or take two; with 0 the bound is that of the root. The
/// result is the same for the same budget everywhere, unless `time_limit` ends the search first. Whenever it ends,
/// `bound ≤ optimum ≤ count`. Before the search, O(n³) for n levels of an axis and O(e²) for the pairs of
/// e edges, up to 1000 of them; for larger structures only the lengths of edges are propagated. Exponential after that.
///
/// ```
/// use polycube::layout::Objective;
/// use polycube::parts::{Ranks, prove};
/// use polycube::generate::{Cuboid, Voxels};
/// use polycube::mesh::CellKind;
/// use polycube::structure::{Polycube, Tolerance};
///
/// // An L: two boxes, whose reflex edge cuts it into three blocks with 14 faces.
/// let boxes = [Cuboid::new([0, 0, 0], [2, 1, 1]), Cuboid::new([0, 0, 1], [1, 1, 2])];
/// let mesh = Voxels::from_boxes(&boxes)?.mesh(CellKind::Quads, 1.0)?;
/// let polycube = Polycube::new(&mesh, None, &Tolerance::default()).expect("a polycube");
/// let start = Ranks::new(&polycube.structure, &polycube.placement);
/// let objective = Objective::BlocksPadded;
/// let proof = prove(&polycube.structure, objective, &start, 1000, None, &Default::default())?;
/// assert!(proof.proven);
/// assert_eq!(proof.bound, 17);
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Polycube`] if `incumbent` is not a valid order, [`ErrorKind::Cancelled`].
pub fn prove(
    structure: &Structure,
    objective: Objective,
    incumbent: &Ranks,
    budget: u64,
    time_limit: Option<Duration>,
    context: &Context,
) -> Result<Proof> {
    let free = Guided::free(structure);
    prove_guided(structure, &free, objective, incumbent, (budget, time_limit), context)
}

/// [`prove`] for the orders that guides allow, of which `incumbent` must be one: both the bound and what is found are
/// theirs.
///
/// What must be equal and what must differ is propagated from the start; orders that are not mirrored, or crowd what is
/// fixed, are dropped once they are complete.
pub(super) fn prove_guided(
    structure: &Structure,
    guided: &Guided,
    objective: Objective,
    incumbent: &Ranks,
    (budget, time_limit): (u64, Option<Duration>),
    context: &Context,
) -> Result<Proof> {
    let mut judge = Judge::new(structure);
    let count =
        Some(incumbent).filter(|i| guided.allows(i)).and_then(|i| judge.cost(objective, i)).ok_or_else(|| {
            Error::new(ErrorKind::Polycube, "the order to start from is not a valid polycube")
                .remedy("start from the order of the input, or from a result of `align`")
        })?;
    let excluded = |_| Error::new(ErrorKind::Internal, "the rules exclude a valid order");
    let (rules, mut root) = Rules::new(structure).map_err(excluded)?;
    rules.restrict(&mut root, &conditions(guided)).map_err(excluded)?;
    let tree = Tree::new(rules, Bound::new(structure), objective, (judge, guided), (incumbent.clone(), count));
    tree.run(root, &Limits { nodes: budget, time: time_limit }, context)
}

/// What guides say about pairs of levels.
fn conditions(guided: &Guided) -> Vec<Condition> {
    let equal = (0..).zip(&guided.partners).flat_map(|(l, p)| p.iter().map(move |&m| (l, m, EQUAL)));
    let apart = guided.apart().iter().map(|&[a, b]| (a, b, BELOW | ABOVE));
    equal.chain(apart).collect()
}
