//! `polycube validate`: every rule, broken by hand.

use super::{Sandbox, bent};
use polycube::generate::{Cuboid, Voxels};
use polycube::mesh::CellKind;
use polycube::mesh::{self, Cells, Mesh, Point};
use polycube::structure::{Polycube, Tolerance};
use serde_json::Value;

/// A cube with sides of `n` and unit cells.
fn cube(n: i64, kind: CellKind) -> Mesh {
    boxes(&[([0; 3], [n; 3])], kind)
}

fn boxes(boxes: &[([i64; 3], [i64; 3])], kind: CellKind) -> Mesh {
    let boxes: Vec<Cuboid> = boxes.iter().map(|&(low, high)| Cuboid::new(low, high)).collect();
    Voxels::from_boxes(&boxes).unwrap().mesh(kind, 1.0).unwrap()
}

fn labels(mesh: &Mesh) -> Vec<i8> {
    Polycube::new(mesh, None, &Tolerance::default()).unwrap().labels().map(|l| l.index() as i8).collect()
}

/// Changes the faces of a mesh of quadrilaterals.
fn edit(mesh: &mut Mesh, change: impl FnOnce(&mut Vec<[u32; 4]>)) {
    let (points, cells) = mesh.clone().into_parts();
    let Cells::Quads(mut quads) = cells else { panic!("not quadrilaterals") };
    change(&mut quads);
    *mesh = Mesh::new(points, Cells::Quads(quads)).unwrap();
}

/// Changes the place of one vertex.
fn place(mesh: &mut Mesh, v: usize, change: impl FnOnce(&mut Point)) {
    *mesh = mesh.clone().edited(|points, _| change(&mut points[v])).unwrap();
}

fn vertex(mesh: &Mesh, at: [f64; 3]) -> usize {
    mesh.points().iter().position(|p| *p == Point::from(at)).unwrap()
}

/// The face of a cube of quadrilaterals whose centre is `at`.
fn face(mesh: &Mesh, at: [f64; 3]) -> usize {
    let along =
        |i: usize, axis: usize| mesh.cells().cell(i).iter().map(|&v| mesh.points()[v as usize][axis]).sum::<f64>();
    (0..mesh.cells().len()).find(|&i| [0, 1, 2].map(|axis| along(i, axis) / 4.0) == at).unwrap()
}

fn check(sandbox: &Sandbox, line: &str) -> Value {
    let run = sandbox.run(&format!("validate --json {line}"));
    assert_eq!((run.code, run.err.as_str()), (3, ""), "{line}: {}", run.out);
    let text = sandbox.run(&format!("validate {line}"));
    let verdict: Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!((text.code, &verdict["valid"]), (3, &false.into()));
    let rule = verdict["violations"][0]["rule"].as_str().unwrap();
    let remedy = verdict["violations"][0]["remedy"].as_str().unwrap();
    assert!(!remedy.is_empty() && text.out.contains(rule) && text.out.contains(remedy), "{line}: {}", text.out);
    verdict
}

/// Asserts that `rule` is broken and gives the first finding of it.
fn broken(line: &str, sandbox: &Sandbox, rule: &str) -> Value {
    let verdict = check(sandbox, line);
    let findings = verdict["violations"].as_array().unwrap();
    let found = findings.iter().find(|f| f["rule"] == rule);
    found.unwrap_or_else(|| panic!("{rule}: {verdict}")).clone()
}

fn broken_mesh(mesh: &Mesh, rule: &str) -> Value {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("bad.vtk", mesh);
    broken("bad.vtk", &sandbox, rule)
}

fn broken_labels(mesh: &Mesh, labels: &[i8], rule: &str) -> Value {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("bad.obj", mesh);
    mesh::write_labels(&sandbox.path("labels"), labels).unwrap();
    broken("bad.obj --labels labels", &sandbox, rule)
}

#[test]
fn what_is_valid_is_told() {
    let sandbox = Sandbox::new();
    for kind in CellKind::ALL {
        let mesh = cube(3, kind);
        sandbox.write_mesh("good.vtk", &mesh);
        sandbox.write_mesh("shape.vtk", &bent(&mesh));
        assert_eq!(sandbox.ok("validate good.vtk --shape shape.vtk"), "good.vtk: valid\n");
        let verdict: Value = serde_json::from_str(&sandbox.ok("validate good.vtk --json")).unwrap();
        assert_eq!(verdict["valid"], true);
    }
}

