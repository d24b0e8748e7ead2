//! The command as a user runs it.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod compare;
#[path = "../../../polycube/tests/common/data.rs"]
mod data;
mod demo;
mod failures;
mod guides;
mod inspect;
mod interrupt;
mod make;
mod others;
mod real;
mod remesh;
mod simplify;
mod validate;
mod view;

use polycube::generate::Example;
use polycube::mesh::CellKind;
use polycube::mesh::{self, Mesh, Point};
use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A folder that goes away with the test, and the command run in it.
pub(crate) struct Sandbox(TempDir);

/// What a run gave.
pub(crate) struct Run {
    /// The exit code.
    pub code: i32,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Sandbox {
    /// An empty folder.
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// The path of the file `name`.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The bytes of a file.
    pub fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap()
    }

    /// A file read as JSON.
    pub fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.read(name)).unwrap()
    }

    /// Writes a text file.
    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    /// Writes a mesh in the format that `name` tells.
    pub fn write_mesh(&self, name: &str, mesh: &Mesh) {
        mesh::write(&self.path(name), mesh, &[]).unwrap();
    }

    /// The names in a folder, hidden ones too.
    pub fn names(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.path(folder)).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The name of the mesh in a folder that a run filled with its four files.
    pub fn results(&self, folder: &str) -> String {
        let mut names = self.names(folder);
        assert_eq!(names.len(), 4, "{names:?}");
        assert_eq!(names.split_off(2), ["report.json", "structure.json"]);
        let labels = names.iter().position(|n| n == "polycube.labels").unwrap();
        names.remove(1 - labels)
    }

    /// Reads a result with its labels and asserts that it is an exact polycube with the counts reported.
    pub fn confirm(&self, folder: &str) {
        let mesh = self.results(folder);
        let line = format!("inspect --json {folder}/{mesh} --labels {folder}/polycube.labels");
        let found: Value = serde_json::from_str(&self.ok(&line)).unwrap();
        assert_eq!(found["counts"], self.json(&format!("{folder}/report.json"))["after"], "{line}");
        assert_eq!(found["deviation"]["distance"], 0.0);
        let levels = found["levels"].as_array().unwrap().iter().flat_map(|l| l.as_array().unwrap());
        assert!(levels.map(|x| x.as_f64().unwrap()).all(|x| x.fract() == 0.0));
    }

    /// The command, not yet started.
    pub fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_polycube"));
        command.current_dir(self.0.path()).args(line.split_whitespace());
        command
    }

    /// Runs the command to its end.
    pub fn run(&self, line: &str) -> Run {
        finished(&self.command(line).output().unwrap())
    }

    /// Runs the command, which must succeed.
    pub fn ok(&self, line: &str) -> String {
        let run = self.run(line);
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{line}: {}", run.out);
        run.out
    }

    /// Runs the command, which must fail with `code` and say each of `words` on standard error.
    pub fn fails(&self, line: &str, code: i32, words: &[&str]) {
        let run = self.run(line);
        assert_eq!(run.code, code, "{line}: {}", run.err);
        for word in words {
            assert!(run.err.contains(word), "{line}: no '{word}' in: {}", run.err);
        }
        assert!(!run.err.contains("panicked"), "{line}: {}", run.err);
    }
}

fn finished(output: &Output) -> Run {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Run { code: output.status.code().unwrap(), out: text(&output.stdout), err: text(&output.stderr) }
}

/// A coarse mesh of an example that has something to align.
pub fn coarse(example: Example, kind: CellKind) -> Mesh {
    example.voxels(1).unwrap().mesh(kind, 6.0).unwrap()
}

/// A smooth shape for a polycube.
pub fn bent(polycube: &Mesh) -> Mesh {
    let bend = |p: &Point| Point::new(p.x + 0.004 * p.y * p.z, p.y + 0.003 * p.x * p.x, 1.2 * p.z);
    polycube.moved(bend).unwrap()
}
