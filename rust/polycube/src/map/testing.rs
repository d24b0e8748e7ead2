//! Small meshes, and the big ones, for the tests of this crate.

use crate::mesh::{Cells, Face, Mesh, Point, Simplices, read};
use crate::rng::SplitMix64;

/// A box of unit cubes with a corner in the origin; vertex (x, y, z) has number x + (nx+1)(y + (ny+1) z).
pub(crate) fn hex_box(n: [u32; 3]) -> Mesh {
    let id = |x: u32, y: u32, z: u32| x + (n[0] + 1) * (y + (n[1] + 1) * z);
    let (mut points, mut hexes) = (Vec::new(), Vec::new());
    for z in 0..=n[2] {
        for y in 0..=n[1] {
            for x in 0..=n[0] {
                points.push(Point::new(f64::from(x), f64::from(y), f64::from(z)));
                if x < n[0] && y < n[1] && z < n[2] {
                    let ring = |z| [id(x, y, z), id(x + 1, y, z), id(x + 1, y + 1, z), id(x, y + 1, z)];
                    let ([a, b, c, d], [e, f, g, h]) = (ring(z), ring(z + 1));
                    hexes.push([a, b, c, d, e, f, g, h]);
                }
            }
        }
    }
    Mesh::new(points, Cells::Hexahedra(hexes)).expect("a mesh")
}

/// The same box of tetrahedra.
pub(crate) fn tet_box(n: [u32; 3]) -> Mesh {
    let mesh = hex_box(n);
    let Simplices::Tetrahedra(t) = mesh.cells().simplices() else { panic!("not a volume") };
    Mesh::new(mesh.points().to_vec(), Cells::Tetrahedra(t.into_owned())).expect("a mesh")
}

/// Its surface of quadrilaterals; the inner vertices stay, used by no cell.
pub(crate) fn quad_box(n: [u32; 3]) -> Mesh {
    let mesh = hex_box(n);
    let quad = |f: Face| match f {
        Face::Quad(q) => q,
        Face::Triangle(_) => panic!("not a quadrilateral"),
    };
    let cells = mesh.cells().boundary().unwrap().into_iter().map(quad).collect();
    Mesh::new(mesh.points().to_vec(), Cells::Quads(cells)).expect("a mesh")
}

/// The same of triangles.
pub(crate) fn tri_box(n: [u32; 3]) -> Mesh {
    let mesh = quad_box(n);
    let Simplices::Triangles(t) = mesh.cells().simplices() else { panic!("not a surface") };
    Mesh::new(mesh.points().to_vec(), Cells::Triangles(t.into_owned())).expect("a mesh")
}

/// The mesh with its vertices numbered at random.
pub(crate) fn shuffled(mesh: &Mesh, seed: u64) -> Mesh {
    let mut random = SplitMix64::new(seed);
    let mut order: Vec<(f64, usize)> = (0..mesh.points().len()).map(|v| (random.unit(), v)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut rank = vec![0; order.len()];
    for (new, &(_, old)) in order.iter().enumerate() {
        rank[old] = new as u32;
    }
    let Cells::Hexahedra(cells) = mesh.cells() else { panic!("not hexahedra") };
    let points = order.iter().map(|&(_, old)| mesh.points()[old]).collect();
    Mesh::new(points, Cells::Hexahedra(cells.iter().map(|c| c.map(|v| rank[v as usize])).collect())).expect("a mesh")
}

/// The box with every coordinate that is free of the box's sides moved by up to `amount`.
pub(crate) fn jittered(mesh: &Mesh, amount: f64, seed: u64) -> Mesh {
    let mut random = SplitMix64::new(seed);
    let sides = levels(mesh);
    let mut mesh = mesh.clone();
    for (p, side) in mesh.points_mut().iter_mut().zip(sides) {
        for k in 0..3 {
            let step = amount * (2.0 * random.unit() - 1.0);
            p[k] += if side[k].is_none() { step } else { 0.0 };
        }
    }
    mesh
}

/// The coordinates of a box's vertices on its sides.
pub(crate) fn levels(mesh: &Mesh) -> Vec<[Option<f64>; 3]> {
    let far = mesh.points().iter().fold([0.0_f64; 3], |m, p| [m[0].max(p.x), m[1].max(p.y), m[2].max(p.z)]);
    let side = |p: &Point, k: usize| (p[k] == 0.0 || p[k] == far[k]).then_some(p[k]);
    mesh.points().iter().map(|p| [side(p, 0), side(p, 1), side(p, 2)]).collect()
}

/// The label of every boundary face, by its normal; −1 for a flat one.
pub(crate) fn labels(mesh: &Mesh) -> Vec<i8> {
    let label = |f: &Face| {
        let p: Vec<_> = f.vertices().iter().map(|&v| mesh.points()[v as usize]).collect();
        let normal = (p[1] - p[0]).cross(&(p[2] - p[0]));
        let axis = normal.iamax() as i8;
        if normal == nalgebra::Vector3::zeros() { -1 } else { 2 * axis + i8::from(normal[axis as usize] < 0.0) }
    };
    mesh.cells().boundary().unwrap().iter().map(label).collect()
}

/// Every boundary vertex on the level of each of its facets, moved by `level(axis, coordinate)`.
pub(crate) fn on_levels(mesh: &Mesh, level: impl Fn(usize, f64) -> f64) -> Vec<[Option<f64>; 3]> {
    let mut fixed = vec![[None; 3]; mesh.points().len()];
    for (face, label) in mesh.cells().boundary().unwrap().iter().zip(labels(mesh)) {
        for &v in face.vertices().iter().filter(|_| label >= 0) {
            let axis = label as usize / 2;
            fixed[v as usize][axis] = Some(level(axis, mesh.points()[v as usize][axis]));
        }
    }
    fixed
}

/// Levels drawn apart unevenly, so that their order stays.
pub(crate) fn uneven(axis: usize, x: f64) -> f64 {
    x + 0.4 * (x * 1.7 + axis as f64).sin()
}

/// Every tetrahedral polycube of the test data with its name; none where there is no data.
pub(crate) fn real_polycubes() -> Vec<(String, Mesh)> {
    let files = crate::data::folder().into_iter().flat_map(|folder| std::fs::read_dir(folder).unwrap());
    let named = files.map(|file| (file.as_ref().unwrap().file_name().into_string().unwrap(), file.unwrap().path()));
    let mut found: Vec<_> = named.filter(|(name, _)| name.ends_with(".polycube.mesh")).collect();
    found.sort();
    found.into_iter().map(|(name, path)| (name, read(&path).unwrap())).collect()
}
