//! `polycube make`, and `polycube remesh` without a polycube.

use super::Sandbox;
use polycube::generate::{Example, example};
use polycube::mesh::{self, CellKind, Cells};
use polycube::structure::{Polycube, Tolerance};
use serde_json::json;

/// A sandbox with a plain shape named `shape.obj`.
fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    let (_, shape) = example(Example::Ring, 1, CellKind::Quads).unwrap();
    sandbox.write_mesh("shape.obj", &shape);
    sandbox
}

#[test]
fn what_is_made_is_valid_and_can_be_meshed() {
    let sandbox = sandbox();
    let out = sandbox.ok("make shape.obj -o out");
    assert!(out.contains("corners") && out.contains("genus 1"), "{out}");
    assert_eq!(sandbox.names("out"), ["polycube.labels", "polycube.obj", "report.json", "shape.obj"]);
    sandbox.ok("validate out/polycube.obj --labels out/polycube.labels --shape out/shape.obj");
    let [shape, cube] = ["shape", "polycube"].map(|f| mesh::read(&sandbox.path(&format!("out/{f}.obj"))).unwrap());
    assert_eq!(shape.cells(), cube.cells());
    let report = sandbox.json("out/report.json");
    assert_eq!((report["genus"].as_u64(), &report["folded"]), (Some(1), &json!([])));
    sandbox.ok("simplify out/polycube.obj --labels out/polycube.labels --shape out/shape.obj -o simple -q");
}

#[test]
fn a_shape_that_looks_inward_is_turned_unless_it_is_to_be_taken_as_it_is() {
    let sandbox = Sandbox::new();
    let (_, shape) = example(Example::Ring, 1, CellKind::Triangles).unwrap();
    let inward = shape.edited(|_, cells| {
        if let Cells::Triangles(all) = cells {
            all.iter_mut().for_each(|t| t.swap(0, 1));
        }
    });
    sandbox.write_mesh("inward.obj", &inward.unwrap());
    assert!(sandbox.ok("make inward.obj -o out").contains("note: repaired: "));
    assert!(sandbox.json("out/report.json")["repairs"][0].as_str().unwrap().contains("turned to look outward"));
    sandbox.fails("make inward.obj -o no --no-repair", 3, &["looks inward", "remedy: "]);
}

#[test]
fn a_shape_alone_is_meshed() {
    let sandbox = sandbox();
    // 4: so coarse a mesh may be far from the shape.
    let run = sandbox.run("remesh shape.obj -o out --hexes 1500 -q");
    assert!([0, 4].contains(&run.code), "{}", run.err);
    let report = sandbox.json("out/report.json");
    assert_eq!((report["inverted"].as_u64(), &report["input"]["polycube"]), (Some(0), &serde_json::Value::Null));
}

#[test]
fn a_labelled_shape_gets_the_polycube_of_its_labels() {
    let sandbox = Sandbox::new();
    let (cube, shape) = example(Example::Ring, 1, CellKind::Quads).unwrap();
    sandbox.write_mesh("shape.obj", &shape);
    let found = Polycube::new(&cube, None, &Tolerance::default()).unwrap();
    let text = |labels: &[usize]| labels.iter().map(|l| format!("{l}\n")).collect::<String>();
    let labels: Vec<usize> = found.labels().map(|l| l.index()).collect();
    sandbox.write("shape.labels", &text(&labels));
    sandbox.ok("make shape.obj --labels shape.labels -o out");
    let words = ["labelled shape", "polycube make"];
    for command in ["inspect", "simplify -o no"] {
        sandbox.fails(&format!("{command} shape.obj --labels shape.labels"), 3, &words);
    }
    let run = sandbox.run("validate shape.obj --labels shape.labels");
    assert!(run.code == 3 && words.iter().all(|word| run.out.contains(word)), "{}", run.out);
    let report = sandbox.json("out/report.json");
    assert_eq!(report["facets"].as_u64(), Some(found.structure.facets.len() as u64));
    assert_eq!((&report["labels"], &report["options"]), (&json!("shape.labels"), &json!(null)));
    assert_eq!(report["folded"], json!([]));
    sandbox.ok("validate out/polycube.obj --labels out/polycube.labels --shape out/shape.obj");
    // 4: so coarse a mesh may be far from the shape.
    let run = sandbox.run("remesh shape.obj --labels shape.labels -o mesh --hexes 1500 -q");
    assert!([0, 4].contains(&run.code), "{}", run.err);
    assert_eq!(sandbox.json("mesh/report.json")["inverted"].as_u64(), Some(0));

    let opposite: Vec<usize> = labels.iter().map(|&l| if l == 2 { 1 } else { l }).collect();
    sandbox.write("wrong.labels", &text(&opposite));
    sandbox.fails("make shape.obj --labels wrong.labels -o no", 3, &["shape.obj", "edge", "opposite label"]);
    sandbox.fails("make shape.obj --labels shape.labels --corners 8 -o no", 2, &["--corners"]);
    assert!(!sandbox.path("no").exists());
}

#[test]
fn options_of_making_and_of_a_polycube_exclude_each_other() {
    let sandbox = sandbox();
    for (arguments, word) in [
        ("--polycube shape.obj --detail 0.3", "--detail"),
        ("--polycube shape.obj --corners 9", "--corners"),
        ("--polycube shape.obj --axes best", "--axes"),
        ("--labels x.labels --detail 0.3", "--detail"),
        ("--labels x.labels --axes best", "--axes"),
        ("--axes worst", "[possible values: keep, best]"),
        ("--detail 1.5", "from 0 to 1"),
    ] {
        sandbox.fails(&format!("remesh shape.obj -o out {arguments}"), 2, &[word]);
    }
}

#[test]
fn an_open_surface_is_refused_with_the_edge() {
    let sandbox = Sandbox::new();
    sandbox.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
    sandbox.fails("make open.obj -o out", 3, &["open.obj", "edge"]);
    assert!(!sandbox.path("out").exists());
}
