//! `polycube simplify`.

use super::{CellKind, Example, Sandbox, bent, coarse};
use polycube::mesh::{self, Format};
use polycube::structure::{Polycube, Tolerance};
use serde_json::Value;

#[test]
fn every_format_goes_in_and_out() {
    let sandbox = Sandbox::new();
    for kind in CellKind::ALL {
        let mesh = coarse(Example::SteppedL, kind);
        let able: Vec<Format> = Format::ALL.into_iter().filter(|f| f.holds(mesh.cells().kind())).collect();
        let mut seen: Option<Value> = None;
        for (i, from) in able.iter().enumerate() {
            let to = able[(i + 1) % able.len()];
            let (name, out) = (format!("{kind}.{from}"), format!("{kind}-{from}"));
            sandbox.write_mesh(&name, &mesh);
            sandbox.ok(&format!("simplify {name} -o {out} --format {to}"));
            let result = mesh::read(&sandbox.path(&format!("{out}/polycube.{to}"))).unwrap();
            assert_eq!(result.cells().kind(), mesh.cells().kind());
            assert_eq!(result.cells().len(), mesh.cells().len(), "{name} to {to}");
            let after = sandbox.json(&format!("{out}/report.json"))["after"].clone();
            assert_eq!(*seen.get_or_insert(after.clone()), after, "{name}");
            sandbox.confirm(&out);
        }
    }
}

#[test]
fn the_format_of_the_input_is_kept_and_a_pair_is_measured() {
    let sandbox = Sandbox::new();
    for format in Format::ALL {
        let mesh = coarse(Example::Ring, CellKind::Triangles);
        sandbox.write_mesh(&format!("p.{format}"), &mesh);
        sandbox.write_mesh(&format!("s.{format}"), &bent(&mesh));
        let out = format!("out-{format}");
        sandbox.ok(&format!("simplify p.{format} --shape s.{format} -o {out}"));
        assert_eq!(sandbox.results(&out), format!("polycube.{format}"));
        let report = sandbox.json(&format!("{out}/report.json"));
        assert!(report["distortion"][0]["angle"].as_f64().unwrap() > 1.0);
    }
}

#[test]
fn the_report_has_every_promised_key() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("ring.obj", &coarse(Example::Ring, CellKind::Quads));
    let text = sandbox.ok("simplify ring.obj -o out --scale 2 --lambda-min 0.25");
    let report = sandbox.json("out/report.json");
    assert_eq!((&report["strategy"], &report["valid"]), (&"best".into(), &true.into()));
    let count = report["after"]["surface_patches"].as_u64();
    assert!(report["bound"]["count"].as_u64() <= count, "the bound is at most what was reached");
    assert_eq!(report["front"][0]["count"].as_u64(), count, "the front begins with the fewest");
    assert_eq!((&report["scale"], &report["output"]), (&2.0.into(), &"polycube.obj".into()));
    let options = &report["options"];
    assert_eq!(
        (&options["lambda_min"], &options["scale"], &options["simplicity"]),
        (&0.25.into(), &2.0.into(), &1.0.into())
    );
    assert!(options["effort"]["time_limit"].is_null());
    for count in ["surface_patches", "blocks", "blocks_padded"] {
        let [before, after] = ["before", "after"].map(|when| report[when][count].as_u64().unwrap());
        assert!(after < before, "{count}");
        assert!(text.contains(&before.to_string()) && text.contains(&after.to_string()));
    }
    for stage in ["read", "structure", "align", "morph", "write", "total"] {
        assert!(report["seconds"][stage].as_f64().unwrap() >= 0.0, "{stage}");
    }
    for round in report["rounds"].as_array().unwrap() {
        assert!(round["lambda"].as_f64().unwrap() >= 0.25 && round["counts"]["blocks"].is_u64());
        assert!(round["pairs"].is_u64() && round["alignments"].is_u64());
    }
    for key in ["max_displacement", "flipped_elements", "deviation", "notes", "input"] {
        assert!(!report[key].is_null(), "{key}");
    }
}

#[test]
fn the_structure_file_ties_corners_to_vertices_and_levels() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Triangles));
    sandbox.ok("simplify l.obj -o out --edge-length 0.5");
    let [before, after] = ["l.obj", "out/polycube.obj"].map(|name| mesh::read(&sandbox.path(name)).unwrap());
    let file = sandbox.json("out/structure.json");
    assert_eq!((&file["scale"], &file["valid"]), (&2.0.into(), &true.into()));
    let corners = file["corners"].as_array().unwrap();
    assert_eq!(corners.len(), 52);
    for corner in corners {
        let vertex = corner["vertex"].as_u64().unwrap() as usize;
        for axis in 0..3 {
            let level = &file["levels"][corner["levels"][axis].as_u64().unwrap() as usize];
            assert_eq!(level["axis"], axis);
            assert_eq!((&level["before"], &level["after"]), (&corner["before"][axis], &corner["after"][axis]));
            assert_eq!(corner["before"][axis].as_f64(), Some(before.points()[vertex][axis]));
            assert_eq!(corner["after"][axis].as_f64(), Some(after.points()[vertex][axis]));
        }
    }
    assert_eq!((file["facets"].as_array().unwrap().len(), file["edges"].as_array().unwrap().len()), (32, 78));
    assert!(file["facets"][0]["loops"][0][0]["edge"].is_u64() && file["facets"][0]["label"].is_u64());
}

