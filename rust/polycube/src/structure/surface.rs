//! Which boundary face lies beside which: half-edges over triangles and quadrilaterals.

use super::label::cone;
use super::violation::Violation;
use crate::mesh::{Face, Point};

/// A side of a face, numbered `4 * face + side`; it runs from vertex `side` of the face to the next one.
pub(crate) type HalfEdge = u32;

const NONE: u32 = u32::MAX;

/// A closed, oriented, manifold surface: the faces and the half-edge opposite to each half-edge.
#[derive(Clone, Debug)]
pub struct Surface {
    faces: Vec<Face>,
    twins: Vec<HalfEdge>,
    /// One half-edge out of each vertex, [`NONE`] for vertices off the surface.
    outgoing: Vec<HalfEdge>,
}

impl Surface {
    /// Links `faces`, which name none but the first `vertices` vertices, or lists everything that is not closed,
    /// oriented and manifold.
    ///
    /// O(n) for n faces and vertices.
    pub(crate) fn new(faces: Vec<Face>, vertices: usize) -> Result<Self, Vec<Violation>> {
        let bad = bad_faces(&faces);
        if faces.is_empty() {
            return Err(vec![Violation::Empty]);
        }
        if !bad.is_empty() {
            return Err(bad);
        }
        let mut surface = Self { twins: vec![NONE; 4 * faces.len()], outgoing: vec![NONE; vertices], faces };
        let violations = surface.link();
        if !violations.is_empty() {
            return Err(violations);
        }
        let violations = surface.start_fans();
        if violations.is_empty() { Ok(surface) } else { Err(violations) }
    }

    /// Number of vertices of the mesh, on the surface or not.
    pub fn vertex_count(&self) -> usize {
        self.outgoing.len()
    }

    /// Six times the volume that it encloses; negative where it looks inward. O(n) for n faces.
    pub(crate) fn volume(&self, points: &[Point]) -> f64 {
        let Some(first) = self.faces.first().map(|f| f.middle(points)) else { return 0.0 };
        self.faces.iter().map(|f| cone(points, f, &first)).sum()
    }

