//! The sixteen real polycubes, where the machine has them.

use polycube::mesh::{Mesh, read};
use std::path::PathBuf;

/// The folder of the models. Without one it says so and gives nothing, unless `POLYCUBE_REQUIRE_DATA` is 1.
pub fn folder() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");
    let folder = std::env::var_os("POLYCUBE_DATA").map_or_else(|| PathBuf::from(beside), PathBuf::from);
    if folder.join("reference.json").is_file() {
        return Some(folder);
    }
    let required = std::env::var("POLYCUBE_REQUIRE_DATA").is_ok_and(|x| x == "1");
    assert!(!required, "there is no data in {}", folder.display());
    println!("skipped: no data");
    None
}

/// The published numbers of every model.
pub fn reference() -> Option<serde_json::Map<String, serde_json::Value>> {
    let text = std::fs::read_to_string(folder()?.join("reference.json")).expect("the reference is readable");
    let value: serde_json::Value = serde_json::from_str(&text).expect("the reference is JSON");
    Some(value.as_object().expect("the reference is one object").clone())
}

/// Names and polycubes of all models, sorted; none where there is no data.
pub fn models() -> Vec<(String, Mesh)> {
    let names = reference().map(|r| r.keys().cloned().collect::<Vec<_>>()).unwrap_or_default();
    assert!(names.is_empty() || names.len() == 16, "sixteen models are expected");
    names.into_iter().map(|name| (name.clone(), model(&name, "polycube.obj"))).collect()
}

/// One file of a model.
pub fn model(name: &str, kind: &str) -> Mesh {
    let path = folder().expect("there is data").join(format!("{name}.{kind}"));
    read(&path).expect("the model is readable")
}