#[test]
fn a_shape_is_checked_for_what_makes_it_a_solid() {
    let sandbox = Sandbox::new();
    let mut mesh = bent(&cube(2, CellKind::Quads));
    sandbox.write_mesh("shape.obj", &mesh);
    assert_eq!(sandbox.ok("validate --as-shape shape.obj"), "shape.obj: valid\n");
    place(&mut mesh, 0, |p| (p.x, p.y, p.z) = (p.x + 0.7, p.y + 1.1, p.z + 3.0));
    sandbox.write_mesh("shape.obj", &mesh);
    let found = broken("--as-shape shape.obj", &sandbox, "crossing_faces");
    assert_eq!((&found["mesh"], found["at"].as_array().map(Vec::len)), (&"shape".into(), Some(3)));
    edit(&mut mesh, |quads| quads.truncate(quads.len() - 1));
    sandbox.write_mesh("shape.obj", &mesh);
    assert_eq!(broken("--as-shape shape.obj", &sandbox, "open_edge")["mesh"], "shape");
    let run = sandbox.run("validate --as-shape shape.obj --shape shape.obj");
    assert!(run.code == 2 && run.err.contains("--as-shape"), "{}", run.err);
}

#[test]
fn files_that_hold_no_mesh() {
    let sandbox = Sandbox::new();
    for extension in ["obj", "stl"] {
        sandbox.write(&format!("empty.{extension}"), "");
        broken(&format!("empty.{extension}"), &sandbox, "empty");
    }
    sandbox.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2 3\n");
    assert_eq!(broken("bad.obj", &sandbox, "malformed")["element"]["line"], 3);
    sandbox.write("nan.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n");
    assert_eq!(broken("nan.off", &sandbox, "not_finite")["element"]["vertex"], 2);
}

#[test]
fn shape_and_polycube_that_do_not_match() {
    let sandbox = Sandbox::new();
    let mut shape = cube(2, CellKind::Quads);
    sandbox.write_mesh("p.obj", &shape);
    edit(&mut shape, |quads| quads[3].rotate_left(1));
    sandbox.write_mesh("s.obj", &shape);
    assert_eq!(broken("p.obj --shape s.obj", &sandbox, "mismatch")["element"]["cell"], 3);
    sandbox.write_mesh("s.obj", &cube(3, CellKind::Quads));
    broken("p.obj --shape s.obj", &sandbox, "mismatch");
}

#[test]
fn a_broken_shape_is_named_and_not_its_polycube() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("p.obj", &cube(2, CellKind::Quads));
    for (name, text) in [("bad", "v 0 0 0\nv 1 0 0\nv 0 1 zero\n"), ("nan", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")] {
        sandbox.write(&format!("{name}.obj"), text);
        let line = format!("p.obj --shape {name}.obj");
        assert_eq!(check(&sandbox, &line)["violations"][0]["mesh"], "shape");
        let out = sandbox.run(&format!("validate {line}")).out;
        assert!(out.starts_with(&format!("{name}.obj: 1 violation")) && !out.contains("p.obj"), "{out}");
        let out = sandbox.run(&format!("validate {name}.obj --shape p.obj")).out;
        assert!(out.starts_with(&format!("{name}.obj: 1 violation")) && !out.contains("p.obj"), "{out}");
    }
}

#[test]
fn surfaces_that_are_not_closed_oriented_manifolds() {
    let mut open = cube(2, CellKind::Quads);
    edit(&mut open, |quads| quads.truncate(quads.len() - 1));
    assert_eq!(broken_mesh(&open, "open_edge")["at"].as_array().unwrap().len(), 3);
    let mut fin = cube(2, CellKind::Quads);
    edit(&mut fin, |quads| quads.push([1, 0, 3, 2].map(|k| quads[0][k])));
    broken_mesh(&fin, "non_manifold_edge");
    let mut turned = cube(2, CellKind::Quads);
    edit(&mut turned, |quads| quads[5].reverse());
    broken_mesh(&turned, "inconsistent_orientation");
    let touching = boxes(&[([0; 3], [1; 3]), ([1; 3], [2; 3])], CellKind::Quads);
    let found = broken_mesh(&touching, "non_manifold_vertex");
    assert_eq!(found["at"], serde_json::json!([1.0, 1.0, 1.0]));
}

