//! Guides turned into conditions on the levels of one structure.

use super::mirror::images;
use super::reflect::Mirror;
use super::{Guides, Symmetry};
use crate::align::chain::{Plane, chain};
use crate::align::classes::Classes;
use crate::align::problem::Difference;
use crate::align::ranks::Ranks;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::structure::{Placement, Structure};

/// What guides ask of the levels of a structure at one scale.
pub(crate) struct Guided {
    axis_of: Vec<usize>,
    /// Levels that must be equal.
    classes: Classes,
    /// For each level the others that must be equal to it.
    pub partners: Vec<Vec<u32>>,
    /// Pairs of levels that must differ.
    apart: Vec<[u32; 2]>,
    /// Where on the lattice a level must lie.
    fixed: Vec<Option<i64>>,
    /// Along each axis, the mirror.
    pub mirrors: [Option<Mirror>; 3],
    any: bool,
}

/// For each of the `levels` the others of its class, ascending.
fn partners(classes: &Classes, levels: usize) -> Vec<Vec<u32>> {
    let mut members = vec![Vec::new(); levels];
    (0..levels as u32).for_each(|l| members[classes.of(l) as usize].push(l));
    let others = |l: u32| members[classes.of(l) as usize].iter().copied().filter(|&m| m != l).collect();
    (0..levels as u32).map(others).collect()
}

impl Guided {
    /// No guides.
    pub(crate) fn free(structure: &Structure) -> Self {
        let levels = structure.levels.len();
        Self {
            axis_of: structure.levels.iter().map(|l| l.axis).collect(),
            classes: Classes::new(levels),
            partners: vec![Vec::new(); levels],
            apart: Vec::new(),
            fixed: vec![None; levels],
            mirrors: [None, None, None],
            any: false,
        }
    }

    /// The conditions of `guides` on the levels of a polycube that lies at `input`, for a lattice with `scale` steps
    /// per unit.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for a facet that does not exist, for facets of different axes, and where guides contradict
    /// each other or the edges of the polycube. [`ErrorKind::Infeasible`] where facets that mirror each other do not
    /// once they are rounded.
    pub(crate) fn new(structure: &Structure, input: &[f64], guides: &Guides, scale: f64) -> Result<Self> {
        debug_assert!(guides.fixed_faces.is_empty() && guides.fixed_labels.is_empty(), "see `Guides::by_facets`");
        Self::conditions(structure, input, guides, scale).map_err(|e| e.in_option("guides"))
    }

    fn conditions(structure: &Structure, input: &[f64], guides: &Guides, scale: f64) -> Result<Self> {
        let mut guided = Self { any: !guides.is_empty(), ..Self::free(structure) };
        guides.together.iter().try_for_each(|group| guided.join(structure, group))?;
        guides.symmetry.iter().try_for_each(|plane| guided.mirror(structure, input, plane, scale))?;
        guided.close_under_mirrors();
        for &facet in &guides.fixed {
            let level = level_of(structure, facet)?;
            guided.fixed[level as usize] = Some((input[level as usize] * scale).round() as i64);
        }
        for pair in &guides.apart {
            guided.apart.push(guided.part(structure, *pair)?);
        }
        guided.check_edges(structure)?;
        guided.check_fixed(structure)?;
        guided.partners = partners(&guided.classes, structure.levels.len());
        guided.hold_mirrors(structure)?;
        Ok(guided)
    }

    /// Whether nothing is asked for.
    pub(crate) fn is_free(&self) -> bool {
        !self.any
    }

    /// The levels that must be equal, as classes.
    pub(crate) fn classes(&self) -> &Classes {
        &self.classes
    }

    /// Pairs of levels that must differ.
    pub(crate) fn apart(&self) -> &[[u32; 2]] {
        &self.apart
    }

