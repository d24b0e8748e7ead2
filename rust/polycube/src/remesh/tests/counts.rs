//! Numbers of cells and blocks, and how they meet.

use super::{Case, cells, corner_jacobians, distinct, generated, scaled_jacobian};
use crate::context::Context;
use crate::error::ErrorKind;
use crate::measure::base_complex;
use crate::mesh::{Cells, Mesh};
use crate::remesh::lattice::scale_for;
use crate::remesh::map::LatticeMap;
use crate::remesh::mesher::{MAX_PADDING, Remesher};
use crate::remesh::{Hexes, Layout, Size, count_hexes};
use crate::structure::Surface;

/// The boundary is a closed manifold with the genus of the polycube; inner faces are shared by two.
fn check_topology(case: &Case, mesh: &Mesh) {
    let boundary = mesh.cells().boundary().unwrap();
    let faces = boundary.len();
    let surface = Surface::new(boundary, mesh.points().len()).unwrap();
    let mut used: Vec<u32> = surface.faces().iter().flat_map(|f| f.vertices().to_vec()).collect();
    used.sort_unstable();
    used.dedup();
    let structure = &case.simplified.input.structure;
    let components = structure.components().into_iter().max().unwrap() as i64 + 1;
    let euler = used.len() as i64 - 2 * faces as i64 + faces as i64;
    assert_eq!(euler, 2 * (components - structure.genus() as i64), "{}", case.name);
}

fn check_blocks(case: &Case, hexes: &Hexes, expected: usize) {
    assert_eq!(distinct(&hexes.block_id), expected, "{}", case.name);
    let found = base_complex(cells(&hexes.mesh), &Context::default()).unwrap();
    assert_eq!(distinct(&found), expected, "{}: base complex", case.name);
    let mut pairs: Vec<_> = found.iter().zip(&hexes.block_id).collect();
    pairs.sort_unstable();
    pairs.dedup();
    assert_eq!(pairs.len(), expected, "{}: other blocks", case.name);
}

/// On the polycube no corner is turned over, and none is flat but at corners that look both ways along an axis.
fn check_polycube(case: &Case, hexes: &Hexes) {
    let worst = cells(&hexes.mesh).iter().map(|h| scaled_jacobian(&hexes.polycube, h));
    let worst = worst.fold(f64::INFINITY, f64::min);
    let regular = case.simplified.input.structure.corners.iter().all(|c| c.valence < 4);
    assert!(worst > 0.0 || !regular, "{}: {worst}", case.name);
}

pub(crate) fn check(case: &Case) {
    let context = Context::default();
    let remesher = case.remesher();
    let after = case.simplified.report.after.unwrap();
    let structure = &case.simplified.input.structure;
    for padding in 0..=2 {
        let hexes = remesher.hexes(padding, &context).unwrap();
        let expected = count_hexes(structure, &case.simplified.levels, padding);
        assert_eq!(hexes.mesh.cells().len() as u64, expected, "{}", case.name);
        assert_eq!(hexes.carriers.len(), hexes.mesh.points().len());
        check_topology(case, &hexes.mesh);
        check_polycube(case, &hexes);
        check_blocks(case, &hexes, if padding > 0 { after.blocks_padded } else { after.blocks });
        let layout = remesher.layout(&hexes.polycube, padding).unwrap();
        let blocks = layout.blocks.as_ref().unwrap();
        assert_eq!(blocks.cells().len(), distinct(&hexes.block_id));
        assert_eq!(layout.patches.cells().len(), after.surface_patches);
        check_topology(case, blocks);
        if padding == 1 {
            check_singular(case, &layout, &hexes);
        }
        check_patches(case, &layout.patches);
        assert!(cells(blocks).iter().all(|h| corner_jacobians(blocks.points(), h).iter().all(|j| *j > 0.0)
            || structure.corners.iter().any(|c| c.valence > 3)));
        assert!(remesher.layout(hexes.mesh.points(), padding).is_ok());
    }
    let quads = remesher.quads(&context).unwrap();
    assert_eq!(distinct(&quads.patch_id), after.surface_patches, "{}", case.name);
    assert_eq!(distinct(&quads.block_id), after.blocks_padded - after.blocks, "{}", case.name);
    check_patches(case, &quads.mesh);
}

fn check_patches(case: &Case, mesh: &Mesh) {
    let faces = mesh.cells().boundary().unwrap();
    let count = faces.len() as i64;
    assert!(Surface::new(faces, mesh.points().len()).is_ok(), "{}", case.name);
    let structure = &case.simplified.input.structure;
    let components = structure.components().into_iter().max().unwrap() as i64 + 1;
    assert_eq!(mesh.points().len() as i64 - count, 2 * (components - structure.genus() as i64), "{}", case.name);
}

#[test]
fn meshes_of_generated_pairs_have_the_reported_structure() {
    for case in generated() {
        check(&case);
        super::surface::check(&case);
    }
}

