//! Polycubes of plain shapes are valid, embedded and of the topology of the shape, which is cut finer but not changed.

mod common;

use common::{cases, coarse, data, dense};
use nalgebra::{Matrix2, Rotation3, Vector3};
use polycube::generate::{Cuboid, Example, Voxels, example, random_polycube};
use polycube::make::{self, Axes, Made, MakeOptions, make};
use polycube::mesh::{CellKind, Cells, Mesh, Point, Simplices, read, write_bytes};
use polycube::remesh::{RemeshOptions, Size, Stages};
use polycube::repair::Repair;
use polycube::simplify::Note;
use polycube::structure::{Polycube, Tolerance};
use polycube::{Context, ErrorKind, Place};
use std::path::PathBuf;

fn made(shape: &Mesh, what: &str) -> Made {
    make(shape, &MakeOptions::default(), &Context::default()).unwrap_or_else(|e| panic!("{what}: {e}"))
}

fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    match mesh.cells().simplices() {
        Simplices::Triangles(t) => t.into_owned(),
        Simplices::Tetrahedra(_) => panic!("this is a surface"),
    }
}

/// Vertices less edges plus faces of a closed surface whose vertices are all used.
fn euler(mesh: &Mesh) -> i64 {
    let count = triangles(mesh).len() as i64;
    mesh.points().len() as i64 - 3 * count / 2 + count
}

fn area(mesh: &Mesh) -> f64 {
    let doubled = |t: [u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.points()[v as usize]);
        (b - a).cross(&(c - a)).norm()
    };
    triangles(mesh).into_iter().map(doubled).sum::<f64>() / 2.0
}

/// How many triangles do not look along their label.
fn turned_over(made: &Made) -> usize {
    let looks_back = |(t, &label): (&[u32; 3], &i8)| {
        let [a, b, c] = t.map(|v| made.polycube.points()[v as usize]);
        let along = (b - a).cross(&(c - a))[label as usize / 2];
        if label % 2 == 0 { along <= 0.0 } else { along >= 0.0 }
    };
    triangles(&made.polycube).iter().zip(&made.labels).filter(|&x| looks_back(x)).count()
}

fn assert_good(shape: &Mesh, made: &Made, what: &str) {
    assert_eq!(made.shape.cells(), made.polycube.cells(), "{what}");
    assert_eq!(made.shape.points()[..shape.points().len()], shape.points()[..], "{what}: vertices keep their numbers");
    assert_eq!(euler(&made.shape), euler(shape), "{what}: the topology is kept");
    assert!((area(&made.shape) / area(shape) - 1.0).abs() < 1e-6, "{what}: the surface is that of the shape");
    let polycube = Polycube::new(&made.polycube, Some(&made.labels), &Tolerance { merge: 0.0, ..Tolerance::default() });
    let polycube = polycube.unwrap_or_else(|v| panic!("{what}: {}", v[0]));
    let levels: Vec<i64> = polycube.placement.iter().map(|x| x.round() as i64).collect();
    assert!(polycube.placement.iter().zip(&levels).all(|(x, &l)| *x == l as f64), "{what}: levels are integers");
    assert_eq!(dense::check(&polycube.structure, &levels), Ok(()), "{what}");
    assert_eq!(made.report.corners, polycube.structure.corners.len(), "{what}");
    assert_eq!(turned_over(made), made.report.folded.len(), "{what}: what is folded is told");
}

/// The same surface, bent and turned.
fn bent(mesh: &Mesh) -> Mesh {
    let low = mesh.points().iter().fold(mesh.points()[0], |m, p| m.inf(p));
    let high = mesh.points().iter().fold(mesh.points()[0], |m, p| m.sup(p));
    let size = (high - low).norm();
    let bend = |p: &Point| {
        let q = (p - low) / size;
        Point::new(p.x + 0.1 * size * q.y * q.y, p.y + 0.08 * size * q.z * q.x, p.z + 0.1 * size * q.x * q.x)
    };
    mesh.moved(bend).expect("finite points")
}