    /// The lattice coordinates at which the levels must lie.
    pub(crate) fn fixed(&self) -> impl Iterator<Item = (u32, i64)> + '_ {
        (0..).zip(&self.fixed).filter_map(|(l, at)| at.map(|at| (l, at)))
    }

    /// Whether an order respects all guides and leaves room for its planes between those that are fixed.
    pub(crate) fn allows(&self, ranks: &Ranks) -> bool {
        !self.any || self.missing(ranks) == 0
    }

    /// By how many planes, about, an order misses what is asked for; 0 if it misses nothing.
    pub(crate) fn missing(&self, ranks: &Ranks) -> usize {
        let rank = |l: u32| usize::from(ranks.of_level[l as usize]);
        let unequal =
            (0..ranks.of_level.len() as u32).map(|l| rank(l).abs_diff(rank(self.classes.of(l)))).sum::<usize>();
        let equal = self.apart.iter().filter(|[a, b]| rank(*a) == rank(*b)).count();
        let crowded = (0..3).filter(|&axis| !self.has_room(ranks, axis)).count();
        unequal + equal + crowded + (0..3).map(|axis| self.skewed(ranks, axis)).sum::<usize>()
    }

    fn skewed(&self, ranks: &Ranks, axis: usize) -> usize {
        let Some(mirror) = &self.mirrors[axis] else { return 0 };
        let rank = |l: u32| usize::from(ranks.of_level[l as usize]);
        let own = (0..).zip(&self.axis_of).filter(|(_, a)| **a == axis);
        own.map(|(l, _): (u32, _)| (rank(l) + rank(mirror.image[l as usize])).abs_diff(ranks.planes[axis] + 1)).sum()
    }

    fn has_room(&self, ranks: &Ranks, axis: usize) -> bool {
        let nothing_fixed = self.fixed.iter().zip(&self.axis_of).all(|(f, a)| *a != axis || f.is_none());
        if nothing_fixed {
            return true;
        }
        let mut planes = vec![Plane { weight: 1, moment: 0, fixed: None }; ranks.planes[axis]];
        self.pin(ranks, axis, &mut planes) && self.place(axis, &planes).is_some()
    }

    /// Fixes planes that hold fixed levels; `false` if one holds two that are fixed at different places.
    pub(crate) fn pin(&self, ranks: &Ranks, axis: usize, planes: &mut [Plane]) -> bool {
        let own = self.fixed().filter(|(l, _)| self.axis_of[*l as usize] == axis);
        own.fold(true, |fits, (l, at)| {
            let plane = &mut planes[usize::from(ranks.of_level[l as usize]) - 1];
            *plane.fixed.get_or_insert(at) == at && fits
        })
    }

    /// The lattice coordinates of the planes along an axis nearest to their targets, mirrored where that is asked for;
    /// nothing if there is no room between fixed ones.
    pub(crate) fn place(&self, axis: usize, planes: &[Plane]) -> Option<Vec<i64>> {
        match &self.mirrors[axis] {
            None => chain(planes, None),
            Some(mirror) => mirror.place(planes),
        }
    }

    /// Distances that keep apart what must differ, and fixed levels as they lie to each other, as seen in `placement`.
    pub(crate) fn differences(&self, placement: &[f64]) -> Vec<Difference> {
        let at = |l: u32| placement[l as usize];
        let apart = self.apart.iter().map(|&[a, b]| if at(a) < at(b) { (a, b) } else { (b, a) });
        let mut found: Vec<Difference> = apart.map(|(low, high)| Difference { low, high, gap: 1 }).collect();
        for axis in 0..3 {
            let mut own: Vec<u32> = self.fixed().map(|f| f.0).filter(|l| self.axis_of[*l as usize] == axis).collect();
            own.sort_by(|&l, &m| at(l).total_cmp(&at(m)));
            for pair in own.windows(2) {
                let gap = (at(pair[1]).round() - at(pair[0]).round()) as i64;
                found.push(Difference { low: pair[0], high: pair[1], gap });
                found.push(Difference { low: pair[1], high: pair[0], gap: -gap });
            }
        }
        found
    }

    /// `placement` with levels that must be equal at their mean, and mirrored levels moved half way to their images.
    pub(crate) fn averaged(&self, structure: &Structure, placement: &[f64]) -> Placement {
        let mut sums = vec![(0.0, 0.0); placement.len()];
        for (l, (level, x)) in (0..).zip(structure.levels.iter().zip(placement)) {
            let sum: &mut (f64, f64) = &mut sums[self.classes.of(l) as usize];
            *sum = (sum.0 + f64::from(level.corners) * x, sum.1 + f64::from(level.corners));
        }
        // A class of one keeps its coordinate to the last bit.
        let alone = |l: u32| self.partners[l as usize].is_empty();
        let mean = |l: u32| sums[self.classes.of(l) as usize].0 / sums[self.classes.of(l) as usize].1;
        let mut averaged: Placement = (0..).zip(placement).map(|(l, &x)| if alone(l) { x } else { mean(l) }).collect();
        for mirror in self.mirrors.iter().flatten() {
            mirror.average(&mut averaged);
        }
        averaged
    }

    /// Every level rounded to the lattice by itself, classes as one, mirrored levels as one of the two.
    ///
    /// # Errors
    /// [`ErrorKind::Infeasible`] if levels that must differ do not.
    pub(crate) fn rounded(&self, structure: &Structure, targets: &[f64]) -> Result<Vec<i64>> {
        let averaged = self.averaged(structure, targets);
        let mut levels: Vec<i64> = averaged.iter().map(|x| x.round() as i64).collect();
        (0..).zip(&mut levels).for_each(|(l, x)| *x = self.held(l).unwrap_or(*x));
        for mirror in self.mirrors.iter().flatten() {
            mirror.reflect(&mut levels, |l| self.held(l).is_some());
        }
        match self.apart.iter().find(|[a, b]| levels[*a as usize] == levels[*b as usize]) {
            None => Ok(levels),
            Some([a, _]) => {
                Err(Error::new(ErrorKind::Infeasible, "rounding brings it together with what must be apart")
                    .at(Place::Facet(structure.facets.iter().position(|f| f.level == *a).unwrap_or(0) as u32))
                    .remedy("use a larger scale or another strategy"))
            }
        }
    }

    /// Where a level must lie because it, or one that must be equal to it, is fixed.
    fn held(&self, level: u32) -> Option<i64> {
        let own = std::iter::once(&level).chain(&self.partners[level as usize]);
        own.filter_map(|&l| self.fixed[l as usize]).next()
    }

    fn join(&mut self, structure: &Structure, group: &[usize]) -> Result<()> {
        let levels: Vec<u32> = group.iter().map(|&f| level_of(structure, f)).collect::<Result<_>>()?;
        for (pair, facets) in levels.windows(2).zip(group.windows(2)) {
            same_axis(structure, [facets[0], facets[1]])?;
            self.classes.join(pair[0], pair[1]);
        }
        Ok(())
    }

    fn mirror(&mut self, structure: &Structure, input: &[f64], plane: &Symmetry, scale: f64) -> Result<()> {
        let mut image = images(structure, input, plane)?;
        for (l, other) in (0..).zip(&mut image) {
            if self.axis_of[l as usize] != plane.axis {
                self.classes.join(l, *other);
                *other = l;
            }
        }
        match &self.mirrors[plane.axis] {
            Some(known) if known.image != image => {
                let message = format!("two planes of symmetry across the axis {}", ["X", "Y", "Z"][plane.axis]);
                Err(Error::new(ErrorKind::Option, message).remedy("give one plane for an axis"))
            }
            _ => {
                self.mirrors[plane.axis] = Some(Mirror::new(image, plane.at * scale));
                Ok(())
            }
        }
    }

    /// Where two levels are one, so are their images.
    fn close_under_mirrors(&mut self) {
        loop {
            let mut changed = false;
            for mirror in self.mirrors.iter().flatten() {
                for l in 0..mirror.image.len() as u32 {
                    let other = self.classes.of(l);
                    changed |= self.classes.join(mirror.image[l as usize], mirror.image[other as usize]);
                }
            }
            if !changed {
                return;
            }
        }
    }

    fn part(&self, structure: &Structure, facets: [usize; 2]) -> Result<[u32; 2]> {
        let [a, b] = [level_of(structure, facets[0])?, level_of(structure, facets[1])?];
        same_axis(structure, facets)?;
        if self.classes.of(a) == self.classes.of(b) {
            let message = format!("must be apart from facet {}, and must be in one plane with it", facets[1]);
            return Err(Error::new(ErrorKind::Option, message)
                .at(Place::Facet(facets[0] as u32))
                .remedy("take one of the two out; facets that share a corner are always in one plane"));
        }
        Ok([a, b])
    }

    /// No chain of edges may lead from a plane back to itself.
    fn check_edges(&self, structure: &Structure) -> Result<()> {
        let mut above: Vec<Vec<u32>> = vec![Vec::new(); self.axis_of.len()];
        let mut entering = vec![0; self.axis_of.len()];
        for [low, high] in structure.edges.iter().map(|e| structure.ends(e).map(|l| self.classes.of(l))) {
            above[low as usize].push(high);
            entering[high as usize] += 1;
        }
        let mut ready: Vec<u32> = (0..).zip(&entering).filter(|(_, n)| **n == 0).map(|(l, _)| l).collect();
        while let Some(l) = ready.pop() {
            for &up in &above[l as usize] {
                entering[up as usize] -= 1;
                if entering[up as usize] == 0 {
                    ready.push(up);
                }
            }
        }
        let stuck = (0..)
            .zip(&entering)
            .find(|(l, n)| **n > 0 && (0..).zip(&self.axis_of).any(|(m, _)| m != *l && self.classes.of(m) == *l));
        let Some((level, _)): Option<(u32, _)> = stuck else { return Ok(()) };
        let facet = (0..).zip(&structure.facets).find(|(_, f)| self.classes.of(f.level) == level).map_or(0, |(f, _)| f);
        Err(Error::new(ErrorKind::Option, "cannot lie in one plane with the facets asked for: edges keep them apart")
            .at(Place::Facet(facet))
            .remedy("take it out of \"together\""))
    }

    /// Fixed facets of one plane must be fixed at one place.
    fn check_fixed(&self, structure: &Structure) -> Result<()> {
        let mut at: Vec<Option<(u32, i64)>> = vec![None; self.axis_of.len()];
        for (level, place) in self.fixed() {
            let (first, other) = *at[self.classes.of(level) as usize].get_or_insert((level, place));
            if other != place {
                let facet = |l: u32| structure.facets.iter().position(|f| f.level == l).unwrap_or(0);
                let message = format!("must not move, and must be in one plane with facet {} elsewhere", facet(first));
                return Err(Error::new(ErrorKind::Option, message)
                    .at(Place::Facet(facet(level) as u32))
                    .remedy("fix one of them only"));
            }
        }
        Ok(())
    }

    /// Fixed facets that mirror each other say where the plane of symmetry lies on the lattice: half way between them.
    fn hold_mirrors(&mut self, structure: &Structure) -> Result<()> {
        let held: Vec<Option<i64>> = (0..self.axis_of.len() as u32).map(|l| self.held(l)).collect();
        let fixed: Vec<(u32, i64)> = self.fixed().collect();
        for (axis, mirror) in self.mirrors.iter_mut().enumerate() {
            let Some(mirror) = mirror else { continue };
            let own = (0..).zip(&self.axis_of).filter(|(_, a)| **a == axis).map(|(l, _)| l);
            mirror.centred = own.filter(|&l| self.classes.of(l) == self.classes.of(mirror.image[l as usize])).collect();
            for &(level, place) in fixed.iter().filter(|(l, _)| self.axis_of[*l as usize] == axis) {
                let image = mirror.image[level as usize];
                if held[image as usize].is_some_and(|other| !mirror.hold(place + other)) {
                    return Err(no_mirror(structure, axis, level, image));
                }
            }
        }
        Ok(())
    }
}

