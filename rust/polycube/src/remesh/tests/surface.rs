//! Where the vertices lie.

use super::{Case, cells, generated, quality};
use crate::align::Strategy;
use crate::context::Context;
use crate::generate::{Cuboid, Example, Voxels, example};
use crate::measure::hausdorff;
use crate::mesh::{CellKind, Face, Mesh, Point};
use crate::remesh::lattice::Carrier;
use crate::remesh::{RemeshOptions, Size, remesh};
use crate::simplify::{Input, SimplifyOptions};
use crate::spatial::Nearest;

fn size(mesh: &Mesh) -> f64 {
    mesh.points().iter().map(|p| p.coords.norm()).fold(0.0, f64::max)
}

fn surface(mesh: &Mesh) -> Nearest<3> {
    let faces = mesh.cells().boundary().unwrap();
    let triangles = faces.iter().flat_map(Face::triangles);
    Nearest::new(triangles.map(|t| t.map(|v| mesh.points()[v as usize])))
}

/// Quadrilaterals and the boundary of hexahedra have their vertices on the shape, corners on corners.
pub(crate) fn check(case: &Case) {
    let context = Context::default();
    let remesher = case.remesher();
    let (index, size) = (surface(&case.shape), size(&case.shape));
    let quads = remesher.quads(&context).unwrap();
    let corners = &case.simplified.input.structure.corners;
    for (p, carrier) in quads.mesh.points().iter().zip(&quads.carriers) {
        assert!(index.distance(p) < 1e-12 * size, "{}: {:e}", case.name, index.distance(p));
        match *carrier {
            Carrier::Corner(c) => assert_eq!(*p, case.shape.points()[corners[c as usize].vertex as usize]),
            Carrier::Edge(e) => {
                let chain = &case.simplified.input.chains[e as usize];
                let segments = chain.windows(2).map(|s| [s[0], s[1], s[1]].map(|v| case.shape.points()[v as usize]));
                assert!(Nearest::new(segments).distance(p) < 1e-12 * size, "{}", case.name);
            }
            Carrier::Facet(_) => {}
            Carrier::Inside => panic!("{}: an inner vertex on the surface", case.name),
        }
    }
    for padding in 0..2 {
        let hexes = remesher.hexes(padding, &context).unwrap();
        let on_surface = hexes.carriers.iter().zip(hexes.mesh.points()).filter(|(s, _)| s.is_surface());
        let outer: Vec<Point> = on_surface.map(|(_, p)| *p).collect();
        assert_eq!(outer, quads.mesh.points(), "{}", case.name);
        let boundary = hexes.mesh.cells().boundary().unwrap();
        let on_boundary = |v: &u32| hexes.carriers[*v as usize].is_surface();
        assert!(boundary.iter().all(|f| f.vertices().iter().all(on_boundary)));
    }
}

/// A bump that no edge of the polycube shows is not worth giving up for better cells.
#[test]
fn what_sticks_out_of_a_facet_is_meshed() {
    const HEIGHT: f64 = 12.0;
    let cube = Voxels::from_boxes(&[Cuboid::new([0; 3], [24; 3])]).unwrap();
    let polycube = cube.mesh(CellKind::Triangles, 1.0).unwrap();
    let raised = |p: &Point| {
        let square = ((p.x - 12.0).powi(2) + (p.y - 24.0).powi(2)) / 2.4_f64.powi(2);
        let height = if p.z == 24.0 { HEIGHT * (-square / 2.0).exp() } else { 0.0 };
        Point::new(p.x, p.y, p.z + height)
    };
    let shape = polycube.clone().with_points(polycube.points().iter().map(raised).collect()).unwrap();
    let input = Input { polycube: &polycube, shape: Some(&shape), labels: None };
    let options = RemeshOptions { size: Some(Size::Hexes(1500)), ..RemeshOptions::default() };
    let found = remesh(&input, &options, &Context::default()).unwrap();
    assert_eq!(found.report.inverted, 0);
    let index = surface(&found.hexes.unwrap().mesh);
    let lost = shape.points().iter().map(|p| index.distance(p)).fold(0.0, f64::max);
    assert!(lost < HEIGHT / 4.0, "{lost}");
}

/// A polycube that is its own shape gives its own lattice.
#[test]
fn the_identity_gives_the_lattice() {
    for (kind, e) in CellKind::ALL.into_iter().zip(Example::ALL) {
        let (polycube, _) = example(e, 0, kind).unwrap();
        let options = SimplifyOptions { strategy: Strategy::Naive, ..SimplifyOptions::default() };
        let case = Case::with(&options, format!("{e} {kind}"), (polycube.clone(), polycube));
        let context = Context::default();
        let remesher = case.remesher();
        for padding in 0..2 {
            let hexes = remesher.hexes(padding, &context).unwrap();
            let off = hexes.mesh.points().iter().zip(&hexes.polycube).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            let tolerance = if case.shape.cells().is_volume() { 1e-12 } else { 1e-9 };
            assert!(off < tolerance * size(&case.shape), "{}: {off:e}", case.name);
            assert_eq!((hexes.guessed, quality(&hexes).0), (0, 0));
        }
        let quads = remesher.quads(&context).unwrap();
        let distance = hausdorff(&quads.mesh, &case.shape, &context).unwrap();
        assert!(distance < 1e-12 * size(&case.shape), "{}: {distance:e}", case.name);
    }
}

#[test]
fn hausdorff_sees_both_ways() {
    let (cube, _) = example(Example::CubeSpikes, 0, CellKind::Quads).unwrap();
    let mut moved = cube.clone();
    moved.points_mut().iter_mut().for_each(|p| p.x += 0.25);
    let context = Context::default();
    let found = hausdorff(&moved, &cube, &context).unwrap();
    assert!((found - 0.25).abs() < 1e-12, "{found}");
    // A spike on one of them alone is seen from either side.
    let mut spiked = cube.clone();
    let top = (0..spiked.points().len()).max_by(|&a, &b| cube.points()[a].z.total_cmp(&cube.points()[b].z)).unwrap();
    spiked.points_mut()[top].z += 3.0;
    let [a, b] = [hausdorff(&spiked, &cube, &context), hausdorff(&cube, &spiked, &context)].map(|x| x.unwrap());
    assert_eq!(a, b);
    assert!((2.5..=3.0).contains(&a), "{a}");
}

#[test]
fn the_outside_of_hexahedra_is_the_surface_and_knows_its_facets() {
    for case in generated().step_by(3) {
        let remesher = case.remesher();
        let context = Context::default();
        let quads = remesher.quads(&context).unwrap();
        let facets = &case.simplified.input.structure.facets;
        for padding in [0, 2] {
            let hexes = remesher.hexes(padding, &context).unwrap();
            hexes.grouped().unwrap();
            assert_eq!(hexes.boundary.len(), quads.label.len(), "{}", case.name);
            for (i, side) in hexes.boundary.iter().enumerate() {
                let at = |v: u32| hexes.mesh.points()[v as usize];
                let expected: Vec<Point> =
                    quads.mesh.cells().cell(i).iter().map(|&v| quads.mesh.points()[v as usize]).collect();
                let found = side.face.vertices(cells(&hexes.mesh)).map(at);
                // A face may begin at another corner.
                let turned = (0..4).any(|k| (0..4).all(|j| found[(j + k) % 4] == expected[j]));
                assert!(turned, "{}: face {i} with padding {padding}", case.name);
                assert_eq!((side.label.index() as i8, side.label), (quads.label[i], facets[side.facet as usize].label));
            }
        }
    }
}