/// The share of the surface whose Jacobian has a singular value below a quarter, by decomposing each.
fn squashed(made: &Made) -> f64 {
    let scale = (area(&made.shape) / area(&made.polycube)).sqrt();
    let plane = |[a, b, c]: [Point; 3]| {
        let (u, v) = (b - a, c - a);
        let e = u.normalize();
        let f = (v - e * v.dot(&e)).normalize();
        Matrix2::new(u.dot(&e), v.dot(&e), u.dot(&f), v.dot(&f))
    };
    let small = |t: &[u32; 3]| {
        let [before, after] = [&made.shape, &made.polycube].map(|m| plane(t.map(|v| m.points()[v as usize])));
        (after * before.try_inverse().expect("an area")).singular_values().min() * scale < 0.25
    };
    let doubled = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| made.shape.points()[v as usize]);
        (b - a).cross(&(c - a)).norm()
    };
    triangles(&made.shape).iter().filter(|t| small(t)).map(doubled).sum::<f64>() / 2.0 / area(&made.shape)
}

/// A square ring, one of whose bars runs up to a ridge: no edge tells how wide the facet around the hole is there.
fn ridged() -> Mesh {
    let bars = [([0, 0], [9, 2]), ([0, 7], [9, 9]), ([0, 2], [2, 7]), ([7, 2], [9, 7])];
    let bars = bars.map(|([a, b], [c, d])| Cuboid::new([a, b, 0], [c, d, 2]));
    let ring = Voxels::from_boxes(&bars).and_then(|v| v.mesh(CellKind::Triangles, 1.0)).expect("a ring");
    let lift = |p: &Point| Point::new(p.x, p.y, if p.z >= 2.0 { p.z + 1.5 * (p.x - 7.0).max(0.0) } else { p.z });
    ring.moved(lift).expect("finite points")
}

#[test]
fn little_is_squashed_and_how_much_is_told() {
    let shape = ridged();
    let made = made(&shape, "ridge");
    assert_good(&shape, &made, "ridge");
    assert!((squashed(&made) - made.report.squashed).abs() < 1e-9);
    assert!(made.report.squashed < 0.05, "{}", made.report.squashed);
}

#[test]
fn bent_random_polycubes_get_valid_polycubes_or_a_reason() {
    let mut valid = 0;
    let count = cases(24);
    for seed in 0..count {
        let voxels = random_polycube(seed, 1 + seed as usize % 6, 4 + seed as i64 % 5).unwrap();
        let shape = bent(&coarse(&voxels, CellKind::Triangles));
        let what = format!("seed {seed}");
        match make(&shape, &MakeOptions::default(), &Context::default()) {
            Ok(made) => {
                assert_good(&shape, &made, &what);
                valid += 1;
            }
            Err(e) => {
                assert!(e.kind == ErrorKind::Polycube && e.place.is_some() && !e.remedy.is_empty(), "{what}: {e}")
            }
        }
    }
    println!("{valid} of {count} valid");
    assert!(4 * valid >= 3 * count, "{valid} of {count}");
}

#[test]
fn examples_get_polycubes_whose_map_is_one_to_one() {
    for kind in Example::ALL {
        let (_, shape) = example(kind, 1, CellKind::Quads).unwrap();
        let found = made(&shape, &kind.to_string());
        assert_good(&shape, &found, &kind.to_string());
        assert!(found.report.folded.is_empty(), "{kind}: {} folded", found.report.folded.len());
    }
}

#[test]
fn the_same_shape_gives_the_same_bytes_for_any_number_of_threads() {
    let (_, shape) = example(Example::Ring, 1, CellKind::Triangles).unwrap();
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let found = pool.install(|| made(&shape, "ring"));
        [&found.shape, &found.polycube].map(|m| write_bytes(polycube::mesh::Format::Obj, m, &[]).unwrap())
    };
    assert!(bytes(1) == bytes(3));
}

