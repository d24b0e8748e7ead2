//! The optimiser on meshes with known answers.

use super::*;
use crate::generate::{Cuboid, Example, Voxels, example};
use crate::measure::{cell_qualities, statistics};
use crate::mesh::{CellKind, Cells, Mesh};
use crate::optimise::guide::Contact;
use crate::rng::SplitMix64;
use nalgebra::Vector3;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

fn block(kind: CellKind, size: i64) -> Mesh {
    Voxels::from_boxes(&[Cuboid::new([0; 3], [size; 3])]).unwrap().mesh(kind, 1.0).unwrap()
}

/// Boundary vertices fixed, others free.
fn fixed_boundary(mesh: &Mesh) -> Vec<Freedom> {
    let mut freedom = vec![Freedom::Free; mesh.points().len()];
    for face in mesh.cells().boundary().unwrap() {
        face.vertices().iter().for_each(|v| freedom[*v as usize] = Freedom::Fixed);
    }
    freedom
}

/// Throws all free vertices anywhere into the box `0..size`.
fn scramble(mesh: &mut Mesh, freedom: &[Freedom], size: f64, seed: u64) {
    let mut rng = SplitMix64::new(seed);
    for (point, _) in mesh.points_mut().iter_mut().zip(freedom).filter(|(_, f)| **f == Freedom::Free) {
        *point = Point::from([(); 3].map(|()| size * rng.unit()));
    }
}

fn hexes(mesh: &Mesh) -> &[[u32; 8]] {
    let Cells::Hexahedra(cells) = mesh.cells() else { panic!("not hexahedra") };
    cells
}

fn tets(mesh: &Mesh) -> &[[u32; 4]] {
    let Cells::Tetrahedra(cells) = mesh.cells() else { panic!("not tetrahedra") };
    cells
}

fn run(mesh: &mut Mesh, elements: &Elements, freedom: &[Freedom], guides: &[&dyn Guide]) -> OptimiseReport {
    optimise(mesh.points_mut(), elements, freedom, guides, &Settings::default(), &Context::default()).unwrap()
}

#[test]
fn scrambled_tetrahedra_are_untangled() {
    for seed in 1..=4 {
        let mut mesh = block(CellKind::Tetrahedra, 6);
        let freedom = fixed_boundary(&mesh);
        let elements = Elements::tetrahedra_like(tets(&mesh), mesh.points()).unwrap();
        let rest = mesh.points().to_vec();
        scramble(&mut mesh, &freedom, 6.0, seed);
        let report = run(&mut mesh, &elements, &freedom, &[]);
        assert!(report.inverted_before > 100, "{report:?}");
        assert_eq!(report.inverted_after, 0, "seed {seed}: {report:?}");
        assert!(report.worst_after > 0.9, "seed {seed}: {report:?}");
        let mut still = freedom.iter().zip(rest.iter().zip(mesh.points()));
        assert!(still.all(|(f, (a, b))| *f == Freedom::Free || a == b));
    }
}

#[test]
fn only_what_is_near_moves_where_little_is_inverted() {
    for kind in [CellKind::Hexahedra, CellKind::Tetrahedra] {
        let mut mesh = block(kind, 12);
        let freedom = fixed_boundary(&mesh);
        let elements = match mesh.cells() {
            Cells::Hexahedra(cells) => Elements::cubes(cells),
            _ => Elements::tetrahedra_like(tets(&mesh), mesh.points()).unwrap(),
        };
        let (rest, middle) = (mesh.points().to_vec(), Point::new(6.0, 6.0, 6.0));
        mesh.points_mut().iter_mut().filter(|p| **p == middle).for_each(|p| p.x += 1.7);
        let settings = Settings { improve_rounds: 0, polish_rounds: 0, ..Settings::default() };
        let report = optimise(mesh.points_mut(), &elements, &freedom, &[], &settings, &Context::default()).unwrap();
        assert!(report.inverted_before > 0 && report.inverted_after == 0, "{kind}: {report:?}");
        let far = rest.iter().zip(mesh.points()).filter(|(p, _)| (*p - middle).amax() > 5.0);
        far.for_each(|(before, after)| assert_eq!(before, after));
    }
}

#[test]
fn scrambled_hexahedra_become_cubes_again() {
    for seed in 1..=3 {
        let mut mesh = block(CellKind::Hexahedra, 6);
        let freedom = fixed_boundary(&mesh);
        let elements = Elements::cubes(hexes(&mesh));
        scramble(&mut mesh, &freedom, 6.0, seed);
        let report = run(&mut mesh, &elements, &freedom, &[]);
        assert!(report.inverted_before > 50 && report.inverted_after == 0, "seed {seed}: {report:?}");
        let stats = statistics(&cell_qualities(&mesh).unwrap());
        assert_eq!((stats.min, stats.inverted), (report.worst_after, 0));
        assert!(stats.min > 0.95 && (stats.volume - 216.0).abs() < 1e-9, "seed {seed}: {stats:?}");
    }
}

