//! `--guides`, `--max-distortion` and `--pareto`.

use super::{CellKind, Example, Sandbox, coarse};
use polycube::mesh;
use serde_json::Value;

/// The coordinate of every facet before, in units of the input, and after, on the lattice.
fn facets(sandbox: &Sandbox, out: &str) -> Vec<(f64, i64)> {
    let file = sandbox.json(&format!("{out}/structure.json"));
    let level = |f: &Value| &file["levels"][f["level"].as_u64().unwrap() as usize];
    let at = |f: &Value| (level(f)["before"].as_f64().unwrap(), level(f)["after"].as_i64().unwrap());
    file["facets"].as_array().unwrap().iter().map(at).collect()
}

#[test]
fn a_file_of_guides_is_respected() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("spikes.obj", &coarse(Example::CubeSpikes, CellKind::Quads));
    sandbox.ok("simplify spikes.obj -o free --scale 2");
    let free = facets(&sandbox, "free");
    let off = |(before, after): &(f64, i64)| (2.0 * before).round() as i64 != *after;
    let moved = free.iter().position(off).expect("something moves");
    sandbox.write("guides.json", &format!("{{\"fixed\": [{moved}], \"fixed_labels\": [5]}}"));
    sandbox.ok("simplify spikes.obj -o kept --scale 2 --guides guides.json");
    let (kept, report) = (facets(&sandbox, "kept"), sandbox.json("kept/report.json"));
    let fixed = report["options"]["guides"]["fixed"].as_array().unwrap();
    assert!(fixed.len() > 1 && fixed.contains(&moved.into()), "{fixed:?}");
    assert!(fixed.iter().all(|f| !off(&kept[f.as_u64().unwrap() as usize])), "{kept:?}");
}

#[test]
fn remesh_takes_guides_and_the_options_of_the_search() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("spikes.obj", &coarse(Example::CubeSpikes, CellKind::Quads));
    let remesh = |options: &str| {
        sandbox.ok(&format!(
            "remesh spikes.obj --polycube spikes.obj -o out --surface-only --max-hausdorff 100 {options}"
        ));
        sandbox.json("out/report.json")
    };
    let free = remesh("");
    sandbox.write("guides.json", "{\"fixed_labels\": [0, 1, 2, 3, 4, 5]}");
    let kept = remesh("--guides guides.json");
    assert_eq!(kept["before"], kept["after"], "nothing moves");
    assert_ne!(free["after"], kept["after"]);
    assert!(kept["options"]["guides"]["fixed"].as_array().is_some_and(|f| f.len() > 20), "{kept}");
    let options = "--steps 7 --proof-nodes 3 --time-limit 50 --lambda-min 0.5 --solver linear";
    let used = remesh(options)["options"].clone();
    assert_eq!((&used["effort"]["steps_per_level"], &used["effort"]["proof_nodes"]), (&7.into(), &3.into()));
    assert_eq!((&used["lambda_min"], &used["solver"]), (&0.5.into(), &"linear".into()));
    sandbox.write("guides.json", "{\"fixed\": [999]}");
    let line = "remesh spikes.obj --polycube spikes.obj -o other --guides guides.json";
    sandbox.fails(line, 2, &["facet 999", "from 0 to"]);
}

#[test]
fn inspect_lists_the_facets_that_guides_name() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    sandbox.ok("simplify l.obj -o out");
    let found: Value = serde_json::from_str(&sandbox.ok("inspect l.obj --facets --json")).unwrap();
    let listed = found["facet_list"].as_array().unwrap().iter().map(|f| f["at"].as_f64().unwrap());
    assert!(listed.eq(facets(&sandbox, "out").iter().map(|f| f.0)));
    assert!(sandbox.ok("inspect l.obj --facets").contains("first face"));
}

#[test]
fn guides_that_cannot_be_say_why() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    for (text, code, words) in [
        ("{\"fixed\": [999]}", 2, ["error: guides.json: facet 999: ", "from 0 to"]),
        ("{\"fixed_labels\": [6]}", 2, ["error: guides.json: there is no label 6", "from 0 to 5"]),
        ("{\"fixed_faces\": [99999]}", 2, ["error: guides.json: face 99999: ", "from 0 on"]),
        ("{\n\"fixd\": [1]}", 1, ["error: guides.json: line 2: ", "simplify --help"]),
        ("{\"symmetry\": [{\"axis\": 0, \"at\": 123.0}]}", 2, ["guides.json: ", "X = 123"]),
    ] {
        sandbox.write("guides.json", text);
        sandbox.fails("simplify l.obj -o out --guides guides.json", code, &words);
    }
    sandbox.fails("simplify l.obj -o out --guides none.json", 1, &["none.json", "check the path"]);
    sandbox.fails("simplify l.obj -o out --max-distortion 0.9", 2, &["1 or more"]);
    assert!(!sandbox.path("out").exists());
}

#[test]
fn every_point_of_the_front_is_measured_and_written() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("ring.obj", &coarse(Example::Ring, CellKind::Quads));
    let text = sandbox.ok("simplify ring.obj -o out --scale 8 --pareto");
    let report = sandbox.json("out/report.json");
    let (front, points) = (report["front"].as_array().unwrap(), report["pareto"].as_array().unwrap());
    assert!(points.len() >= 2 && points.len() == front.len());
    assert_eq!(sandbox.names("out/front").len(), points.len());
    assert_eq!((&points[0]["counts"], &points[0]["chosen"]), (&report["after"], &true.into()));
    assert_eq!(points[0]["distortion"], report["distortion"][1]);
    for point in points {
        let name = point["file"].as_str().unwrap();
        let mesh = mesh::read(&sandbox.path(&format!("out/{name}"))).unwrap();
        assert_eq!(mesh.cells().kind(), CellKind::Quads);
        // Faces that the morph turned over would be read by their normals otherwise.
        let told = sandbox.ok(&format!("inspect --json out/{name} --labels out/polycube.labels"));
        let found: Value = serde_json::from_str(&told).unwrap();
        assert_eq!(found["counts"], point["counts"], "{name}");
    }
    assert!(text.contains("(chosen)"), "{text}");
    let angle = |p: &Value| p["distortion"]["angle"].as_f64().unwrap();
    let least = points.iter().map(angle).fold(f64::INFINITY, f64::min);
    assert!(least < angle(&points[0]), "there is something to choose");
    let limit = f64::midpoint(least, angle(&points[0]));
    sandbox.ok(&format!("simplify ring.obj -o out --scale 8 --max-distortion {limit}"));
    assert!(sandbox.json("out/report.json")["distortion"][1]["angle"].as_f64().unwrap() <= limit);
    assert!(!sandbox.path("out/front").exists(), "the points of the earlier run are gone, and their folder");
}
