//! `polycube remesh`.

use super::Sandbox;
use polycube::generate::{Example, example};
use polycube::measure::cell_qualities;
use polycube::mesh::{self, CellKind, Cells};

/// A sandbox with a pair named `shape.EXT` and `cube.EXT`.
fn sandbox(kind: CellKind, extension: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    let (polycube, shape) = example(Example::SteppedL, 1, kind).unwrap();
    sandbox.write_mesh(&format!("cube.{extension}"), &polycube);
    sandbox.write_mesh(&format!("shape.{extension}"), &shape);
    sandbox
}

const FILES: [&str; 8] = [
    "hexes.mesh",
    "hexes.vtu",
    "layout.obj",
    "layout.vtk",
    "polycube.labels",
    "polycube.mesh",
    "quads.obj",
    "report.json",
];

#[test]
fn all_files_are_there_and_read_back() {
    let sandbox = sandbox(CellKind::Tetrahedra, "mesh");
    let out = sandbox.ok("remesh shape.mesh --polycube cube.mesh -o out --hexes 2000 --max-hausdorff 5");
    assert!(out.contains("hexahedra") && out.contains("scaled Jacobian"), "{out}");
    assert_eq!(sandbox.names("out"), FILES);
    let report = sandbox.json("out/report.json");
    assert_eq!((&report["inverted"], &report["inverted_cells"]), (&0.into(), &serde_json::json!([])));
    assert_eq!(report["hex_blocks"], report["after"]["blocks_padded"]);
    for (file, cells) in [("hexes.mesh", "hexes"), ("hexes.vtu", "hexes"), ("layout.vtk", "hex_blocks")] {
        let mesh = mesh::read(&sandbox.path(&format!("out/{file}"))).unwrap();
        assert_eq!(report[cells].as_u64().unwrap() as usize, mesh.cells().len(), "{file}");
        assert!(cell_qualities(&mesh).unwrap().iter().all(|q| q.1 > 0.0), "{file}");
    }
    let quads = mesh::read(&sandbox.path("out/quads.obj")).unwrap();
    assert!(!String::from_utf8_lossy(&sandbox.read("out/quads.obj")).contains("vt "));
    assert!(matches!(quads.cells(), Cells::Quads(_)));
    assert_eq!(report["quads"].as_u64().unwrap() as usize, quads.cells().len());
    let text = String::from_utf8_lossy(&sandbox.read("out/hexes.vtu")).into_owned();
    assert!(["scaled_jacobian", "block_id", "label"].iter().all(|f| text.contains(&format!("\"{f}\""))));
}

#[test]
fn a_surface_alone_has_no_hexahedra() {
    let sandbox = sandbox(CellKind::Triangles, "obj");
    let line = "remesh shape.obj --polycube cube.obj -o out --surface-only --quiet --max-hausdorff 5";
    assert_eq!(sandbox.ok(&format!("{line} --format ply --format msh")), "");
    let expected =
        ["layout.obj", "polycube.labels", "polycube.obj", "quads.msh", "quads.obj", "quads.ply", "report.json"];
    assert_eq!(sandbox.names("out"), expected);
    assert_eq!(sandbox.json("out/report.json")["hexes"], 0);
    let plain = mesh::read(&sandbox.path("out/quads.obj")).unwrap();
    sandbox.ok(&format!("{line} --uv"));
    assert_eq!(mesh::read(&sandbox.path("out/quads.obj")).unwrap(), plain);
    let text = String::from_utf8(sandbox.read("out/quads.obj")).unwrap();
    let corners: Vec<&str> =
        text.lines().filter_map(|line| line.strip_prefix("f ")).flat_map(str::split_whitespace).collect();
    let numbers: Vec<usize> = corners.iter().map(|word| word.split_once('/').unwrap().1.parse().unwrap()).collect();
    assert_eq!(numbers.len(), 4 * plain.cells().len());
    // A place for each vertex in each chart, in the order in which faces name them.
    let count = text.lines().filter(|line| line.starts_with("vt ")).count();
    let mut last = 0;
    numbers.iter().for_each(|&n| if n == last + 1 { last = n } else { assert!(n >= 1 && n <= last) });
    assert_eq!(last, count);
    assert!(count >= plain.points().len() && count < numbers.len());
}

#[test]
fn no_mesh_of_an_earlier_run_stays() {
    let sandbox = sandbox(CellKind::Triangles, "obj");
    let (polycube, shape) = example(Example::CubeSpikes, 1, CellKind::Triangles).unwrap();
    sandbox.write_mesh("cube.ply", &polycube);
    sandbox.write_mesh("shape.ply", &shape);
    let remesh = |line: &str| {
        let run = sandbox.run(&format!("remesh {line} -o out --quiet --max-hausdorff 50"));
        assert!(matches!(run.code, 0 | 4), "{line}: {}", run.err);
    };
    remesh("shape.obj --polycube cube.obj --hexes 400 --format vtk");
    assert!(sandbox.names("out").contains(&"hexes.vtk".to_owned()));
    remesh("shape.ply --polycube cube.ply --surface-only");
    assert_eq!(sandbox.names("out"), ["layout.obj", "polycube.labels", "polycube.ply", "quads.obj", "report.json"]);
}