#[test]
fn polycube_coordinates_keep_their_bits() {
    let (mut polycube, shape) = example(Example::SteppedL, 1, CellKind::Tetrahedra).unwrap();
    let mut fixed = vec![[false; 3]; polycube.points().len()];
    for face in polycube.cells().boundary().unwrap() {
        let [a, b, c] = [0, 1, 2].map(|i| polycube.points()[face.vertices()[i] as usize]);
        let axis = (b - a).cross(&(c - a)).iamax();
        face.vertices().iter().for_each(|v| fixed[*v as usize][axis] = true);
    }
    let freedom: Vec<_> = fixed.iter().copied().map(Freedom::Axes).collect();
    let elements = Elements::tetrahedra_like(tets(&polycube), shape.points()).unwrap();
    let mut rng = SplitMix64::new(3);
    for (p, fixed) in polycube.points_mut().iter_mut().zip(&fixed) {
        (0..3).for_each(|a| p[a] += if fixed[a] { -0.0 } else { 1.5 * rng.unit() - 0.75 });
    }
    polycube.points_mut()[0].coords.iter_mut().filter(|x| **x == 0.0).for_each(|x| *x = -0.0);
    let start = polycube.points().to_vec();
    let report = run(&mut polycube, &elements, &freedom, &[]);
    assert!(report.inverted_before > 100 && report.inverted_after == 0, "{report:?}");
    for ((before, after), fixed) in start.iter().zip(polycube.points()).zip(&fixed) {
        assert!((0..3).all(|a| !fixed[a] || before[a].to_bits() == after[a].to_bits()));
    }
}

/// A sphere about the origin.
struct Sphere(f64);

impl Guide for Sphere {
    fn contact(&self, point: &Point) -> Contact {
        let normal = point.coords.try_normalize(0.0).unwrap_or(Vector3::x());
        Contact { point: Point::from(normal * self.0), tangent: Tangent::Plane(normal) }
    }
}

/// A cube of hexahedra about the origin, its surface pushed to the sphere of radius 3 in the worse of ways.
fn ball() -> (Mesh, Vec<Freedom>) {
    let mut mesh = block(CellKind::Hexahedra, 6);
    mesh.points_mut().iter_mut().for_each(|p| p.coords.add_scalar_mut(-3.0));
    let free = fixed_boundary(&mesh);
    let freedom = free.iter().map(|f| if *f == Freedom::Free { *f } else { Freedom::Guided(0) }).collect();
    (mesh, freedom)
}

#[test]
fn sliding_vertices_end_on_the_sphere() {
    let (mut mesh, freedom) = ball();
    let elements = Elements::cubes(hexes(&mesh));
    let report = run(&mut mesh, &elements, &freedom, &[&Sphere(3.0)]);
    assert!(report.inverted_after == 0 && report.worst_after > 0.25, "{report:?}");
    for (p, f) in mesh.points().iter().zip(&freedom) {
        assert!(*f == Freedom::Free || (p.coords.norm() / 3.0 - 1.0).abs() < 1e-12);
    }
}

#[test]
fn sliding_vertices_end_on_the_triangles_and_curves() {
    let (mut mesh, _) = example(Example::CubeSpikes, 0, CellKind::Hexahedra).unwrap();
    let (_, shape) = example(Example::CubeSpikes, 0, CellKind::Triangles).unwrap();
    let (_, volume) = example(Example::CubeSpikes, 0, CellKind::Hexahedra).unwrap();
    let Cells::Triangles(triangles) = shape.cells() else { panic!("not triangles") };
    mesh.points_mut().copy_from_slice(volume.points());
    let guide = SurfaceGuide::new(shape.points(), triangles).unwrap();
    let free = fixed_boundary(&mesh);
    let freedom: Vec<_> = free.iter().map(|f| if *f == Freedom::Free { *f } else { Freedom::Guided(0) }).collect();
    let elements = Elements::boxes_like(hexes(&mesh), mesh.points(), 3).unwrap();
    let settings = Settings { improve_rounds: 4, improve_iterations: 8, ..Settings::default() };
    let context = Context::default();
    let report = optimise(mesh.points_mut(), &elements, &freedom, &[&guide], &settings, &context).unwrap();
    assert!(report.inverted_after == 0 && report.worst_after >= report.worst_before, "{report:?}");
    for (p, f) in mesh.points().iter().zip(&freedom) {
        assert!(*f == Freedom::Free || (guide.contact(p).point - p).norm() < 1e-11);
    }
}

