//! The JSON of blocks.

use super::*;
use serde_json::Value;

fn array(value: &Value) -> Vec<i64> {
    value.as_array().unwrap().iter().map(|x| x.as_i64().unwrap()).collect()
}

fn number(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

#[test]
fn points_are_exact_and_grids_hold_every_hexahedron() {
    let mesh = box_mesh();
    let file: Value = serde_json::from_str(&texts(SolverFormat::Json, &grouped(&mesh)).remove(0)).unwrap();
    assert_eq!((number(&file["version"]), number(&file["hexes"]), number(&file["inner_faces"])), (1, 12, 1));
    let coordinate = |p: &Value, a: usize| p[a].as_f64().unwrap();
    let points = file["points"].as_array().unwrap();
    let points: Vec<Point> = points.iter().map(|p| Point::from([0, 1, 2].map(|a| coordinate(p, a)))).collect();
    assert_eq!(points, mesh.points());
    let mut found = BTreeSet::new();
    for block in file["blocks"].as_array().unwrap() {
        let vertices = array(&block["vertices"]);
        let size: [i64; 3] = array(&block["size"]).try_into().unwrap();
        let at = |i: i64, j: i64, k: i64| vertices[((k * (size[1] + 1) + j) * (size[0] + 1) + i) as usize] as u32;
        for n in 0..size.iter().product() {
            let [i, j, k] = [n % size[0], n / size[0] % size[1], n / size[0] / size[1]];
            let corner = |octant: i64| at(i + (octant & 1), j + (octant >> 1 & 1), k + (octant >> 2));
            found.insert((0..8).map(corner).collect::<BTreeSet<u32>>());
        }
    }
    assert_eq!(found, cells(&mesh).iter().map(|cell| cell.iter().copied().collect()).collect());
}

#[test]
fn faces_have_names_or_a_neighbour_and_edges_their_class() {
    let mesh = box_mesh();
    let file: Value = serde_json::from_str(&texts(SolverFormat::Json, &grouped(&mesh)).remove(0)).unwrap();
    let blocks = file["blocks"].as_array().unwrap();
    assert_eq!(blocks.iter().map(|b| b["name"].as_str().unwrap()).collect::<Vec<_>>(), ["block_0", "block_1"]);
    assert_eq!(array(&file["classes"]), [1, 2, 2, 2]);
    assert_eq!(blocks.iter().map(|b| array(&b["class"])).collect::<Vec<_>>(), [[0, 1, 2], [3, 1, 2]]);
    assert!(blocks.iter().all(|b| array(&b["sign"]) == [1, 1, 1]));
    let between = &blocks[0]["faces"][1];
    assert_eq!((number(&between["block"]), between["face"].as_str()), (1, Some("-i")));
    assert_eq!((array(&between["transform"]), array(&between["first"])), (vec![1, 2, 3], vec![0, 0, 0]));
    for (face, side) in SIDES.into_iter().enumerate() {
        let block = usize::from(face != 0);
        let patch = format!("facet_{}", 2 * face + block);
        assert_eq!(
            blocks[block]["faces"][face],
            match face {
                0 => serde_json::json!({ "patch": "facet_0", "side": "minus_x" }),
                _ => serde_json::json!({ "patch": patch, "side": side }),
            }
        );
    }
}