/// What has sharp creases between faces along the axes is its own polycube: nothing is squashed, and no face looks
/// elsewhere, however it is cut into triangles. Turned a little, it still has the creases of one.
#[test]
fn the_faces_between_sharp_creases_are_the_facets() {
    let bracket = Voxels::from_boxes(&[Cuboid::new([0, 0, 0], [6, 2, 1]), Cuboid::new([0, 0, 1], [1, 2, 5])]).unwrap();
    let frame =
        Voxels::from_difference(&[Cuboid::new([0, 0, 0], [3, 3, 1])], &[Cuboid::new([1, 1, 0], [2, 2, 1])]).unwrap();
    let cube = Voxels::from_boxes(&[Cuboid::new([0, 0, 0], [1, 1, 1])]).unwrap();
    for (voxels, corners, step) in [(cube, 8, 2.0), (bracket.clone(), 12, 1.0), (bracket, 12, 0.5), (frame, 16, 1.0)] {
        let shape = voxels.mesh(CellKind::Triangles, step).unwrap();
        let found = made(&shape, "a polycube");
        assert_good(&shape, &found, "a polycube");
        let report = &found.report;
        assert_eq!((report.corners, report.folded.len()), (corners, 0));
        assert!(report.misfit < 1e-12 && report.squashed < 1e-12, "{report:?}");
        let turn = Rotation3::from_scaled_axis(Vector3::new(0.1, -0.2, 0.3));
        let turned = shape.moved(|p| turn * p).unwrap();
        let found = made(&turned, "a polycube, turned");
        assert_good(&turned, &found, "a polycube, turned");
        assert_eq!((found.report.corners, found.report.folded.len()), (corners, 0));
    }
}

#[test]
fn a_part_that_lies_askew_gets_the_corners_it_has_upright() {
    let (upright, _) = example(Example::SteppedL, 1, CellKind::Triangles).unwrap();
    let turn = Rotation3::from_euler_angles(0.4, -0.3, 0.5);
    let askew = Mesh::new(upright.points().iter().map(|p| turn * p).collect(), upright.cells().clone()).unwrap();
    let along = MakeOptions { axes: Axes::Best, ..MakeOptions::default() };
    let [own, best] = [&upright, &askew].map(|shape| make(shape, &along, &Context::default()).unwrap());
    assert_good(&askew, &best, "askew");
    assert_eq!((best.report.corners, own.report.rotation), (own.report.corners, None));
    assert!(best.report.misfit < 1e-9, "{}", best.report.misfit);
    let rows = best.report.rotation.expect("it was turned");
    assert!((nalgebra::Matrix3::from_fn(|i, j| rows[i][j]) * turn.matrix()).abs().is_identity(1e-6));
    let size = Some(Size::Hexes(400));
    let (_, meshes) =
        make::remesh(&askew, &along, &RemeshOptions { size, ..RemeshOptions::default() }, &Context::default()).unwrap();
    assert_eq!((meshes.report.inverted, meshes.report.within_hausdorff), (0, true));
}

#[test]
fn creases_give_way_where_fewer_corners_are_asked_for() {
    let bracket = Voxels::from_boxes(&[Cuboid::new([0, 0, 0], [6, 2, 1]), Cuboid::new([0, 0, 1], [1, 2, 2])]).unwrap();
    let shape = bracket.mesh(CellKind::Triangles, 0.5).unwrap();
    let few = make(&shape, &MakeOptions { corners: Some(8), ..MakeOptions::default() }, &Context::default()).unwrap();
    assert_good(&shape, &few, "a bracket");
    assert_eq!(few.report.corners, 8);
}

#[test]
fn corners_are_taken_away_until_few_are_left() {
    let (_, shape) = example(Example::SteppedL, 1, CellKind::Triangles).unwrap();
    let options = MakeOptions { corners: Some(8), ..MakeOptions::default() };
    let few = make(&shape, &options, &Context::default()).unwrap();
    assert_good(&shape, &few, "stepped-l");
    assert!(few.report.corners < made(&shape, "stepped-l").report.corners);
}