#[test]
fn faces_that_look_nowhere_or_aslant() {
    let mut flat = cube(4, CellKind::Triangles);
    let v = vertex(&flat, [2.0, 2.0, 4.0]);
    place(&mut flat, v, |p| *p = Point::new(1.0, 2.0, 4.0));
    broken_mesh(&flat, "flat_face");
    let mut skew = cube(4, CellKind::Triangles);
    place(&mut skew, v, |p| p.z += 1.5);
    let found = broken_mesh(&skew, "skew_face");
    assert!(found["element"]["face"].is_u64() && found["message"].as_str().unwrap().contains("degrees"));
}

#[test]
fn labels_that_make_no_polycube() {
    let mesh = cube(4, CellKind::Quads);
    let good = labels(&mesh);
    let relabelled = |changes: &[([f64; 3], i8)]| {
        let mut labels = good.clone();
        changes.iter().for_each(|&(at, label)| labels[face(&mesh, at)] = label);
        labels
    };
    broken_labels(&mesh, &relabelled(&[([3.5, 1.5, 4.0], 1)]), "opposite_charts");
    broken_labels(&mesh, &relabelled(&[([1.5, 1.5, 4.0], 0), ([2.5, 2.5, 4.0], 0)]), "incomplete_corner");
    let found = broken_labels(&mesh, &relabelled(&[([1.5, 1.5, 4.0], 0)]), "too_few_corners");
    assert!(found["message"].as_str().unwrap().contains("0 corners"));
    let frame = [([0, 0, 0], [3, 1, 1]), ([0, 2, 0], [3, 3, 1]), ([0, 1, 0], [1, 2, 1]), ([2, 1, 0], [3, 2, 1])];
    let ring = boxes(&frame, CellKind::Quads);
    broken_labels(&ring, &vec![4; ring.cells().len()], "chart_with_handle");
}

#[test]
fn edges_and_levels_that_are_out_of_place() {
    let mut step = boxes(&[([0; 3], [4, 4, 2]), ([0, 0, 2], [2, 4, 4])], CellKind::Quads);
    let step_labels = labels(&step);
    step = step.moved(|p| Point::new(p.x, p.y, p.z.min(2.0))).unwrap();
    broken_labels(&step, &step_labels, "zero_length_edge");
    let mut back = cube(4, CellKind::Quads);
    let v = vertex(&back, [2.0, 0.0, 0.0]);
    place(&mut back, v, |p| p.x = 0.2);
    broken_mesh(&back, "non_monotone_edge");
    let mut bulge = cube(4, CellKind::Quads);
    let v = vertex(&bulge, [2.0, 2.0, 4.0]);
    place(&mut bulge, v, |p| p.z += 0.9);
    let bulge_labels = labels(&cube(4, CellKind::Quads));
    assert!(broken_labels(&bulge, &bulge_labels, "off_level")["message"].as_str().unwrap().contains("0.450"));
}

#[test]
fn surfaces_that_cross_themselves_or_look_inward() {
    let mut crossing = cube(2, CellKind::Quads);
    let beside = crossing.moved(|p| Point::new(p.x + 1.0, p.y + 1.0, p.z + 1.0)).unwrap();
    let count = crossing.points().len() as u32;
    crossing = crossing.edited(|points, _| points.extend(beside.points())).unwrap();
    edit(&mut crossing, |quads| quads.extend(quads.clone().iter().map(|q| q.map(|v| v + count))));
    assert!(broken_mesh(&crossing, "self_overlap")["message"].as_str().unwrap().contains("face"));
    let mut inward = cube(2, CellKind::Quads);
    edit(&mut inward, |quads| quads.iter_mut().for_each(|q| q.reverse()));
    broken_mesh(&inward, "inside_out");
}

#[test]
fn elements_that_are_inverted() {
    for kind in [CellKind::Tetrahedra, CellKind::Hexahedra] {
        let good = cube(2, kind);
        let mut bad = good.clone();
        let v = vertex(&bad, [1.0, 1.0, 1.0]);
        place(&mut bad, v, |p| p.x = 3.0);
        let found = broken_mesh(&bad, "inverted_cell");
        assert!(found["element"]["cell"].is_u64() && found["mesh"] == "polycube");
        let sandbox = Sandbox::new();
        sandbox.write_mesh("p.vtu", &good);
        sandbox.write_mesh("s.vtu", &bad);
        assert_eq!(broken("p.vtu --shape s.vtu", &sandbox, "inverted_cell")["mesh"], "shape");
    }
    let mut folded = cube(4, CellKind::Quads);
    let v = vertex(&folded, [1.0, 2.0, 4.0]);
    place(&mut folded, v, |p| p.x = 2.5);
    broken_mesh(&folded, "flipped_face");
}
