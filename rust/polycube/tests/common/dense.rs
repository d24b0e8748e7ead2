//! Whether levels make a valid polycube, decided cell by cell on the lattice and by nothing that the library uses.

use polycube::structure::{Facet, Structure};
use std::collections::{BTreeMap, BTreeSet};

/// A face of the surface: the facet it belongs to, or none.
type Sheet = Option<u32>;

/// The lattice spanned by the distinct levels, with one empty layer around: vertex `r` of an axis has cell `r − 1`
/// below and cell `r` above it.
struct Lattice<'a> {
    structure: &'a Structure,
    /// The lattice plane of every level, from 1.
    rank: Vec<usize>,
    size: [usize; 3],
    /// The facet on the lower face of every cell along each axis.
    sheets: [Vec<Sheet>; 3],
    solid: Vec<bool>,
}

/// Checks that the surface of `structure`, with its levels at `levels`, bounds a solid: every facet is covered once
/// and from outside, no two facets share a face, every cell is inside 0 times or once, the surface is manifold around
/// every lattice vertex, and facets, their neighbours, corners, components and Euler number are those of `structure`.
pub fn check(structure: &Structure, levels: &[i64]) -> Result<(), String> {
    let mut lattice = Lattice::new(structure, levels);
    for (i, facet) in (0..).zip(&structure.facets) {
        lattice.cover(i, facet)?;
    }
    lattice.fill()?;
    lattice.check_vertices()?;
    lattice.check_facets()?;
    lattice.check_topology()
}

impl<'a> Lattice<'a> {
    fn new(structure: &'a Structure, levels: &[i64]) -> Self {
        let mut size = [0; 3];
        let mut rank = vec![0; levels.len()];
        for (axis, size) in size.iter_mut().enumerate() {
            let own = || (0..levels.len()).filter(|&l| structure.levels[l].axis == axis);
            let planes: Vec<i64> = own().map(|l| levels[l]).collect::<BTreeSet<_>>().into_iter().collect();
            own().for_each(|l| rank[l] = 1 + planes.iter().position(|&p| p == levels[l]).unwrap_or(0));
            *size = planes.len() + 2;
        }
        let cells = size.iter().product();
        let sheets = [(); 3].map(|()| vec![None; cells]);
        Self { structure, rank, size, sheets, solid: vec![false; cells] }
    }

    fn index(&self, at: [usize; 3]) -> usize {
        at[0] + self.size[0] * (at[1] + self.size[1] * at[2])
    }

    fn stride(&self, axis: usize) -> usize {
        self.size[..axis].iter().product()
    }

    /// All positions but those on the upper border of the lattice.
    fn positions(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let [nx, ny, nz] = self.size.map(|n| n - 1);
        (1..nz).flat_map(move |z| (1..ny).flat_map(move |y| (1..nx).map(move |x| [x, y, z])))
    }

    /// Puts a facet on the lattice faces that its loops wind around.
    fn cover(&mut self, number: u32, facet: &Facet) -> Result<(), String> {
        let axis = facet.label.axis();
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut change = vec![vec![0_i32; self.size[u]]; self.size[v]];
        for side in facet.sides() {
            let edge = &self.structure.edges[side.edge as usize];
            if edge.axis == v {
                let [from, to] =
                    edge.corners.map(|c| self.structure.corners[c as usize].levels.map(|l| self.rank[l as usize]));
                let up = if side.forward == (from[v] < to[v]) { 1 } else { -1 };
                (from[v].min(to[v])..from[v].max(to[v])).for_each(|j| change[j][from[u]] += up);
            }
        }
        let mut covered = 0;
        for (j, row) in change.iter().enumerate() {
            // A facet that looks up runs counter-clockwise in (u, v): down on its left, up on its right.
            let mut winding = 0;
            for (i, change) in row.iter().enumerate() {
                winding -= change * i32::from(facet.label.sign());
                match winding {
                    0 => continue,
                    1 => covered += 1,
                    _ => return Err(format!("facet {number} winds {winding} times around a face")),
                }
                let mut at = [self.rank[facet.level as usize]; 3];
                (at[u], at[v]) = (i, j);
                let at = self.index(at);
                if let Some(other) = self.sheets[axis][at].replace(number) {
                    return Err(format!("facets {other} and {number} share a face"));
                }
            }
        }
        if covered == 0 { Err(format!("facet {number} is empty")) } else { Ok(()) }
    }

    fn sign(&self, facet: u32) -> i32 {
        i32::from(self.structure.facets[facet as usize].label.sign())
    }

    /// Sums windings along X, then compares every pair of neighbouring cells with the facet between them.
    fn fill(&mut self) -> Result<(), String> {
        let mut winding = 0;
        for cell in 0..self.solid.len() {
            winding -= self.sheets[0][cell].map_or(0, |f| self.sign(f));
            self.solid[cell] = match winding {
                0 => false,
                1 => true,
                _ => return Err(format!("a cell is inside {winding} times")),
            };
        }
        for axis in 0..3 {
            for cell in self.positions().map(|at| self.index(at)) {
                let step = i32::from(self.solid[cell - self.stride(axis)]) - i32::from(self.solid[cell]);
                if step != self.sheets[axis][cell].map_or(0, |f| self.sign(f)) {
                    return Err("a facet does not lie between inside and outside".into());
                }
            }
        }
        Ok(())
    }