#[test]
fn the_seconds_of_a_shape_alone_have_the_making() {
    let (_, shape) = example(Example::SteppedL, 1, CellKind::Triangles).unwrap();
    let options = RemeshOptions { size: Some(Size::Hexes(300)), max_hausdorff: 1.0, ..RemeshOptions::default() };
    let (made, meshes) = make::remesh(&shape, &MakeOptions::default(), &options, &Context::default()).unwrap();
    let Stages { simplify, map, mesh, optimise, measure, total } = meshes.report.seconds;
    assert!(total >= made.report.seconds.total + simplify + map + mesh + optimise + measure);
    assert_eq!(meshes.report.simplify.seconds.total, total);
}

#[test]
fn what_is_no_closed_surface_is_refused_with_its_place() {
    let (_, shape) = example(Example::SteppedL, 1, CellKind::Triangles).unwrap();
    let refused = |mesh: &Mesh| make(mesh, &MakeOptions::default(), &Context::default()).unwrap_err();
    let all = triangles(&shape);
    let open = Mesh::new(shape.points().to_vec(), Cells::Triangles(all[1..].to_vec())).unwrap();
    assert!(matches!(refused(&open).place, Some(Place::Edge(..))));
    let (_, volume) = example(Example::SteppedL, 1, CellKind::Tetrahedra).unwrap();
    assert_eq!(refused(&volume).kind, ErrorKind::Unsupported);
    let options = MakeOptions { detail: f64::NAN, ..MakeOptions::default() };
    assert_eq!(make(&shape, &options, &Context::default()).unwrap_err().option, Some("detail"));
}

/// An L, whose creases are those of a polycube.
fn ell() -> Mesh {
    let boxes = [Cuboid::new([0; 3], [4, 2, 2]), Cuboid::new([0; 3], [2, 4, 2])];
    Voxels::from_boxes(&boxes).and_then(|v| v.mesh(CellKind::Triangles, 1.0)).expect("an L")
}