#[test]
fn formats_for_solvers_may_be_several_and_go_with_the_next_run() {
    let sandbox = sandbox(CellKind::Triangles, "obj");
    let line = "remesh shape.obj --polycube cube.obj -o out --quiet --hexes 400 --max-hausdorff 50";
    let formats = "--format msh --format foam --format vtk --format MSH --format su2 --format inp";
    sandbox.ok(&format!("{line} {formats} --format json --format xyz --format blockmesh"));
    let more = ["blockmesh", "blocks.json", "foam", "hexes.inp", "hexes.msh", "hexes.su2", "hexes.vtk", "hexes.xyz"];
    let mut all: Vec<&str> = FILES.map(|file| if file == "polycube.mesh" { "polycube.obj" } else { file }).to_vec();
    let without = all.clone();
    all.extend(more);
    all.sort_unstable();
    assert_eq!(sandbox.names("out"), all);
    let files = ["boundary", "cellZones", "faces", "neighbour", "owner", "points"];
    assert_eq!(sandbox.names("out/foam/constant/polyMesh"), files);
    assert_eq!(sandbox.names("out/blockmesh/system"), ["blockMeshDict"]);
    assert_eq!(sandbox.names("out/blockmesh/constant/triSurface"), ["between.obj", "boundary.obj"]);
    sandbox.ok(line);
    assert_eq!(sandbox.names("out"), without);
}

/// The upper half of the shape is the group `lid`, as OBJ has it; the boundary of the mesh has its area.
#[test]
fn groups_of_the_shape_are_on_the_boundary() {
    let sandbox = sandbox(CellKind::Triangles, "obj");
    let shape = mesh::read(&sandbox.path("shape.obj")).unwrap();
    let text = String::from_utf8(sandbox.read("shape.obj")).unwrap();
    let height = |i: usize| shape.cells().cell(i).iter().map(|&v| shape.points()[v as usize].z).sum::<f64>();
    let middle = (0..shape.cells().len()).map(height).sum::<f64>() / shape.cells().len() as f64;
    let faces = (0..shape.cells().len()).zip(text.lines().filter(|line| line.starts_with('f')));
    let named = faces.map(|(i, line)| format!("g {}\n{line}\n", if height(i) > middle { "the lid" } else { "base" }));
    let vertices = text.lines().filter(|line| line.starts_with('v')).map(|line| format!("{line}\n"));
    sandbox.write("painted.obj", &vertices.chain(named).collect::<String>());
    let line =
        "remesh shape.obj --polycube cube.obj -o out --quiet --hexes 1500 --max-hausdorff 50 --groups painted.obj";
    sandbox.ok(&format!("{line} --format msh --format inp --format su2 --format foam --format json"));
    let area = |surface: &mesh::GroupedSurface, name: &str| {
        let number = surface.groups().names().iter().position(|n| n == name).unwrap() as u32;
        let at = |v: u32| surface.mesh().points()[v as usize];
        let of = |i: usize| match *surface.mesh().cells().cell(i) {
            [a, b, c] if surface.groups().of()[i] == number => (at(b) - at(a)).cross(&(at(c) - at(a))).norm() / 2.0,
            _ => 0.0,
        };
        (0..surface.mesh().cells().len()).map(of).sum::<f64>()
    };
    let [was, is] = ["painted.obj", "out/hexes.msh"].map(|f| mesh::read_grouped_surface(&sandbox.path(f)).unwrap());
    for name in ["the_lid", "base"] {
        let (was, is) = (area(&was, name), area(&is, name));
        assert!((is / was - 1.0).abs() < 0.02, "{name}: {was} became {is}");
    }
    let held = |file: &str, text: &str| String::from_utf8_lossy(&sandbox.read(file)).contains(text);
    assert!(held("out/hexes.su2", "NMARK= 2\n") && held("out/hexes.inp", "*SURFACE, TYPE=ELEMENT, NAME=the_lid\n"));
    assert!(held("out/foam/constant/polyMesh/boundary", "    the_lid\n") && held("out/blocks.json", "plus_x"));
    assert_eq!(sandbox.json("out/report.json")["input"]["groups"], "painted.obj");
    let line = "remesh shape.obj --polycube cube.obj -o no --format msh --groups";
    sandbox.fails(&format!("{line} cube.obj"), 1, &["cube.obj", "no face", "in a group"]);
    sandbox.fails(&format!("{line} none.obj"), 1, &["none.obj"]);
    sandbox.fails("remesh shape.obj --polycube cube.obj -o no --groups painted.obj", 2, &["--groups", "--format msh"]);
    assert!(!sandbox.path("no").exists());
}

#[test]
fn solvers_want_hexahedra() {
    let sandbox = sandbox(CellKind::Triangles, "obj");
    let line = "remesh shape.obj --polycube cube.obj -o no";
    for format in ["su2", "foam", "json", "xyz", "blockmesh"] {
        sandbox.fails(&format!("{line} --surface-only --format {format}"), 2, &[format, "--surface-only"]);
    }
    sandbox.fails(&format!("{line} --format cgns"), 2, &["cgns", "msh, inp, su2, foam, json, xyz, blockmesh"]);
    assert!(!sandbox.path("no").exists());
}

#[test]
fn a_surface_too_far_away_is_written_with_exit_code_4() {
    let sandbox = sandbox(CellKind::Triangles, "obj");
    let line = "remesh shape.obj --polycube cube.obj -o out --hexes 400 --max-hausdorff 0.0001";
    sandbox.fails(line, 4, &["Hausdorff"]);
    assert_eq!(sandbox.names("out").len(), 8);
    assert_eq!(sandbox.json("out/report.json")["within_hausdorff"], false);
    sandbox.fails("remesh shape.obj --polycube cube.obj -o no --hexes 0", 2, &["--hexes"]);
    sandbox.fails("remesh shape.obj --polycube cube.obj -o no --hexes 9 --scale 1", 2, &["cannot be used"]);
    sandbox.fails("remesh shape.obj --polycube cube.obj -o no --format stl", 2, &["stl"]);
    assert!(!sandbox.path("no").exists());
}
