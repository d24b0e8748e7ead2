//! The sixteen real polycubes and what is published of them.

use super::data::folder;
use polycube::mesh::{Mesh, read};

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
    names.into_iter().filter_map(|name| Some((name.clone(), model(&name)?))).collect()
}

/// The polycube of a model as a surface; nothing where there is no data.
pub fn model(name: &str) -> Option<Mesh> {
    let path = folder()?.join(format!("{name}.polycube.obj"));
    Some(read(&path).expect("the model is readable"))
}