#[test]
fn what_has_one_right_answer_is_repaired_and_told() {
    let shape = ell();
    let all = triangles(&shape);
    let right = made(&shape, "ell");
    assert!(right.report.repairs.is_empty());

    let turned = all.iter().map(|t| [t[0], t[2], t[1]]).collect();
    let inward = Mesh::new(shape.points().to_vec(), Cells::Triangles(turned)).unwrap();
    let found = made(&inward, "inward");
    assert_eq!(found.report.repairs, [Repair::TurnedFaces(all.len())]);
    assert!(found.labels == right.labels && found.polycube.points() == right.polycube.points());
    let strict = MakeOptions { no_repair: true, ..MakeOptions::default() };
    assert_eq!(make(&inward, &strict, &Context::default()).unwrap_err().kind, ErrorKind::Mesh);

    // As STL has it: three vertices for every triangle.
    let points: Vec<Point> = all.iter().flatten().map(|&v| shape.points()[v as usize]).collect();
    let apart = (0..all.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let soup = Mesh::new(points, Cells::Triangles(apart)).unwrap();
    let found = made(&soup, "soup");
    assert_eq!(found.report.repairs, [Repair::Welded(soup.points().len() - shape.points().len())]);
    assert_eq!(found.report.corners, right.report.corners);
    assert_eq!(&found.shape.points()[..soup.points().len()], soup.points());
    assert!(make(&soup, &strict, &Context::default()).is_err());

    // Labels turn with faces that they went with.
    let labels: Vec<i8> = right.labels.iter().map(|label| label ^ 1).collect();
    let turned = triangles(&right.shape).iter().map(|t| [t[0], t[2], t[1]]).collect();
    let inward = Mesh::new(right.shape.points().to_vec(), Cells::Triangles(turned)).unwrap();
    let [found, again] = [(&inward, &labels), (&right.shape, &right.labels)].map(|(s, l)| labelled(s, l).unwrap());
    assert_eq!(found.report.repairs.len(), 2);
    assert!(found.labels == again.labels && found.polycube.points() == again.polycube.points());
}

#[test]
fn repairs_are_notes_of_the_mesh_of_a_shape_alone() {
    let shape = ell();
    let turned = triangles(&shape).iter().map(|t| [t[0], t[2], t[1]]).collect();
    let inward = Mesh::new(shape.points().to_vec(), Cells::Triangles(turned)).unwrap();
    let options = RemeshOptions { size: Some(Size::Hexes(400)), ..RemeshOptions::default() };
    let (made, meshes) = make::remesh(&inward, &MakeOptions::default(), &options, &Context::default()).unwrap();
    assert_eq!(meshes.report.simplify.notes[0], Note::Repaired(made.report.repairs[0]));
}

/// The polycube of a labelled shape.
fn labelled(shape: &Mesh, labels: &[i8]) -> polycube::Result<Made> {
    make(shape, &MakeOptions { labels: Some(labels.to_vec()), ..MakeOptions::default() }, &Context::default())
}

#[test]
fn labels_of_random_polycubes_get_polycubes_of_the_same_structure() {
    let count = cases(40);
    let (mut embedded, mut folded) = (0, 0_u64);
    for seed in 0..count {
        let voxels = random_polycube(seed, 1 + seed as usize % 6, 4 + seed as i64 % 5).unwrap();
        let cube = coarse(&voxels, CellKind::Triangles);
        let own = common::read(&cube);
        let (shape, labels, what) = (bent(&cube), common::labels(&own), format!("seed {seed}"));
        match labelled(&shape, &labels) {
            Ok(made) => {
                assert_good(&shape, &made, &what);
                let found = Polycube::new(&made.polycube, Some(&made.labels), &Tolerance::default()).unwrap();
                let sizes =
                    |p: &Polycube| (p.structure.corners.len(), p.structure.edges.len(), p.structure.facets.len());
                assert_eq!(sizes(&found), sizes(&own), "{what}");
                let convex = |p: &Polycube| p.structure.edges.iter().filter(|e| p.structure.is_convex(e)).count();
                assert_eq!(convex(&found), convex(&own), "{what}");
                embedded += 1;
                folded += u64::from(!made.report.folded.is_empty());
            }
            Err(e) => {
                assert!(e.kind == ErrorKind::Polycube && e.place.is_some() && !e.remedy.is_empty(), "{what}: {e}")
            }
        }
    }
    println!("{embedded} of {count} embedded, {folded} folded");
    assert!(20 * embedded >= 19 * count, "{embedded} of {count}");
    assert!(10 * folded <= count, "{folded} of {count} folded");
}

/// A bar along X, with the label of each of its faces, and its points moved.
fn bar(moved: impl Fn(&Point) -> Point) -> (Mesh, Vec<i8>) {
    let voxels = Voxels::from_boxes(&[Cuboid { min: [0, 0, 0], max: [12, 2, 2] }]).expect("a box");
    let cube = voxels.mesh(CellKind::Quads, 1.0).expect("a mesh");
    (cube.moved(moved).expect("finite points"), common::labels(&common::read(&cube)))
}

/// Bent once around, both ends of the bar lie side by side: how far edges lead along X says nothing, and where the bar
/// is bent farther, the opposite.
#[test]
fn edges_run_as_the_dihedral_angles_say_where_their_ends_do_not_tell() {
    for angle in [0.0, 180.0, 270.0, 330.0_f64] {
        let curl = |p: &Point| {
            let (radius, turn) = (6.0 - p.y, angle.to_radians() * p.x / 12.0);
            Point::new(radius * turn.sin(), -radius * turn.cos(), p.z + 0.3 * p.x)
        };
        let (shape, labels) = bar(|p| if angle == 0.0 { *p } else { curl(p) });
        let made = labelled(&shape, &labels).unwrap_or_else(|e| panic!("{angle} degrees: {e}"));
        assert_good(&made.shape, &made, "bar");
        assert_eq!((made.report.corners, made.report.facets), (8, 6), "{angle} degrees");
        assert_eq!(made.report.folded, [0; 0], "{angle} degrees");
    }
}

#[test]
fn labels_that_are_no_polycube_are_refused_with_their_place() {
    let (shape, labels) = bar(|p| *p);
    let faces = shape.cells().boundary().unwrap();
    let middle = |face: usize| faces[face].vertices().iter().map(|&v| shape.points()[v as usize].x).sum::<f64>() / 4.0;
    let told = |change: &dyn Fn(usize, i8) -> i8| {
        let changed: Vec<i8> = labels.iter().enumerate().map(|(face, &l)| change(face, l)).collect();
        let error = labelled(&shape, &changed).unwrap_err();
        assert!(!error.remedy.is_empty(), "{error}");
        (error.kind, error.place)
    };
    // +Y beside -Y: the edges between lie in one plane.
    let (kind, place) = told(&|face, l| if l == 2 && middle(face) < 6.0 { 3 } else { l });
    assert!(
        kind == ErrorKind::Polycube
            && matches!(place, Some(Place::Edge(a, b)) if [a, b].iter().all(|&v| {
                let p = shape.points()[v as usize];
                p.y == 2.0 && p.x <= 6.0
            })),
        "{place:?}"
    );
    // A chart of one face inside another has corners without the third axis.
    let face = (0..faces.len()).find(|&f| labels[f] == 4 && (5.0..6.0).contains(&middle(f))).unwrap();
    let (kind, place) = told(&|f, l| if f == face { 2 } else { l });
    assert!(kind == ErrorKind::Polycube && place.is_some(), "{place:?}");
    // All faces alike: a chart without border.
    assert!(matches!(told(&|_, _| 0), (ErrorKind::Polycube, Some(Place::Face(_)))));
    // Seen in a mirror every border turns the wrong way.
    assert!(matches!(told(&|_, l| if l < 2 { 1 - l } else { l }), (ErrorKind::Polycube, Some(Place::Face(_)))));
    assert_eq!(told(&|f, l| if f == 7 { -1 } else { l }), (ErrorKind::Mismatch, Some(Place::Face(7))));
    assert_eq!(labelled(&shape, &labels[1..]).unwrap_err().kind, ErrorKind::Mismatch);
}

/// The folder of plain shapes, beside that of the real polycubes.
fn shapes() -> Option<PathBuf> {
    let own = std::env::var_os("POLYCUBE_SHAPES").map(PathBuf::from);
    own.or_else(|| Some(data::folder()?.parent()?.join("shapes"))).filter(|folder| folder.is_dir())
}

/// Corners in sum, against those of a labeler of 2025, which the README of the shapes lists.
#[test]
fn real_shapes_get_no_more_corners_than_from_others() {
    let Some(folder) = shapes() else { return println!("skipped: no shapes") };
    let cases = [
        ("hexme_s09o_bridge", 16),
        ("mambo_B0", 16),
        ("cmu_rod", 32),
        ("cubespikes", 56),
        ("hexme_n05o_box_min_pcyls", 64),
        ("bob", 36),
        ("bunny_ihm", 42),
        ("rockerarm_ihm", 62),
    ];
    let (mut ours, mut theirs) = (0, 0);
    for (name, corners) in cases {
        let shape = read(&folder.join(format!("{name}.obj"))).unwrap();
        let found = made(&shape, name);
        assert_good(&shape, &found, name);
        println!("{name}: {} corners, {corners} by others", found.report.corners);
        (ours, theirs) = (ours + found.report.corners, theirs + corners);
    }
    assert!(ours <= theirs, "{ours} corners, {theirs} by others");
}
