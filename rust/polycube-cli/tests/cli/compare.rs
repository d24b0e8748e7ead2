//! `polycube compare`.

use super::Sandbox;
use polycube::generate::{Example, example};
use polycube::mesh::CellKind;
use serde_json::Value;

/// A sandbox with two pairs in the folder `pairs`, one pair of other names and one broken pair.
fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    std::fs::create_dir(sandbox.path("pairs")).unwrap();
    for (name, pick) in [("l", Example::SteppedL), ("ring", Example::Ring)] {
        let (polycube, shape) = example(pick, 1, CellKind::Tetrahedra).unwrap();
        sandbox.write_mesh(&format!("pairs/{name}.polycube.mesh"), &polycube);
        sandbox.write_mesh(&format!("pairs/{name}.shape.mesh"), &shape);
    }
    let (polycube, shape) = example(Example::SteppedL, 2, CellKind::Triangles).unwrap();
    sandbox.write_mesh("cube.obj", &polycube);
    sandbox.write_mesh("bent.obj", &shape);
    sandbox.write_mesh("bad.polycube.obj", &shape);
    sandbox.write_mesh("bad.shape.obj", &shape);
    sandbox
}

#[test]
fn the_numbers_are_those_of_remesh() {
    let sandbox = sandbox();
    let told = sandbox.ok("compare pairs -q --hexes 250 --format json");
    let rows: Value = serde_json::from_str(&told).unwrap();
    let models: Vec<&str> = rows.as_array().unwrap().iter().map(|r| r["model"].as_str().unwrap()).collect();
    assert_eq!(models, ["l.mesh", "ring.mesh"]);
    // 4: so coarse a mesh is farther from the shape than asked for.
    let remesh = |options: &str| {
        let run = sandbox.run(&format!("remesh pairs/l.shape.mesh --polycube pairs/l.polycube.mesh -q {options}"));
        assert!(matches!(run.code, 0 | 4), "{options}: {}", run.err);
    };
    remesh("-o plain --strategy naive --hexes 250");
    let found = &rows[0]["comparison"];
    same(&found["without"], &sandbox.json("plain/report.json"));
    let hexes = &found["without"]["hexes"];
    remesh(&format!("-o simplified --hexes {hexes}"));
    same(&found["with"], &sandbox.json("simplified/report.json"));
    for row in rows.as_array().unwrap() {
        let hexes = |side: &str| row["comparison"][side]["hexes"].as_f64().unwrap();
        assert!((0.75..1.25).contains(&(hexes("with") / hexes("without"))), "{row}");
        assert!(row["error"].is_null());
    }
}

/// Asserts that a part of a comparison says what the report of `remesh` does.
fn same(found: &Value, report: &Value) {
    for key in ["hexes", "quads", "inverted", "min_sj", "avg_sj", "hausdorff", "hausdorff_percent"] {
        assert_eq!(found[key], report[key], "{key}");
    }
    for (key, whole, part) in [
        ("max_edge_ratio", "edge_ratio", "max"),
        ("min_determinant", "determinant", "min"),
        ("max_non_orthogonality", "non_orthogonality", "max"),
        ("max_skewness", "skewness", "max"),
    ] {
        assert_eq!(found[key], report[whole][part], "{key}");
    }
    for key in ["surface_patches", "blocks", "blocks_padded"] {
        assert_eq!(found[key], report["after"][key], "{key}");
    }
    assert_eq!(found["blocks_padded"], report["hex_blocks"]);
}

