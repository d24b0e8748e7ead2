//! Solutions of difference constraints alone, by longest paths, and the cycle that proves there are none.

use crate::align::difference::Difference;
use crate::error::{Error, ErrorKind, Result};

/// At most this many variables of a contradictory cycle are written out.
const NAMED: usize = 12;

/// The midpoint (rounded down) of the least solution above `near` and the greatest solution below it.
pub(crate) fn between(differences: &[Difference], near: &[i64]) -> Result<Vec<i64>> {
    let mut above = near.to_vec();
    raise(differences, &mut above)?;
    let mirrored: Vec<Difference> = differences.iter().map(mirror).collect();
    let mut below: Vec<i64> = near.iter().map(|x| -x).collect();
    raise(&mirrored, &mut below)?;
    Ok(above.iter().zip(&below).map(|(a, b)| (a - b).div_euclid(2)).collect())
}

/// The same constraint on the negated variables.
fn mirror(d: &Difference) -> Difference {
    Difference { low: d.high, high: d.low, gap: d.gap }
}

/// Raises `x` to the least solution that is nowhere below it: Bellman–Ford for longest paths.
///
/// A change in the n-th pass, or a level beyond what a simple path can reach, leaves a cycle among the parents
/// (see any text on Bellman–Ford). The second test also keeps the numbers small.
fn raise(differences: &[Difference], x: &mut [i64]) -> Result<()> {
    let limit = farthest(differences, x);
    let mut parent = vec![None; x.len()];
    for pass in 0..=x.len() {
        let mut changed = None;
        for d in differences {
            let (low, high) = (d.low as usize, d.high as usize);
            let least = x[low] + d.gap;
            if x[high] < least {
                x[high] = least;
                parent[high] = Some(d);
                changed = Some(high);
                if least > limit {
                    return Err(contradiction(&parent, high));
                }
            }
        }
        match changed {
            None => return Ok(()),
            Some(at) if pass == x.len() => return Err(contradiction(&parent, at)),
            Some(_) => {}
        }
    }
    Ok(())
}

/// The highest level a simple path can lead to: each variable is entered once, by its greatest gap at most.
fn farthest(differences: &[Difference], x: &[i64]) -> i64 {
    let mut gaps = vec![0_i64; x.len()];
    for d in differences {
        gaps[d.high as usize] = gaps[d.high as usize].max(d.gap);
    }
    let start = x.iter().copied().max().unwrap_or(0);
    gaps.iter().fold(start, |sum, &gap| sum.saturating_add(gap))
}

/// The error that names the cycle among `parent` behind the variable `at`.
fn contradiction(parent: &[Option<&Difference>], at: usize) -> Error {
    let back = |v: usize| parent[v].map_or(v, |d| d.low as usize);
    // After as many steps as there are variables the walk is on the cycle.
    let on_cycle = (0..parent.len()).fold(at, |v, _| back(v));
    let mut cycle = vec![on_cycle];
    let mut v = back(on_cycle);
    while v != on_cycle {
        cycle.push(v);
        v = back(v);
    }
    cycle.reverse();
    let lowest = (0..cycle.len()).min_by_key(|&i| cycle[i]).unwrap_or(0);
    cycle.rotate_left(lowest);
    let excess: i64 = cycle.iter().filter_map(|&v| parent[v]).map(|d| d.gap).sum();
    Error::new(ErrorKind::Infeasible, describe(&cycle, excess)).remedy("remove one of these distances or lower its gap")
}

fn describe(cycle: &[usize], excess: i64) -> String {
    let mut names: Vec<String> = cycle.iter().take(NAMED).map(|v| format!("x{v}")).collect();
    if cycle.len() > NAMED {
        names.push(format!("… ({} in all)", cycle.len()));
    }
    names.push(format!("x{}", cycle[0]));
    format!("distances contradict each other along {}: their gaps add up to {excess}, above 0", names.join(" → "))
}
