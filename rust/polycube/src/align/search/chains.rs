//! How many chains of annealing there are, where they begin, and how long they are.

use super::anneal::{Landscape, Schedule};
use super::front::Front;
use super::state::State;
use crate::align::effort::Effort;
use crate::context::Context;
use crate::error::{Error, ErrorKind, Result};

/// The first chains, two from the result of Algorithm 1 and two from that of greedy merging, of which one each minds
/// displacement.
const FIRST: [Schedule; 4] = [
    WARM,
    Schedule { seed: 2, hot: 0.1, ..WARM },
    Schedule { seed: 3, weight: 0.3, ..WARM },
    Schedule { seed: 4, weight: 2.0, ..WARM },
];

const WARM: Schedule =
    Schedule { seed: 1, steps: 0, hot: 0.05, cold: 0.002, weight: 0.01, paired: false, most: f64::INFINITY };

/// The last chains, two by two from the coarsest state so far, cooler, with two levels at once. On large polycubes they
/// find what single levels do not; small ones are done before.
const LAST: [Schedule; 4] = {
    const COOL: Schedule = Schedule { seed: 5, hot: 0.02, cold: 0.001, paired: true, ..WARM };
    [COOL, Schedule { seed: 6, ..COOL }, Schedule { seed: 7, ..COOL }, Schedule { seed: 8, ..COOL }]
};

/// How far the chains that make the front denser may move corners, as parts of the displacement of the coarsest state.
const BOUNDS: [f64; 6] = [0.7, 0.5, 0.35, 0.25, 0.18, 0.12];
/// How many times shorter they are than others.
const SHORTER: u32 = 3;
const NEAR: Schedule = Schedule { weight: 0.3, ..WARM };

/// Walks all chains and leaves what they see in `front`, which must hold where they begin.
pub(super) fn walk(
    landscape: &Landscape,
    begin: &[State; 2],
    effort: &Effort,
    front: &mut Front,
    context: &Context,
) -> Result<()> {
    let steps = landscape.affordable(effort.steps_per_level.saturating_mul(landscape.structure.levels.len() as u32));
    let long = |schedule: Schedule| Schedule { steps, ..schedule };
    for (half, pair) in FIRST.chunks(2).enumerate() {
        let jobs = [0, 1].map(|i| (begin[i].clone(), long(pair[i])));
        walk_two(landscape, jobs, front, &context.stage("search", 0.25 * half as f64, 0.25 * (half + 1) as f64))?;
    }
    for (half, pair) in LAST.chunks(2).enumerate() {
        let Some(best) = front.states().next().cloned() else { return Ok(()) };
        let jobs = [0, 1].map(|i| (best.clone(), long(pair[i])));
        walk_two(
            landscape,
            jobs,
            front,
            &context.stage("search", 0.5 + 0.25 * half as f64, 0.75 + 0.25 * half as f64),
        )?;
    }
    Ok(())
}

/// Makes the front denser: chains that may move corners seven tenths as far as the coarsest state does, less far, and
/// so on, each from the coarsest state that keeps its bound.
pub(super) fn fill(landscape: &Landscape, effort: &Effort, front: &mut Front, context: &Context) -> Result<()> {
    let Some(farthest) = front.states().next().map(State::shape_cost) else { return Ok(()) };
    let steps = effort.steps_per_level / SHORTER;
    let steps = landscape.affordable(steps.saturating_mul(landscape.structure.levels.len() as u32));
    for (k, pair) in BOUNDS.chunks(2).enumerate() {
        let [from, to] = [k, k + 1].map(|k| (2 * k) as f64 / BOUNDS.len() as f64);
        let jobs = [0, 1].map(|i| {
            let most = farthest * pair[i] * pair[i];
            let start = front.states().find(|s| s.shape_cost() <= most)?.clone();
            Some((start, Schedule { seed: 9 + (2 * k + i) as u64, steps, most, ..NEAR }))
        });
        if let [Some(own), Some(other)] = jobs {
            walk_two(landscape, [own, other], front, &context.stage("search", from, to))?;
        }
    }
    Ok(())
}

/// Two chains at a time. What they find does not depend on how they are scheduled.
fn walk_two(landscape: &Landscape, jobs: [(State, Schedule); 2], front: &mut Front, context: &Context) -> Result<()> {
    let walk = |(start, schedule): (State, Schedule)| {
        let mut seen = Front::default();
        landscape.chain()?.walk(start, &schedule, &mut seen, context).map(|()| seen)
    };
    let [own, other] = jobs;
    let results = std::thread::scope(|scope| {
        let other = scope.spawn(|| walk(other));
        [Ok(walk(own)), other.join()]
    });
    for result in results {
        front.join(result.map_err(|_| Error::new(ErrorKind::Internal, "a chain of the search failed"))??);
    }
    Ok(())
}
