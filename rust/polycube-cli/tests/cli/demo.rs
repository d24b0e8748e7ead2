//! `polycube demo`, and the other subcommands on what it wrote.

use super::Sandbox;

#[test]
fn a_newcomer_sees_the_main_job_run() {
    let sandbox = Sandbox::new();
    let text = sandbox.ok("demo");
    for word in ["cube-spikes", "surface patches", "blocks, padded", "Try next"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert_eq!(sandbox.names("polycube-demo"), ["cube-spikes", "examples"]);
    assert_eq!(sandbox.names("polycube-demo/examples").len(), 16);
    assert_eq!(sandbox.results("polycube-demo/cube-spikes"), "polycube.mesh");
    let report = sandbox.json("polycube-demo/cube-spikes/report.json");
    assert_eq!(report["after"]["blocks_padded"], 111);
    let next = text.lines().skip_while(|l| !l.starts_with("Try next")).filter_map(|l| l.strip_prefix("  polycube "));
    let commands: Vec<&str> = next.collect();
    assert_eq!(commands.len(), 4);
    for line in commands {
        sandbox.ok(line);
    }
}

#[test]
fn every_example_can_be_simplified_and_the_seed_matters() {
    let sandbox = Sandbox::new();
    assert_eq!(sandbox.ok("demo -q -o a --example ring --seed 7"), "");
    sandbox.ok("demo -q -o b --example double-torus --seed 8");
    let ring = |folder: &str| sandbox.read(&format!("{folder}/examples/ring.polycube.obj"));
    assert_ne!(ring("a"), ring("b"));
    assert_eq!(sandbox.json("a/ring/report.json")["valid"], true);
    assert_eq!(sandbox.json("b/double-torus/report.json")["valid"], true);
    sandbox.fails("demo --example cube", 2, &["cube-spikes"]);
}
