//! Exit codes, messages, closed and full outputs, completions.

use super::{CellKind, Example, Sandbox, coarse};
use polycube::mesh::{self, Format, Point};
use std::process::Stdio;

#[test]
fn wrong_usage_is_2() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    for (line, word) in [
        ("", "Usage"),
        ("simplify l.obj", "--output"),
        ("simplify l.obj -o out --scale 0", "above 0"),
        ("simplify l.obj -o out --scale nan", "above 0"),
        ("simplify l.obj -o out --scale -3", "'-3' for '--scale <S>': expected a number above 0"),
        ("simplify l.obj -o out --steps -1", "expected a whole number of 0 or more"),
        ("simplify l.obj -o out --steps 1.5", "expected a whole number of 0 or more"),
        ("simplify l.obj -o out --proof-nodes x", "expected a whole number of 0 or more"),
        ("remesh l.obj --polycube l.obj -o out --hexes 0", "expected a whole number of 1 or more"),
        ("remesh l.obj --polycube l.obj -o out --hexes 9999999999", "from 1 to 4294967295"),
        ("compare l.obj --padding 17", "expected a whole number from 0 to 16"),
        ("demo -o out --seed -1", "expected a whole number of 0 or more"),
        ("simplify l.obj -o out --scale 1 --edge-length 1", "cannot be used with"),
        ("simplify l.obj -o out --lambda-min 2", "from 0 to 1"),
        ("simplify l.obj -o out --strategy best-effort", "paper"),
        ("simplify l.obj -o out --solver none", "exact"),
        ("simplify l.obj -o out --format pdf", ".vtu"),
        ("simplify l.obj -o out --format stl", "cannot hold quadrilaterals"),
        ("simplify l.obj -o out --angle-tolerance 50", "from 0 to 45"),
        ("simplify l.obj -o out --scale 1e12", "smaller scale"),
    ] {
        sandbox.fails(line, 2, &[word]);
    }
    assert_eq!(sandbox.names("."), ["l.obj"]);
}

#[test]
fn options_without_effect_are_wrong_usage() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    for option in [
        "--simplicity 1",
        "--steps 400",
        "--proof-nodes 3",
        "--time-limit 4",
        "--objective blocks",
        "--max-displacement 1",
        "--max-distortion 2",
        "--pareto",
    ] {
        let name = option.split(' ').next().unwrap();
        let told = format!("error: {name} is for `--strategy best`\n  remedy: leave it out");
        for strategy in ["paper", "naive"] {
            sandbox.fails(&format!("simplify l.obj -o out --strategy {strategy} {option}"), 2, &[&told]);
        }
        if option != "--pareto" {
            let line = format!("remesh l.obj --polycube l.obj -o out --strategy naive {option}");
            sandbox.fails(&line, 2, &[&told]);
        }
    }
    let told = "--lambda-min is for `--strategy best` or `paper`";
    sandbox.fails("simplify l.obj -o out --strategy naive --lambda-min 0.5", 2, &[told]);
    sandbox.fails("compare --pair l.obj l.obj --strategy paper --simplicity 0.5", 2, &["--simplicity is for"]);
    assert_eq!(sandbox.names("."), ["l.obj"]);
    sandbox.ok("simplify l.obj -o out --strategy paper --lambda-min 0.5 --solver exact");
}

#[test]
fn limits_beyond_the_end_of_the_clock_are_none() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    for seconds in ["1e19", "1e300"] {
        sandbox.run(&format!("simplify l.obj -o out-{seconds} --steps 5 --time-limit {seconds}"));
    }
}

#[test]
fn what_cannot_be_read_or_written_is_1() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    sandbox.write("bad.obj", "v 0 0 0\nf 1 x 3\n");
    sandbox.write("mesh.step", "");
    sandbox.write("file", "");
    sandbox.write("labels", "0\n7\n");
    sandbox.fails("simplify none.obj -o out", 1, &["none.obj", "check the path"]);
    sandbox.fails("simplify bad.obj -o out", 1, &["bad.obj", "line 2"]);
    sandbox.fails("inspect mesh.step", 1, &["mesh.step", ".obj"]);
    sandbox.fails("validate none.obj", 1, &["none.obj"]);
    sandbox.fails("simplify l.obj --labels labels -o out", 1, &["line 2", "labels", "from -1 to 5"]);
    assert!(!sandbox.path("out").exists());
    // A file that holds no mesh is not understood; that is no judgement of a polycube.
    sandbox.write("empty.obj", "");
    sandbox.write("nan.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n");
    sandbox.write("points.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nEnd\n");
    for (name, words) in [("empty.obj", "no cells"), ("nan.off", "vertex 2: "), ("points.mesh", "no cells")] {
        let start = format!("error: {name}: ");
        sandbox.fails(&format!("inspect {name}"), 1, &[&start, words]);
        sandbox.fails(&format!("simplify {name} -o out"), 1, &[&start]);
        sandbox.fails(&format!("view l.obj --hexes {name} -o page.html"), 1, &[&start]);
    }
    sandbox.fails("simplify l.obj -o file", 1, &["file", "name a folder"]);
    sandbox.fails("simplify l.obj -o file/out", 1, &["file/out"]);
}

