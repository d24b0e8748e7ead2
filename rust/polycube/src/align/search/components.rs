//! Solids that never meet are searched one by one.
//!
//! Sheets and patches do not leave the solid they are in, so what an order of all levels counts is the sum of what it
//! counts in each solid. If the boxes around solids are separate along some axis, every order of the one goes with
//! every order of the other, as long as they stay separate along this axis. So the least sum is the sum of the least,
//! and so are lower bounds.

use super::SearchResult;
use super::anneal::Chain;
use super::front::Front;
use super::state::State;
use crate::align::Task;
use crate::align::classes::Classes;
use crate::align::guides::Guided;
use crate::align::problem::Difference;
use crate::align::ranks::Ranks;
use crate::align::relax::{Demand, relax};
use crate::align::unit::Unit;
use crate::context::Context;
use crate::error::Result;
use crate::structure::{Corner, Edge, Facet, Side, Structure};

/// A part of a structure with a structure of its own.
pub(super) struct Component {
    /// The structure of this part.
    pub structure: Structure,
    /// The level of the whole that each of its levels is.
    pub levels: Vec<u32>,
}

type Extent = ([f64; 3], [f64; 3]);

/// The parts of a structure whose boxes are pairwise separate in `placement`; one if there is nothing to tell apart.
pub(super) fn split(structure: &Structure, placement: &[f64]) -> Vec<Component> {
    let component = structure.components();
    let count = component.iter().max().map_or(0, |c| *c as usize + 1);
    let mut group: Vec<usize> = (0..count).collect();
    // Joining two boxes makes a larger one, which may meet others.
    while let Some((a, b)) = touching(&extents(structure, placement, &component, &group)) {
        group.iter_mut().filter(|g| **g == b).for_each(|g| *g = a);
    }
    let mut names = group.clone();
    names.sort_unstable();
    names.dedup();
    names
        .into_iter()
        .map(|name| Component::new(structure, |facet| group[component[facet as usize] as usize] == name))
        .collect()
}

/// The box around each group of components; nothing for a number that no group has.
fn extents(structure: &Structure, placement: &[f64], component: &[u32], group: &[usize]) -> Vec<Option<Extent>> {
    let mut extents: Vec<Option<Extent>> = vec![None; group.len()];
    for edge in &structure.edges {
        let own = group[component[edge.facets[0] as usize] as usize];
        for corner in edge.corners {
            let at = structure.position(corner, placement);
            let (low, high) = extents[own].get_or_insert((at, at));
            *low = std::array::from_fn(|a| low[a].min(at[a]));
            *high = std::array::from_fn(|a| high[a].max(at[a]));
        }
    }
    extents
}

/// The first two boxes that no axis separates.
fn touching(extents: &[Option<Extent>]) -> Option<(usize, usize)> {
    let pairs = (0..extents.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
    pairs.into_iter().find(|&(a, b)| match (&extents[a], &extents[b]) {
        (Some(a), Some(b)) => (0..3).all(|k| a.0[k] <= b.1[k] && b.0[k] <= a.1[k]),
        _ => false,
    })
}

impl Component {
    fn new(whole: &Structure, holds: impl Fn(u32) -> bool) -> Self {
        let facets: Vec<u32> = (0..whole.facets.len() as u32).filter(|&f| holds(f)).collect();
        let edges: Vec<u32> = (0..).zip(&whole.edges).filter(|(_, e)| holds(e.facets[0])).map(|(i, _)| i).collect();
        let of_edges = edges.iter().flat_map(|&e| whole.edges[e as usize].corners);
        let corners = ascending(of_edges);
        let levels = ascending(corners.iter().flat_map(|&c| whole.corners[c as usize].levels));
        let own = |list: &[u32], item: u32| list.partition_point(|&x| x < item) as u32;
        let facet = |&f: &u32| {
            let Facet { label, level, loops } = &whole.facets[f as usize];
            let side = |s: &Side| Side { edge: own(&edges, s.edge), forward: s.forward };
            let loops = loops.iter().map(|l| l.iter().map(side).collect()).collect();
            Facet { label: *label, level: own(&levels, *level), loops }
        };
        let edge = |&e: &u32| {
            let e = &whole.edges[e as usize];
            Edge {
                axis: e.axis,
                corners: e.corners.map(|c| own(&corners, c)),
                facets: e.facets.map(|f| own(&facets, f)),
            }
        };
        let corner = |&c: &u32| {
            let c = &whole.corners[c as usize];
            Corner { levels: c.levels.map(|l| own(&levels, l)), ..*c }
        };
        let structure = Structure {
            facets: facets.iter().map(facet).collect(),
            edges: edges.iter().map(edge).collect(),
            corners: corners.iter().map(corner).collect(),
            levels: levels.iter().map(|&l| whole.levels[l as usize].clone()).collect(),
        };
        Self { structure, levels }
    }

    /// What belongs to this part of something that each level of the whole has.
    pub(super) fn of<T: Copy>(&self, whole: &[T]) -> Vec<T> {
        self.levels.iter().map(|&l| whole[l as usize]).collect()
    }

    /// The task of this part alone.
    pub(super) fn task<'a>(&'a self, whole: &Task<'a>, input: &'a [f64]) -> Task<'a> {
        Task {
            structure: &self.structure,
            input,
            start: self.of(&whole.start),
            targets: self.of(&whole.targets),
            guided: Guided::free(&self.structure),
            before: whole.before,
            deadline: whole.deadline,
            options: whole.options,
        }
    }
}