    /// The faces, as given.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// All half-edges, face by face.
    pub fn half_edges(&self) -> impl Iterator<Item = HalfEdge> + '_ {
        let sides = |(i, f): (usize, &Face)| (0..f.vertices().len()).map(move |k| (4 * i + k) as HalfEdge);
        self.faces.iter().enumerate().flat_map(sides)
    }

    /// The face that `h` is a side of.
    pub fn face(&self, h: HalfEdge) -> usize {
        h as usize / 4
    }

    /// The half-edge on the other side.
    pub fn twin(&self, h: HalfEdge) -> HalfEdge {
        self.twins[h as usize]
    }

    /// The next side of the same face.
    pub fn next(&self, h: HalfEdge) -> HalfEdge {
        let sides = self.faces[self.face(h)].vertices().len() as u32;
        if h % 4 + 1 == sides { h + 1 - sides } else { h + 1 }
    }

    /// The side before `h` in the same face.
    pub fn previous(&self, h: HalfEdge) -> HalfEdge {
        let sides = self.faces[self.face(h)].vertices().len() as u32;
        if h.is_multiple_of(4) { h + sides - 1 } else { h - 1 }
    }

    /// The vertex that `h` starts from.
    pub fn start(&self, h: HalfEdge) -> u32 {
        self.faces[self.face(h)].vertices()[h as usize % 4]
    }

    /// The vertex that `h` ends at.
    pub fn end(&self, h: HalfEdge) -> u32 {
        self.start(self.next(h))
    }

    /// The half-edges that leave `vertex`, counter-clockwise seen from outside; none for a vertex off the surface.
    pub fn fan(&self, vertex: u32) -> impl Iterator<Item = HalfEdge> + '_ {
        let first = self.outgoing[vertex as usize];
        let turn = move |&h: &HalfEdge| Some(self.twin(self.previous(h))).filter(|&h| h != first);
        std::iter::successors(Some(first).filter(|&h| h != NONE), turn)
    }

    /// Calls `visit` with every half-edge and the vertices it runs from and to, face by face.
    fn each_side(&self, mut visit: impl FnMut(HalfEdge, u32, u32)) {
        for (first, face) in (0..).step_by(4).zip(&self.faces) {
            let vertices = face.vertices();
            let mut from = vertices[0];
            for (h, &to) in (first..).zip(&vertices[1..]) {
                visit(h, from, to);
                from = to;
            }
            visit(first + vertices.len() as u32 - 1, from, vertices[0]);
        }
    }

    /// Pairs up half-edges over one mesh edge.
    fn link(&mut self) -> Vec<Violation> {
        let mut violations = Vec::new();
        let mut twins = std::mem::take(&mut self.twins);
        for group in self.by_ends().chunk_by(|a, b| a.ends == b.ends) {
            let edge = group[0].ends;
            match *group {
                [Spoke { half_edge: a, .. }, Spoke { half_edge: b, .. }] if self.start(a) != self.start(b) => {
                    twins[a as usize] = b;
                    twins[b as usize] = a;
                }
                [_] => violations.push(Violation::OpenEdge { edge }),
                [_, _] => violations.push(Violation::InconsistentOrientation { edge }),
                _ => violations.push(Violation::NonManifoldEdge { edge }),
            }
        }
        self.twins = twins;
        violations
    }

    /// All half-edges by the mesh edges that they run over, then face by face. O(n): sorted by one end after the other.
    fn by_ends(&self) -> Vec<Spoke> {
        let mut spokes = Vec::with_capacity(4 * self.faces.len());
        self.each_side(|half_edge, from, to| spokes.push(Spoke { ends: [from.min(to), from.max(to)], half_edge }));
        for end in [1, 0] {
            spokes = by_end(&spokes, end, self.outgoing.len());
        }
        spokes
    }

    /// Finds a half-edge out of each vertex and the vertices with more than one fan.
    fn start_fans(&mut self) -> Vec<Violation> {
        let mut valence = vec![0_u32; self.outgoing.len()];
        let mut outgoing = std::mem::take(&mut self.outgoing);
        self.each_side(|h, from, _| {
            valence[from as usize] += 1;
            outgoing[from as usize] = outgoing[from as usize].min(h);
        });
        self.outgoing = outgoing;
        let several = |&v: &u32| self.fan(v).count() < valence[v as usize] as usize;
        let vertices = 0..valence.len() as u32;
        vertices.filter(several).map(|vertex| Violation::NonManifoldVertex { vertex }).collect()
    }
}

/// A half-edge with the lower and the higher of its two vertices.
#[derive(Clone, Copy)]
struct Spoke {
    ends: [u32; 2],
    half_edge: HalfEdge,
}

/// The spokes by their lower (0) or higher (1) end, in the order in which they come where that is the same.
fn by_end(spokes: &[Spoke], end: usize, vertices: usize) -> Vec<Spoke> {
    let mut free = vec![0; vertices + 1];
    spokes.iter().for_each(|s| free[s.ends[end] as usize + 1] += 1);
    for v in 1..free.len() {
        free[v] += free[v - 1];
    }
    let mut sorted = spokes.to_vec();
    for spoke in spokes {
        let place = &mut free[spoke.ends[end] as usize];
        sorted[*place] = *spoke;
        *place += 1;
    }
    sorted
}

fn bad_faces(faces: &[Face]) -> Vec<Violation> {
    let repeats = |f: &Face| match *f {
        Face::Triangle([a, b, c]) => a == b || b == c || c == a,
        Face::Quad([a, b, c, d]) => a == b || b == c || c == d || d == a || a == c || b == d,
    };
    let numbered = (0..).zip(faces);
    numbered.filter(|(_, f)| repeats(f)).map(|(face, _)| Violation::BadFace { face }).collect()
}