#[test]
fn labels_from_a_file_replace_the_normals() {
    let sandbox = Sandbox::new();
    let mut mesh = coarse(Example::SteppedL, CellKind::Triangles);
    let polycube = Polycube::new(&mesh, None, &Tolerance::default()).unwrap();
    let labels: Vec<i8> = polycube.labels().map(|l| l.index() as i8).collect();
    // Half as high, so that the inner vertex of a facet that is moved a little tilts its faces more.
    let inner = polycube.vertex_levels.iter().position(|l| l.iter().flatten().count() == 1).unwrap();
    let axis = polycube.vertex_levels[inner].iter().position(Option::is_some).unwrap();
    mesh = mesh.edited(|points, _| points[inner][axis] += 3.0).unwrap();
    sandbox.write_mesh("l.obj", &mesh);
    mesh::write_labels(&sandbox.path("l.labels"), &labels).unwrap();
    sandbox.fails("simplify l.obj -o out --angle-tolerance 10", 3, &["give labels in a label file"]);
    sandbox.ok("simplify l.obj -o out --angle-tolerance 10 --labels l.labels");
    assert_eq!(sandbox.json("out/report.json")["input"]["labels"], "l.labels");
}

#[test]
fn naive_rounding_that_breaks_is_told_and_not_written() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    sandbox.ok("simplify l.obj -o out --strategy naive");
    assert_eq!(sandbox.json("out/report.json")["strategy"], "naive");
    sandbox.fails("simplify l.obj -o out --strategy naive --scale 0.05", 3, &["not a valid polycube", "report.json"]);
    assert_eq!(sandbox.names("out"), ["report.json", "structure.json"], "the older result is gone, too");
    for name in ["out/report.json", "out/structure.json"] {
        let file = sandbox.json(name);
        assert_eq!(file["valid"], false);
        assert!(file["broken"][0]["facets"][1].is_u64() && file["broken"][0]["point"][2].is_f64());
    }
    assert!(sandbox.json("out/report.json")["output"].is_null());
    sandbox.ok("simplify l.obj -o out --scale 0.05");
    assert_eq!(sandbox.results("out"), "polycube.obj");
}

#[test]
fn all_options_are_in_the_report() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    sandbox.run("simplify l.obj -o out --simplicity 0.5 --time-limit 90.5 --steps 9 --max-displacement 40");
    let options = &sandbox.json("out/report.json")["options"];
    assert_eq!((&options["simplicity"], &options["max_displacement"]), (&0.5.into(), &40.0.into()));
    assert_eq!((&options["effort"]["time_limit"], &options["effort"]["steps_per_level"]), (&90.5.into(), &9.into()));
    assert!(options["scale"].is_null());
}

#[test]
fn no_mesh_of_an_earlier_run_stays_and_no_input_goes() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.obj", &coarse(Example::SteppedL, CellKind::Quads));
    sandbox.ok("simplify l.obj -o out --format vtk");
    sandbox.ok("simplify l.obj -o out --format ply");
    assert_eq!(sandbox.results("out"), "polycube.ply");
    sandbox.ok("simplify out/polycube.ply --labels out/polycube.labels -o out --format obj");
    assert_eq!(sandbox.names("out").len(), 5, "{:?}", sandbox.names("out"));
    assert!(sandbox.names("out").contains(&"polycube.ply".to_owned()), "it was read");
    std::fs::create_dir(sandbox.path("mine")).unwrap();
    sandbox.write("mine/polycube.off", "");
    sandbox.ok("simplify l.obj -o mine");
    assert_eq!(sandbox.names("mine").len(), 5, "what lies in a folder that is no result is not ours");
}

#[test]
fn both_solvers_and_every_scale_give_valid_results() {
    let sandbox = Sandbox::new();
    let mesh = polycube::parts::scale(&coarse(Example::Ring, CellKind::Triangles), 0.37).unwrap();
    sandbox.write_mesh("ring.off", &mesh);
    for options in ["", "--solver linear", "--scale 0.37", "--scale 3", "--edge-length 0.9"] {
        sandbox.ok(&format!("simplify ring.off -o out {options}"));
        sandbox.confirm("out");
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let sandbox = Sandbox::new();
    let mesh = coarse(Example::DoubleTorus, CellKind::Tetrahedra);
    sandbox.write_mesh("p.mesh", &mesh);
    sandbox.write_mesh("s.mesh", &bent(&mesh));
    let run = |out: &str| {
        sandbox.ok(&format!("simplify p.mesh --shape s.mesh -o {out} --format vtu"));
        let mut report = sandbox.json(&format!("{out}/report.json"));
        report.as_object_mut().unwrap().remove("seconds").unwrap();
        let [mesh, structure] = ["polycube.vtu", "structure.json"].map(|n| sandbox.read(&format!("{out}/{n}")));
        (report.to_string(), mesh, structure)
    };
    assert!(run("one") == run("two"));
}

#[test]
fn quiet_is_quiet() {
    let sandbox = Sandbox::new();
    sandbox.write_mesh("l.stl", &coarse(Example::SteppedL, CellKind::Triangles));
    assert_eq!(sandbox.ok("simplify l.stl -o out --quiet"), "");
    assert_eq!(sandbox.results("out"), "polycube.stl");
}
