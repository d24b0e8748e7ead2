//! Ctrl-C.
#![cfg(target_os = "linux")]

use super::{CellKind, Example, Sandbox};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

#[test]
fn ctrl_c_leaves_no_file() {
    let sandbox = Sandbox::new();
    let mesh = Example::CubeSpikes.voxels(1).unwrap().mesh(CellKind::Tetrahedra, 0.6).unwrap();
    sandbox.write_mesh("spikes.mesh", &mesh);
    for milliseconds in [0, 400, 800, 1600] {
        let mut command = sandbox.command("simplify spikes.mesh -o out/deep");
        let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        wait_for_handler(&child);
        std::thread::sleep(Duration::from_millis(milliseconds));
        let pid = child.id().to_string();
        assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
        let run = super::finished(&child.wait_with_output().unwrap());
        if milliseconds > 0 && run.code == 0 {
            println!("finished within {milliseconds} ms");
            sandbox.results("out/deep");
            return;
        }
        assert_eq!((run.code, run.err.as_str()), (130, "cancelled\n"), "after {milliseconds} ms: {}", run.out);
        assert_eq!(sandbox.names("."), ["spikes.mesh"]);
    }
}

/// Returns once the process catches the signal 2.
fn wait_for_handler(child: &Child) {
    let catches = || {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
        let mask = status.lines().find_map(|l| l.strip_prefix("SigCgt:")).unwrap().trim();
        u64::from_str_radix(mask, 16).unwrap() & 0b10 != 0
    };
    while !catches() {
        std::thread::sleep(Duration::from_millis(5));
    }
}
