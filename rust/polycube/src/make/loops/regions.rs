//! What loops leave of a surface.

use super::NONE;
use super::cut_mesh::CutMesh;

/// The connected parts of a surface between loops.
pub(super) struct Regions {
    /// The region of each triangle.
    pub(super) of: Vec<u32>,
    /// The Euler number of each region: 1 for a disc.
    pub(super) euler: Vec<i32>,
}

impl Regions {
    /// Those that the living cuts leave. Linear in the triangles.
    pub(super) fn new(mesh: &CutMesh, alive: &[bool]) -> Self {
        let wall = |t: usize, k: usize| {
            let cut = mesh.triangles[t].cut[k];
            cut != NONE && alive[cut as usize]
        };
        let (of, count) = flood(mesh, wall);
        let euler = euler_numbers(mesh, wall, &of, count);
        Self { of, euler }
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.euler.len()
    }
}

fn flood(mesh: &CutMesh, wall: impl Fn(usize, usize) -> bool) -> (Vec<u32>, usize) {
    let mut of = vec![NONE; mesh.triangles.len()];
    let mut count = 0;
    let mut stack = Vec::new();
    for seed in 0..of.len() {
        if of[seed] != NONE {
            continue;
        }
        of[seed] = count;
        stack.push(seed);
        while let Some(t) = stack.pop() {
            for k in (0..3).filter(|&k| !wall(t, k)) {
                let other = mesh.twins[t][k] as usize;
                if of[other] == NONE {
                    of[other] = count;
                    stack.push(other);
                }
            }
        }
        count += 1;
    }
    (of, count as usize)
}

/// Triangles less inner sides plus inner vertices: the border of a region has as many sides as vertices.
fn euler_numbers(mesh: &CutMesh, wall: impl Fn(usize, usize) -> bool, of: &[u32], count: usize) -> Vec<i32> {
    let mut twice = vec![0; count];
    let mut on_wall = vec![false; mesh.points.len()];
    let mut owner = vec![NONE; mesh.points.len()];
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        twice[of[t] as usize] += 2;
        for k in 0..3 {
            let [from, to] = [k, (k + 1) % 3].map(|k| triangle.vertices[k] as usize);
            owner[from] = of[t];
            if wall(t, k) {
                on_wall[from] = true;
                on_wall[to] = true;
            } else {
                twice[of[t] as usize] -= 1;
            }
        }
    }
    for (owner, _) in owner.iter().zip(&on_wall).filter(|(o, on)| **o != NONE && !**on) {
        twice[*owner as usize] += 2;
    }
    twice.iter().map(|t| t / 2).collect()
}