/// The layout's singular edges, padded once, are all that the mesh has.
fn check_singular(case: &Case, layout: &Layout, hexes: &Hexes) {
    let length: usize = layout.singular.iter().map(|s| s.points.len() - 1).sum();
    assert_eq!(length, inner_singular_edges(cells(&hexes.mesh)), "{}", case.name);
    assert!(layout.singular.iter().all(|s| s.valence != 4 && (3..=6).contains(&s.valence)));
}

/// How many inner edges have another number of hexahedra than four, counted edge by edge.
fn inner_singular_edges(hexes: &[[u32; 8]]) -> usize {
    let sides = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)];
    let edge = |h: &[u32; 8], (a, b): (usize, usize)| (h[a].min(h[b]), h[a].max(h[b]));
    let mut edges: Vec<_> = hexes.iter().flat_map(|h| sides.map(|s| edge(h, s))).collect();
    edges.sort_unstable();
    let faces = Cells::Hexahedra(hexes.to_vec()).boundary().unwrap();
    let mut border: Vec<_> = faces
        .iter()
        .flat_map(|f| {
            let v = f.vertices().to_vec();
            (0..4).map(move |k| (v[k].min(v[(k + 1) % 4]), v[k].max(v[(k + 1) % 4])))
        })
        .collect();
    border.sort_unstable();
    edges.chunk_by(|a, b| a == b).filter(|g| g.len() != 4 && border.binary_search(&g[0]).is_err()).count()
}

#[test]
fn sizes_are_met() {
    let context = Context::default();
    for case in generated().step_by(3) {
        for wanted in [6000, 30000] {
            let size = Size::Hexes(wanted);
            let scale = scale_for(&case.input(), &case.simplified, size, 1, &context).unwrap();
            let result = case.simplified.rescaled(&case.input(), scale, &context).unwrap();
            let found = count_hexes(&result.input.structure, &result.levels, 1) as f64;
            assert!((found / wanted as f64 - 1.0).abs() < 0.15, "{}: {found} for {wanted}", case.name);
            assert_eq!(result.report.after, case.simplified.report.after, "{}", case.name);
        }
        check_edge_length(&case);
        let fine = scale_for(&case.input(), &case.simplified, Size::EdgeLength(1.0), 1, &context).unwrap();
        let coarse = scale_for(&case.input(), &case.simplified, Size::EdgeLength(2.0), 1, &context).unwrap();
        assert_eq!(fine, 2.0 * coarse);
    }
}

/// The squares of the surface have about the wanted edge length.
fn check_edge_length(case: &Case) {
    let context = Context::default();
    let scale = scale_for(&case.input(), &case.simplified, Size::EdgeLength(2.0), 0, &context).unwrap();
    let result = case.simplified.rescaled(&case.input(), scale, &context).unwrap();
    let map = LatticeMap::new(&result).unwrap();
    let quads = Remesher::new(&map, &case.shape, &context).unwrap().quads(&context).unwrap();
    let Cells::Quads(cells) = quads.mesh.cells() else { panic!("not quadrilaterals") };
    let at = |v: u32| quads.mesh.points()[v as usize];
    let lengths = cells.iter().flat_map(|q| (0..4).map(move |k| (at(q[k]) - at(q[(k + 1) % 4])).norm()));
    let mean = lengths.sum::<f64>() / (4 * cells.len()) as f64;
    assert!((1.5..2.5).contains(&mean), "{}: {mean}", case.name);
}

#[test]
fn the_same_input_gives_the_same_bits() {
    let context = Context::default();
    let case = generated().nth(1).unwrap();
    let [a, b] = [0, 1].map(|_| case.remesher().hexes(1, &context).unwrap());
    assert_eq!(a, b);
}

#[test]
fn bad_options_are_refused() {
    let context = Context::default();
    let case = generated().next().unwrap();
    for size in [Size::Hexes(0), Size::Scale(0.0), Size::EdgeLength(-1.0), Size::Scale(f64::NAN)] {
        let error = scale_for(&case.input(), &case.simplified, size, 1, &context).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Option, "{size:?}");
    }
    let remesher = case.remesher();
    assert_eq!(remesher.hexes(MAX_PADDING + 1, &context).unwrap_err().kind, ErrorKind::Option);
    assert_eq!(remesher.layout(&[], 1).unwrap_err().kind, ErrorKind::Mismatch);
    context.cancel();
    assert_eq!(remesher.hexes(1, &context).unwrap_err().kind, ErrorKind::Cancelled);
    assert_eq!(remesher.quads(&context).unwrap_err().kind, ErrorKind::Cancelled);
    let again = Remesher::new(case.map.get().unwrap(), &case.shape, &context);
    assert_eq!(again.err().unwrap().kind, ErrorKind::Cancelled);
    let mut none = case.simplified.clone();
    none.polycube = None;
    assert_eq!(LatticeMap::new(&none).unwrap_err().kind, ErrorKind::Polycube);
}
