//! A facet cut into rectangles, whatever its holes.

use super::{Facet, Structure};

/// A box of the lattice by the levels of its sides; `low` and `high` are equal along an axis where it is flat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelBox {
    /// The lower level along X, Y and Z.
    pub low: [u32; 3],
    /// The higher level along X, Y and Z.
    pub high: [u32; 3],
}

/// A coordinate and the level it belongs to.
type At = (f64, u32);

/// A side of the facet across the sweep: where it lies, which part it covers, and what it adds to the winding number.
#[derive(Clone, Copy)]
struct Event {
    at: At,
    from: At,
    to: At,
    winding: i32,
}

/// A place along the sweep line where the winding number changes.
type Step = (At, i32);

/// An interval that the sweep line covers since `since`.
struct Open {
    since: At,
    from: At,
    to: At,
}

/// The rectangles that tile `facet` under `placement`, by the levels of their sides.
///
/// A plane sweep over the facet's sides. `None` where the region is covered more than once or from the wrong side, so
/// that its loops do not bound a plane region. O(k log k) for k sides when few of them overlap along the sweep, O(k²)
/// at worst.
pub(crate) fn rectangles(structure: &Structure, facet: &Facet, placement: &[f64]) -> Option<Vec<LevelBox>> {
    let axis = facet.label.axis();
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut events = events(structure, facet, placement, u, v);
    events.sort_by(|a, b| a.at.0.total_cmp(&b.at.0).then(a.at.1.cmp(&b.at.1)));
    let mut steps: Vec<Step> = Vec::new();
    let mut open: Vec<Open> = Vec::new();
    let mut tiles = Vec::new();
    for group in events.chunk_by(|a, b| a.at.0 == b.at.0) {
        for event in group {
            add_step(&mut steps, event.from, event.winding);
            add_step(&mut steps, event.to, -event.winding);
        }
        let covered = covered(&steps)?;
        let mut close = |o: &Open| {
            let (mut low, mut high) = ([facet.level; 3], [facet.level; 3]);
            (low[u], high[u]) = (o.since.1, group[0].at.1);
            (low[v], high[v]) = (o.from.1, o.to.1);
            tiles.push(LevelBox { low, high });
        };
        let same = |o: &Open, c: &(At, At)| o.from.0 == c.0.0 && o.to.0 == c.1.0;
        open.retain(|o| {
            let goes_on = covered.iter().any(|c| same(o, c));
            if !goes_on {
                close(o);
            }
            goes_on
        });
        let fresh: Vec<_> = covered.into_iter().filter(|c| !open.iter().any(|o| same(o, c))).collect();
        open.extend(fresh.into_iter().map(|(from, to)| Open { since: group[0].at, from, to }));
    }
    open.is_empty().then_some(tiles)
}

/// The sides along `v`, each with the winding number that crossing it towards larger `u` adds.
fn events(structure: &Structure, facet: &Facet, placement: &[f64], u: usize, v: usize) -> Vec<Event> {
    let across = facet.sides().filter(|s| structure.edges[s.edge as usize].axis == v);
    let at = |level: u32| (placement[level as usize], level);
    let event = |side: super::Side| {
        let LevelBox { low, high } = structure.edge_box(&structure.edges[side.edge as usize]);
        // Seen from outside, the facet lies to the left of its sides.
        let upward = if side.forward { 1 } else { -1 };
        let winding = -upward * i32::from(facet.label.sign());
        Event { at: at(low[u]), from: at(low[v]), to: at(high[v]), winding }
    };
    across.map(event).collect()
}

fn add_step(steps: &mut Vec<Step>, at: At, winding: i32) {
    let i = steps.partition_point(|s| s.0.0 < at.0);
    match steps.get_mut(i) {
        Some(step) if step.0.0 == at.0 => {
            step.1 += winding;
            step.0 = at;
            if step.1 == 0 {
                steps.remove(i);
            }
        }
        _ => steps.insert(i, (at, winding)),
    }
}

/// The intervals of winding number 1, or `None` where another number than 0 and 1 occurs.
fn covered(steps: &[Step]) -> Option<Vec<(At, At)>> {
    let mut intervals = Vec::new();
    let mut winding = 0;
    let mut from = None;
    for &(at, change) in steps {
        winding += change;
        match (winding, from.take()) {
            (1, None) => from = Some(at),
            (0, Some(start)) => intervals.push((start, at)),
            _ => return None,
        }
    }
    Some(intervals)
}
