//! Ctrl-C.
#![cfg(unix)]

use super::{CellKind, Example, Sandbox};
use std::process::{Command, Stdio};
use std::time::Duration;

#[test]
fn ctrl_c_leaves_no_file() {
    let sandbox = Sandbox::new();
    let mesh = Example::CubeSpikes.voxels(1).unwrap().mesh(CellKind::Tetrahedra, 0.6).unwrap();
    sandbox.write_mesh("spikes.mesh", &mesh);
    for milliseconds in [100, 500, 1000] {
        let mut command = sandbox.command("simplify spikes.mesh -o out/deep");
        let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        let pid = child.id().to_string();
        assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
        let run = super::finished(&child.wait_with_output().unwrap());
        assert_eq!((run.code, run.err.as_str()), (130, "cancelled\n"), "after {milliseconds} ms: {}", run.out);
        assert_eq!(sandbox.names("."), ["spikes.mesh"]);
    }
}
