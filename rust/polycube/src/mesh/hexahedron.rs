//! What a hexahedron is made of, by the numbers of its vertices in VTK's order.

/// The faces, counter-clockwise seen from outside: of a box those at −X +X −Y +Y −Z +Z.
pub(crate) const FACES: [[usize; 4]; 6] =
    [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]];

/// Each vertex with its three neighbours, right-handed.
pub(crate) const CORNERS: [[usize; 4]; 8] =
    [[0, 1, 3, 4], [1, 2, 0, 5], [2, 3, 1, 6], [3, 0, 2, 7], [4, 7, 5, 0], [5, 4, 6, 1], [6, 5, 7, 2], [7, 6, 4, 3]];

/// The twelve edges, in three sets of four parallel ones.
pub(crate) const EDGES: [[[usize; 2]; 4]; 3] =
    [[[0, 1], [3, 2], [4, 5], [7, 6]], [[0, 3], [1, 2], [4, 7], [5, 6]], [[0, 4], [1, 5], [2, 6], [3, 7]]];

/// The octant of a box that each vertex lies in: bit `a` is set on the upper side along axis `a`. Its own inverse.
pub(crate) const OCTANTS: [usize; 8] = [0, 1, 3, 2, 4, 5, 7, 6];

/// A face of a hexahedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, bitcode::Encode, bitcode::Decode)]
pub struct HexFace {
    /// The hexahedron.
    pub cell: u32,
    /// Which of its faces, 0 to 5: of a box in VTK's order those at −X +X −Y +Y −Z +Z.
    pub face: u8,
}

impl HexFace {
    /// Its vertices, counter-clockwise seen from outside the hexahedron.
    ///
    /// # Panics
    /// Unless the hexahedron is one of `cells` and the face one of 0 to 5.
    pub fn vertices(self, cells: &[[u32; 8]]) -> [u32; 4] {
        FACES[usize::from(self.face)].map(|k| cells[self.cell as usize][k])
    }
}

/// The tetrahedra at the eight vertices, positive where the hexahedron is not inverted.
pub(crate) fn corner_tetrahedra(hex: &[u32; 8]) -> [[u32; 4]; 8] {
    CORNERS.map(|corner| corner.map(|k| hex[k]))
}

/// The faces that two hexahedra share, by all their vertices, each as the one with the lower number has it, then the
/// other; none is that of more than two. O(n log n).
pub(crate) fn shared_faces(cells: &[[u32; 8]]) -> Vec<[HexFace; 2]> {
    let mut keys = Vec::with_capacity(cells.len() * FACES.len());
    for (cell, _) in (0..).zip(cells) {
        for side in (0..FACES.len() as u8).map(|face| HexFace { cell, face }) {
            let mut key = side.vertices(cells);
            key.sort_unstable();
            keys.push((key, side));
        }
    }
    keys.sort_unstable();
    let pairs = keys.chunk_by(|a, b| a.0 == b.0).filter_map(|same| match *same {
        [(_, one), (_, other)] => Some([one, other]),
        _ => None,
    });
    pairs.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tables are true of the unit cube that the octants make.
    #[test]
    fn tables_describe_a_cube() {
        let at = |k: usize| [0, 1, 2].map(|a| (OCTANTS[k] >> a & 1) as i32);
        let step = |from: usize, to: usize| [0, 1, 2].map(|a| at(to)[a] - at(from)[a]);
        let det = |[a, b, c]: [[i32; 3]; 3]| {
            let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
            a[0] * minor(1, 2) - a[1] * minor(0, 2) + a[2] * minor(0, 1)
        };
        for [o, a, b, c] in CORNERS {
            assert_eq!(det([a, b, c].map(|k| step(o, k))), 1);
        }
        for [a, b, c, d] in FACES {
            assert_eq!(step(a, b), step(d, c));
            // What is off the plane of a face is behind it.
            let far = (0..8).find(|&k| det([step(a, k), step(a, b), step(a, d)]) != 0).unwrap();
            assert!(det([step(a, far), step(a, b), step(a, d)]) < 0);
        }
        for (axis, set) in EDGES.into_iter().enumerate() {
            let unit = std::array::from_fn(|a| i32::from(a == axis));
            assert!(set.iter().all(|&[a, b]| step(a, b) == unit));
        }
        assert!((0..8).all(|k| OCTANTS[OCTANTS[k]] == k));
    }
}