fn ascending(items: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut items: Vec<u32> = items.collect();
    items.sort_unstable();
    items.dedup();
    items
}

/// Trade-offs of the whole from those of its parts: from the coarsest of all on, in each step the part gives way that
/// saves most displacement for a block. What does not fit together is left out.
pub(super) fn combine(
    task: &Task,
    parts: &[Component],
    found: &[SearchResult],
    chain: &mut Chain,
    front: &mut Front,
    context: &Context,
) -> Result<()> {
    let states: Vec<Vec<&State>> = found.iter().map(|f| f.front.states().collect()).collect();
    let mut at = vec![0; parts.len()];
    loop {
        let chosen: Vec<&State> = states.iter().zip(&at).map(|(s, &i)| s[i]).collect();
        let state = merged(task, parts, &chosen, context)?.and_then(|ranks| chain.state(ranks));
        state.iter().for_each(|s| front.offer(s));
        let gain = |k: usize| {
            let (now, next) = (states[k][at[k]], states[k].get(at[k] + 1)?);
            Some((now.shape_cost() - next.shape_cost()) / (next.count - now.count) as f64)
        };
        let gains = (0..parts.len()).filter_map(|k| gain(k).map(|g| (g, k)));
        let Some((_, next)) = gains.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))) else { return Ok(()) };
        at[next] += 1;
    }
}

/// One order of all levels that has the given order in each part and keeps the parts separate, as near to the input as
/// it can be; nothing if that is not valid.
fn merged(task: &Task, parts: &[Component], states: &[&State], context: &Context) -> Result<Option<Ranks>> {
    let structure = task.structure;
    let fine = Unit::of(structure, task.input).apply(structure, task.input);
    let mut classes = Classes::new(fine.len());
    let mut differences = Vec::new();
    for (part, state) in parts.iter().zip(states) {
        let mut order: Vec<(usize, u16, u32)> = part
            .levels
            .iter()
            .zip(&state.ranks.of_level)
            .map(|(&l, &rank)| (structure.levels[l as usize].axis, rank, l))
            .collect();
        order.sort_unstable();
        for pair in order.windows(2) {
            let [(axis, rank, low), (other, next, high)] = [pair[0], pair[1]];
            if (axis, rank) == (other, next) {
                classes.join(low, high);
            } else if axis == other {
                differences.push(Difference { low, high, gap: 1 });
            }
        }
    }
    differences.extend(separations(task, parts, states));
    let demand = Demand { targets: &fine, classes: &classes, pairs: &[], halvings: 0, differences, planes: Vec::new() };
    // Any order that satisfies the demand will do to begin with: the solver finds the nearest, and the judge looks at
    // it.
    match relax(structure, &fine, demand, &*task.options.solver.solver(), context) {
        Ok(placement) => Ok(Some(Ranks::new(structure, &placement))),
        Err(error) if error.kind == crate::ErrorKind::Cancelled => Err(error),
        Err(_) => Ok(None),
    }
}

/// What keeps every two parts separate along the axis on which they are farthest apart in the start: the highest plane
/// of the one, in the order given, below the lowest of the other.
fn separations(task: &Task, parts: &[Component], states: &[&State]) -> Vec<Difference> {
    let end = |k: usize, axis: usize, key: &dyn Fn(usize) -> f64| {
        let own = (0..parts[k].levels.len()).filter(|&l| parts[k].structure.levels[l].axis == axis);
        own.max_by(|&a, &b| key(a).total_cmp(&key(b))).map_or(0, |l| parts[k].levels[l])
    };
    let start = |k: usize, l: usize| task.start[parts[k].levels[l] as usize];
    let rank = |k: usize, l: usize| f64::from(states[k].ranks.of_level[l]);
    let gap = |&(axis, low, high): &(usize, usize, usize)| {
        let top = task.start[end(low, axis, &|l| start(low, l)) as usize];
        task.start[end(high, axis, &|l| -start(high, l)) as usize] - top
    };
    let pairs = (0..parts.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
    let widest = |(a, b): (usize, usize)| {
        let all = (0..3).flat_map(|axis| [(axis, a, b), (axis, b, a)]);
        all.max_by(|p, q| gap(p).total_cmp(&gap(q)))
    };
    let keep = |(axis, low, high): (usize, usize, usize)| Difference {
        low: end(low, axis, &|l| rank(low, l)),
        high: end(high, axis, &|l| -rank(high, l)),
        gap: 1,
    };
    pairs.filter_map(widest).map(keep).collect()
}