#[test]
fn what_is_wrong_with_a_file_begins_with_its_name_and_line() {
    let sandbox = Sandbox::new();
    sandbox.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 x 0\nf 1 2 3\n");
    let remedy = "does not follow the format that its extension names; export it again or rename it";
    sandbox.fails("inspect bad.obj", 1, &["error: bad.obj: line 3: expected a coordinate, found \"x\"\n", remedy]);
    std::fs::create_dir(sandbox.path("folder.obj")).unwrap();
    let mesh = coarse(Example::SteppedL, CellKind::Triangles);
    sandbox.write_mesh("l.obj", &mesh);
    for line in ["inspect folder.obj", "validate folder.obj", "simplify l.obj --shape folder.obj -o out"] {
        sandbox.fails(line, 1, &["folder.obj is a folder", "name a mesh file"]);
    }
    sandbox.fails("simplify l.obj -o out --guides folder.obj", 1, &["folder.obj is a folder", "JSON"]);
    sandbox.fails("compare --list folder.obj", 1, &["folder.obj is a folder"]);
    sandbox.fails("inspect l.obj --labels folder.obj", 1, &["folder.obj is a folder", "name a file"]);
}

#[test]
fn files_under_the_extension_of_another_format_are_recognised() {
    let sandbox = Sandbox::new();
    let mesh = coarse(Example::SteppedL, CellKind::Triangles);
    let text = [Format::Obj, Format::Off, Format::Ply, Format::Medit, Format::Vtk, Format::Vtu];
    for (i, from) in text.into_iter().enumerate() {
        for to in [text[(i + 1) % text.len()], text[(i + 3) % text.len()], Format::Stl] {
            let name = format!("renamed-{from}.{to}");
            std::fs::write(sandbox.path(&name), mesh::write_bytes(from, &mesh, &[]).unwrap()).unwrap();
            let words = ["is it another format under this name?", &format!("as a .{from} file does")];
            sandbox.fails(&format!("inspect {name}"), 1, &words);
        }
    }
}

#[test]
fn a_shape_in_the_place_of_a_polycube_is_recognised() {
    let sandbox = Sandbox::new();
    let cube = coarse(Example::SteppedL, CellKind::Triangles);
    let turned = |p: &Point| Point::new(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z);
    let shape = cube.moved(turned).unwrap();
    sandbox.write_mesh("cube.obj", &cube);
    sandbox.write_mesh("shape.obj", &shape);
    let words =
        ["36.9 degrees off the nearest axis, more than 30;", "looks like a shape, not a polycube", "raise the angle"];
    sandbox.fails("simplify shape.obj -o out", 3, &words);
    assert!(sandbox.run("validate shape.obj").out.contains("looks like a shape, not a polycube"));
    let swapped = "swap the two: what was given as the shape is a polycube";
    sandbox.fails("simplify shape.obj --shape cube.obj -o out", 3, &[swapped]);
    assert!(sandbox.run("validate shape.obj --shape cube.obj").out.contains(swapped));
}

#[test]
fn what_is_no_polycube_is_3_and_names_file_element_and_remedy() {
    let sandbox = Sandbox::new();
    let mut mesh = coarse(Example::SteppedL, CellKind::Triangles);
    sandbox.write_mesh("shape.obj", &coarse(Example::Ring, CellKind::Triangles));
    sandbox.write_mesh("l.obj", &mesh);
    sandbox.write("labels", "0\n1\n");
    sandbox.fails(
        "simplify l.obj --shape shape.obj -o out",
        3,
        &["l.obj and shape.obj: the polycube has", "without reordering"],
    );
    sandbox.fails("inspect l.obj --labels labels", 3, &["2 labels", "one label per face"]);
    mesh = mesh.edited(|points, _| points[10].x += 20.0).unwrap();
    sandbox.write_mesh("skew.obj", &mesh);
    for line in ["simplify skew.obj -o out", "inspect skew.obj"] {
        sandbox.fails(line, 3, &["error: skew.obj: ", "remedy: ", "more like it"]);
    }
    assert!(!sandbox.path("out").exists());
}

#[test]
fn a_closed_output_is_no_panic() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    for line in ["--help", "completions bash", "inspect l.obj", "simplify l.obj -o out"] {
        let mut child = sandbox.command(line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let run = super::finished(&child.wait_with_output().unwrap());
        assert!(!run.err.contains("panicked"), "{line}: {}", run.err);
        assert!(line == "--help" || run.code == 0, "{line}: {}", run.err);
    }
    assert_eq!(sandbox.names("out").len(), 4);
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_output_is_reported_and_no_result_is_lost() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = sandbox.command("simplify l.obj -o out").stdout(full).output().unwrap();
    let run = super::finished(&output);
    assert_eq!(run.code, 1);
    assert!(run.err.contains("standard output"), "{}", run.err);
    assert_eq!(sandbox.names("out").len(), 4);
}

#[test]
fn help_and_completions_know_every_subcommand() {
    let sandbox = Sandbox::new();
    let help = sandbox.ok("--help");
    for word in ["Exit codes", "130", "Cherchi, Livesu and Scateni"] {
        assert!(help.contains(word), "{word}");
    }
    for line in ["", "simplify", "remesh", "compare", "view", "validate"] {
        let help = sandbox.ok(&format!("{line} --help"));
        let wide = help.lines().find(|l| l.chars().count() > 100);
        assert_eq!(wide, None, "{line}");
    }
    assert!(sandbox.ok("simplify --help").contains("\"symmetry\": [{\"axis\": 0, \"at\": 2.5}]"));
    assert!(sandbox.ok("remesh --help").contains("--hexes N with --surface-only"));
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = sandbox.ok(&format!("completions {shell}"));
        for name in ["simplify", "inspect", "validate", "demo", "view", "completions", "--edge-length"] {
            assert!(script.contains(name.trim_start_matches('-')), "{shell}: {name}");
            assert!(help.contains(name) || name.starts_with('-'));
        }
    }
    sandbox.fails("completions tcsh", 2, &["bash"]);
}
