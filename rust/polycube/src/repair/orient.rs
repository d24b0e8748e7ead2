//! Cells and faces that are numbered the other way round.

use super::winding::winding;
use super::{Repair, Work};
use crate::measure::tetrahedron_volume;
use crate::mesh::hexahedron::{self, corner_tetrahedra};
use crate::mesh::{Cells, Face, Point};
use crate::structure::{Label, area_vector, cone};

impl Work<'_> {
    /// Mirrors cells of a volume that are numbered left-handed. Neighbours shall see the face between them from
    /// opposite sides, and the larger part of each connected volume shall be positive: a cell that is inverted inside
    /// the map stays so.
    pub(super) fn turn_cells(&mut self) {
        let volumes = volumes(self.points, &self.cells);
        if volumes.iter().all(|volume| *volume >= 0.0) {
            return;
        }
        let (_, turned) = consistent(&Sides::of_cells(&self.cells), &volumes);
        let count = turned.iter().filter(|turned| **turned).count();
        if count == 0 {
            return;
        }
        let cells = match &self.cells {
            Cells::Tetrahedra(c) => Cells::Tetrahedra(mirrored(c, &turned, [1, 0, 2, 3])),
            Cells::Hexahedra(c) => Cells::Hexahedra(mirrored(c, &turned, [4, 5, 6, 7, 0, 1, 2, 3])),
            surface => surface.clone(),
        };
        self.replace(cells, |v| v);
        self.repairs.push(Repair::TurnedCells(count));
    }

    /// Turns faces of a closed surface so that neighbours agree and each part looks out of the solid, and the labels
    /// that went with their faces as they were.
    pub(super) fn turn_faces(&mut self) {
        let Ok(faces) = self.cells.boundary() else { return };
        let sides = Sides::of_faces(&self.cells);
        let (pairs, odd) = sides.pairs();
        if odd > 0 {
            return;
        }
        let cones = cones(self.points, &faces);
        let (parts, mut turned) = consistent(&sides, &cones);
        if pairs.iter().any(|(a, b, opposite)| (turned[*a as usize] == turned[*b as usize]) != *opposite) {
            return;
        }
        self.look_out(&faces, &parts, &cones, &mut turned);
        let count = turned.iter().filter(|turned| **turned).count();
        if count == 0 {
            return;
        }
        self.cells = match &self.cells {
            Cells::Triangles(c) => Cells::Triangles(mirrored(c, &turned, [0, 2, 1])),
            Cells::Quads(c) => Cells::Quads(mirrored(c, &turned, [0, 3, 2, 1])),
            volume => volume.clone(),
        };
        self.repairs.push(Repair::TurnedFaces(count));
        self.turn_labels(&turned);
    }

    /// Turns parts that lie in as many others as they should not: a part in an odd number of them bounds a hole.
    fn look_out(&self, faces: &[Face], parts: &[u32], cones: &[f64], turned: &mut [bool]) {
        let count = parts.iter().max().map_or(0, |p| *p + 1);
        let of = |part: u32| (0..faces.len()).filter(move |&i| parts[i] == part);
        let boxes: Vec<[Point; 2]> = (0..count).map(|part| bounds(self.points, of(part).map(|i| &faces[i]))).collect();
        for part in 0..count {
            let [low, high] = boxes[part as usize];
            let within = |other: &u32| {
                let [from, to] = boxes[*other as usize];
                *other != part && (0..3).all(|a| from[a] < low[a] && high[a] < to[a])
            };
            let volume: f64 = of(part).map(|i| if turned[i] { -cones[i] } else { cones[i] }).sum();
            let at = of(part).next().map_or_else(Point::origin, |i| self.points[faces[i].vertices()[0] as usize]);
            let encloses = |other: &u32| {
                // The faces of one part agree with each other up to the turn.
                let own = of(*other).filter(|&i| !turned[i]).map(|i| &faces[i]);
                let against = of(*other).filter(|&i| turned[i]).map(|i| &faces[i]);
                (winding(self.points, own, &at) - winding(self.points, against, &at)).abs() > 0.5
            };
            let depth = (0..count).filter(within).filter(encloses).count();
            if (volume < 0.0) != (depth % 2 == 1) {
                of(part).for_each(|i| turned[i] = !turned[i]);
            }
        }
    }

    /// Turns the labels of turned faces if they go with how most of those looked before.
    fn turn_labels(&mut self, turned: &[bool]) {
        let (Some(labels), Ok(faces)) = (&mut self.labels, self.cells.boundary()) else { return };
        let own: Vec<usize> = (0..faces.len()).filter(|&i| turned[i] && Label::new(labels[i]).is_some()).collect();
        let against = own.iter().filter(|&&i| {
            let normal = area_vector(self.points, &faces[i]);
            Label::new(labels[i]).is_some_and(|l| normal[l.axis()] * f64::from(l.sign()) < 0.0)
        });
        if 2 * against.count() <= own.len() {
            return;
        }
        for &i in &own {
            labels[i] ^= 1;
        }
        self.repairs.push(Repair::TurnedLabels(own.len()));
    }
}

/// Twice or six times the volume of each cell.
fn volumes(points: &[Point], cells: &Cells) -> Vec<f64> {
    match cells {
        Cells::Tetrahedra(c) => c.iter().map(|t| tetrahedron_volume(points, t)).collect(),
        Cells::Hexahedra(c) => {
            c.iter().map(|h| corner_tetrahedra(h).iter().map(|t| tetrahedron_volume(points, t)).sum()).collect()
        }
        Cells::Triangles(_) | Cells::Quads(_) => Vec::new(),
    }
}