    /// The cells around a lattice vertex, as bits.
    fn octants(&self, vertex: usize) -> u8 {
        let cell = |o: usize| (0..3).filter(|a| o >> a & 1 == 0).fold(vertex, |c, a| c - self.stride(a));
        (0..8).filter(|&o| self.solid[cell(o)]).fold(0, |bits, o| bits | 1 << o)
    }

    fn check_vertices(&self) -> Result<(), String> {
        let expected: BTreeSet<usize> =
            self.structure.corners.iter().map(|c| self.index(c.levels.map(|l| self.rank[l as usize]))).collect();
        let mut corners = BTreeSet::new();
        for vertex in self.positions().map(|at| self.index(at)) {
            let octants = self.octants(vertex);
            if !connected(octants) || !connected(!octants) {
                return Err("the surface touches itself at a vertex or along an edge".into());
            }
            let differs = |a: usize| (0..8).any(|o: usize| (octants >> o ^ octants >> (o ^ (1 << a))) & 1 == 1);
            if (0..3).all(differs) {
                corners.insert(vertex);
            }
        }
        let same = corners == expected && corners.len() == self.structure.corners.len();
        if same { Ok(()) } else { Err("the corners are not those of the structure".into()) }
    }

    /// The two faces of the surface at a lattice edge, if it lies on the surface; the surface must be manifold.
    fn faces_at(&self, edge: usize, axis: usize) -> Vec<(usize, usize)> {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let around = [(u, edge), (u, edge - self.stride(v)), (v, edge), (v, edge - self.stride(u))];
        around.into_iter().filter(|&(a, cell)| self.sheets[a][cell].is_some()).collect()
    }

    /// Every pair of faces with a common lattice edge.
    fn neighbours(&self) -> Vec<[(usize, usize); 2]> {
        let edges = (0..3).flat_map(|axis| self.positions().map(move |at| (at, axis)));
        edges.filter_map(|(at, axis)| <[_; 2]>::try_from(self.faces_at(self.index(at), axis)).ok()).collect()
    }

    /// Facets must be connected, unlike their neighbours, and next to the same facets as in the structure.
    fn check_facets(&self) -> Result<(), String> {
        let expected: BTreeSet<[u32; 2]> = self.structure.edges.iter().map(|e| sorted(e.facets)).collect();
        let mut found = BTreeSet::new();
        let mut inside = Vec::new();
        for pair in self.neighbours() {
            let [a, b] = pair.map(|(axis, cell)| self.sheets[axis][cell].unwrap_or(u32::MAX));
            if a == b {
                inside.push(pair);
            } else {
                found.insert(sorted([a, b]));
            }
        }
        if found != expected {
            return Err("the facets have other neighbours than in the structure".into());
        }
        let parts = self.components(&inside);
        let count = self.structure.facets.len();
        if parts == count { Ok(()) } else { Err(format!("{count} facets lie in {parts} parts")) }
    }

    /// Connected sets of surface faces.
    fn components(&self, pairs: &[[(usize, usize); 2]]) -> usize {
        let mut beside: BTreeMap<(usize, usize), Vec<(usize, usize)>> = BTreeMap::new();
        for axis in 0..3 {
            let faces = (0..self.solid.len()).filter(|&c| self.sheets[axis][c].is_some());
            beside.extend(faces.map(|c| ((axis, c), Vec::new())));
        }
        for &[a, b] in pairs {
            beside.entry(a).or_default().push(b);
            beside.entry(b).or_default().push(a);
        }
        let mut left: BTreeSet<_> = beside.keys().copied().collect();
        let mut count = 0;
        while let Some(seed) = left.pop_first() {
            count += 1;
            let mut stack = vec![seed];
            while let Some(face) = stack.pop() {
                stack.extend(beside[&face].iter().filter(|f| left.remove(f)));
            }
        }
        count
    }

    fn check_topology(&self) -> Result<(), String> {
        let pairs = self.neighbours();
        let parts = self.components(&pairs);
        let expected = self.structure.components().iter().max().map_or(0, |c| *c as usize + 1);
        if parts != expected {
            return Err(format!("{expected} components became {parts}"));
        }
        let faces: usize = self.sheets.iter().map(|s| s.iter().flatten().count()).sum();
        let vertices = self.positions().filter(|&at| !matches!(self.octants(self.index(at)), 0 | 255)).count();
        let euler = vertices as i64 - pairs.len() as i64 + faces as i64;
        let expected = euler_number(self.structure);
        if euler == expected { Ok(()) } else { Err(format!("the Euler number {expected} became {euler}")) }
    }
}

/// The Euler number of the surface from corners, edges and facets.
pub fn euler_number(structure: &Structure) -> i64 {
    let facets: i64 = structure.facets.iter().map(|f| 2 - f.loops.len() as i64).sum();
    structure.corners.len() as i64 - structure.edges.len() as i64 + facets
}

/// Whether octants are connected through their faces.
fn connected(octants: u8) -> bool {
    let mut reached = octants & octants.wrapping_neg();
    for _ in 0..8 {
        for o in (0..8).filter(|o| octants >> o & 1 == 1) {
            if (0..3).any(|a| reached >> (o ^ (1 << a)) & 1 == 1) {
                reached |= 1 << o;
            }
        }
    }
    reached == octants
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
