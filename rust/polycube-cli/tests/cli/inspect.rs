//! `polycube inspect`.

use super::{CellKind, Example, Sandbox, coarse};
use polycube::mesh::Point;
use serde_json::{Value, json};

fn inspect(sandbox: &Sandbox, line: &str) -> Value {
    serde_json::from_str(&sandbox.ok(&format!("inspect --json {line}"))).unwrap()
}

#[test]
fn everything_found_is_told() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("spikes.obj", &coarse(Example::CubeSpikes, CellKind::Triangles));
    let text = sandbox.ok("inspect spikes.obj");
    for line in [
        "components           1",
        "genus                0",
        "charts               +X 6, -X 6, +Y 6, -Y 6, +Z 6, -Z 6",
        "corners              56 (56 of valence 3)",
        "facets               36, 6 with holes",
        "off exact by         none, it is exact",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    let found = inspect(&sandbox, "spikes.obj");
    let listed = inspect(&sandbox, "spikes.obj --facets")["facet_list"].clone();
    let first: Vec<u64> = listed.as_array().unwrap().iter().map(|f| f["face"].as_u64().unwrap()).collect();
    assert!(first.contains(&0) && first.len() == 36, "{first:?}");
    assert_eq!(first.iter().collect::<std::collections::BTreeSet<_>>().len(), 36, "no two facets share a face");
    assert_eq!(found["corners"], 56);
    assert_eq!(found["edges"], 84);
    assert_eq!(found["charts"], json!({"+X": 6, "-X": 6, "+Y": 6, "-Y": 6, "+Z": 6, "-Z": 6}));
    assert!(found["counts"]["blocks_padded"].as_u64().unwrap() > 111);
    let levels = |axis: usize| found["levels"][axis].as_array().unwrap().len();
    assert_eq!([0, 1, 2].map(levels), [12; 3]);
}

#[test]
fn all_kinds_of_cells_have_one_structure() {
    let sandbox = Sandbox::new();
    let found = CellKind::ALL.map(|kind| {
        let name = format!("{kind}.vtu");
        sandbox.write_mesh(&name, &coarse(Example::DoubleTorus, kind));
        let mut found = inspect(&sandbox, &name);
        for key in ["file", "cell_kind", "cells", "vertices", "boundary_faces"] {
            found.as_object_mut().unwrap().remove(key).unwrap();
        }
        found
    });
    assert_eq!(found[0]["genus"], 2);
    for other in &found[1..] {
        assert_eq!(*other, found[0]);
    }
}

#[test]
fn what_is_nearly_a_polycube_is_accepted_and_reported() {
    let sandbox = Sandbox::new();
    let mut mesh = coarse(Example::Ring, CellKind::Triangles);
    let askew = |(i, p): (usize, &mut Point)| {
        *p *= 0.37;
        p.z += 0.05 * (i as f64).sin();
    };
    mesh = mesh.edited(|points, _| points.iter_mut().enumerate().for_each(askew)).unwrap();
    sandbox.write_mesh("ring.ply", &mesh);
    let found = inspect(&sandbox, "ring.ply");
    assert_eq!((&found["genus"], &found["corners"]), (&json!(1), &json!(80)));
    let degrees = found["deviation"]["degrees"].as_f64().unwrap();
    assert!(degrees > 0.1 && degrees < 30.0);
    sandbox.fails("inspect ring.ply --angle-tolerance 0.01", 3, &["raise the angle tolerance"]);
    sandbox.fails("inspect ring.ply --level-tolerance 0.00001", 3, &["raise the level tolerance"]);
}
