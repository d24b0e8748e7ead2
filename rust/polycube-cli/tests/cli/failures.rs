//! Exit codes, messages, closed and full outputs, completions.

use super::{CellKind, Example, Sandbox, coarse};
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
    sandbox.fails("simplify l.obj -o file", 1, &["file", "name a folder"]);
    sandbox.fails("simplify l.obj -o file/out", 1, &["file/out"]);
}

#[test]
fn what_is_no_polycube_is_3_and_names_file_element_and_remedy() {
    let sandbox = Sandbox::new();
    let mut mesh = coarse(Example::SteppedL, CellKind::Triangles);
    sandbox.write_mesh("shape.obj", &coarse(Example::Ring, CellKind::Triangles));
    sandbox.write_mesh("l.obj", &mesh);
    sandbox.write("labels", "0\n1\n");
    sandbox.fails("simplify l.obj --shape shape.obj -o out", 3, &["polycube has", "without reordering"]);
    sandbox.fails("inspect l.obj --labels labels", 3, &["2 labels", "one label per face"]);
    mesh.points[10].x += 20.0;
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
    for word in ["Exit codes", "130"] {
        assert!(help.contains(word), "{word}");
    }
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = sandbox.ok(&format!("completions {shell}"));
        for name in ["simplify", "inspect", "validate", "demo", "view", "completions", "--edge-length"] {
            assert!(script.contains(name.trim_start_matches('-')), "{shell}: {name}");
            assert!(help.contains(name) || name.starts_with('-'));
        }
    }
    sandbox.fails("completions tcsh", 2, &["bash"]);
}
