//! The main job on a real polycube.

use super::Sandbox;

#[test]
fn the_bunny_becomes_coarser() {
    let Some(data) = super::data::folder() else { return };
    let data = data.canonicalize().unwrap();
    let sandbox = Sandbox::new();
    let mut command = sandbox.command("simplify -o out");
    command.arg(data.join("marco2016sgp-bunny.polycube.obj"));
    command.arg("--shape").arg(data.join("marco2016sgp-bunny.shape.obj"));
    let run = super::finished(&command.output().unwrap());
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    assert_eq!(sandbox.results("out"), "polycube.obj");
    let report = sandbox.json("out/report.json");
    assert_eq!(report["valid"], true);
    assert!(report["after"]["blocks_padded"].as_u64().unwrap() <= 197);
}