#[test]
fn what_fails_has_a_line_and_the_others_go_on() {
    let sandbox = sandbox();
    sandbox.write("list", "# shape, tab, polycube\nbent.obj\tcube.obj\nnone.polycube.off\n");
    let run = sandbox.run("compare bad.polycube.obj --list list --hexes 300 -q --surface-only --format csv");
    assert_eq!(run.code, 1);
    assert_eq!(run.err.matches("error: ").count(), 2, "{}", run.err);
    assert!(run.err.contains("bad.obj") && run.err.contains("none.polycube.off"), "{}", run.err);
    let lines: Vec<Vec<&str>> = run.out.lines().map(|l| l.split(',').collect()).collect();
    let column = |name: &str| lines[0].iter().position(|n| *n == name).unwrap();
    let told = |name: &str| lines[1..].iter().map(|l| l[column(name)]).collect::<Vec<_>>();
    assert_eq!(told("model"), ["bad.obj", "cube.obj", "cube.obj", "none.off"]);
    assert_eq!(told("simplification"), ["", "without", "with", ""]);
    assert_eq!(told("strategy"), ["", "naive", "best", ""]);
    assert!(run.out.lines().nth(4).unwrap().contains("none.polycube.off"));
    let patches: Vec<f64> = told("surface_patches").iter().filter_map(|x| x.parse().ok()).collect();
    let gain: f64 = told("gain_surface_patches")[2].parse().unwrap();
    assert!((gain - 100.0 * (patches[0] - patches[1]) / patches[0]).abs() < 1e-9);
}

#[test]
fn tables_for_the_terminal_and_for_documents() {
    let sandbox = sandbox();
    let line = "compare --pair bent.obj cube.obj --hexes 300 -q --surface-only";
    let text = sandbox.ok(line);
    assert!(["model", "without", "with", "cube.obj", "fewer patches\n"].iter().all(|w| text.contains(w)), "{text}");
    assert_eq!(sandbox.ok(&format!("{line} --format markdown -o new/table.md")), "");
    let text = String::from_utf8(sandbox.read("new/table.md")).unwrap();
    assert!(text.starts_with('|'), "{text}");
    let table: Vec<&str> = text.lines().take_while(|l| !l.is_empty()).collect();
    assert_eq!(table.len(), 4, "{text}");
    let columns = |l: &&str| l.matches('|').count();
    assert!(table.iter().all(|l| columns(l) == 19 && l.starts_with('|') && l.ends_with('|')), "{text}");
    assert!(table[1].chars().all(|c| "|-: ".contains(c)), "{text}");
}

#[test]
fn the_format_follows_the_file_and_a_failure_is_told_once() {
    let sandbox = sandbox();
    let line = "compare --pair none.obj none.obj -q";
    for (file, start) in [("t.csv", "model,"), ("t.MD", "|"), ("t.json", "["), ("t.txt", " model")] {
        let run = sandbox.run(&format!("{line} -o {file}"));
        assert_eq!((run.code, run.out.as_str()), (1, ""), "{}", run.err);
        let text = String::from_utf8(sandbox.read(file)).unwrap();
        assert!(text.starts_with(start) && text.contains("cannot read none.obj"), "{file}: {text}");
    }
    sandbox.run(&format!("{line} -o u.csv --format json"));
    assert!(sandbox.read("u.csv").starts_with(b"["));
    let run = sandbox.run(line);
    assert!(run.out.contains("failed") && !run.out.contains("cannot read"), "{}", run.out);
    assert_eq!(run.err.matches("cannot read none.obj").count(), 1, "{}", run.err);
}

#[test]
fn wrong_usage_is_told_before_any_work() {
    let sandbox = sandbox();
    sandbox.fails("compare", 2, &["nothing to compare", "--pair"]);
    sandbox.fails("compare cube.obj", 2, &["NAME.polycube.EXT"]);
    sandbox.fails("compare --pair cube.obj", 2, &["--pair"]);
    sandbox.fails("compare nodir", 1, &["nodir does not exist", "check the path"]);
    std::fs::create_dir(sandbox.path("bare")).unwrap();
    sandbox.fails("compare pairs bare", 2, &["no pairs in the folder bare", "NAME.polycube.EXT and NAME.shape.EXT"]);
    sandbox.fails("compare --list none", 1, &["none"]);
    sandbox.fails("compare pairs --hexes 9 --scale 1", 2, &["cannot be used"]);
    sandbox.write("list", "a\tb\tc\n");
    sandbox.fails("compare --list list", 1, &["line 1", "list"]);
}