fn level_of(structure: &Structure, facet: usize) -> Result<u32> {
    structure.facets.get(facet).map(|f| f.level).ok_or_else(|| {
        let last = structure.facets.len().saturating_sub(1);
        Error::new(ErrorKind::Option, "the guides name this facet, which does not exist")
            .at(Place::Facet(u32::try_from(facet).unwrap_or(u32::MAX)))
            .remedy(format!("name facets from 0 to {last}, as in structure.json"))
    })
}

fn same_axis(structure: &Structure, facets: [usize; 2]) -> Result<()> {
    let [a, b] = facets.map(|f| structure.facets[f].label.axis());
    if a == b {
        return Ok(());
    }
    let message = format!("looks along another axis than facet {}: they are never in one plane", facets[0]);
    Err(Error::new(ErrorKind::Option, message)
        .at(Place::Facet(facets[1] as u32))
        .remedy("name facets that look along one axis"))
}

fn no_mirror(structure: &Structure, axis: usize, level: u32, image: u32) -> Error {
    let facet = |l: u32| structure.facets.iter().position(|f| f.level == l).unwrap_or(0);
    let axis = ["X", "Y", "Z"][axis];
    let message = format!(
        "does not mirror facet {} across {axis} if the fixed facets stay where they are on this lattice",
        facet(image)
    );
    Error::new(ErrorKind::Infeasible, message)
        .at(Place::Facet(facet(level) as u32))
        .remedy("fix one of the two only, or choose a scale at which the plane of symmetry lies on the lattice")
}