#[test]
fn good_meshes_are_not_worsened() {
    for kind in [CellKind::Hexahedra, CellKind::Tetrahedra] {
        let mut mesh = block(kind, 4);
        let freedom = fixed_boundary(&mesh);
        let start = mesh.clone();
        let elements = match mesh.cells() {
            Cells::Hexahedra(c) => Elements::cubes(c),
            _ => Elements::tetrahedra_like(tets(&mesh), mesh.points()).unwrap(),
        };
        let report = run(&mut mesh, &elements, &freedom, &[]);
        assert!(report.worst_after >= report.worst_before && report.worst_before > 1.0 - 1e-12, "{report:?}");
        assert!(start.points().iter().zip(mesh.points()).all(|(a, b)| (a - b).norm() < 1e-6));
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let result = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (mut mesh, freedom) = ball();
            let elements = Elements::boxes_like(hexes(&mesh), mesh.points(), 2).unwrap();
            run(&mut mesh, &elements, &freedom, &[&Sphere(3.0)]);
            mesh.points().to_vec()
        })
    };
    let one = result(1);
    assert_eq!(one, result(2));
    assert_eq!(one, result(3));
}

/// Optimises a ball and cancels at the step `last` that is reported, from 0: what came of it and how many were
/// reported.
fn cancelled_at(last: usize, mesh: &mut Mesh, freedom: &[Freedom]) -> (Result<OptimiseReport>, usize) {
    let elements = Elements::cubes(hexes(mesh));
    let (slot, steps): (Arc<OnceLock<Context>>, Arc<AtomicUsize>) = Default::default();
    let (own, counted) = (Arc::clone(&slot), Arc::clone(&steps));
    let context = Context::new(move |_, _| {
        if counted.fetch_add(1, Ordering::Relaxed) == last {
            own.get().unwrap().cancel();
        }
    });
    slot.set(context.clone()).unwrap();
    let result = optimise(mesh.points_mut(), &elements, freedom, &[&Sphere(3.0)], &Settings::default(), &context);
    (result, steps.load(Ordering::Relaxed))
}

#[test]
fn cancelling_leaves_the_points_as_they_were() {
    let (start, freedom) = ball();
    let (done, steps) = cancelled_at(usize::MAX, &mut start.clone(), &freedom);
    done.unwrap();
    assert!(steps > 5, "{steps}");
    // The last step is reported when all is done.
    for last in [0, steps / 2, steps - 2] {
        let mut mesh = start.clone();
        let (result, _) = cancelled_at(last, &mut mesh, &freedom);
        assert_eq!((result.unwrap_err().kind, &mesh), (ErrorKind::Cancelled, &start), "at {last} of {steps}");
    }
}

#[test]
fn bad_input_is_an_error_that_names_its_place() {
    let mesh = block(CellKind::Hexahedra, 2);
    let elements = Elements::cubes(hexes(&mesh));
    let attempt = |points: &[Point], freedom: &[Freedom], settings: &Settings| {
        let mut points = points.to_vec();
        optimise(&mut points, &elements, freedom, &[], settings, &Context::default()).unwrap_err()
    };
    let good = Settings::default();
    let free = vec![Freedom::Free; mesh.points().len()];
    assert_eq!(attempt(mesh.points(), &free[1..], &good).kind, ErrorKind::Mismatch);
    assert_eq!(attempt(&mesh.points()[..9], &free[..9], &good).kind, ErrorKind::Mesh);
    assert_eq!(attempt(mesh.points(), &free, &Settings { theta: 1.0, ..good.clone() }).kind, ErrorKind::Option);
    let mut guided = free.clone();
    guided[3] = Freedom::Guided(0);
    assert_eq!(attempt(mesh.points(), &guided, &good).place, Some(Place::Vertex(3)));
    let mut points = mesh.points().to_vec();
    points[7].y = f64::NAN;
    assert_eq!(attempt(&points, &free, &good).place, Some(Place::Vertex(7)));
    assert!(Elements::boxes_like(&[[99; 8]], mesh.points(), 1).is_err());
}

#[test]
fn nothing_at_all_is_optimised_to_nothing() {
    let mut points = Vec::new();
    let elements = Elements::cubes(&[]);
    let report = optimise(&mut points, &elements, &[], &[], &Settings::default(), &Context::default()).unwrap();
    assert_eq!((report.inverted_after, report.iterations, report.largest_move), (0, 0, 0.0));
    assert!(elements.is_empty());
}

/// `cargo test --release -p polycube optimise -- --ignored --nocapture`
#[test]
#[ignore = "measures time"]
fn thirty_thousand_hexahedra_in_seconds() {
    let mut mesh = block(CellKind::Hexahedra, 31);
    let freedom = fixed_boundary(&mesh);
    let mut rng = SplitMix64::new(1);
    for (p, _) in mesh.points_mut().iter_mut().zip(&freedom).filter(|(_, f)| **f == Freedom::Free) {
        (0..3).for_each(|a| p[a] += 2.0 * rng.unit() - 1.0);
    }
    let elements = Elements::cubes(hexes(&mesh));
    let start = std::time::Instant::now();
    let report = run(&mut mesh, &elements, &freedom, &[]);
    println!("{:.2} s: {report:?}", start.elapsed().as_secs_f64());
    assert_eq!(report.inverted_after, 0);
}