/// The lowest and the highest corner of the box around some faces.
fn bounds<'a>(points: &[Point], faces: impl Iterator<Item = &'a Face>) -> [Point; 2] {
    let empty = [f64::INFINITY, f64::NEG_INFINITY].map(|x| Point::from([x; 3]));
    let all = faces.flat_map(|f| f.vertices()).map(|&v| points[v as usize]);
    all.fold(empty, |[low, high], p| [low.inf(&p), high.sup(&p)])
}

/// Six times the volume of the cone over each face from the middle of all.
fn cones(points: &[Point], faces: &[Face]) -> Vec<f64> {
    let sum: nalgebra::Vector3<f64> = faces.iter().map(|f| f.middle(points).coords).sum();
    let middle = Point::from(sum / faces.len() as f64);
    faces.iter().map(|f| cone(points, f, &middle)).collect()
}

/// A side of an element: its vertices in ascending order, and whether the element passes them that way round.
type Side = ([u32; 4], bool);

/// The sides of elements that have `width` each, one element after the other.
struct Sides {
    all: Vec<Side>,
    width: usize,
    /// Where each side is in `all`, in groups of the same vertices.
    order: Vec<u32>,
}

impl Sides {
    fn new(all: Vec<Side>, width: usize) -> Self {
        let mut order: Vec<u32> = (0..all.len() as u32).collect();
        order.sort_unstable_by_key(|&i| (all[i as usize].0, i));
        Self { all, width, order }
    }

    /// The faces of the cells of a volume.
    fn of_cells(cells: &Cells) -> Self {
        let local: Vec<&[usize]> = match cells {
            Cells::Tetrahedra(_) => vec![&[0, 1, 3], &[1, 2, 3], &[2, 0, 3], &[0, 2, 1]],
            _ => hexahedron::FACES.iter().map(|face| &face[..]).collect(),
        };
        let sides = |i: usize| local.iter().map(move |face| side(face.iter().map(|&k| cells.cell(i)[k])));
        Self::new((0..cells.len()).flat_map(sides).collect(), local.len())
    }

    /// The edges of the faces of a surface.
    fn of_faces(cells: &Cells) -> Self {
        let width = cells.cell(0).len();
        let sides = |i: usize| {
            let v = cells.cell(i);
            (0..width).map(move |k| side([v[k], v[(k + 1) % width]].into_iter()))
        };
        Self::new((0..cells.len()).flat_map(sides).collect(), width)
    }

    /// How many elements there are.
    fn len(&self) -> usize {
        self.all.len() / self.width
    }

    /// Each pair of elements that alone share a side, with whether they pass it in opposite directions; and how many
    /// sides have not two.
    fn pairs(&self) -> (Vec<(u32, u32, bool)>, usize) {
        let (mut pairs, mut odd) = (Vec::with_capacity(self.order.len() / 2), 0);
        for group in self.order.chunk_by(|&a, &b| self.all[a as usize].0 == self.all[b as usize].0) {
            match *group {
                [a, b] => {
                    let [x, y] = [a, b].map(|i| self.all[i as usize].1);
                    pairs.push((a / self.width as u32, b / self.width as u32, x != y));
                }
                _ => odd += 1,
            }
        }
        (pairs, odd)
    }
}

/// A side of two, three or four vertices; those of four are in a ring.
fn side(corners: impl Iterator<Item = u32>) -> Side {
    let mut ring = [u32::MAX; 4];
    let count = ring.iter_mut().zip(corners).map(|(slot, v)| *slot = v).count();
    let start = (0..count).min_by_key(|&k| ring[k]).unwrap_or(0);
    let upwards = match count {
        2 => start == 0,
        n => ring[(start + 1) % n] < ring[(start + n - 1) % n],
    };
    ring.sort_unstable();
    (ring, upwards)
}

/// The connected part of each element, numbered from 0, and which elements must be turned so that neighbours pass their
/// common side in opposite directions and the sum of `volumes` of each part is positive.
fn consistent(sides: &Sides, volumes: &[f64]) -> (Vec<u32>, Vec<bool>) {
    let (pairs, _) = sides.pairs();
    let mut beside = vec![Vec::new(); sides.len()];
    for (a, b, opposite) in pairs {
        beside[a as usize].push((b, opposite));
        beside[b as usize].push((a, opposite));
    }
    let (mut part, mut turned) = (vec![u32::MAX; sides.len()], vec![false; sides.len()]);
    let mut count = 0;
    for seed in 0..sides.len() {
        if part[seed] != u32::MAX {
            continue;
        }
        part[seed] = count;
        let mut own = vec![seed];
        let mut next = 0;
        while let Some(&i) = own.get(next) {
            next += 1;
            for &(other, opposite) in &beside[i] {
                if part[other as usize] == u32::MAX {
                    part[other as usize] = count;
                    turned[other as usize] = turned[i] == opposite;
                    own.push(other as usize);
                }
            }
        }
        let volume: f64 = own.iter().map(|&i| if turned[i] { -volumes[i] } else { volumes[i] }).sum();
        if volume < 0.0 {
            own.iter().for_each(|&i| turned[i] = !turned[i]);
        }
        count += 1;
    }
    (part, turned)
}

fn mirrored<const N: usize>(cells: &[[u32; N]], turned: &[bool], order: [usize; N]) -> Vec<[u32; N]> {
    let turn = |(cell, turned): (&[u32; N], &bool)| if *turned { order.map(|k| cell[k]) } else { *cell };
    cells.iter().zip(turned).map(turn).collect()
}
